// Another program, fed and read.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace regionmesh::formats {

/// A program that reads all of its standard input before it writes its standard output, run without a shell. It may
/// compute as long as it likes; one that does otherwise, or ends early, neither blocks this process nor brings it a
/// signal. It ends with this object. Requires one caller at a time.
class PipedProgram {
public:
    /// How it ended; neither code nor signal if it did not end by itself in time.
    struct Ending {
        std::optional<int> exit_code = {};
        std::optional<int> signal = {};
        std::string last_words = {};  // last line of its standard error, what fits a message
    };

    /// Throws Error(kInput) naming the program if it cannot be started.
    explicit PipedProgram(const std::filesystem::path& program);
    PipedProgram(const PipedProgram&) = delete;
    PipedProgram& operator=(const PipedProgram&) = delete;
    ~PipedProgram();

    /// Whether it took them; not if it has ended, or writes already.
    bool send(std::span<const std::byte> bytes);
    void end_input();

    /// Fills `bytes` with what it writes and returns how many; less than asked for only where its output ends.
    std::size_t receive(std::span<std::byte> bytes);

    /// After the end of its output. Gives it some seconds, then ends it. To be called once, and last.
    Ending end();

private:
    /// Sleeps until the socket is ready for one of `events`, and keeps its standard error flowing meanwhile. Returns
    /// what the socket is ready for; 0 after so many milliseconds, if they are not negative.
    short wait_for(short events, int milliseconds = -1);
    void read_errors();
    void close();
    void kill();

    pid_t process_ = -1;
    int socket_ = -1;  // standard input and output
    int errors_ = -1;
    std::string words_;
};

}  // namespace regionmesh::formats
