#include "blocks/staged_labels.h"

#include "volume/section_window.h"

namespace regionmesh {

void StagedLabels::write(SectionReader& reader, LabelTable& labels, const std::filesystem::path& path,
                         const OutputOptions& options, const OnStrip& on_strip) {
    OutputFile file(path, options);
    SectionWindow window(reader, labels);
    const auto put = [&](std::span<const Label> section) {
        file.write({reinterpret_cast<const char*>(section.data()), section.size_bytes()});
    };
    while (window.advance()) {
        if (window.sections_read() == 2) put(window.low());
        put(window.high());
        if (on_strip) on_strip(window.low(), window.high(), window.is_last());
    }
    file.commit();
}

StagedLabels::StagedLabels(const std::filesystem::path& path, const Lattice& lattice, const Sweep& sweep)
    : file_(path), lattice_(lattice), sweep_(sweep) {
    const std::uint64_t samples = std::uint64_t{lattice.size[0]} * lattice.size[1] * lattice.size[2];
    if (file_.size() != samples * sizeof(Label))
        formats::fail(path, std::to_string(file_.size()) + " bytes instead of " +
                                std::to_string(samples * sizeof(Label)) + "; remove the file, and run again");
}

void StagedLabels::read(const IndexBox& box, std::uint32_t number, std::span<Label> section) const {
    const int u = sweep_.axes[0], v = sweep_.axes[1];
    const std::uint64_t width = lattice_.size[u], height = lattice_.size[v];
    const std::array<std::uint32_t, 3> size = box.size();
    const bool is_whole_width = size[u] == width;
    const std::uint32_t reads = is_whole_width ? 1 : size[v];
    const std::size_t count = is_whole_width ? section.size() : size[u];
    for (std::uint32_t row = 0; row < reads; ++row) {
        const std::uint64_t first = (number * height + box.low[v] + row) * width + box.low[u];
        const auto bytes = std::as_writable_bytes(section.subspan(row * count, count));
        if (file_.read(first * sizeof(Label), bytes) != bytes.size())
            formats::fail_section(file_.path(), number, "the file ends early; remove it, and run again");
    }
}

}  // namespace regionmesh
