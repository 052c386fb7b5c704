// Models in pieces for other programs: ParaView and Neuroglancer.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>

#include "blocks/join.h"
#include "formats/report/json_parts.h"
#include "regionmesh/blocks.h"
#include "regionmesh/error.h"
#include "stream/place_in_space.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

Mesh mesh_of(const Piece& piece, const Manifest& manifest) {
    Mesh mesh;
    mesh.reserve(piece.vertices.size(), piece.faces.size());
    for (const PieceVertex& vertex : piece.vertices) mesh.add_vertex(vertex.position, vertex.sides);
    for (const PieceFace& face : piece.faces)
        mesh.add_face(VertexId{face.vertices[0]}, VertexId{face.vertices[1]}, VertexId{face.vertices[2]},
                      face.labels[0], face.labels[1]);
    unscale_z(mesh, manifest.scale_z);
    place_in_space(mesh, manifest.lattice);
    return mesh;
}

/// The part of a region's boundary in a piece, its faces outward.
struct Fragment {
    std::vector<float> positions;
    std::vector<std::uint32_t> corners;
};

/// By dense label, the background left out.
std::map<Label, Fragment> fragments_of(const Mesh& mesh, const std::vector<Label>& background, double nanometres) {
    std::map<Label, Fragment> fragments;
    std::map<Label, std::map<VertexId, std::uint32_t>> numbers;
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        const Face& face = mesh[FaceId{f}];
        for (int side = 0; side < 2; ++side) {
            const Label label = face.labels[side];
            if (is_exterior(label) || std::ranges::find(background, label) != background.end()) continue;
            Fragment& fragment = fragments[label];
            for (int n = 0; n < 3; ++n) {
                const VertexId v = face.vertices[side == 0 ? n : 2 - n];
                const auto next = static_cast<std::uint32_t>(fragment.positions.size() / 3);
                const auto [place, is_new] = numbers[label].try_emplace(v, next);
                fragment.corners.push_back(place->second);
                if (!is_new) continue;
                for (int axis = 0; axis < 3; ++axis)
                    fragment.positions.push_back(static_cast<float>(mesh.position(v)[axis] * nanometres));
            }
        }
    }
    return fragments;
}

template <class T>
std::string_view bytes_of(const std::vector<T>& items) {
    return {reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T)};
}

std::vector<Label> background_of(const Manifest& manifest, LabelTable& labels) {
    std::vector<Label> background;
    for (const InputLabel label : manifest.background) background.push_back(labels.dense(label));
    return background;
}

void write_text_file(const fs::path& path, const std::string& text, const OutputOptions& options) {
    OutputFile file(path, options);
    file.write(text);
    file.commit();
}

/// `info` of the folder, and the names of regions.
void write_info(const Manifest& manifest, const LabelTable& labels, const std::vector<Label>& used,
                const fs::path& output, const OutputOptions& options) {
    Json info{{"@type", "neuroglancer_legacy_mesh"}};
    Json ids = Json::array(), values = Json::array();
    for (const Label label : used) {
        const InputLabel input = labels.input(label);
        const auto name = manifest.names.find(input);
        ids.push_back(labels.text(input));
        values.push_back(name == manifest.names.end() ? labels.text(input) : name->second);
    }
    info["segment_properties"] = "names";
    const Json names{
        {"@type", "neuroglancer_segment_properties"},
        {"inline",
         {{"ids", ids}, {"properties", Json::array({{{"id", "label"}, {"type", "label"}, {"values", values}}})}}}};
    write_text_file(output / "info", text_of(info), options);
    write_text_file(output / "names" / "info", text_of(names), options);
}

}  // namespace

std::vector<fs::path> write_vtp_pieces(const fs::path& folder, const fs::path& path, const OutputOptions& options) {
    const Manifest manifest = read_complete_manifest(folder);
    LabelTable labels = read_labels(manifest, folder);
    const WriteOptions write{.background = background_of(manifest, labels),
                             .names = manifest.names,
                             .space = manifest.space,
                             .output = options};
    std::vector<fs::path> written;
    std::string pieces;
    for (std::uint32_t block = 0; block < manifest.pieces.size(); ++block) {
        if (manifest.pieces[block].faces == 0) continue;
        fs::path file = path;
        file.replace_filename(fmt::format("{}-{:06}.vtp", path.stem().string(), block));
        write_mesh(mesh_of(read_entry(manifest, folder, block), manifest), labels, file, write);
        written.push_back(file);
        pieces += fmt::format("    <Piece Source=\"{}\"/>\n", file.filename().string());
    }
    write_text_file(path,
                    "<?xml version=\"1.0\"?>\n<VTKFile type=\"PPolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
                    "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n  <PPolyData GhostLevel=\"0\">\n"
                    "    <PPoints>\n      <PDataArray type=\"Float64\" NumberOfComponents=\"3\"/>\n    </PPoints>\n"
                    "    <PPointData>\n      <PDataArray type=\"Int8\" Name=\"NodeType\"/>\n    </PPointData>\n"
                    "    <PCellData>\n"
                    "      <PDataArray type=\"Int64\" Name=\"BoundaryLabels\" NumberOfComponents=\"2\"/>\n"
                    "      <PDataArray type=\"Int64\" Name=\"Region\"/>\n"
                    "      <PDataArray type=\"Int64\" Name=\"Neighbour\"/>\n"
                    "      <PDataArray type=\"UInt8\" Name=\"RGB\" NumberOfComponents=\"3\"/>\n"
                    "    </PCellData>\n" +
                        pieces + "  </PPolyData>\n</VTKFile>\n",
                    options);
    written.push_back(path);
    return written;
}

std::uint64_t write_precomputed(const fs::path& folder, const fs::path& output, double metres,
                                const OutputOptions& options) {
    const Manifest manifest = read_complete_manifest(folder);
    LabelTable labels = read_labels(manifest, folder);
    const std::vector<Label> background = background_of(manifest, labels);
    std::map<Label, Json> manifests;
    for (std::uint32_t block = 0; block < manifest.pieces.size(); ++block) {
        if (manifest.pieces[block].faces == 0) continue;
        const Mesh mesh = mesh_of(read_entry(manifest, folder, block), manifest);
        for (const auto& [label, fragment] : fragments_of(mesh, background, metres * 1e9)) {
            const std::string name = fmt::format("{}:0:{}", labels.text(labels.input(label)), block);
            OutputFile file(output / name, options);
            const std::vector<std::uint32_t> count{static_cast<std::uint32_t>(fragment.positions.size() / 3)};
            file.write(bytes_of(count));
            file.write(bytes_of(fragment.positions));
            file.write(bytes_of(fragment.corners));
            file.commit();
            manifests[label].push_back(name);
        }
    }
    std::vector<Label> used;
    for (const auto& [label, names] : manifests) {
        used.push_back(label);
        write_text_file(output / (labels.text(labels.input(label)) + ":0"), text_of(Json{{"fragments", names}}),
                        options);
    }
    write_info(manifest, labels, used, output, options);
    return used.size();
}

}  // namespace regionmesh
