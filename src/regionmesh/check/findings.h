// Collects violations: counts all, lists some.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "regionmesh/check/check.h"

namespace regionmesh {

class Findings {
public:
    Findings(CheckReport& report, std::uint32_t listed) : report_(report), listed_(listed) {}

    void add(ViolationKind kind, std::vector<std::uint32_t> vertices, std::vector<std::uint32_t> faces,
             std::string text) {
        if (report_.counts[static_cast<int>(kind)]++ < listed_)
            report_.violations.push_back({kind, std::move(vertices), std::move(faces), std::move(text)});
    }

private:
    CheckReport& report_;
    std::uint32_t listed_;
};

/// "region 17", in the words of the input where they are known.
inline std::string region_name(const CheckOptions& options, Label label) {
    if (is_exterior(label)) return "the exterior";
    return "region " + (options.label_text ? options.label_text(label) : std::to_string(label) + " (dense)");
}

/// The four parts of check(); each reads the model and adds what it finds.
void check_stars(const Model& model, const CheckOptions& options, CheckReport& report, Findings& findings);
void check_crossing(const Model& model, Findings& findings);
void check_nesting(const Model& model, const CheckOptions& options, Findings& findings);
void check_against_labels(const CheckOptions& options, CheckReport& report, Findings& findings);

}  // namespace regionmesh
