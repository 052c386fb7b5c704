// The temporary files of outputs that are being written: removed on signals, and by the next run after a kill.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>

namespace regionmesh {

class OutputFile;

namespace formats {

/// `.name.part-`: temporary files of a target begin so.
std::string part_prefix(const std::filesystem::path& target);

/// `.name.part-<pid>`, and `-<attempt>` from the second attempt on.
std::string part_name(const std::filesystem::path& target, int attempt);

/// Creates the temporary file of one output of this process, which signals remove until it is forgotten. No signal ends
/// the process in between. Returns a descriptor for writing, or -1 with errno. Thread-safe.
int create_part(const OutputFile* output, const std::filesystem::path& part, unsigned mode);
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
