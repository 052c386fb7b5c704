// A folder of pieces as a model to compare, and its size.
#include "blocks/folder_parts.h"
#include "blocks/piece_mesh.h"
#include "mesh/extent.h"
#include "regionmesh/blocks.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

class ComparedFolder final : public ComparedModel {
public:
    explicit ComparedFolder(const fs::path& path) : folder_{path}, labels_(read_labels(folder_.manifest, path)) {}

    const LabelTable& labels() const override { return labels_; }
    std::uint64_t face_count() const override { return folder_.manifest.faces; }
    std::uint64_t vertex_count() const override { return folder_.manifest.vertices; }
    std::uint32_t part_count() const override { return folder_.grid.count(); }

    /// Pieces are of sections, whose exterior is a box.
    bool has_sides() const override { return true; }

    void read(std::uint32_t block, const std::function<void(const Mesh&, const MeshPart*)>& visit) const override {
        MeshPart part;
        const Mesh mesh = read_part(folder_, block, part);
        visit(mesh, &part);
    }

    CheckReport measure(const CheckOptions& options) const override {
        return check_block_folder(folder_.path, options);
    }

private:
    BlockFolder folder_;
    LabelTable labels_;
};

}  // namespace

std::unique_ptr<ComparedModel> open_block_folder(const fs::path& folder) {
    return std::make_unique<ComparedFolder>(folder);
}

ModelSize size_of_block_folder(const fs::path& path) {
    const BlockFolder folder{path};
    ModelSize size{.faces = folder.manifest.faces, .vertices = folder.manifest.vertices};
    Box box;
    for (std::uint32_t block = 0; block < folder.grid.count(); ++block)
        box.join(extent_of(mesh_of(read_entry(folder.manifest, path, block), folder.manifest), 1));
    if (!box.is_empty()) size.box = box;
    return size;
}

}  // namespace regionmesh
