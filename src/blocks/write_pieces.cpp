// Models in pieces for ParaView.
#include <fmt/format.h>

#include "blocks/global_numbers.h"
#include "blocks/join.h"
#include "blocks/piece_mesh.h"
#include "formats/surface/mesh_formats.h"
#include "formats/text/xml_text.h"
#include "regionmesh/blocks.h"
#include "regionmesh/census.h"
#include "regionmesh/write_report.h"
#include "surface/region_colours.h"

namespace regionmesh {

namespace fs = std::filesystem;

namespace {

/// Colours for the whole model, by place: the same in all pieces.
std::vector<std::uint32_t> colours_of(const Manifest& manifest, const fs::path& folder, const LabelTable& labels,
                                      const std::vector<Label>& background, const LabelColours& given) {
    RegionNeighbours neighbours;
    for (std::uint32_t block = 0; block < manifest.pieces.size(); ++block) {
        const Mesh mesh = mesh_of(read_entry(manifest, folder, block), manifest);
        add_neighbours(FileView(mesh, labels, background), neighbours);
    }
    const Mesh none;
    FileView view(none, labels, background);
    view.set_given_colours(given);
    return region_colours(view, neighbours);
}

}  // namespace

std::vector<fs::path> write_vtp_pieces(const fs::path& folder, const fs::path& path, const VtpPiecesOptions& options) {
    const Manifest manifest = read_complete_manifest(folder);
    LabelTable labels = read_labels(manifest, folder);
    const std::vector<Label> background = dense_background(manifest.background, labels);
    const LabelNames& names = options.names.empty() ? manifest.names : options.names;
    const LabelColours& given = options.colours.empty() ? manifest.colours : options.colours;
    const std::vector<std::uint32_t> colours = colours_of(manifest, folder, labels, background, given);
    GlobalNumbers numbers(manifest, folder);
    OutputFiles files(options.output);
    std::vector<fs::path> written;
    std::string pieces;
    for (std::uint32_t block = 0; block < manifest.pieces.size(); ++block) {
        if (manifest.pieces[block].faces == 0) continue;
        const Piece piece = read_entry(manifest, folder, block);
        const Mesh mesh = mesh_of(piece, manifest);
        FileView view(mesh, labels, background, names);
        view.set_coordinates(coordinates_of(manifest));
        view.set_given_colours(given);
        view.set_colours_of_whole(colours);
        fs::path name = path;
        name.replace_filename(fmt::format("{}-{:06}.vtp", path.stem().string(), block));
        write_vtp_part(view, numbers.number(piece, block), files.add(name));
        written.push_back(name);
        pieces += fmt::format("    <Piece Source=\"{}\"/>\n", formats::xml_attribute(name.filename().string()));
    }
    const auto label_array = [&](const char* name, const char* components) {
        return fmt::format("      <PDataArray type=\"{}\" Name=\"{}\"{}/>\n", vtk_label_type(labels), name, components);
    };
    files.add(path).write(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PPolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n  <PPolyData GhostLevel=\"0\">\n"
        "    <PPoints>\n      <PDataArray type=\"Float64\" NumberOfComponents=\"3\"/>\n    </PPoints>\n"
        "    <PPointData GlobalIds=\"GlobalIds\">\n"
        "      <PDataArray type=\"Int64\" IdType=\"1\" Name=\"GlobalIds\"/>\n      <PDataArray type=\"Int8\" "
        "Name=\"NodeType\"/>\n    </PPointData>\n"
        "    <PCellData Scalars=\"Region\">\n" +
        label_array("BoundaryLabels", " NumberOfComponents=\"2\"") + label_array("Region", "") +
        label_array("Neighbour", "") +
        "      <PDataArray type=\"UInt8\" Name=\"RGB\" NumberOfComponents=\"3\"/>\n"
        "    </PCellData>\n" +
        pieces + "  </PPolyData>\n</VTKFile>\n");
    files.commit();
    written.push_back(path);
    return written;
}

}  // namespace regionmesh
