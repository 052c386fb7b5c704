// Asks a program that reads one file, in the protocol of apps/hdf5/README.md and apps/dicom/README.md.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/find_program.h"
#include "formats/piped_program.h"

namespace regionmesh::formats {

using Bytes = std::vector<std::byte>;

/// What differs between the programs.
struct Asked {
    HelperProgram program;
    std::array<char, 2> letters;  // in the magic numbers of its messages: RMxxASK1, RMxxANS1, RMxxNO_1
    const char* library;          // that fails on a damaged file: "HDF5 library"
};

/// A library that crashes on a damaged file, or never ends, does so in the program, which ends with this object: here
/// that is an Error(kInput) that names the file. Requires one caller at a time.
class AskedProgram {
public:
    /// Throws Error(kInput) where the program is not found or cannot be started.
    AskedProgram(const Asked& asked, const std::filesystem::path& path);

    /// The body of the answer. Throws Error(kInput) that names the file: the text of a refusal, or how the program
    /// ended.
    Bytes ask(std::string_view request);

private:
    [[noreturn]] void report_end();

    Asked asked_;
    std::filesystem::path path_, program_path_;
    std::optional<PipedProgram> program_;  // none once it has failed
};

}  // namespace regionmesh::formats
