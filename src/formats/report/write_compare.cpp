#include "formats/report/json_parts.h"
#include "regionmesh/write_report.h"

namespace regionmesh {
namespace {

Json statistics_json(const std::optional<DistanceStatistics>& statistics) {
    if (!statistics) return nullptr;
    return {{"samples", statistics->samples},
            {"rms", statistics->rms},
            {"mean", statistics->mean},
            {"max", statistics->max},
            {"quantile_95", statistics->quantile_95}};
}

Json distance_json(const TwoSidedDistance& distance) {
    if (!distance.both) return nullptr;
    return {{"a_to_b", statistics_json(distance.a_to_b)},
            {"b_to_a", statistics_json(distance.b_to_a)},
            {"both", statistics_json(distance.both)}};
}

template <class T>
Json both_json(const std::array<T, 2>& values) {
    return {{"a", values[0]}, {"b", values[1]}};
}

Json measures_json(const std::optional<RegionReport>& region) {
    if (!region) return nullptr;
    return {{"euler", region->euler},
            {"components", region->components},
            {"volume", region->volume},
            {"area", region->area}};
}

Json change_json(const std::array<std::optional<RegionReport>, 2>& measures) {
    if (!measures[0] || !measures[1]) return nullptr;
    const RegionReport &a = *measures[0], &b = *measures[1];
    return {{"euler", b.euler - a.euler},
            {"components", std::int64_t{b.components} - a.components},
            {"volume", b.volume - a.volume},
            {"area", b.area - a.area}};
}

/// Converts dense labels to JSON.
class Labels {
public:
    explicit Labels(const LabelTable& table) : table_(table), exterior_(table.exterior_label()) {}

    InputLabel exterior() const { return exterior_; }
    Json operator()(Label label) const {
        return is_exterior(label) ? Json(exterior_) : label_json(table_.input(label), table_);
    }
    Json operator()(const std::vector<Label>& labels) const {
        Json json = Json::array();
        for (const Label label : labels) json.push_back((*this)(label));
        return json;
    }

private:
    const LabelTable& table_;
    InputLabel exterior_;
};

Json regions_json(const std::vector<RegionComparison>& regions, const Labels& name) {
    Json json = Json::array();
    for (const RegionComparison& region : regions)
        json.push_back({{"label", name(region.label)},
                        {"a", measures_json(region.measures[0])},
                        {"b", measures_json(region.measures[1])},
                        {"change", change_json(region.measures)},
                        {"distance", distance_json(region.distance)}});
    return json;
}

Json optional_json(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json strata_json(const std::vector<StratumComparison>& strata, const char* measure, const Labels& name) {
    Json json = Json::array();
    for (const StratumComparison& stratum : strata)
        json.push_back(
            {{"labels", name(stratum.labels)},
             {measure, {{"a", optional_json(stratum.measures[0])}, {"b", optional_json(stratum.measures[1])}}},
             {"distance", distance_json(stratum.distance)}});
    return json;
}

/// The labels of regions, interfaces and lines that only model `which` has.
Json only_in(int which, const CompareReport& report, const Labels& name) {
    const auto is_only = [&](const auto& measures) { return measures[which] && !measures[1 - which]; };
    Json regions = Json::array(), interfaces = Json::array(), lines = Json::array();
    for (const RegionComparison& region : report.regions)
        if (is_only(region.measures)) regions.push_back(name(region.label));
    for (const StratumComparison& stratum : report.interfaces)
        if (is_only(stratum.measures)) interfaces.push_back(name(stratum.labels));
    for (const StratumComparison& stratum : report.lines)
        if (is_only(stratum.measures)) lines.push_back(name(stratum.labels));
    return {{"regions", regions}, {"interfaces", interfaces}, {"lines", lines}};
}

}  // namespace

std::string compare_json(const CompareReport& report, const LabelNames& names) {
    const Labels name(report.labels);
    Json json;
    json["faces"] = both_json(report.faces);
    json["vertices"] = both_json(report.vertices);
    json["exterior_label"] = name.exterior();
    json["distance"] = distance_json(report.distance);
    json["only_in_a"] = only_in(0, report, name);
    json["only_in_b"] = only_in(1, report, name);
    Json& regions = json["regions"] = regions_json(report.regions, name);
    for (std::size_t n = 0; n < report.regions.size(); ++n)
        if (const auto found = names.find(report.labels.input(report.regions[n].label)); found != names.end())
            regions[n]["name"] = found->second;
    json["interfaces"] = strata_json(report.interfaces, "area", name);
    json["lines"] = strata_json(report.lines, "length", name);
    json["quality"] = {{"a", quality_json(report.quality[0])}, {"b", quality_json(report.quality[1])}};
    return text_of(json);
}

}  // namespace regionmesh
