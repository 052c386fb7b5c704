// Holds the peak of the program against --memory. Each trial draws a volume, options, a multiple of the least --memory
// that the program accepts, and the kind of limit. The peak is that of the child process (wait4). A plan may be passed
// by kTolerance, and by more where topology keeps the model above its target and the program warns during the run. A
// hard limit may be passed by nothing: the run ends with exit code 1, one line and no file.
// Usage: regionmesh_memory [--count N | --volumes N] [--seed S] [--longest N]
//   --volumes N   instead of trials drawn: N volumes, each with all options and multiples, on two threads, with a plan
//   --longest N   of an axis of a volume, in samples
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "memory/volumes.h"

namespace regionmesh::memory {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// The promise of a plan (docs/explanation/memory.md).
constexpr double kTolerance = 0.10;
constexpr double kBudgets[] = {1, 1.1, 1.3, 1.7, 2.5};  // times the least
const Words kOptions[] = {
    {"--reduce", "90%"},
    {"--reduce", "95%", "--smooth", "0", "--min-quality", "0.2"},
    {"--target-faces", "20000", "--smooth-filter", "taubin", "--smooth", "60", "--sweep", "x"},
    {"--no-decimate", "--smooth", "0"},
};

struct Ran {
    int code = -1;
    double peak = 0;  // bytes
    std::string text;
};

std::string text_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

Ran run(const fs::path& folder, const Words& arguments) {
    const std::string log = (folder / "log").string();
    Words words{REGIONMESH_PROGRAM, "reconstruct", (folder / "v.npy").string(), "-o",
                (folder / "out" / "m.vtp").string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
        ::dup2(1, 2);
        ::execv(REGIONMESH_PROGRAM, pointers.data());
        ::_exit(98);
    }
    int status = 0;
    rusage usage{};
    ::wait4(child, &status, 0, &usage);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, static_cast<double>(usage.ru_maxrss) * 1024, text_of(log)};
}

/// The least --memory in MB, from the line with which the program refuses too little.
double least_megabytes(const fs::path& folder, Words options) {
    options.insert(options.end(), {"--memory", "1MB"});
    const std::string text = run(folder, options).text, words = "needs at least ";
    const std::size_t at = text.find(words);
    return at == std::string::npos ? 0 : std::atof(text.c_str() + at + words.size());
}

/// What is wrong with a run, or nothing.
std::string fault(const Ran& ran, double memory, bool is_hard, bool has_output) {
    if (!is_hard) {
        if (ran.code != 0) return "exit code " + std::to_string(ran.code);
        const auto has = [&](const char* words) { return ran.text.find(words) != std::string::npos; };
        const bool is_said = has("used more than --memory") && has("stopped before the target") &&
                             has("warning: topology or --max-error leave");
        return ran.peak > memory * (1 + kTolerance) && !is_said ? "more than the plan" : "";
    }
    if (ran.peak > memory) return "more than the hard limit";
    if (ran.code == 0) return has_output ? "" : "no output";
    if (ran.code != 1 || ran.text.rfind("regionmesh: --memory-limit hard", 0) != 0) return "no clear end";
    return has_output ? "an output of a run that was ended" : "";
}

/// What a trial draws.
struct Draw {
    Volume volume;
    Words options;
    double times;  // the least memory
    bool is_hard;
};

Draw draw_trial(std::mt19937_64& random, std::uint32_t longest) {
    const auto draw = [&](std::uint32_t end) { return static_cast<std::uint32_t>(random() % end); };
    Draw drawn{
        .volume = {static_cast<Pattern>(draw(kPatterns)), {}, random()}, .options = {}, .times = 1, .is_hard = true};
    for (std::uint32_t& size : drawn.volume.size) size = longest * 3 / 8 + draw(longest * 5 / 8 + 1);
    drawn.options = kOptions[draw(std::size(kOptions))];
    drawn.options.insert(drawn.options.end(), {"--no-background", "--threads", std::to_string(1 + draw(3))});
    drawn.times = kBudgets[draw(std::size(kBudgets))];
    drawn.is_hard = draw(2) == 1;
    return drawn;
}

/// Noise that topology keeps above its target: no plan holds.
Draw hopeless() {
    return {.volume = {Pattern::kNoise, {28, 28, 28}, 1},
            .options = {"--reduce", "99%", "--smooth", "0", "--min-quality", "0.25", "--no-background"},
            .times = 1,
            .is_hard = true};
}

/// What a test found.
struct Sums {
    std::uint64_t trials = 0, failures = 0, warned = 0;  // warned: passed by more than the tolerance
    double most = 0;                                     // of the peaks of others, as a share of the memory
};

void try_one(const Draw& drawn, const fs::path& folder, Sums& sums) {
    const auto& [volume, drawn_options, times, is_hard] = drawn;
    Words options = drawn_options;
    write_npy(volume, folder / "v.npy");
    fs::remove_all(folder / "out");
    fs::create_directory(folder / "out");
    ++sums.trials;
    const double least = least_megabytes(folder, options);
    if (least <= 0) {
        std::printf("FAILED %s: no least memory: %s\n", volume.text().c_str(), text_of(folder / "log").c_str());
        ++sums.failures;
        return;
    }
    const auto memory = static_cast<std::uint64_t>(least * times * 1e6);
    options.insert(options.end(), {"--memory", std::to_string(memory)});
    if (is_hard) options.insert(options.end(), {"--memory-limit", "hard"});
    const Ran ran = run(folder, options);
    const std::string wrong = fault(ran, static_cast<double>(memory), is_hard, !fs::is_empty(folder / "out"));
    std::string words;
    for (const std::string& word : options) words += " " + word;
    std::printf("%s%s:%s: exit %d, peak %.0f MB of %.0f MB (%.0f %%) %s\n", wrong.empty() ? "" : "FAILED ",
                volume.text().c_str(), words.c_str(), ran.code, ran.peak / 1e6, static_cast<double>(memory) / 1e6,
                100 * ran.peak / static_cast<double>(memory), wrong.c_str());
    std::fflush(stdout);
    if (!wrong.empty()) std::printf("%s", ran.text.c_str());
    sums.failures += !wrong.empty();
    const double share = ran.peak / static_cast<double>(memory);
    if (share > 1 + kTolerance) {
        ++sums.warned;
    } else {
        sums.most = std::max(sums.most, share);
    }
}

/// All options and multiples of the least memory for a volume.
void try_all(const Volume& volume, const fs::path& folder, Sums& sums) {
    for (const Words& options : kOptions)
        for (const double times : kBudgets) {
            Draw drawn{.volume = volume, .options = options, .times = times, .is_hard = false};
            drawn.options.insert(drawn.options.end(), {"--no-background", "--threads", "2"});
            try_one(drawn, folder, sums);
        }
}

}  // namespace
}  // namespace regionmesh::memory

int main(int argc, char** argv) {
    using namespace regionmesh::memory;
    std::uint64_t count = 12, seed = 1, longest = 64, volumes = 0;
    for (int n = 1; n + 1 < argc; n += 2) {
        const std::string flag = argv[n];
        if (flag == "--count") count = std::strtoull(argv[n + 1], nullptr, 10);
        if (flag == "--volumes") volumes = std::strtoull(argv[n + 1], nullptr, 10);
        if (flag == "--longest") longest = std::strtoull(argv[n + 1], nullptr, 10);
        if (flag == "--seed") seed = std::strtoull(argv[n + 1], nullptr, 10);
    }
    std::string folder = (fs::temp_directory_path() / "regionmesh-memory-XXXXXX").string();
    if (!::mkdtemp(folder.data())) return 1;
    std::mt19937_64 random(seed);
    Sums sums;
    for (std::uint64_t n = 0; n < volumes; ++n) {
        Volume volume = draw_trial(random, static_cast<std::uint32_t>(longest)).volume;
        volume.pattern = static_cast<Pattern>(n % kPatterns);  // as many of each
        try_all(volume, folder, sums);
    }
    for (std::uint64_t n = 0; volumes == 0 && n < count; ++n)
        try_one(n == 0 ? hopeless() : draw_trial(random, static_cast<std::uint32_t>(longest)), folder, sums);
    fs::remove_all(folder);
    std::printf(
        "seed %llu: %llu trials, %llu failures; %llu above the plan by more than a tenth, with a warning; the "
        "others took %.0f %% at most\n",
        static_cast<unsigned long long>(seed), static_cast<unsigned long long>(sums.trials),
        static_cast<unsigned long long>(sums.failures), static_cast<unsigned long long>(sums.warned), 100 * sums.most);
    return sums.failures > 0 ? 1 : 0;
}
