// Lets single calls and allocations of the program fail, and kills it, at places drawn at random. Whatever fails:
// the exit code is 0 to 3, inputs keep their bytes, outputs have either their earlier bytes or those of a good run, no
// temporary file is left behind, and the program ends. Usage: regionmesh_faults [--count N] [--seed S] [--from N]
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "faults/scenarios.h"
#include "support/paths.h"

namespace regionmesh::faults {
namespace {

namespace fs = std::filesystem;
using Bytes = std::map<std::string, std::string>;  // of files, by name

constexpr const char* kModes[] = {"call", "memory", "kill", "term"};
constexpr int kMostSeconds = 120;

struct Fault {
    std::string mode = "none";
    std::uint64_t at = 0;
    std::string text() const { return mode + " " + std::to_string(at); }
};

struct Ran {
    int code = -1, signal = 0;
    std::string error;
};

std::string text_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

Bytes files_in(const fs::path& folder) {
    Bytes files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = text_of(entry.path());
    return files;
}

/// Runs the program in `folder` under the shim.
Ran run(const Scenario& scenario, const fs::path& folder, const Fault& fault) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::alarm(kMostSeconds);  // kept by the program that is started
        if (::chdir((folder / "out").c_str()) != 0) ::_exit(99);
        ::dup2(::open((folder / "stdout").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
        ::dup2(::open((folder / "stderr").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
        ::setenv("LD_PRELOAD", test::shim().c_str(), 1);
        ::setenv("REGIONMESH_FAULT", fault.mode.c_str(), 1);
        ::setenv("REGIONMESH_FAULT_AT", std::to_string(fault.at).c_str(), 1);
        ::setenv("REGIONMESH_FAULT_COUNT", (folder / "counts").c_str(), 1);
        std::vector<std::string> words{test::program()};
        words.insert(words.end(), scenario.arguments.begin(), scenario.arguments.end());
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        ::execv(words[0].c_str(), pointers.data());
        ::_exit(98);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    Ran ran{.error = text_of(folder / "stderr")};
    if (WIFEXITED(status)) ran.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) ran.signal = WTERMSIG(status);
    return ran;
}

/// A scenario in a folder of its own, with its good outputs.
class Trial {
public:
    Trial(const Scenario& scenario, const fs::path& folder) : scenario_(scenario), folder_(folder) {
        fs::create_directories(folder / "in");
        fs::create_directories(folder / "out");
        for (const auto& [name, bytes] : scenario.inputs) put(folder / "in" / name, bytes);
        inputs_ = files_in(folder / "in");
        const Ran good = run(scenario, folder, {});
        if (good.code != 0) complain("a good run", good, "fails");
        good_ = files_in(folder / "out");
        std::ifstream(folder / "counts") >> calls_ >> allocations_;
    }

    std::uint64_t places(const std::string& mode) const { return mode == "memory" ? allocations_ : calls_; }
    int failures() const { return failures_; }

    void try_fault(const Fault& fault) {
        Bytes earlier;
        fs::remove_all(folder_ / "out");
        fs::create_directory(folder_ / "out");
        for (const auto& [name, bytes] : good_) {
            earlier[name] = "earlier " + name;
            put(folder_ / "out" / name, earlier[name]);
        }
        const Ran ran = run(scenario_, folder_, fault);
        const std::string what = scenario_.name + ", " + fault.text();
        judge_ending(what, fault, ran);
        judge_files(what, fault, ran, earlier);
        if (files_in(folder_ / "in") != inputs_) complain(what, ran, "an input changed");
        if (fault.mode == "kill") judge_next_run(what);
    }

private:
    static void put(const fs::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

    void complain(const std::string& what, const Ran& ran, const std::string& text) {
        ++failures_;
        std::printf("%s: %s (exit code %d, signal %d)\n%s\n", what.c_str(), text.c_str(), ran.code, ran.signal,
                    ran.error.c_str());
    }

    void judge_ending(const std::string& what, const Fault& fault, const Ran& ran) {
        const int wanted = fault.mode == "kill" ? SIGKILL : fault.mode == "term" ? SIGTERM : 0;
        if (ran.signal == SIGALRM) complain(what, ran, "did not end");
        if (ran.signal != 0 && ran.signal != wanted) complain(what, ran, "crashed");
        if (ran.signal == 0 && (ran.code < 0 || ran.code > 3)) complain(what, ran, "has an unknown exit code");
    }

    /// Reports hold times, so their bytes differ; a whole one ends with its last brace.
    bool is_good(const std::string& name, const std::string& bytes) const {
        if (name.ends_with(".json")) return bytes.starts_with("{") && bytes.ends_with("}\n");
        return bytes == good_.at(name);
    }

    void judge_files(const std::string& what, const Fault& fault, const Ran& ran, const Bytes& earlier) {
        std::size_t whole = 0, old = 0;
        const Bytes found = files_in(folder_ / "out");
        for (const auto& [name, bytes] : found) {
            if (!good_.contains(name)) {
                if (fault.mode != "kill") complain(what, ran, name + " was left behind");
            } else if (bytes == earlier.at(name)) {
                ++old;
            } else if (is_good(name, bytes)) {
                ++whole;
            } else {
                complain(what, ran, name + " is neither as before nor as it should be");
            }
        }
        for (const auto& [name, bytes] : good_)
            if (!found.contains(name)) complain(what, ran, name + " is gone");
        if (whole > 0 && old > 0 && fault.mode != "kill") complain(what, ran, "only some outputs are new");
        if (ran.signal == 0 && ran.code == 0 && old > 0) complain(what, ran, "says success, and an output is old");
    }

    /// The next run removes what a kill has left.
    void judge_next_run(const std::string& what) {
        const Ran ran = run(scenario_, folder_, {});
        if (ran.code != 0) complain(what, ran, "the next run fails");
        for (const auto& [name, bytes] : files_in(folder_ / "out"))
            if (!good_.contains(name)) complain(what, ran, name + " is left after the next run");
    }

    const Scenario& scenario_;
    fs::path folder_;
    Bytes inputs_, good_;
    std::uint64_t calls_ = 0, allocations_ = 0;
    int failures_ = 0;
};

int run_all(std::uint64_t count, std::uint64_t seed, std::uint64_t from) {
    const fs::path folder = fs::temp_directory_path() / ("regionmesh_faults_" + std::to_string(::getpid()));
    const std::vector<Scenario> scenarios = all_scenarios();
    std::vector<Trial> trials;
    trials.reserve(scenarios.size());
    for (const Scenario& scenario : scenarios) trials.emplace_back(scenario, folder / scenario.name);
    // The first allocation: what ends a program without memory must not need any itself.
    for (Trial& trial : trials) trial.try_fault({.mode = "memory", .at = 1});
    std::map<std::string, std::uint64_t> tried;
    for (std::uint64_t n = from; n < from + count; ++n) {
        std::mt19937_64 random(seed * 1'000'003 + n);
        Trial& trial = trials[n % trials.size()];
        Fault fault{.mode = kModes[n / trials.size() % std::size(kModes)]};
        if (trial.places(fault.mode) == 0) continue;
        fault.at = 1 + random() % trial.places(fault.mode);
        trial.try_fault(fault);
        ++tried[fault.mode];
    }
    int failures = 0;
    for (const Trial& trial : trials) failures += trial.failures();
    fs::remove_all(folder);
    std::printf("seed %llu, from %llu:", static_cast<unsigned long long>(seed), static_cast<unsigned long long>(from));
    for (const auto& [mode, times] : tried)
        std::printf(" %s %llu", mode.c_str(), static_cast<unsigned long long>(times));
    std::printf("; %d failures\n", failures);
    return failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace regionmesh::faults

int main(int count, char** words) {
    std::uint64_t values[] = {300, 1, 0};  // --count, --seed, --from
    constexpr const char* kNames[] = {"--count", "--seed", "--from"};
    for (int n = 1; n + 1 < count; n += 2)
        for (int i = 0; i < 3; ++i)
            if (!std::strcmp(words[n], kNames[i])) values[i] = std::strtoull(words[n + 1], nullptr, 10);
    return regionmesh::faults::run_all(values[0], values[1], values[2]);
}
