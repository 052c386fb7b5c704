// Collects violations: counts all and lists the first of each kind. Names things in their sentences.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "regionmesh/check.h"

namespace regionmesh {

/// Each part of the work collects its own; they are appended in an order that does not depend on the threads.
class Findings {
public:
    explicit Findings(std::uint32_t listed = 0) : listed_(listed) {}

    /// text() makes the sentence; called only if the finding is listed. Returns it then, until the next is added.
    template <class Text>
    Violation* add(ViolationKind kind, std::vector<std::uint32_t> vertices, std::vector<std::uint32_t> faces,
                   Text&& text) {
        if (counts_[static_cast<int>(kind)]++ >= listed_) return nullptr;
        return &violations_.emplace_back(Violation{kind, std::move(vertices), std::move(faces), text(), {}, {}});
    }

    void append(Findings&& later) {
        std::array<std::uint64_t, kViolationKindCount> listed = counts_;
        for (Violation& violation : later.violations_)
            if (listed[static_cast<int>(violation.kind)]++ < listed_) violations_.push_back(std::move(violation));
        for (int kind = 0; kind < kViolationKindCount; ++kind) counts_[kind] += later.counts_[kind];
    }

    std::uint64_t count(ViolationKind kind) const { return counts_[static_cast<int>(kind)]; }

    /// The findings of a report, before anything else.
    void take_from(CheckReport&& report) {
        counts_ = report.counts;
        violations_ = std::move(report.violations);
    }

    void move_to(CheckReport& report) {
        report.counts = counts_;
        report.violations = std::move(violations_);
    }

private:
    std::uint32_t listed_;
    std::array<std::uint64_t, kViolationKindCount> counts_{};
    std::vector<Violation> violations_;
};

inline std::string name(VertexId v) { return "vertex " + std::to_string(index(v)); }
inline std::string name(FaceId f) { return "face " + std::to_string(index(f)); }
inline std::string name(VertexId u, VertexId v) {
    return "edge " + std::to_string(index(u)) + "-" + std::to_string(index(v));
}
/// "region 17", with the label of the input if label_text is set.
inline std::string region_name(const CheckOptions& options, Label label) {
    if (is_exterior(label)) return "the exterior";
    return "region " + (options.label_text ? options.label_text(label) : std::to_string(label) + " (dense)");
}

}  // namespace regionmesh
