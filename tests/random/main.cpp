// Whole runs with volumes and options drawn at random. Of every run it demands: an exit code that is documented, one
// line and no file where it fails, no other file than those asked for, a report that agrees with the exit code and with
// what `check --sections` finds in the model, every sample in its region where the options promise it, and the same
// bytes for any number of threads and, without decimation, for the least --memory. Usage: regionmesh_random [--count N]
// [--seed S] [--from N]; `--from N --count 1` repeats run N and leaves its files.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "random/draw_case.h"

namespace regionmesh::random {
namespace {

namespace fs = std::filesystem;

constexpr int kMostSeconds = 120;

struct Ran {
    int code = -1, signal = 0;
    std::string output, error;
};

std::string bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string joined(const Words& words) {
    std::string text;
    for (const std::string& word : words) text += " " + word;
    return text;
}

Words operator+(Words a, const Words& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// Runs the program in `folder`.
Ran run(const fs::path& folder, Words words) {
    words.insert(words.begin(), REGIONMESH_PROGRAM);
    const pid_t child = ::fork();
    if (child == 0) {
        ::alarm(kMostSeconds);  // kept by the program that is started
        if (::chdir(folder.c_str()) != 0) ::_exit(99);
        ::dup2(::open("../stdout", O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
        ::dup2(::open("../stderr", O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        ::execv(REGIONMESH_PROGRAM, pointers.data());
        ::_exit(98);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    Ran ran{.output = bytes_of(folder / "../stdout"), .error = bytes_of(folder / "../stderr")};
    if (WIFEXITED(status)) ran.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) ran.signal = WTERMSIG(status);
    return ran;
}

/// One case in a folder of its own. The first thing that is wrong ends it.
class Trial {
public:
    Trial(const Case& drawn, const fs::path& folder) : case_(drawn), folder_(folder) {
        fs::remove_all(folder);
        fs::create_directories(folder);
        std::ofstream(folder / "v.npy", std::ios::binary) << drawn.npy;
    }

    /// What is wrong, or nothing. `outcome` says how the program ended.
    std::string wrong(std::string& outcome) {
        Words limit;
        if (case_.memory > 0) {
            const double least = least_megabytes();
            if (least > 0) limit = {"--memory", std::to_string(static_cast<std::uint64_t>(least * case_.memory * 1e6))};
        }
        const Ran first = reconstruct("one", Words{"--threads", "1"} + limit);
        outcome = "exit " + std::to_string(first.code) + (limit.empty() ? "" : ", tight");
        if (std::string text = wrong_ending("one", first); !text.empty()) return text;
        const Ran second = reconstruct("two", Words{"--threads", std::to_string(case_.threads)} + limit);
        if (second.code != first.code || second.signal != 0)
            return "another exit code with more threads: " + second.error;
        if (first.code == 1 || first.code == 2) return "";
        if (model("one") != model("two")) return "other bytes with more threads";
        if (std::string text = wrong_report(first.code); !text.empty()) return text;
        if (std::string text = wrong_check(first.code); !text.empty()) return text;
        if (limit.empty() || case_.is_decimated) return "";
        reconstruct("three", {});
        return model("one") == model("three") ? "" : "other bytes with less --memory";
    }

private:
    Ran reconstruct(const std::string& name, const Words& more) {
        fs::create_directory(folder_ / name);
        return run(folder_ / name,
                   Words{"reconstruct", "../v.npy", "-o", case_.model, "--report", "r.json", "--no-sync"} +
                       case_.input + case_.both + case_.options + more);
    }
    std::string model(const std::string& name) const { return bytes_of(folder_ / name / case_.model); }

    /// From the line with which the program refuses too little; 0 if it ends before that.
    double least_megabytes() {
        const std::string error = reconstruct("least", {"--memory", "1MB"}).error, words = "needs at least ";
        const std::size_t at = error.find(words);
        return at == std::string::npos ? 0 : std::atof(error.c_str() + at + words.size());
    }

    std::string wrong_ending(const std::string& name, const Ran& ran) const {
        if (ran.signal == SIGALRM) return "did not end";
        if (ran.signal != 0) return "signal " + std::to_string(ran.signal) + ": " + ran.error;
        std::size_t files = 0;
        for (const auto& entry : fs::directory_iterator(folder_ / name)) {
            const std::string file = entry.path().filename();
            if (file != case_.model && file != "r.json") return file + " is left";
            ++files;
        }
        if (ran.code == 0 || ran.code == 3 || ran.code == 4) return files == 2 ? "" : "an output is missing";
        if (ran.code != 1 && ran.code != 2) return "exit code " + std::to_string(ran.code) + ": " + ran.error;
        if (files > 0) return "a file of a failed run";
        const bool is_line =
            ran.error.starts_with("regionmesh") && std::count(ran.error.begin(), ran.error.end(), '\n') == 1;
        return is_line ? "" : "more than one line: " + ran.error;
    }

    std::string wrong_report(int code) const {
        const nlohmann::json report = nlohmann::json::parse(bytes_of(folder_ / "one" / "r.json"));
        std::uint64_t violations = 0;
        for (const auto& [kind, count] : report.at("violation_counts").items())
            violations += count.get<std::uint64_t>();
        if ((violations > 0) != (code == 3))
            return std::to_string(violations) + " violations, exit " + std::to_string(code);
        if ((report.at("volumes_preserved").at("regions_off") > 0) != (code == 4) && code != 3)
            return "volumes that are off, exit " + std::to_string(code);
        if (!case_.keeps_samples) return "";
        if (case_.is_open) return report.contains("samples") ? "samples of an open model" : "";
        const auto moved = report.at("samples_wrong").get<std::uint64_t>();
        return moved == 0 ? "" : std::to_string(moved) + " samples wrong";
    }

    std::string wrong_check(int code) const {
        // --room changes labels first, so that the model is not that of the sections.
        const Words sections = case_.has_room ? Words{} : Words{"--sections", "../v.npy"} + case_.input;
        const Ran ran = run(folder_ / "one", Words{"check", case_.model} + sections + case_.both);
        if (ran.code != (code == 4 ? 0 : code))
            return "check ends with " + std::to_string(ran.code) + ", the run with " + std::to_string(code) + ": " +
                   ran.output + ran.error;
        if (!case_.keeps_samples || case_.has_room || case_.is_open) return "";
        return ran.output.find("keeps its label") != std::string::npos ? "" : "check: " + ran.output;
    }

    const Case& case_;
    fs::path folder_;
};

int run_all(std::uint64_t count, std::uint64_t seed, std::uint64_t from) {
    const fs::path folder = fs::temp_directory_path() / ("regionmesh_random_" + std::to_string(::getpid()));
    std::map<std::string, std::uint64_t> outcomes;
    std::uint64_t failures = 0, refused = 0;
    std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
    for (std::uint64_t n = from; n < from + count; ++n) {
        std::mt19937_64 random(seed * 1'000'003 + n);
        const Case drawn = draw_case(random);
        std::string outcome;
        const std::string wrong = Trial(drawn, folder).wrong(outcome);
        ++outcomes[outcome];
        refused += outcome.starts_with("exit 1") || outcome.starts_with("exit 2");
        if (outcome.starts_with("exit 3"))
            std::printf("violations, reported by the run: --seed %llu --from %llu\n",
                        static_cast<unsigned long long>(seed), static_cast<unsigned long long>(n));
        if (!wrong.empty()) {
            ++failures;
            std::printf("FAILED --seed %llu --from %llu: %s, %s,%s%s, threads 1 and %llu, memory %.1f: %s\n",
                        static_cast<unsigned long long>(seed), static_cast<unsigned long long>(n), drawn.text.c_str(),
                        drawn.model.c_str(), joined(drawn.input + drawn.both).c_str(), joined(drawn.options).c_str(),
                        static_cast<unsigned long long>(drawn.threads), drawn.memory, wrong.c_str());
        }
        if ((n - from) % 500 == 499)
            std::printf("%llu runs, %llu failures\n", static_cast<unsigned long long>(n - from + 1),
                        static_cast<unsigned long long>(failures));
        std::fflush(stdout);
    }
    if (count == 1) {
        std::printf("files: %s\n", folder.c_str());
    } else {
        fs::remove_all(folder);
    }
    for (const auto& [outcome, times] : outcomes)
        std::printf("%s: %llu\n", outcome.c_str(), static_cast<unsigned long long>(times));
    // A program that refuses everything would pass.
    if (count >= 50 && refused * 3 > count) ++failures, std::printf("FAILED: more than a third were refused\n");
    std::printf("seed %llu, from %llu: %llu runs, %llu failures\n", static_cast<unsigned long long>(seed),
                static_cast<unsigned long long>(from), static_cast<unsigned long long>(count),
                static_cast<unsigned long long>(failures));
    return failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace regionmesh::random

int main(int count, char** words) {
    std::uint64_t values[] = {50, 1, 0};
    constexpr const char* kNames[] = {"--count", "--seed", "--from"};
    for (int n = 1; n + 1 < count; n += 2)
        for (int i = 0; i < 3; ++i)
            if (!std::strcmp(words[n], kNames[i])) values[i] = std::strtoull(words[n + 1], nullptr, 10);
    return regionmesh::random::run_all(values[0], values[1], values[2]);
}
