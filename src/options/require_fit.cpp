#include <fmt/core.h>

#include <algorithm>

#include "regionmesh/error.h"
#include "regionmesh/options.h"

namespace regionmesh {
namespace {

const char* kind_text(InputKind kind) {
    return kind == kVolumeInput ? "a volume of samples" : kind == kTableInput ? "a table of points" : "a mesh";
}

}  // namespace

InputKind kind_of_input(const std::vector<std::string>& inputs) {
    const auto found = std::ranges::find_if(inputs, [](const auto& input) { return holds_tetrahedra(input); });
    if (found == inputs.end()) return kVolumeInput;
    return is_mesh(*found) ? kMeshInput : kTableInput;
}

void require_fit(const Settings& settings, const std::vector<std::string>& inputs) {
    if (inputs.empty()) return;
    const InputKind kind = kind_of_input(inputs);
    if (kind != kVolumeInput && inputs.size() > 1)
        throw Error(ErrorCode::kUsage, inputs[1] + ": one table or mesh at a time; give one");
    for (const auto& [name, text] : settings.given) {
        const OptionSpec& option = *find_option(name);
        if ((option.inputs & kind) != 0) continue;
        const std::string value = option.kind == OptionKind::kFlag ? "" : ' ' + text;
        throw Error(ErrorCode::kUsage, fmt::format("{}{}: does not apply to {}, which is {}", option.flag(), value,
                                                   inputs[0], kind_text(kind)));
    }
}

void require_consistent(const Settings& settings) {
    if (!settings.volume.select.labels.empty() && settings.reconstruct.background.empty())
        throw Error(ErrorCode::kUsage,
                    "--labels: the other labels become background, and --no-background has none; leave out one");
    if (settings.reconstruct.cap) return;
    if (settings.hull)
        throw Error(ErrorCode::kUsage, "--hull closes the regions that --boundary open leaves open: give one");
    if (settings.reconstruct.preserve_volume)
        throw Error(ErrorCode::kUsage, "--preserve-volume: open regions have no volume; leave out --boundary open");
}

}  // namespace regionmesh
