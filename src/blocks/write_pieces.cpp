// Models in pieces for ParaView.
#include <fmt/format.h>

#include "blocks/join.h"
#include "blocks/piece_mesh.h"
#include "regionmesh/blocks.h"
#include "regionmesh/census.h"
#include "regionmesh/write_report.h"

namespace regionmesh {

namespace fs = std::filesystem;

std::vector<fs::path> write_vtp_pieces(const fs::path& folder, const fs::path& path, const OutputOptions& options) {
    const Manifest manifest = read_complete_manifest(folder);
    LabelTable labels = read_labels(manifest, folder);
    const WriteOptions write{.background = dense_background(manifest.background, labels),
                             .names = manifest.names,
                             .colours = manifest.colours,
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
    write_text(path,
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

}  // namespace regionmesh
