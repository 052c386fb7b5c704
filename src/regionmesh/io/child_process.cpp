#include "regionmesh/io/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>
#include <utility>

#include "regionmesh/base/error.h"

namespace regionmesh::io {
namespace {

// Both directions: a head, then `size` bytes. What an answer holds is told by `kind`.
enum class Kind : std::uint64_t { kBytes, kError };
struct Head {
    Kind kind = Kind::kBytes;
    std::uint64_t size = 0;
};

bool send_all(int socket, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return true;
}

bool receive_all(int socket, std::span<std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::recv(socket, bytes.data(), bytes.size(), 0);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return true;
}

bool send_message(int socket, Kind kind, std::span<const std::byte> bytes) {
    const Head head{kind, bytes.size()};
    return send_all(socket, std::as_bytes(std::span(&head, 1))) && send_all(socket, bytes);
}

/// Handlers of this process have no place in the copy; an interrupt is for this process to act on.
void reset_signals() {
    for (int number = 1; number < NSIG; ++number) ::signal(number, SIG_DFL);
    ::signal(SIGINT, SIG_IGN);
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// A file held open here would stay open for others when this process closes it.
void drop_files(int socket) {
    const int nowhere = ::open("/dev/null", O_RDWR);
    for (int standard = 0; standard < 3; ++standard) ::dup2(nowhere, standard);
    if (socket > 3) ::close_range(3, static_cast<unsigned>(socket) - 1, 0);
    ::close_range(static_cast<unsigned>(socket) + 1, ~0u, 0);
}

void limit(int resource, rlim_t most) {
    rlimit now{};
    if (::getrlimit(resource, &now) != 0) return;
    now.rlim_cur = std::min(now.rlim_max, most);
    ::setrlimit(resource, &now);
}

void limit_memory(std::uint64_t bytes) {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    if (pages > 0) limit(RLIMIT_AS, pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) + bytes);
}

void limit_seconds(unsigned seconds) {
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    limit(RLIMIT_CPU, static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1 + seconds);
}

bool answer_one(int socket, const ChildProcess::Answer& answer) {
    Head head;
    if (!receive_all(socket, std::as_writable_bytes(std::span(&head, 1)))) return false;
    Bytes request(head.size);
    if (!receive_all(socket, request)) return false;
    std::string problem;
    try {
        const Bytes bytes = answer(request);
        return send_message(socket, Kind::kBytes, bytes);
    } catch (const Error& error) {
        problem = error.what();
    } catch (const std::bad_alloc&) {
        return false;
    }
    return send_message(socket, Kind::kError, std::as_bytes(std::span(problem)));
}

/// Ends without destructors and without what others asked to be done at the end: all that is the other process's.
[[noreturn]] void serve(int socket, const ChildProcess::Answer& answer, const ChildLimits& limits) {
    reset_signals();
    drop_files(socket);
    limit(RLIMIT_CORE, 0);
    try {
        limit_memory(limits.memory_bytes);
        do limit_seconds(limits.seconds);
        while (answer_one(socket, answer));
    } catch (...) {
    }
    ::_exit(0);
}

}  // namespace

ChildProcess::ChildProcess(Answer answer, std::string complaint, const ChildLimits& limits)
    : complaint_(std::move(complaint)) {
    int sockets[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0) {
        throw Error(ErrorCode::kInput, "a process to read in cannot be started: " + std::string(std::strerror(errno)));
    }
    process_ = ::fork();
    if (process_ == 0) {
        ::close(sockets[0]);
        serve(sockets[1], answer, limits);
    }
    const int problem = errno;
    ::close(sockets[1]);
    socket_ = sockets[0];
    if (process_ < 0) {
        ::close(socket_);
        throw Error(ErrorCode::kInput,
                    "a process to read in cannot be started: " + std::string(std::strerror(problem)));
    }
}

ChildProcess::~ChildProcess() { end(); }

void ChildProcess::end() {
    if (socket_ < 0) return;
    ::close(std::exchange(socket_, -1));
    ::kill(process_, SIGKILL);
    while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

void ChildProcess::complain() {
    end();
    throw Error(ErrorCode::kInput, complaint_);
}

Bytes ChildProcess::ask(std::span<const std::byte> request) {
    if (socket_ < 0) complain();
    Head head;
    if (!send_message(socket_, Kind::kBytes, request) ||
        !receive_all(socket_, std::as_writable_bytes(std::span(&head, 1)))) {
        complain();
    }
    Bytes bytes(head.size);
    if (!receive_all(socket_, bytes)) complain();
    if (head.kind == Kind::kBytes) return bytes;
    throw Error(ErrorCode::kInput, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

}  // namespace regionmesh::io
