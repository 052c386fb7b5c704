// The part that regionmesh-hdf5 and regionmesh-dicom share: requests on standard input, answers on standard output.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace regionmesh::helper {

enum Exit { kDone, kWrongInput, kUsage, kOutOfMemory };

/// Why the file cannot be read: text for the user, without the name of the file. The next request may follow.
struct Refusal : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A program, and the two letters in the magic numbers of its messages: RMxxASK1, RMxxANS1, RMxxNO_1.
struct Program {
    const char* name;
    std::array<char, 2> letters;
};

/// Sends one message. Ends the process where the reader is gone.
void send_answer(const Program& program, std::span<const std::byte> body);
void send_answer(const Program& program, std::string_view body);

/// JSON must be UTF-8; words of a file need not be: bytes that are not become U+FFFD.
std::string to_text(const nlohmann::json& json);

/// Default signals, no core file, no interrupts: those are for the process that asks.
void prepare_process();

/// 4 GiB of address space in addition to what the process has now.
void limit_memory();

/// Calls `answer` for every request until standard input ends, with the key `seconds` of the request as limit of
/// processor time; SIGPROF ends the process. `answer` sends one answer or throws Refusal.
int serve(const Program& program, const std::function<void(const nlohmann::json&)>& answer);

/// Calls `work`, and ends the process with the exit code it returns, without destructors: on a damaged file, closing it
/// may crash, too.
[[noreturn]] void run(const Program& program, const std::function<int()>& work);

}  // namespace regionmesh::helper
