// Looks after one reader at work: memory, time, crashes.
#pragma once

#include <cstdint>
#include <string>

namespace regionmesh::fuzz {

/// From now on whatever ends the program by force prints the text of the last begin_watch: a crash, a finding of a
/// sanitizer, ten seconds of processor time for one file, memory far beyond the limit.
void start_watching();

/// One file is about to be read: `text` says how to do it again.
void begin_watch(const std::string& text, std::uint64_t most_bytes);

/// The file was read. The most bytes that were held at once.
std::uint64_t end_watch();

}  // namespace regionmesh::fuzz
