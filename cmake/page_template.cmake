# The page that `regionmesh view` fills in becomes a string of the library. viewer/build makes it; it is kept in the tree,
# so that a build needs no Node.
set(page_template ${PROJECT_SOURCE_DIR}/viewer/dist/page.html)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page_template})
file(READ ${page_template} page_text)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/page_template.cpp @ONLY CONTENT
"#include \"page/page_template.h\"
namespace regionmesh {
const std::string_view kPageTemplate = R\"page(@page_text@)page\";
}
")
target_sources(regionmesh_formats PRIVATE ${PROJECT_BINARY_DIR}/page_template.cpp)
