// Work that may crash or never end, done in a copy of this process.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace regionmesh::formats {

using Bytes = std::vector<std::byte>;

/// A copy of this process, made by fork, that answers requests one after another with a function given beforehand.
/// For libraries that a damaged file can make crash, loop or eat memory: that ends the copy only, and is told by
/// Error(kInput). The copy holds no files or sockets of this process, prints nothing, and ends with this object.
///
/// Fork as early as can be: the copy keeps the memory that there is then. Where other threads run, the function may
/// use no lock that one of them may hold just then, but for those of the C library's own memory and files. Requires
/// one caller at a time.
class ChildProcess {
public:
    using Answer = std::function<Bytes(std::span<const std::byte> request)>;

    /// `complaint` is the text of the Error when the copy ends without an answer; `memory_bytes` of address space are
    /// all that it gets on top of what there is when it begins.
    ChildProcess(Answer answer, std::string complaint, std::uint64_t memory_bytes = std::uint64_t{4} << 30);
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;
    ~ChildProcess();

    /// What `answer` returns within so many seconds of computing. An Error that it throws is thrown here; after that it
    /// can be asked again.
    Bytes ask(std::span<const std::byte> request, unsigned seconds = 10);

private:
    void end();
    [[noreturn]] void complain();

    std::string complaint_;
    pid_t process_ = -1;
    int socket_ = -1;
};

}  // namespace regionmesh::formats
