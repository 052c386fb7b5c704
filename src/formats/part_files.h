// The temporary files of outputs that are being written: removed on signals, and by the next run after a kill.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>

namespace regionmesh {

class OutputFile;

namespace formats {

/// `.name.part-<pid>`, and `-<attempt>` from the second attempt on.
std::string part_name(const std::filesystem::path& target, int attempt);

/// The temporary file of one output of this process, until it is forgotten. Thread-safe.
void note_part(const OutputFile* output, const std::filesystem::path& part);
void forget_part(const OutputFile* output) noexcept;

/// While it lives, no signal removes temporary files or ends the process.
class PartsHeld {
public:
    PartsHeld();

private:
    std::unique_lock<std::mutex> lock_;
};

/// Removes temporary files for `target`, and for STEM-*.EXTENSION where `per_region`, whose process has ended and whose
/// lock nobody holds.
void remove_stale_parts(const std::filesystem::path& target, bool per_region);

}  // namespace formats
}  // namespace regionmesh
