// One run at a time works in a folder of pieces.
#pragma once

#include <filesystem>

namespace regionmesh {

/// A lock that ends with the process, however that ends. File systems without locks give it to everybody.
class FolderLock {
public:
    /// Throws Error(kOutput) where another process has it.
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

private:
    int file_;
};

}  // namespace regionmesh
