#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <string>

#include "formats/surface/mesh_formats.h"
#include "formats/surface/ply_layout.h"
#include "regionmesh/output_file.h"

namespace regionmesh {
namespace {

static_assert(std::endian::native == std::endian::little,
              "the file says little endian and numbers are written as they lie in memory");

constexpr std::size_t kBufferBytes = 1 << 20;

// Packs numbers without gaps and hands them on by the megabyte.
class Packer {
public:
    explicit Packer(OutputFile& file) : file_(file) { buffer_.reserve(kBufferBytes + 64); }
    template <class T>
    void put(T value) {
        char bytes[sizeof(T)];
        std::memcpy(bytes, &value, sizeof(T));
        buffer_.append(bytes, sizeof(T));
        if (buffer_.size() >= kBufferBytes) flush();
    }
    void flush() {
        file_.write(buffer_);
        buffer_.clear();
    }

private:
    OutputFile& file_;
    std::string buffer_;
};

bool all_labels_fit_32_bits(const FileView& view) {
    const auto fits = [](InputLabel label) { return label == static_cast<std::int32_t>(label); };
    const LabelTable& labels = view.labels();
    for (Label label = 0; label < labels.size(); ++label)
        if (!fits(labels.input(label))) return false;
    return fits(view.exterior_label());
}

void put_label(Packer& packer, InputLabel label, bool is_wide) {
    packer.put(static_cast<std::uint32_t>(label));
    if (is_wide) packer.put(static_cast<std::uint32_t>(static_cast<std::uint64_t>(label) >> 32));
}

/// Which labels a face has.
enum class FaceLabels { kBoth, kNone };

void write(const FileView& view, FaceLabels face_labels, OutputFile& file) {
    const Mesh& mesh = view.mesh();
    const bool is_wide = !all_labels_fit_32_bits(view);
    std::string comments = fmt::format("comment exterior_label {}\n", view.exterior_label());
    for (const Label label : view.ordered_labels())
        if (const std::string name = view.name(label); !name.empty())
            comments += fmt::format("comment region {} {}\n", view.labels().input(label), name);
    file.write(fmt::format("{}{}element vertex {}\n{}element face {}\n{}{}end_header\n", kPlyMagic, comments,
                           mesh.vertex_count(), kPlyVertex, mesh.face_count(), kPlyFace,
                           face_labels == FaceLabels::kNone ? ""
                           : is_wide                        ? kPlyWideLabels
                                                            : kPlyLabels));
    Packer packer(file);
    view.for_vertices([&](VertexId v) {
        const Vec3 position = mesh.position(v);
        for (int axis = 0; axis < 3; ++axis) packer.put(position[axis]);
        packer.put(view.node_type(v));
    });
    view.for_faces([&](FaceId f) {
        const FileFace face = view.face(f);
        packer.put(std::uint8_t{3});
        for (const std::uint32_t v : face.vertices) packer.put(v);
        if (face_labels == FaceLabels::kNone) return;
        for (const InputLabel label : face.labels) put_label(packer, label, is_wide);
    });
    packer.flush();
}

}  // namespace

void write_ply(const FileView& view, OutputFile& file) { write(view, FaceLabels::kBoth, file); }

void write_region_ply(const FileView& view, OutputFile& file) { write(view, FaceLabels::kNone, file); }

}  // namespace regionmesh
