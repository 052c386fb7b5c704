// A zip archive, written entry by entry.
#pragma once

#include <cstdint>
#include <exception>
#include <string_view>

#include "regionmesh/output_file.h"

namespace regionmesh {

/// Deflates entries into a file that can be sought, without dates. A failing write throws from the call that caused it.
class ZipFile {
public:
    explicit ZipFile(OutputFile& file);
    ~ZipFile();
    ZipFile(const ZipFile&) = delete;
    ZipFile& operator=(const ZipFile&) = delete;

    /// Ends the entry before. Requires an upper bound on the bytes of the entry.
    void begin_entry(const char* name, std::uint64_t most_bytes);
    void write(std::string_view bytes);
    /// Writes the list of entries. Nothing may follow.
    void finish();

private:
    struct Target;

    void check(int result);
    void end_entry();

    OutputFile& file_;
    std::uint64_t place_ = 0;     // of the next byte
    std::exception_ptr failure_;  // of a write, which the library calls
    void* archive_ = nullptr;     // of minizip
    bool has_entry_ = false;
};

}  // namespace regionmesh
