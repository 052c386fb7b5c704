#include "input.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <mutex>
#include <optional>

#include "messages.h"
#include "regionmesh/blocks.h"

namespace regionmesh::cli {

namespace {

/// Half a turn about z leads from RAS to LPS and back. Requires a mesh without free places.
void turn(MeshFile& file, Space space) {
    Space& own = file.coordinates.space;
    if (space == Space::kUnknown || space == own) return;
    if (own != Space::kUnknown)
        for (std::uint32_t n = 0; n < file.mesh.vertex_end(); ++n) {
            Vec3& p = file.mesh[VertexId{n}].position;
            p = {-p.x, -p.y, p.z};
        }
    own = space;
}

template <class Reader>
std::unique_ptr<Reader> with_warning(std::unique_ptr<Reader> reader) {
    static std::once_flag once;
    const auto& info = reader->info();
    if (!info.warning.empty()) std::call_once(once, [&] { warn(info.source + ": " + info.warning); });
    return reader;
}

}  // namespace

void warn_of_rest(const SectionReader& reader, const std::string& before) {
    const VolumeInfo& info = reader.info();
    if (info.warning != before && info.warning.starts_with(before))
        warn(info.source + ": " + info.warning.substr(before.empty() ? 0 : before.size() + 2));
}

std::unique_ptr<SectionReader> open_volume(const Settings& settings, const std::vector<std::string>& inputs) {
    return with_warning(open_lattice(settings, inputs));
}

PreparedSections open_prepared_volume(const Settings& settings, const std::vector<std::string>& inputs) {
    PreparedSections made = open_prepared(settings, inputs);
    made.reader = with_warning(std::move(made.reader));
    return made;
}

std::unique_ptr<TetrahedronReader> open_unstructured(const Settings& settings, const std::vector<std::string>& inputs) {
    return with_warning(open_tetrahedra(inputs.front(), settings.tetrahedra));
}

void resolve_by_input(Settings& settings) {
    if (settings.deferred.empty()) return;
    LabelNames names;
    std::optional<double> metres;
    std::string source;
    if (!settings.models.empty()) {
        source = settings.models.front();
        const MeshFile file = is_block_folder(source) ? describe_block_folder(source) : read_mesh(source);
        names = file.names;
        metres = file.coordinates.metres;
    } else if (!settings.inputs.empty()) {
        source = settings.inputs.front();
        if (source == "-")
            throw Error(ErrorCode::kUsage, "--" + settings.deferred.front().first + ' ' +
                                               settings.deferred.front().second +
                                               ": standard input can be read once; give a number, or name a file");
        Settings whole = settings;  // without what is to be resolved
        whole.volume.select = {};
        const auto note = [&](const auto& info) {
            names = info.names;
            metres = info.metres;
        };
        if (is_lattice(whole, whole.inputs))
            note(open_lattice(whole, whole.inputs)->info());
        else
            note(open_tetrahedra(whole.inputs.front(), whole.tetrahedra)->info());
    }
    if (!settings.names.empty()) names = read_label_names(settings.names);
    resolve_options(settings, names, metres, source);
}

bool has_extension(const std::string& path, const std::string& extensions) {
    std::string own = std::filesystem::path(path).extension().string();
    for (char& c : own) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return !own.empty() && (' ' + extensions + ' ').find(' ' + own + ' ') != std::string::npos;
}

void refuse_options(const Settings& settings, std::span<const std::string_view> names, const std::string& why) {
    for (const auto& [name, text] : settings.given)
        if (std::ranges::find(names, name) != names.end()) throw Error(ErrorCode::kUsage, "--" + name + ": " + why);
}

void refuse_prepared_blocks(const Settings& settings) {
    const bool is_between = settings.prepare.between.value_or(0) > 0;
    if (is_between || settings.prepare.align != AlignKind::kOff)
        throw Error(ErrorCode::kUsage, std::string(is_between ? "--between" : "--align") +
                                           ": a folder of pieces is made of the sections as they are; leave it out, or "
                                           "make a model in one file");
}

void require_fit_of_folder(const std::string& path, const ReadMeshOptions& options) {
    if (options.weld)
        throw Error(ErrorCode::kUsage, "--weld: the pieces of " + path + " share their points already; leave it out");
    if (options.orient)
        throw Error(ErrorCode::kUsage, "--orient: the pieces of " + path + " are oriented already; leave it out");
}

MeshFile read_model(const std::string& path, const ReadMeshOptions& options) {
    if (!is_block_folder(path)) return read_mesh(path, options);
    require_fit_of_folder(path, options);
    MeshFile file = read_block_folder(path);
    turn(file, options.space);
    return file;
}

CensusOptions census_options(const Settings& settings) {
    const ReconstructOptions& options = settings.reconstruct;
    return {.cap = options.cap,
            .background = options.background,
            .sweep = options.sweep,
            .cells = cell_kind(options),
            .threads = options.threads};
}

Settings settings_for(const Settings& settings, const MeshFile& file) {
    Settings own = settings;
    if (own.volume.space == Space::kUnknown) own.volume.space = file.coordinates.space;
    if (!has_background(settings) && file.background) {
        own.reconstruct.background = *file.background;
        if (!file.background->empty()) own.volume.select.rest = file.background->front();
    }
    return own;
}

CheckOptions check_options(const Settings& settings, LabelTable& labels) {
    CheckOptions options;
    options.boundary_is_open = !settings.reconstruct.cap;
    options.threads = settings.reconstruct.threads;
    for (InputLabel label : settings.reconstruct.background) options.background.push_back(labels.dense(label));
    options.label_text = [&labels](Label label) { return labels.text(labels.input(label)); };
    return options;
}

}  // namespace regionmesh::cli
