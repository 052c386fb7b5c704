#include "formats/asked_program.h"

#include <cstdint>
#include <span>

#include "formats/input_file.h"

namespace regionmesh::formats {
namespace {

using Magic = std::array<char, 8>;

constexpr std::uint64_t kMaxAnswer = std::uint64_t{2} << 30;
constexpr int kOutOfMemory = 3;  // exit code

struct Head {
    Magic magic;
    std::uint64_t size;
};

Magic magic_of(const Asked& asked, std::string_view kind) {
    return {'R', 'M', asked.letters[0], asked.letters[1], kind[0], kind[1], kind[2], '1'};
}

}  // namespace

AskedProgram::AskedProgram(const Asked& asked, const std::filesystem::path& path)
    : asked_(asked), path_(path), program_path_(find_program(asked.program)) {
    program_.emplace(program_path_, std::vector{path.string()});
}

/// A signal, an ordinary end without an answer, or a lack of memory is the fault of the file.
void AskedProgram::report_end() {
    if (program_) {
        const PipedProgram::Ending ending = program_->end();
        program_.reset();
        const int code = ending.exit_code.value_or(0);
        if (code != 0 && code != kOutOfMemory) {
            fail(path_, program_path_.string() + " failed with exit code " + std::to_string(code) + " (" +
                            ending.last_words + "); is it another program?");
        }
    }
    fail(path_,
         std::string("the ") + asked_.library +
             " fails on this file (it crashed, or took more time or memory than it should); the file is damaged, "
             "fetch it again");
}

Bytes AskedProgram::ask(std::string_view request) {
    Head head{magic_of(asked_, "ASK"), request.size()};
    const auto head_bytes = std::as_writable_bytes(std::span(&head, 1));
    if (!program_ || !program_->send(head_bytes) || !program_->send(std::as_bytes(std::span(request))) ||
        program_->receive(head_bytes) < sizeof head) {
        report_end();
    }
    const bool is_refusal = head.magic == magic_of(asked_, "NO_");
    if ((head.magic != magic_of(asked_, "ANS") && !is_refusal) || head.size > kMaxAnswer) {
        program_.reset();
        fail(path_,
             program_path_.string() + " did not answer as " + asked_.program.name + " does; is it another program?");
    }
    Bytes bytes(head.size);
    if (program_->receive(bytes) < bytes.size()) report_end();
    if (is_refusal) fail(path_, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    return bytes;
}

}  // namespace regionmesh::formats
