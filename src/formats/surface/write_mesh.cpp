#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/option_range.h"
#include "formats/registry.h"
#include "formats/surface/file_regions.h"
#include "formats/surface/mesh_formats.h"
#include "formats/text/header_text.h"
#include "mesh/edge_rounding.h"
#include "regionmesh/error.h"
#include "regionmesh/limits.h"
#include "regionmesh/mesh_file.h"
#include "surface/region_colours.h"

namespace regionmesh {
namespace {

using Path = std::filesystem::path;

using formats::Format;

/// Whether the other file can name this one: its readers take the name as it is.
bool is_plain(const std::string& name, std::string_view forbidden) {
    return std::ranges::none_of(name, [&](char letter) {
        const auto c = static_cast<unsigned char>(letter);
        return c < ' ' || c == 0x7F || forbidden.find(letter) != std::string_view::npos;
    });
}

/// "quotes, backslashes and ".
std::string words_of(std::string_view forbidden) {
    constexpr std::pair<char, const char*> kWords[] = {
        {'"', "quotes"}, {'\\', "backslashes"}, {':', "colons"}, {'<', "'<', '>', '&'"}};
    std::string words;
    for (const auto& [letter, word] : kWords)
        if (forbidden.find(letter) != std::string_view::npos) words.append(words.empty() ? "" : ", ").append(word);
    return words.empty() ? words : words + " and ";
}

/// The format of `path`, if it can hold what the options ask for.
const Format& format_of(const Path& path, const WriteOptions& options, bool has_point_arrays) {
    const auto refuse = [&](const std::string& text) {
        throw Error(ErrorCode::kOutput, fmt::format("{}: {}", path.string(), text));
    };
    const Format* const found = formats::find_format(path);
    if (found && found->holds_surface && !found->part.is_built)
        refuse(fmt::format("this build writes no {}; build with REGIONMESH_WITH_{}", found->name, found->part.option));
    if (!found || !found->write_surface)
        refuse(fmt::format("no model format has the extension '{}': use one of {}", path.extension().string(),
                           writable_extensions()));
    if (has_point_arrays && !found->has_point_arrays) refuse("only .vtp and .vtu files hold a number for each vertex");
    if (options.per_region && !found->write_region)
        refuse("a file for each region is written as " + formats::extensions_with(&Format::write_region));
    if (const auto& metres = options.coordinates.metres)
        require_number("metres", *metres, {kLeastUnit, kMostUnit, "1e-15 to 1e6"});
    if (const auto& spacing = options.coordinates.spacing)
        for (int axis = 0; axis < 3; ++axis)
            require_number("spacing", (*spacing)[axis], {kLeastLength, kMostLength, "1e-12 to 1e8"});
    if (options.boundary_is_open && found->needs_closed_regions)
        refuse("holds closed regions only: leave out --boundary open");
    if (found->forbidden_in_name && !is_plain(path.filename().string(), found->forbidden_in_name))
        refuse(fmt::format("one of it and its {} file names the other: a name without {}control characters is needed",
                           found->companion, words_of(found->forbidden_in_name)));
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

/// "model-liver.stl", "model-3.stl".
Path file_of(const FileView& view, const FileRegion& region, const Path& path) {
    const std::string own = view.name(region.label).empty() ? view.label_text(region.label) : region.word;
    return path.parent_path() / fmt::format("{}-{}{}", path.stem().string(), own, path.extension().string());
}

/// A file for each region, and the companion of all: with all other labels as background its normals point outward.
std::vector<Path> write_regions(const FileView& view, const Format& format, OutputFiles& files, const Path& path) {
    const FileRegions regions(view);
    const GroupedFaces faces = faces_by_region(view, regions);
    const std::vector<std::uint32_t> colours = region_colours(view);
    const Path companion = format.companion ? Path(path).replace_extension(format.companion) : Path();
    std::vector<Path> written;
    for (std::size_t n = 0; n < regions.all().size(); ++n) {
        const Label own = regions.all()[n].label;
        std::vector<Label> others = view.ordered_labels();
        std::erase(others, own);
        const Mesh part = part_of(view.mesh(), faces, n);
        written.push_back(file_of(view, regions.all()[n], path));
        FileView part_view(part, view.labels(), others, view.names());
        part_view.set_coordinates(view.coordinates());
        part_view.set_given_colours(view.given_colours());
        const RegionStyle style{colours[view.rank(own)], regions.all()[n].word, companion.filename().string()};
        format.write_region(part_view, style, files.add(written.back()));
    }
    if (format.write_companion) {
        written.push_back(companion);
        format.write_companion(view, files.add(companion));
    }
    return written;
}

/// Names that formats of lines can hold.
LabelNames in_one_line(const LabelNames& names) {
    LabelNames lines;
    for (const auto& [label, name] : names)
        if (std::string line = formats::one_line(name); !line.empty()) lines.emplace(label, std::move(line));
    return lines;
}

void require_arrays(const Mesh& mesh, const Path& path, const WriteOptions& options) {
    std::set<std::string_view> names{"NodeType"};
    for (const PointArray& array : options.point_arrays) {
        if (!names.insert(array.name).second)
            throw Error(ErrorCode::kOutput, fmt::format("{}: there is a point array '{}' already; give another name",
                                                        path.string(), array.name));
        const bool is_word = !array.name.empty() && std::ranges::all_of(array.name, [](unsigned char c) {
            return std::isalnum(c) || c == '_';
        });
        if (!is_word || array.values.size() < mesh.vertex_end())
            throw Error(ErrorCode::kOutput,
                        fmt::format("{}: point array '{}' of {} values for {} vertices; give a name of letters, digits "
                                    "and '_', and a value for each vertex",
                                    path.string(), array.name, array.values.size(), mesh.vertex_end()));
    }
}

/// Faces with labels that `labels` has not, and vertices that no reader would take.
void require_model(const Mesh& mesh, const LabelTable& labels, const Path& path) {
    for_vertices(mesh, [&](VertexId v) {
        const Vec3 p = mesh.position(v);
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            throw Error(ErrorCode::kOutput, fmt::format("{}: vertex {} lies at {}, {}, {}; give finite coordinates",
                                                        path.string(), index(v), p.x, p.y, p.z));
    });
    require_labels(mesh, labels, path.string());
}

}  // namespace

double rounded_share_of_edge(const Mesh& mesh, const Path& path, const WriteOptions& options) {
    const Format* const format = formats::find_format(path);
    if (!format || !(options.per_region ? format->has_single_region_points : format->has_single_points)) return 0;
    EdgeRounding rounding;
    rounding.add(mesh);
    return rounding.share();
}

std::string writable_extensions() { return formats::extensions_with(&Format::write_surface); }

std::vector<Path> write_mesh(const Mesh& mesh, const LabelTable& labels, const Path& path, const WriteOptions& options,
                             OutputFiles& files) {
    const Format& format = format_of(path, options, !options.point_arrays.empty());
    require_arrays(mesh, path, options);
    require_model(mesh, labels, path);
    const LabelNames names = in_one_line(options.names);
    FileView view(mesh, labels, options.background, names);
    view.set_coordinates(options.coordinates);
    view.set_given_colours(options.colours);
    if (options.per_region) return write_regions(view, format, files, path);
    std::vector<Path> written{path};
    format.write_surface(view, options, files, path);
    if (format.companion) written.push_back(Path(path).replace_extension(format.companion));
    return written;
}

std::vector<Path> write_mesh(const Mesh& mesh, const LabelTable& labels, const Path& path,
                             const WriteOptions& options) {
    OutputFiles files(options.output);
    auto written = write_mesh(mesh, labels, path, options, files);
    files.commit();
    return written;
}

void require_writable_mesh(const Path& path, const WriteOptions& options, bool with_point_arrays) {
    const Format& format = format_of(path, options, with_point_arrays || !options.point_arrays.empty());
    require_writable(path, options.output, options.per_region);
    if (format.companion) require_writable(Path(path).replace_extension(format.companion), options.output);
}

}  // namespace regionmesh
