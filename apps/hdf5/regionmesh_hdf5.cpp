// Reads or makes one HDF5 file for another process; README.md describes the protocol.
#include <signal.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>

#include "catalogue.h"
#include "dream3d_file.h"
#include "regionmesh/sandbox.h"

namespace regionmesh::hdf5 {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kMostBytes = std::uint64_t{4} << 30;  // of address space, in addition to that at the start
constexpr std::uint64_t kMostRequest = std::uint64_t{1} << 20;
enum Exit { kDone, kWrongInput, kUsage, kOutOfMemory };

/// In front of each message, in either direction.
struct Head {
    std::array<char, 8> magic;
    std::uint64_t size;  // of the message, in bytes
};
constexpr std::array<char, 8> kRequest{'R', 'M', 'H', '5', 'A', 'S', 'K', '1'};
constexpr std::array<char, 8> kAnswer{'R', 'M', 'H', '5', 'A', 'N', 'S', '1'};
constexpr std::array<char, 8> kRefusal{'R', 'M', 'H', '5', 'N', 'O', '_', '1'};

void limit(int resource, rlim_t most) {
    rlimit now{};
    if (::getrlimit(resource, &now) != 0) return;
    now.rlim_cur = std::min(now.rlim_max, most);
    ::setrlimit(resource, &now);
}

/// The first number of statm is the size of the process in pages.
void limit_memory() {
    std::uint64_t pages = 0;
    if (std::ifstream("/proc/self/statm") >> pages)
        limit(RLIMIT_AS, pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) + kMostBytes);
}

/// Of processor time, from now on; SIGPROF ends the process. RLIMIT_CPU counts from the start of the process instead.
void limit_seconds(unsigned seconds) {
    itimerval timer{};
    timer.it_value.tv_sec = static_cast<time_t>(seconds);
    ::setitimer(ITIMER_PROF, &timer, nullptr);
}

/// To the file, if there is one, and to what the library may load: filters, from the folders where they are installed.
void confine(const char* name) {
    SandboxRules rules{.reads_anything = false};
    if (name == nullptr) {
        enter_sandbox(rules);
        return;
    }
    rules.readable = {name, "/usr", "/lib", "/lib64", "/opt", "/etc/ld.so.cache"};
    const char* variable = std::getenv("HDF5_PLUGIN_PATH");
    std::istringstream folders(variable == nullptr ? "" : variable);
    for (std::string folder; std::getline(folders, folder, ':');) rules.readable.emplace_back(folder);
    enter_sandbox(rules);
}

bool receive(void* bytes, std::size_t count) { return std::fread(bytes, 1, count, stdin) == count; }

void send(const std::array<char, 8>& magic, std::span<const std::byte> message) {
    const Head head{magic, message.size()};
    if (std::fwrite(&head, sizeof head, 1, stdout) != 1 ||
        std::fwrite(message.data(), 1, message.size(), stdout) != message.size() || std::fflush(stdout) != 0) {
        std::exit(kDone);  // the reader is gone
    }
}

void send(const std::array<char, 8>& magic, std::string_view text) { send(magic, std::as_bytes(std::span(text))); }

/// Words of the file need not be UTF-8, as JSON must be.
std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json to_json(const Entry& entry) {
    return {{"path", entry.path},
            {"is_dataset", entry.is_dataset},
            {"type", entry.type},
            {"shape", entry.shape},
            {"chunk", entry.chunk},
            {"is_integer", entry.is_integer},
            {"stored_bytes", entry.stored_bytes},
            {"obstacle", entry.obstacle},
            {"values", entry.values},
            {"numbers", entry.numbers},
            {"words", entry.words}};
}

void send_entries(Catalogue& file, const Json& request) {
    Json entries = Json::array();
    if (!request.contains("path")) {
        for (const Entry& entry : file.entries()) entries.push_back(to_json(entry));
    } else if (const auto entry = file.entry(request.at("path"))) {
        entries.push_back(to_json(*entry));
    }
    send(kAnswer, dump(entries));
}

void answer(const char* name, std::optional<Catalogue>& file, const Json& request) {
    limit_seconds(request.at("seconds"));
    try {
        if (!file) file.emplace(name);
        if (!request.contains("start")) return send_entries(*file, request);
        send(kAnswer, file->read(request.at("path"), {.start = request.at("start"), .count = request.at("count")}));
    } catch (const Refusal& refusal) {
        send(kRefusal, std::string_view(refusal.what()));
    }
}

/// The file comes on standard output, whole or not at all.
int write_dream3d() {
    const std::string bytes = make_dream3d();
    const std::uint64_t size = bytes.size();
    if (std::fwrite(&size, sizeof size, 1, stdout) != 1) return kWrongInput;
    return std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size() && std::fflush(stdout) == 0 ? kDone
                                                                                                          : kWrongInput;
}

int serve(const char* name) {
    std::optional<Catalogue> file;
    for (Head head; receive(&head, sizeof head);) {
        std::string text(std::min(head.size, kMostRequest), '\0');
        if (head.magic != kRequest || !receive(text.data(), text.size()) || text.size() != head.size) {
            std::fputs("regionmesh-hdf5: standard input holds no request\n", stderr);
            return kWrongInput;
        }
        answer(name, file, Json::parse(text));
    }
    return kDone;
}

}  // namespace
}  // namespace regionmesh::hdf5

int main(int count, char** words) {
    using namespace regionmesh::hdf5;
    if (count == 2 && std::strcmp(words[1], "--version") == 0)
        return std::puts("regionmesh-hdf5 " REGIONMESH_VERSION), 0;
    if (count != 2) {
        std::fputs("regionmesh-hdf5 FILE or --write-dream3d: reads and writes HDF5 for regionmesh, which starts it\n",
                   stderr);
        return kUsage;
    }
    // An interrupt is for the process that asks; when that ends, so does the input here.
    ::signal(SIGINT, SIG_IGN);
    for (const int number : {SIGPROF, SIGABRT, SIGSEGV, SIGBUS, SIGFPE}) ::signal(number, SIG_DFL);
    limit(RLIMIT_CORE, 0);
    const bool is_writing = std::strcmp(words[1], "--write-dream3d") == 0;
    if (!is_writing) limit_memory();
    int code = kWrongInput;
    try {
        confine(is_writing ? nullptr : words[1]);
        code = is_writing ? write_dream3d() : serve(words[1]);
    } catch (const std::bad_alloc&) {
        code = kOutOfMemory;
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "regionmesh-hdf5: %s\n", problem.what());
    }
    std::fflush(stdout);
    std::_Exit(code);  // no destructors: on a damaged file, closing it may crash too
}
