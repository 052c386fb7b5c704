// The page without its data.
#pragma once

#include <string_view>

namespace regionmesh {

/// The text of viewer/dist/page.html.
extern const std::string_view kPageTemplate;

}  // namespace regionmesh
