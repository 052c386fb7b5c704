// Takes rights away from this process, where the kernel can: for work on files that nobody has vetted.
#pragma once

#include <filesystem>
#include <vector>

namespace regionmesh {

/// What stays allowed. Files that are open already stay usable, and so do those below a folder named here.
struct SandboxRules {
    bool reads_anything = true;
    std::vector<std::filesystem::path> readable = {};  // files and folders, where it may not read anything
    std::vector<std::filesystem::path> writable = {};  // folders in which files may be made, replaced and removed, and
                                                       // files and devices; what does not exist is left out
    std::vector<std::filesystem::path> emptied = {};   // folders out of which empty folders may be removed
    bool starts_programs = false;                      // those that `runnable` names
    std::vector<std::filesystem::path> runnable = {};  // programs, as files
};

/// Which rights could be taken away.
struct SandboxState {
    bool files = false;  // Landlock: files other than those of the rules
    bool calls = false;  // seccomp: sockets, other processes, kernel interfaces; programs where none are started
};

/// Confines the calling thread and all threads and processes that it starts: for good, and before work begins. Network
/// sockets cannot be made in any case. Does what the kernel has, and says what that was; never fails.
SandboxState enter_sandbox(const SandboxRules& rules) noexcept;

}  // namespace regionmesh
