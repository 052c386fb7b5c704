// 3D Manufacturing Format, core specification 1.3: https://github.com/3MFConsortium/spec_core. A zip archive of XML.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "formats/surface/file_regions.h"
#include "formats/surface/mesh_formats.h"
#include "formats/surface/zip_file_3mf.h"
#include "formats/text/xml_text.h"
#include "regionmesh/error.h"
#include "surface/region_colours.h"
#include "surface/shells.h"

namespace regionmesh {
namespace {

constexpr std::string_view kContentTypes =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
    "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
    "<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n";
constexpr std::string_view kRelations =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
    "<Relationship Id=\"model\" Target=\"/3D/3dmodel.model\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>\n";
constexpr std::size_t kBufferBytes = std::size_t{1} << 20;
constexpr std::uint64_t kBytesPerFace = 90, kBytesPerVertex = 110, kBytesPerRegion = 2000;  // upper bounds
constexpr int kMaterials = 1, kFirstObject = 2;                                             // ids of resources

/// A unit of the format, and that of the model in it.
std::pair<const char*, double> unit_of(std::optional<double> metres) {
    constexpr std::pair<const char*, double> kUnits[] = {{"micron", 1e-6}, {"millimeter", 1e-3}, {"centimeter", 1e-2},
                                                         {"inch", 0.0254}, {"foot", 0.3048},     {"meter", 1}};
    if (!metres) return {"millimeter", 1};  // as readers assume
    for (const auto& [name, length] : kUnits)
        if (*metres == length) return {name, 1};
    if (*metres >= 1) return {"meter", *metres};
    if (*metres >= 1e-3) return {"millimeter", *metres / 1e-3};
    return {"micron", *metres / 1e-6};
}

/// Each region is a closed object with its own copy of the faces that it shares.
class Writer3mf {
public:
    Writer3mf(const FileView& view, std::optional<double> metres, OutputFile& file)
        : view_(view), regions_(view), faces_(faces_by_region(view, regions_)), zip_(file) {
        std::tie(unit_, scale_) = unit_of(metres);
    }

    void write() {
        zip_.begin_entry("[Content_Types].xml", kContentTypes.size());
        zip_.write(kContentTypes);
        zip_.begin_entry("_rels/.rels", kRelations.size());
        zip_.write(kRelations);
        std::uint64_t corners = 0;
        for (std::size_t n = 0; n < regions_.all().size(); ++n) corners += faces_.count(n);
        zip_.begin_entry("3D/3dmodel.model",
                         4096 + corners * (kBytesPerFace + kBytesPerVertex) + regions_.all().size() * kBytesPerRegion);
        write_model();
        flush();
        zip_.finish();
    }

private:
    template <class... Values>
    void put(fmt::format_string<Values...> text, Values&&... values) {
        fmt::format_to(std::back_inserter(text_), text, std::forward<Values>(values)...);
        if (text_.size() >= kBufferBytes) flush();
    }

    void flush() {
        zip_.write(text_);
        text_.clear();
    }

    void write_model() {
        put("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"{}\" xml:lang=\"en-US\" "
            "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" xmlns:rm=\"urn:regionmesh\">\n"
            "<metadata name=\"Application\">regionmesh</metadata>\n",
            unit_);
        if (view_.coordinates().space != Space::kUnknown)
            put("<metadata name=\"rm:Space\">{}</metadata>\n", space_name(view_.coordinates().space));
        put("<resources>\n<basematerials id=\"{}\">\n", kMaterials);
        const std::vector<std::uint32_t> colours = region_colours(view_);
        for (const FileRegion& region : regions_.all())
            put("<base name=\"{}\" displaycolor=\"#{:06X}FF\"/>\n", formats::xml_attribute(title_of(region)),
                colours[view_.rank(region.label)]);
        put("</basematerials>\n");
        for (std::size_t n = 0; n < regions_.all().size(); ++n) write_object(n);
        put("</resources>\n<build>\n");
        for (std::size_t n = 0; n < regions_.all().size(); ++n) put("<item objectid=\"{}\"/>\n", kFirstObject + n);
        put("</build>\n</model>\n");
    }

    /// "liver", or "region_3" where the label has no name.
    std::string title_of(const FileRegion& region) const {
        const std::string name = view_.name(region.label);
        return name.empty() ? region.title : name;
    }

    void write_object(std::size_t n) {
        std::vector<VertexId> vertices;
        faces_.for_group(n, [&](FaceId f, std::uint32_t) {
            for (const VertexId v : view_.mesh()[f].vertices) vertices.push_back(v);
        });
        std::ranges::sort(vertices);
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        const auto number = [&](VertexId v) { return std::ranges::lower_bound(vertices, v) - vertices.begin(); };
        put("<object id=\"{}\" type=\"model\" name=\"{}\" partnumber=\"{}\" pid=\"{}\" pindex=\"{}\">\n<mesh>\n"
            "<vertices>\n",
            kFirstObject + n, formats::xml_attribute(title_of(regions_.all()[n])),
            view_.label_text(regions_.all()[n].label), kMaterials, n);
        for (const VertexId v : vertices) {
            const Vec3 p = view_.mesh().position(v) * scale_;
            put("<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>\n", p.x, p.y, p.z);
        }
        put("</vertices>\n<triangles>\n");
        faces_.for_group(n, [&](FaceId f, std::uint32_t side) {
            const auto [a, b, c] = turned_vertices(view_.mesh(), f, side);
            put("<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>\n", number(a), number(b), number(c));
        });
        put("</triangles>\n</mesh>\n</object>\n");
    }

    const FileView& view_;
    FileRegions regions_;
    GroupedFaces faces_;
    ZipFile zip_;
    const char* unit_;
    double scale_;  // of coordinates
    std::string text_;
};

/// Faces may still cross, or be inside out.
void require_no_open_edges(const FileView& view) {
    UnionFind joined(2 * view.mesh().face_end());
    const std::vector<bool> ends = join_sides(view.mesh(), joined);
    for (std::uint32_t side = 0; side < ends.size(); ++side) {
        const Label label = label_of_side(view.mesh(), side);
        if (ends[side] && !is_exterior(label) && !view.is_background(label))
            throw Error(ErrorCode::kOutput,
                        fmt::format("region {} has open edges, so that it is no closed object: leave out --boundary "
                                    "open, join points with --weld, or see regionmesh check",
                                    view.label_text(label)));
    }
}

}  // namespace

void write_3mf(const FileView& view, std::optional<double> metres, OutputFile& file) {
    require_no_open_edges(view);
    Writer3mf(view, metres, file).write();
}

}  // namespace regionmesh
