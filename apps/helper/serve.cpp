#include "serve.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <new>
#include <string>

namespace regionmesh::helper {
namespace {

using Json = nlohmann::json;
using Magic = std::array<char, 8>;

constexpr std::uint64_t kMostBytes = std::uint64_t{4} << 30;  // most address space, beyond that at the start
constexpr std::uint64_t kMostRequest = std::uint64_t{1} << 20;

/// In front of each message, in either direction.
struct Head {
    Magic magic;
    std::uint64_t size;  // size of the message, in bytes
};

Magic magic_of(const Program& program, std::string_view kind) {
    return {'R', 'M', program.letters[0], program.letters[1], kind[0], kind[1], kind[2], '1'};
}

void limit(int resource, rlim_t most) {
    rlimit now{};
    if (::getrlimit(resource, &now) != 0) return;
    now.rlim_cur = std::min(now.rlim_max, most);
    ::setrlimit(resource, &now);
}

/// Of processor time, from now on. RLIMIT_CPU counts from the start of the process instead.
void limit_seconds(unsigned seconds) {
    itimerval timer{};
    timer.it_value.tv_sec = static_cast<time_t>(seconds);
    ::setitimer(ITIMER_PROF, &timer, nullptr);
}

bool receive(void* bytes, std::size_t count) { return count == 0 || std::fread(bytes, 1, count, stdin) == count; }

void send(const Magic& magic, std::span<const std::byte> body) {
    const Head head{magic, body.size()};
    if (std::fwrite(&head, sizeof head, 1, stdout) != 1 ||
        (!body.empty() && std::fwrite(body.data(), 1, body.size(), stdout) != body.size()) ||
        std::fflush(stdout) != 0) {
        std::exit(kDone);  // the reader is gone
    }
}

}  // namespace

void send_answer(const Program& program, std::span<const std::byte> body) { send(magic_of(program, "ANS"), body); }

void send_answer(const Program& program, std::string_view body) {
    send_answer(program, std::as_bytes(std::span(body)));
}

std::string to_text(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

void prepare_process() {
    ::signal(SIGINT, SIG_IGN);  // when the process that asks ends, so does the input here
    for (const int number : {SIGPROF, SIGABRT, SIGSEGV, SIGBUS, SIGFPE}) ::signal(number, SIG_DFL);
    limit(RLIMIT_CORE, 0);
}

/// The first number of statm is the size of the process in pages.
void limit_memory() {
    std::uint64_t pages = 0;
    if (std::ifstream("/proc/self/statm") >> pages)
        limit(RLIMIT_AS, pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) + kMostBytes);
}

int serve(const Program& program, const std::function<void(const Json&)>& answer) {
    for (Head head; receive(&head, sizeof head);) {
        std::string text(std::min(head.size, kMostRequest), '\0');
        if (head.magic != magic_of(program, "ASK") || !receive(text.data(), text.size()) || text.size() != head.size) {
            std::fprintf(stderr, "%s: standard input holds no request\n", program.name);
            return kWrongInput;
        }
        const Json request = Json::parse(text);
        limit_seconds(request.at("seconds"));
        try {
            answer(request);
        } catch (const Refusal& refusal) {
            send(magic_of(program, "NO_"), std::as_bytes(std::span(std::string_view(refusal.what()))));
        }
    }
    return kDone;
}

void run(const Program& program, const std::function<int()>& work) {
    int code = kWrongInput;
    try {
        code = work();
    } catch (const std::bad_alloc&) {
        code = kOutOfMemory;
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "%s: %s\n", program.name, problem.what());
    }
    std::fflush(stdout);
    std::_Exit(code);
}

}  // namespace regionmesh::helper
