#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <initializer_list>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include "formats/codec/base64.h"
#include "formats/report/json_parts.h"
#include "page/page_geometry.h"
#include "page/page_template.h"
#include "regionmesh/box_axes.h"
#include "regionmesh/check.h"
#include "regionmesh/error.h"
#include "regionmesh/mesh_arrays.h"
#include "regionmesh/output_file.h"
#include "regionmesh/page.h"
#include "regionmesh/simplify.h"
#include "regionmesh/write_report.h"
#include "surface/region_colours.h"

namespace regionmesh {
namespace {

constexpr std::string_view kTitlePlace = "<!--TITLE-->", kDataPlace = "<!--DATA-->";

std::string escaped(std::string_view text, std::initializer_list<std::pair<char, std::string_view>> escapes) {
    std::string all;
    for (const char letter : text) {
        const auto escape = std::ranges::find(escapes, letter, &std::pair<char, std::string_view>::first);
        if (escape == escapes.end())
            all += letter;
        else
            all += escape->second;
    }
    return all;
}

std::string escaped_html(std::string_view text) {
    return escaped(text, {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}});
}

/// JSON in which no character can end or open an element of HTML.
std::string script_json(const Json& json) {
    return escaped(json.dump(-1, ' ', true, Json::error_handler_t::replace),
                   {{'<', "\\u003c"}, {'>', "\\u003e"}, {'&', "\\u0026"}});
}

std::string deflated(const std::vector<std::uint8_t>& bytes) {
    uLongf size = compressBound(bytes.size());
    std::vector<std::byte> packed(size);
    if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, bytes.data(), bytes.size(), Z_BEST_COMPRESSION) !=
        Z_OK)
        throw std::bad_alloc();
    packed.resize(size);
    return base64(packed);
}

Json vector_json(Vec3 p) { return {p.x, p.y, p.z}; }

Json labels_json(const FileView& view) {
    const std::vector<std::uint32_t> colours = region_colours(view);
    Json all = Json::array();
    std::size_t place = 0;
    for (const Label label : view.ordered_labels()) {
        Json json{{"label", view.label_text(label)}, {"colour", hex_of(colours[place++])}};
        if (const std::string name = view.name(label); !name.empty()) json["name"] = name;
        if (view.is_background(label)) json["background"] = true;
        all.push_back(std::move(json));
    }
    return all;
}

Json geometry_json(const PageGeometry& geometry) {
    Json pairs = Json::array();
    for (const PagePair& pair : geometry.pairs) pairs.push_back({pair.first, pair.second, pair.faces});
    return {{"low", vector_json(geometry.low)},
            {"high", vector_json(geometry.high)},
            {"shown_vertices", geometry.vertices},
            {"shown_faces", geometry.faces},
            {"pairs", std::move(pairs)},
            {"index_bytes", geometry.index_bytes},
            {"largest_distance", geometry.largest_distance}};
}

/// A copy with at most `faces` faces, where topology allows it. Parts with violations stay as they are.
LabelledMesh preview_of(const PageModel& model, const PageOptions& options) {
    LabelledMesh copy = import_arrays(export_arrays(model.mesh, model.labels, model.background));
    std::vector<Label> background;
    for (const Label label : model.background) background.push_back(copy.labels.dense(model.labels.input(label)));
    const BoxAxes axes(copy.mesh);
    lock_violations(copy.mesh, {.background = background, .threads = options.threads});
    simplify(copy.mesh, {.target_faces = options.preview_faces,
                         .promises = {.scale = typical_edge(copy.mesh)},
                         .threads = options.threads});
    axes.restore(copy.mesh);
    return copy;
}

struct PageData {
    Json json;
    std::string bytes;
};

PageData model_data(const PageModel& model, const PageOptions& options) {
    FileView view(model.mesh, model.labels, model.background, model.names);
    view.set_given_colours(model.colours);
    PageData data{{{"title", model.title},
                   {"faces", model.mesh.face_count()},
                   {"vertices", model.mesh.vertex_count()},
                   {"exterior", view.label_text(exterior(0))},
                   {"space", model.space == Space::kUnknown ? Json(nullptr) : Json(space_name(model.space))},
                   {"labels", labels_json(view)}},
                  {}};
    PageGeometry geometry;
    if (model.mesh.face_count() <= options.preview_faces) {
        geometry = page_geometry(view, model.distances);
        data.json["has_distances"] = !model.distances.empty();
    } else {
        LabelledMesh preview = preview_of(model, options);
        LabelTable labels = std::move(preview.labels);
        // All labels of the model, so that places in the order of labels are those of the model.
        for (Label label = 0; label < model.labels.size(); ++label) labels.dense(model.labels.input(label));
        std::vector<Label> background;
        for (const Label label : model.background) background.push_back(labels.dense(model.labels.input(label)));
        geometry = page_geometry(FileView(preview.mesh, labels, background), {});
        data.json["has_distances"] = false;
    }
    data.json["fingerprint"] = fmt::format("{:016x}", model_fingerprint(view));
    data.json.update(geometry_json(geometry));
    data.bytes = deflated(geometry.bytes);
    return data;
}

/// Labels as text: a number of JavaScript holds 53 bits.
void put_labels_as_text(Json& json) {
    const auto to_text = [](Json& label) {
        if (label.is_number()) label = label.dump();
    };
    if (json.is_object())
        for (auto& [key, value] : json.items()) {
            if (key == "label")
                to_text(value);
            else if (key == "labels" && value.is_array())
                for (Json& label : value) to_text(label);
            else
                put_labels_as_text(value);
        }
    else if (json.is_array() && !json.empty() && json.front().is_object())
        for (Json& value : json) put_labels_as_text(value);
}

Json page_json(const std::filesystem::path& path, const PageOptions& options) {
    Json json{{"version", 1},
              {"command", options.command},
              {"command_line", options.command_line},
              {"has_labels", options.has_labels},
              {"boundary_is_open", options.boundary_is_open}};
    json["min_quality"] = options.min_quality ? Json(*options.min_quality) : Json(nullptr);
    json["max_error"] = options.max_error ? Json(*options.max_error) : Json(nullptr);
    json["report"] = options.report.empty() ? Json(nullptr) : Json::parse(options.report, nullptr, false);
    if (json["report"].is_discarded())
        throw Error(ErrorCode::kOutput, path.string() + ": its report is no JSON text; give that of report_json()");
    put_labels_as_text(json["report"]);
    json["models"] = Json::array();
    return json;
}

/// The unit of length that all models have.
Json unit_json(const std::vector<PageModel>& models) {
    const std::optional<double> metres = models.front().metres;
    const bool is_common =
        metres && std::ranges::all_of(models, [&](const PageModel& m) { return m.metres == metres; });
    return is_common ? Json(length_symbol(*metres)) : Json(nullptr);
}

std::string title_of(const std::vector<PageModel>& models) {
    std::string title;
    for (const PageModel& model : models) title += (title.empty() ? "" : " and ") + model.title;
    return title + " - regionmesh";
}

}  // namespace

void write_page(const std::filesystem::path& path, const std::vector<PageModel>& models, const PageOptions& options,
                OutputFiles& files) {
    if (models.empty() || models.size() > 2)
        throw Error(ErrorCode::kOutput,
                    fmt::format("{}: {} models; a page shows one, or two side by side", path.string(), models.size()));
    for (const PageModel& model : models)
        if (!model.distances.empty() && model.distances.size() < model.mesh.vertex_end())
            throw Error(ErrorCode::kOutput,
                        fmt::format("{}: {} distances for {} vertices; give one for each", path.string(),
                                    model.distances.size(), model.mesh.vertex_end()));
    Json json = page_json(path, options);
    json["unit"] = unit_json(models);
    OutputFile& file = files.add(path);
    const std::size_t title = kPageTemplate.find(kTitlePlace), data = kPageTemplate.find(kDataPlace);
    file.write(kPageTemplate.substr(0, title));
    file.write(escaped_html(title_of(models)));
    file.write(kPageTemplate.substr(title + kTitlePlace.size(), data - title - kTitlePlace.size()));
    for (std::size_t n = 0; n < models.size(); ++n) {
        PageData model = model_data(models[n], options);
        file.write(fmt::format("<script type=\"text/plain\" id=\"geometry-{}\">{}</script>\n", n, model.bytes));
        json["models"].push_back(std::move(model.json));
    }
    file.write(fmt::format("<script type=\"application/json\" id=\"page-data\">{}</script>\n", script_json(json)));
    file.write(kPageTemplate.substr(data + kDataPlace.size()));
}

void write_page(const std::filesystem::path& path, const std::vector<PageModel>& models, const PageOptions& options) {
    OutputFiles files;
    write_page(path, models, options, files);
    files.commit();
}

}  // namespace regionmesh
