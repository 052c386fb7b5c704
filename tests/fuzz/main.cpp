// Reads damaged files, and looks for crashes, hangs, and memory that no file of that size justifies.
//   regionmesh_fuzz [--seconds S | --count N] [--seed N] [--from N] [FORMAT...]
// Every file follows from the seed and its number: `--from N --count 1` reads one of them again, and leaves it.
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/fuzz_formats.h"
#include "fuzz/watch.h"
#include "regionmesh/error.h"
#include "support/paths.h"

namespace regionmesh::fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kBaseBytes = std::uint64_t{256} << 20;
constexpr std::uint64_t kBytesPerByte = 1100;  // deflate may bring forth 1032 of one
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;

struct Arguments {
    std::uint64_t seconds = 0, count = 300, seed = 1, from = 0;
    std::vector<std::string> names;
};

struct Seeds {
    std::vector<std::string> extensions, texts;
    std::vector<fs::path> stores, places;  // of a directory that is read whole, and of the file in it
};

/// Every file of every store of a format.
Seeds gather_stores(const Format& format) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(test::data_folder()) / format.folder))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    Seeds seeds;
    for (const fs::path& file : files) {
        fs::path store = file;
        while (store.has_relative_path() && store.extension() != format.store) store = store.parent_path();
        if (!store.has_relative_path()) continue;  // beside the stores
        seeds.stores.push_back(store);
        seeds.places.push_back(file.lexically_relative(store));
        seeds.texts.push_back(text_of(file));
        seeds.extensions.emplace_back(format.store);
    }
    return seeds;
}

/// The changed text in a file of that name, or in its place in a copy of its store.
void put(const fs::path& path, const Seeds& seeds, std::size_t index, const std::string& text) {
    fs::path file = path;
    fs::remove_all(path);  // writing over a file may wait for the disk
    if (!seeds.stores.empty()) {
        fs::copy(seeds.stores[index], path, fs::copy_options::recursive);
        file /= seeds.places[index];
    }
    fs::remove(file);  // writing over a file may wait for the disk
    std::ofstream(file, std::ios::binary) << text;
}

/// The seeds of a format; all files of its folder go into `work`, where headers may name them.
Seeds gather(const Format& format, const fs::path& work) {
    if (*format.store != '\0') return gather_stores(format);
    const fs::path folder = fs::path(test::data_folder()) / format.folder;
    std::vector<fs::path> files;
    if (*format.folder == '\0') {
        files.assign(fs::directory_iterator(folder), {});
    } else if (fs::is_directory(folder)) {
        files.assign(fs::recursive_directory_iterator(folder), {});
    }
    std::sort(files.begin(), files.end());
    Seeds seeds;
    for (const fs::path& file : files) {
        if (!fs::is_regular_file(file)) continue;
        fs::copy_file(file, work / file.filename(), fs::copy_options::overwrite_existing);
        if (std::find(format.extensions.begin(), format.extensions.end(), file.extension()) == format.extensions.end())
            continue;
        seeds.texts.push_back(text_of(file));
        const bool is_packed = file.extension() == ".gz";
        seeds.extensions.push_back((is_packed ? file.stem().extension().string() : "") + file.extension().string());
    }
    return seeds;
}

/// Whether the file was read; otherwise it was refused. Anything but an Error of one line ends the program.
bool read_one(const Format& format, const fs::path& path, const std::string& text, Random& random) {
    bool is_read = false;
    std::string wrong;
    try {
        format.read(path, random);
        is_read = true;
    } catch (const Error& error) {
        if (std::string_view(error.what()).find('\n') != std::string_view::npos) wrong = "an error of several lines";
        if (error.code() != ErrorCode::kInput) wrong = "an error that is not kInput";
    } catch (const std::exception& other) {
        wrong = std::string("an exception that is no Error: ") + other.what();
    }
    if (wrong.empty()) return is_read;
    std::fprintf(stderr, "%s\nfound while reading %s\n", wrong.c_str(), text.c_str());
    std::exit(1);
}

void fuzz(const Format& format, const Arguments& arguments) {
    const fs::path work = fs::temp_directory_path() / ("regionmesh_fuzz_" + std::to_string(::getpid()));
    fs::create_directories(work);
    const Seeds seeds = gather(format, work);
    if (seeds.texts.empty()) {
        std::fprintf(stderr, "%s: no seeds in tests/data/%s\n", format.name, format.folder);
        std::exit(1);
    }
    const auto start = Clock::now();
    const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    std::uint64_t number = arguments.from, read = 0, most = 0;
    const auto goes_on = [&] {
        return arguments.seconds > 0 ? elapsed() < static_cast<double>(arguments.seconds)
                                     : number - arguments.from < arguments.count;
    };
    for (; goes_on(); ++number) {
        Random random(arguments.seed * 0x9e3779b97f4a7c15 + number);
        const std::size_t index = random.below(seeds.texts.size());
        const std::string text = mutate(seeds.texts, index, random);
        const fs::path path = work / ("mutant" + seeds.extensions[index]);
        put(path, seeds, index, text);
        const std::string again = std::string(path) + ": again with --seed " + std::to_string(arguments.seed) +
                                  " --from " + std::to_string(number) + " --count 1 " + format.name;
        begin_watch(again, std::min(kMostBytes, kBaseBytes + kBytesPerByte * text.size()));
        read += read_one(format, path, again, random);
        most = std::max(most, end_watch());
    }
    std::printf("%-7s %8llu files in %.0f s: %llu read, the others refused; at most %llu MB held\n", format.name,
                static_cast<unsigned long long>(number - arguments.from), elapsed(),
                static_cast<unsigned long long>(read), static_cast<unsigned long long>(most >> 20));
    std::fflush(stdout);
    if (arguments.count != 1) fs::remove_all(work);
}

[[noreturn]] void usage() {
    std::fprintf(stderr, "regionmesh_fuzz [--seconds S | --count N] [--seed N] [--from N] [FORMAT...]\nformats:");
    for (const Format& format : formats()) std::fprintf(stderr, " %s", format.name);
    std::fprintf(stderr, "\n");
    std::exit(2);
}

Arguments parse(int count, char** words) {
    Arguments arguments;
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        std::uint64_t* const value = word == "--seconds" ? &arguments.seconds
                                     : word == "--count" ? &arguments.count
                                     : word == "--seed"  ? &arguments.seed
                                     : word == "--from"  ? &arguments.from
                                                         : nullptr;
        if (!value) {
            arguments.names.push_back(word);
            continue;
        }
        if (++i == count) usage();
        const std::string_view text = words[i];
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), *value);
        if (error != std::errc{} || end != text.data() + text.size()) usage();
    }
    for (const std::string& name : arguments.names)
        if (std::none_of(formats().begin(), formats().end(), [&](const Format& f) { return name == f.name; })) usage();
    return arguments;
}

}  // namespace
}  // namespace regionmesh::fuzz

int main(int count, char** words) {
    using namespace regionmesh::fuzz;
    const Arguments arguments = parse(count, words);
    start_watching();
    for (const Format& format : formats()) {
        const auto& names = arguments.names;
        if (names.empty() || std::find(names.begin(), names.end(), format.name) != names.end()) fuzz(format, arguments);
    }
    return 0;
}
