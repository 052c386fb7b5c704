// Runs another program and talks to it over pipes.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace regionmesh::formats {

/// A program started without a shell, whose standard input and output are one socket. It may read all of its input
/// before it writes, or answer requests one after another. It may compute for any length of time, but is killed where
/// it neither answers nor uses the processor for kIdleSeconds: it hangs. A program that writes
/// while it should read, or ends early, neither blocks this process nor causes a signal in it. It is killed with this
/// object. It inherits no other file of this process. Safe beside threads: posix_spawn, no code between fork and exec.
/// Requires one caller at a time.
class PipedProgram {
public:
    /// How the program ended; neither code nor signal if it had to be killed.
    struct Ending {
        std::optional<int> exit_code = {};
        std::optional<int> signal = {};
        std::string last_words = {};  // last line of its standard error, shortened to fit a message
        bool was_idle = false;        // it was killed because it neither answered nor computed
    };

    /// Throws Error(kInput) naming the program if it cannot be started.
    explicit PipedProgram(const std::filesystem::path& program, std::vector<std::string> arguments = {});
    static constexpr std::chrono::seconds kIdleSeconds{600};
    void set_patience(std::chrono::milliseconds idle) { patience_ = idle; }

    PipedProgram(const PipedProgram&) = delete;
    PipedProgram& operator=(const PipedProgram&) = delete;
    ~PipedProgram();

    /// Whether the program took all bytes; false if it has ended, or writes already.
    bool send(std::span<const std::byte> bytes);
    void end_input();

    /// Fills `bytes` with output of the program and returns their number: fewer than asked for only where it ends.
    std::size_t receive(std::span<std::byte> bytes);

    /// Waits up to 10 s for the program to end, then kills it. Call once, after the last receive().
    Ending end();

private:
    /// Sleeps until the socket is ready for one of `events`, and reads standard error meanwhile. Returns the events
    /// that the socket is ready for; 0 after `milliseconds`, if they are not negative.
    short wait_for(short events, int milliseconds = -1);
    void read_errors();
    void kill_if_idle();
    void close();
    void kill();

    pid_t process_ = -1;
    int socket_ = -1;  // standard input and output
    int errors_ = -1;
    std::string words_;
    std::chrono::milliseconds patience_ = kIdleSeconds;
    std::chrono::steady_clock::time_point busy_ = std::chrono::steady_clock::now();  // when it last did something
    std::uint64_t ticks_ = 0;                                                        // of processor time, then
    bool was_idle_ = false;
};

}  // namespace regionmesh::formats
