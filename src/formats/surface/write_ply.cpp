#include <fmt/format.h>

#include <string>
#include <string_view>

#include "formats/codec/number_writer.h"
#include "formats/surface/file_surface.h"
#include "formats/surface/mesh_formats.h"
#include "surface/region_colours.h"

namespace regionmesh {
namespace {

constexpr std::string_view kVertex =
    "property double x\nproperty double y\nproperty double z\nproperty uchar node_type\n";
constexpr std::string_view kFace = "property list uchar uint vertex_indices\n";
/// Labels that fit 32 bits with their sign.
constexpr std::string_view kLabels = "property int label_first\nproperty int label_second\n";
/// Other labels as two words each: PLY has no integers of 64 bits.
constexpr std::string_view kWideLabels =
    "property uint label_first_low\nproperty uint label_first_high\nproperty uint label_second_low\nproperty uint "
    "label_second_high\n";

constexpr std::string_view kColour = "property uchar red\nproperty uchar green\nproperty uchar blue\n";

bool all_labels_fit_32_bits(const FileView& view) {
    const auto fits = [](InputLabel label) { return label == static_cast<std::int32_t>(label); };
    const LabelTable& labels = view.labels();
    for (Label label = 0; label < labels.size(); ++label)
        if (!fits(labels.input(label))) return false;
    return fits(view.exterior_label());
}

/// Which labels a face has.
enum class FaceLabels { kBoth, kNone };

/// colour_of(FaceId) is red, green and blue.
template <class ColourOf>
void write(const FileView& view, FaceLabels face_labels, const ColourOf& colour_of, OutputFile& file) {
    const Mesh& mesh = view.mesh();
    const bool is_wide = !all_labels_fit_32_bits(view);
    std::string comments = fmt::format("comment exterior_label {}\n", view.exterior_label());
    if (view.labels().has_large()) comments += "comment unsigned_labels 1\n";
    for (const std::string& comment : coordinate_comments(view.coordinates()))
        comments += fmt::format("comment {}\n", comment);
    if (face_labels == FaceLabels::kBoth) {
        const std::vector<InputLabel> background = view.background_labels();
        if (background.empty()) comments += "comment no_background 0\n";
        for (const InputLabel label : background) comments += fmt::format("comment background {}\n", label);
    }
    view.for_names([&](Label label, const std::string& name) {
        comments += fmt::format("comment region {} {}\n", view.labels().input(label), name);
    });
    view.for_given_colours([&](Label label, std::uint32_t colour) {
        comments += fmt::format("comment colour {} {}\n", view.labels().input(label), hex_of(colour));
    });
    file.write(
        fmt::format("ply\nformat binary_little_endian 1.0\n{}element vertex {}\n{}element face {}\n{}{}{}end_header\n",
                    comments, mesh.vertex_count(), kVertex, mesh.face_count(), kFace,
                    face_labels == FaceLabels::kNone ? ""
                    : is_wide                        ? kWideLabels
                                                     : kLabels,
                    kColour));
    formats::NumberWriter numbers(file);
    view.for_vertices([&](VertexId v) {
        const Vec3 position = mesh.position(v);
        for (int axis = 0; axis < 3; ++axis) numbers.put(position[axis]);
        numbers.put(view.node_type(v));
    });
    view.for_faces([&](FaceId f) {
        const FileFace face = view.face(f);
        numbers.put(std::uint8_t{3});
        for (const std::uint32_t v : face.vertices) numbers.put(v);
        if (face_labels == FaceLabels::kBoth)
            for (const InputLabel label : face.labels)  // two words of 32 bits, the lower first, are one of 64
                is_wide ? numbers.put(label) : numbers.put(static_cast<std::int32_t>(label));
        for (const std::uint8_t part : colour_of(f)) numbers.put(part);
    });
    numbers.flush();
}

}  // namespace

void write_ply(const FileView& view, OutputFile& file) { write(view, FaceLabels::kBoth, FaceColours(view), file); }

void write_region_ply(const FileView& view, const RegionStyle& style, OutputFile& file) {
    write(
        view, FaceLabels::kNone, [&](FaceId) { return rgb_of(style.colour); }, file);
}

}  // namespace regionmesh
