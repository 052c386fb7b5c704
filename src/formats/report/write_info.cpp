// What an input holds, as JSON.
#include <algorithm>
#include <vector>

#include "formats/report/json_parts.h"
#include "mesh/extent.h"
#include "regionmesh/read_sections.h"
#include "regionmesh/write_report.h"

namespace regionmesh {
namespace {

/// The labels that occur, in order. `thing` is what is counted: "samples", "points" or "tetrahedra".
template <class AnyCensus>
Json labels_json(const AnyCensus& census, const LabelNames& names, const char* thing) {
    std::vector<Label> order;
    for (Label label = 0; label < std::min<std::size_t>(census.labels.size(), census.samples.size()); ++label)
        if (census.samples[label] > 0) order.push_back(label);
    std::ranges::sort(
        order, [&](Label a, Label b) { return census.labels.less(census.labels.input(a), census.labels.input(b)); });
    Json json = Json::array();
    for (const Label label : order) {
        json.push_back({{"label", label_json(census.labels.input(label), census.labels)}});
        if (const auto name = names.find(census.labels.input(label)); name != names.end())
            json.back()["name"] = name->second;
        json.back()[thing] = census.samples[label];
    }
    return json;
}

std::string axis_text(const Sweep& sweep) { return {"xyz"[sweep.axes[2]]}; }

Json three(Vec3 v) { return {v.x, v.y, v.z}; }

}  // namespace

std::string info_json(const VolumeInfo& info, const Census& census, const std::optional<Roughness>& roughness) {
    const Lattice& lattice = info.lattice;
    Json json{{"kind", "volume"},
              {"file", info.source},
              {"format", info.format},
              {"type", to_string(info.type)},
              {"size", lattice.size},
              {"spacing", three(lattice.spacing)},
              {"origin", three(lattice.origin)},
              {"direction", lattice.direction},
              {"sweep", axis_text(info.sweep)},
              {"labels", labels_json(census, info.names, "samples")},
              {"unsimplified_faces", census.face_count},
              {"region_pairs", census.oracle.region_pairs}};
    put_unit(info.metres, json);
    if (roughness) put_roughness(*roughness, json);
    return text_of(json);
}

std::string info_json(const TetrahedraInfo& info, const TetrahedronCensus& census) {
    Json json{{"kind", "tetrahedra"},
              {"file", info.source},
              {"format", info.format},
              {"points", census.point_count},
              {"tetrahedra", census.tetrahedron_count},
              {"mean_spacing", census.spacing},
              {"scale_z", info.scale_z},
              {"sweep", axis_text(census.sweep)},
              {"labels", labels_json(census, info.names, info.has_cell_labels ? "tetrahedra" : "points")},
              {"unsimplified_faces", census.face_count},
              {"region_pairs", census.oracle.region_pairs}};
    put_unit(info.metres, json);
    return text_of(json);
}

std::string info_json(const std::string& source, const MeshFile& file, const ModelSize& size,
                      const CheckReport& report) {
    std::vector<RegionReport> regions = report.regions;
    std::ranges::sort(regions, [&](const RegionReport& a, const RegionReport& b) {
        return file.labels.less(file.labels.input(a.label), file.labels.input(b.label));
    });
    Json all = Json::array();
    for (const RegionReport& region : regions) {
        const InputLabel label = file.labels.input(region.label);
        all.push_back({{"label", label_json(label, file.labels)}});
        if (const auto name = file.names.find(label); name != file.names.end()) all.back()["name"] = name->second;
        all.back()["volume"] = region.volume;
        all.back()["area"] = region.area;
        all.back()["components"] = region.components;
    }
    Json json{{"kind", "model"},
              {"file", source},
              {"faces", size.faces},
              {"vertices", size.vertices},
              {"box", {{"low", three(size.box.low)}, {"high", three(size.box.high)}}},
              {"regions", std::move(all)},
              {"region_pairs", report.region_pairs}};
    put_unit(file.coordinates.metres, json);
    return text_of(json);
}

ModelSize size_of(const Mesh& mesh) {
    ModelSize size{.faces = mesh.face_count(), .vertices = mesh.vertex_count()};
    if (const Box box = extent_of(mesh, 1); !box.is_empty()) size.box = box;
    return size;
}

}  // namespace regionmesh
