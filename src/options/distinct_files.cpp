// Refuses a run that would write over one of its own files.
#include <fmt/core.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "formats/array/volume_formats.h"
#include "formats/registry.h"
#include "regionmesh/error.h"
#include "regionmesh/options.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

/// A file as the system identifies it: device and number, and the name in that folder for a file that does not exist.
struct Identity {
    dev_t device;
    ino_t number;
    std::string name;
    auto operator<=>(const Identity&) const = default;
};

/// None for a device or a pipe, which may be written and read under several names, and where no file can be.
std::optional<Identity> identity_of(const fs::path& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0) {
        if (!S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) return {};
        return Identity{status.st_dev, status.st_ino, {}};
    }
    std::error_code ignored;
    const fs::path target = fs::weakly_canonical(path, ignored);
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (::stat(folder.c_str(), &status) != 0) return {};
    return Identity{status.st_dev, status.st_ino, target.filename().string()};
}

/// One file of the run, and the option that names it.
struct NamedFile {
    const OptionSpec* option;
    fs::path path;

    std::string text() const { return (option->is_argument ? "" : option->flag() + " ") + path.string(); }
};

struct Files {
    std::vector<NamedFile> read, written;
};

Files files_of(const Settings& settings) {
    Files files;
    for (const auto& [name, text] : settings.given) {
        const OptionSpec& option = *find_option(name);
        if (option.kind != OptionKind::kFile || text.empty()) continue;
        if (!option.is_output) {
            files.read.push_back({&option, file_of_input(text)});
            continue;
        }
        files.written.push_back({&option, text});
        const formats::Format* const format = formats::find_format(text);
        if (format && format->companion)
            files.written.push_back({&option, fs::path(text).replace_extension(format->companion)});
    }
    return files;
}

[[noreturn]] void refuse(const NamedFile& written, const NamedFile& other) {
    throw Error(ErrorCode::kUsage,
                fmt::format("{}: is the same file as {}, which this run {}; give another name", written.text(),
                            other.text(), other.option->is_output ? "writes, too" : "reads"));
}

bool is_in_folder(const fs::path& path, const fs::path& folder) {
    std::error_code ignored;
    const fs::path inner = fs::weakly_canonical(path, ignored), outer = fs::weakly_canonical(folder, ignored);
    const auto [at, in] = std::ranges::mismatch(outer, inner);
    return at == outer.end() && in != inner.end();
}

/// A model may be smoothed or decimated in place: it is held in memory before it is written.
bool is_in_place(const NamedFile& written, const NamedFile& read) {
    return written.option->name == "output" && read.option->name == "model" &&
           fs::path(written.path).extension() == fs::path(read.path).extension();
}

/// Whether --per-region may give a region of this name, or this label, to a file. The regions are not known yet.
bool is_region(std::string text) {
    const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
    const auto is_of_word = [](unsigned char c) { return c < 0x80 && (std::isalnum(c) != 0 || c == '_'); };
    if (text.empty()) return false;
    if (std::isalpha(static_cast<unsigned char>(text[0]))) return std::ranges::all_of(text, is_of_word);
    if (text.starts_with('-')) text.erase(0, 1);
    return !text.empty() && std::ranges::all_of(text, is_digit);
}

/// Whether `path` is a file that --per-region may write: MODEL-NAME.EXTENSION or MODEL-LABEL.EXTENSION.
bool is_region_file(const fs::path& path, const fs::path& model) {
    const std::string name = path.stem().string(), start = model.stem().string() + '-';
    if (path.extension() != model.extension() || !name.starts_with(start)) return false;
    if (!is_region(name.substr(start.size()))) return false;
    const auto parent = [](const fs::path& file) {
        return file.has_parent_path() ? file.parent_path() : fs::path(".");
    };
    return identity_of(parent(path)) == identity_of(parent(model));
}

}  // namespace

fs::path file_of_input(const std::string& input) { return formats::split_dataset(input).file; }

void require_distinct_files(const Settings& settings) {
    const auto [read, written] = files_of(settings);
    for (std::size_t n = 0; n < written.size(); ++n) {
        const NamedFile& file = written[n];
        const auto identity = identity_of(file.path);
        if (!identity) continue;
        const auto clashes = [&](const NamedFile& other) {
            return identity_of(other.path) == identity ||
                   (settings.per_region && file.path == settings.output && is_region_file(other.path, file.path));
        };
        std::error_code ignored;
        for (const NamedFile& other : read) {
            if (clashes(other) && !is_in_place(file, other)) refuse(file, other);
            if (fs::is_directory(other.path, ignored) && fs::exists(file.path, ignored) &&
                is_in_folder(file.path, other.path))
                throw Error(ErrorCode::kUsage,
                            fmt::format("{}: is a file in {}, which this run reads; give another name", file.text(),
                                        other.path.string()));
        }
        for (std::size_t m = 0; m < written.size(); ++m)
            if (m != n && (m < n || settings.per_region) && clashes(written[m])) refuse(file, written[m]);
    }
}

}  // namespace regionmesh
