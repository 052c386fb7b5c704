#include "formats/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

#include "regionmesh/error.h"

namespace regionmesh::formats {
namespace {

constexpr std::uint64_t kMaxAnswer = std::uint64_t{2} << 30;  // more comes from a copy that has lost its wits

// Both directions: a head, then `size` bytes.
enum class Kind : std::uint32_t { kBytes, kError };
struct Head {
    Kind kind = Kind::kBytes;   // of an answer
    std::uint32_t seconds = 0;  // for a request
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

bool send_message(int socket, Head head, std::span<const std::byte> bytes) {
    head.size = bytes.size();
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

/// The first number there is the size of the process in pages.
void limit_memory(std::uint64_t bytes) {
    char text[32] = {};
    const int file = ::open("/proc/self/statm", O_RDONLY);
    const bool is_known = file >= 0 && ::read(file, text, sizeof text - 1) > 0;
    if (file >= 0) ::close(file);
    const std::uint64_t page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    if (is_known) limit(RLIMIT_AS, std::strtoull(text, nullptr, 10) * page + bytes);
}

/// From now on. A limit of all that the process takes would have to be raised by what it has taken so far, which the
/// system counts in two ways that drift apart.
void limit_seconds(unsigned seconds) {
    itimerval timer{};
    timer.it_value.tv_sec = static_cast<time_t>(seconds);
    ::setitimer(ITIMER_PROF, &timer, nullptr);
}

bool answer_one(int socket, const ChildProcess::Answer& answer) {
    Head head;
    if (!receive_all(socket, std::as_writable_bytes(std::span(&head, 1)))) return false;
    Bytes request(head.size);
    if (!receive_all(socket, request)) return false;
    limit_seconds(head.seconds);
    std::string problem;
    try {
        const Bytes bytes = answer(request);
        return send_message(socket, {.kind = Kind::kBytes}, bytes);
    } catch (const Error& error) {
        problem = error.what();
    } catch (const std::bad_alloc&) {
        return false;
    }
    return send_message(socket, {.kind = Kind::kError}, std::as_bytes(std::span(problem)));
}

/// Ends without destructors and without what others asked to be done at the end: all that is the other process's.
[[noreturn]] void serve(int socket, const ChildProcess::Answer& answer, std::uint64_t memory_bytes) {
    reset_signals();
    drop_files(socket);
    limit(RLIMIT_CORE, 0);
    try {
        limit_memory(memory_bytes);
        while (answer_one(socket, answer)) continue;
    } catch (...) {
    }
    ::_exit(0);
}

}  // namespace

ChildProcess::ChildProcess(Answer answer, std::string complaint, std::uint64_t memory_bytes)
    : complaint_(std::move(complaint)) {
    int sockets[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0) {
        throw Error(ErrorCode::kInput, "a process to read in cannot be started: " + std::string(std::strerror(errno)));
    }
    process_ = ::fork();
    if (process_ == 0) {
        ::close(sockets[0]);
        serve(sockets[1], answer, memory_bytes);
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

Bytes ChildProcess::ask(std::span<const std::byte> request, unsigned seconds) {
    if (socket_ < 0) complain();
    Head head;
    if (!send_message(socket_, {.seconds = seconds}, request) ||
        !receive_all(socket_, std::as_writable_bytes(std::span(&head, 1)))) {
        complain();
    }
    if (head.size > kMaxAnswer) complain();
    Bytes bytes(head.size);
    if (!receive_all(socket_, bytes)) complain();
    if (head.kind == Kind::kBytes) return bytes;
    throw Error(ErrorCode::kInput, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

}  // namespace regionmesh::formats
