#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>

#include "formats/surface/file_regions.h"
#include "formats/surface/mesh_formats.h"
#include "regionmesh/error.h"
#include "regionmesh/mesh_file.h"

namespace regionmesh {
namespace {

using Path = std::filesystem::path;

struct Format {
    const char* extension;
    void (*write)(const FileView&, const WriteOptions&, OutputFiles&, const Path&);
    void (*write_region)(const FileView&, OutputFile&) = nullptr;  // as a file of its own
    bool has_point_arrays = false;
    bool needs_closed_regions = false;
    const char* companion = nullptr;
};

template <void (*kWrite)(const FileView&, OutputFile&)>
void write_one(const FileView& view, const WriteOptions&, OutputFiles& files, const Path& path) {
    kWrite(view, files.add(path));
}

template <void (*kWrite)(const FileView&, const std::vector<PointArray>&, OutputFile&)>
void write_with_arrays(const FileView& view, const WriteOptions& options, OutputFiles& files, const Path& path) {
    kWrite(view, options.point_arrays, files.add(path));
}

void write_two(const FileView& view, const WriteOptions&, OutputFiles& files, const Path& path) {
    write_msh(view, files, path);
}

constexpr Format kFormats[] = {
    {.extension = ".vtp", .write = write_with_arrays<write_vtp>, .has_point_arrays = true},
    {.extension = ".vtu", .write = write_with_arrays<write_vtu>, .has_point_arrays = true},
    {.extension = ".ply", .write = write_one<write_ply>, .write_region = write_region_ply},
    {.extension = ".stl", .write = write_one<write_stl>, .write_region = write_region_stl},
    {.extension = ".obj", .write = write_one<write_obj>, .write_region = write_region_obj},
    {.extension = ".msh", .write = write_two, .needs_closed_regions = true, .companion = ".geo"},
    {.extension = ".smesh", .write = write_one<write_smesh>, .needs_closed_regions = true},
    {.extension = ".poly", .write = write_one<write_poly>, .needs_closed_regions = true},
    {.extension = ".inp", .write = write_one<write_inp>},
    {.extension = ".glb", .write = write_one<write_glb>},
    {.extension = ".dream3d", .write = write_one<write_dream3d>},
};

std::string extensions_where(bool (*is_such)(const Format&)) {
    std::string text;
    for (const Format& format : kFormats)
        if (is_such(format)) text += (text.empty() ? "" : " ") + std::string(format.extension);
    return text;
}

std::string lower_extension(const Path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
    return extension;
}

/// The format of `path`, if it can hold what the options ask for.
const Format& format_of(const Path& path, const WriteOptions& options, bool has_point_arrays) {
    const std::string extension = lower_extension(path);
    const auto refuse = [&](const std::string& text) {
        throw Error(ErrorCode::kOutput, fmt::format("{}: {}", path.string(), text));
    };
    const auto found = std::ranges::find_if(kFormats, [&](const Format& f) { return f.extension == extension; });
    if (found == std::end(kFormats))
        refuse(fmt::format("no model format has the extension '{}': use one of {}", path.extension().string(),
                           writable_extensions()));
    if (has_point_arrays && !found->has_point_arrays) refuse("only .vtp and .vtu files hold a number for each vertex");
    if (options.per_region && !found->write_region)
        refuse("a file for each region is written as " +
               extensions_where([](const Format& f) { return f.write_region != nullptr; }));
    if (options.boundary_is_open && found->needs_closed_regions)
        refuse("holds closed regions only: leave out --boundary open");
    return *found;
}

/// The faces of one region, with both labels.
Mesh part_of(const Mesh& mesh, const GroupedFaces& faces, std::size_t group) {
    Mesh part;
    std::vector<VertexId> vertices;
    faces.for_group(group, [&](FaceId f, std::uint32_t) {
        for (const VertexId v : mesh[f].vertices) vertices.push_back(v);
    });
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const VertexId v : vertices) part.add_vertex(mesh.position(v), mesh[v].sides);
    const auto there = [&](VertexId v) {
        return VertexId{static_cast<std::uint32_t>(std::ranges::lower_bound(vertices, v) - vertices.begin())};
    };
    faces.for_group(group, [&](FaceId f, std::uint32_t) {
        const auto& [a, b, c] = mesh[f].vertices;
        part.add_face(there(a), there(b), there(c), mesh[f].labels[0], mesh[f].labels[1]);
    });
    return part;
}

/// A file for each region: with all other labels as background its normals point outward.
void write_regions(const FileView& view, const Format& format, OutputFiles& files, const Path& path) {
    const FileRegions regions(view);
    const GroupedFaces faces = faces_by_region(view, regions);
    for (std::size_t n = 0; n < regions.all().size(); ++n) {
        const Label own = regions.all()[n].label;
        std::vector<Label> others = view.ordered_labels();
        std::erase(others, own);
        const Mesh part = part_of(view.mesh(), faces, n);
        const Path file = path.parent_path() /
                          fmt::format("{}-{}{}", path.stem().string(), view.label_text(own), path.extension().string());
        format.write_region(FileView(part, view.labels(), others, view.names()), files.add(file));
    }
}

}  // namespace

std::string writable_extensions() {
    return extensions_where([](const Format&) { return true; });
}

void write_mesh(const Mesh& mesh, const LabelTable& labels, const Path& path, const WriteOptions& options) {
    const Format& format = format_of(path, options, !options.point_arrays.empty());
    const FileView view(mesh, labels, options.background, options.names);
    OutputFiles files;
    options.per_region ? write_regions(view, format, files, path) : format.write(view, options, files, path);
    files.commit();
}

void require_writable_mesh(const Path& path, const WriteOptions& options, bool with_point_arrays) {
    const Format& format = format_of(path, options, with_point_arrays || !options.point_arrays.empty());
    require_writable(path);
    if (format.companion) require_writable(Path(path).replace_extension(format.companion));
}

}  // namespace regionmesh
