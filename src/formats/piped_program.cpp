#include "formats/piped_program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string_view>
#include <utility>

#include "formats/text/header_text.h"
#include "regionmesh/error.h"

extern char** environ;

namespace regionmesh::formats {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kPatience = std::chrono::seconds(10);
constexpr std::size_t kMostWords = 500;
constexpr std::int64_t kLookMilliseconds = 1000;  // between two looks at a program that does not answer

[[noreturn]] void refuse(const std::filesystem::path& program, int problem) {
    throw Error(ErrorCode::kInput, program.string() + ": cannot be started: " + std::strerror(problem));
}

void close_file(int& file) {
    if (file >= 0) ::close(std::exchange(file, -1));
}

/// Our end and the program's end, both closed by the destructor. Neither is a standard stream, even where this process
/// has closed those: otherwise the duplicates made for the program would overwrite one another.
struct Ends {
    int ours = -1, theirs = -1;

    ~Ends() {
        close_file(ours);
        close_file(theirs);
    }
    bool rise() { return rise(ours) && rise(theirs); }

private:
    static bool rise(int& file) {
        if (file > STDERR_FILENO) return true;
        const int higher = ::fcntl(file, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
        close_file(file);
        file = higher;
        return higher >= 0;
    }
};

bool make_socket(Ends& ends) {
    int sockets[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0) return false;
    ends.ours = sockets[0];
    ends.theirs = sockets[1];
    return ends.rise();
}

bool make_pipe(Ends& ends) {
    int pipes[2];
    if (::pipe2(pipes, O_CLOEXEC) != 0) return false;
    ends.ours = pipes[0];
    ends.theirs = pipes[1];
    return ends.rise() && ::fcntl(ends.ours, F_SETFL, O_NONBLOCK) == 0;
}

/// Starts words[0] with all words as arguments. Returns an error number, or 0. The program starts with no signal
/// blocked and with the default action for SIGPIPE, whatever this process has set.
int spawn(std::vector<std::string> words, int socket, int errors, pid_t& process) {
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawnattr_init(&attributes);
    ::posix_spawn_file_actions_adddup2(&files, socket, STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&files, socket, STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&files, errors, STDERR_FILENO);
    sigset_t none, broken_pipe;
    ::sigemptyset(&none);
    ::sigemptyset(&broken_pipe);
    ::sigaddset(&broken_pipe, SIGPIPE);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setsigdefault(&attributes, &broken_pipe);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const int problem = ::posix_spawn(&process, arguments[0], &files, &attributes, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&files);
    ::posix_spawnattr_destroy(&attributes);
    return problem;
}

struct Activity {
    std::uint64_t ticks = 0;         // of processor time
    bool is_in_system_call = false;  // it waits for a disk, say
};

/// What the system says of a process; nothing where it does not tell.
Activity activity_of(pid_t process) {
    std::ifstream file("/proc/" + std::to_string(process) + "/stat");
    std::string text;
    std::getline(file, text);
    // Behind the name in parentheses: the state, ten numbers, and the time in user and in system mode.
    std::istringstream words(text.substr(std::min(text.rfind(')') + 1, text.size())));
    std::string state;
    words >> state;
    std::uint64_t number = 0, user = 0, system = 0;
    for (int n = 0; n < 10; ++n) words >> number;
    words >> user >> system;
    return {user + system, state == "D"};
}

std::string last_line(std::string_view text) {
    text = trim(text);
    return one_line(text.substr(text.rfind('\n') + 1));  // rfind is npos for a single line
}

}  // namespace

PipedProgram::PipedProgram(const std::filesystem::path& program, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), program.string());
    Ends socket, errors;
    if (!make_socket(socket) || !make_pipe(errors)) refuse(program, errno);
    if (const int problem = spawn(std::move(arguments), socket.theirs, errors.theirs, process_))
        refuse(program, problem);
    socket_ = std::exchange(socket.ours, -1);
    errors_ = std::exchange(errors.ours, -1);
}

PipedProgram::~PipedProgram() {
    close();
    kill();
}

void PipedProgram::close() {
    close_file(socket_);
    close_file(errors_);
}

void PipedProgram::kill() {
    if (process_ < 0) return;
    ::kill(process_, SIGKILL);
    while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
}

void PipedProgram::read_errors() {
    std::array<char, 1 << 16> piece;  // as much as a pipe holds
    const ssize_t count = ::read(errors_, piece.data(), piece.size());
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) return;
    if (count <= 0) return close_file(errors_);
    words_.append(piece.data(), static_cast<std::size_t>(count));
    if (words_.size() > kMostWords) words_.erase(0, words_.size() - kMostWords);
}

/// Its end closes the socket, which ends the wait.
void PipedProgram::kill_if_idle() {
    const Activity now = activity_of(process_);
    if (now.is_in_system_call || now.ticks != ticks_) {
        ticks_ = now.ticks;
        busy_ = Clock::now();
    } else if (Clock::now() - busy_ > patience_) {
        was_idle_ = true;
        ::kill(process_, SIGKILL);
    }
}

short PipedProgram::wait_for(short events, int milliseconds) {
    busy_ = Clock::now();
    for (;;) {
        pollfd files[] = {{socket_, events, 0}, {errors_, POLLIN, 0}};  // poll ignores negative descriptors
        const int slice = static_cast<int>(std::min<std::int64_t>(patience_.count(), kLookMilliseconds));
        const int count = ::poll(files, 2, milliseconds < 0 ? slice : milliseconds);
        if (files[1].revents != 0) read_errors();
        if (count > 0 && files[0].revents != 0) return files[0].revents;
        if (milliseconds >= 0) return 0;
        if (count == 0) kill_if_idle();
    }
}

bool PipedProgram::send(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        if ((wait_for(POLLOUT | POLLIN) & ~POLLOUT) != 0) return false;
        const ssize_t count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (count < 0 && errno != EINTR && errno != EAGAIN) return false;
        if (count > 0) bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return true;
}

void PipedProgram::end_input() { ::shutdown(socket_, SHUT_WR); }

std::size_t PipedProgram::receive(std::span<std::byte> bytes) {
    std::size_t filled = 0;
    while (filled < bytes.size()) {
        wait_for(POLLIN);
        const ssize_t count = ::recv(socket_, bytes.data() + filled, bytes.size() - filled, MSG_DONTWAIT);
        if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
        if (count <= 0) break;  // an error, too, if the program ended before it had read all input
        filled += static_cast<std::size_t>(count);
    }
    return filled;
}

PipedProgram::Ending PipedProgram::end() {
    close_file(socket_);
    const auto deadline = Clock::now() + kPatience;
    int status = 0;
    pid_t ended = 0;
    while ((ended = ::waitpid(process_, &status, WNOHANG)) == 0 && Clock::now() < deadline) {
        // The end of standard error wakes poll just before the program ends.
        wait_for(0, errors_ >= 0 ? 100 : 1);
    }
    if (errors_ >= 0) read_errors();
    Ending ending{.last_words = last_line(words_), .was_idle = was_idle_};
    if (ended != process_) {
        kill();
        return ending;
    }
    process_ = -1;
    if (WIFEXITED(status)) ending.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) ending.signal = WTERMSIG(status);
    return ending;
}

}  // namespace regionmesh::formats
