// Files made worse, in ways that readers of files meet.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace regionmesh::fuzz {

/// A small generator with the same numbers everywhere.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next();
    /// Below `end`, which is not 0.
    std::size_t below(std::size_t end) { return static_cast<std::size_t>(next() % end); }
    bool one_in(std::size_t count) { return below(count) == 0; }

private:
    std::uint64_t state_;
};

/// The bytes of a file.
std::string text_of(const std::filesystem::path& path);

/// One to six changes, few more often, to one of `seeds`, number `index`: bits, bytes, spans; numbers in text and in
/// binary made huge, negative or none; words exchanged for words of other seeds; spans of other seeds. What is gzipped
/// is changed inside, half of the time, and what has the check sums of PNG gets new ones.
std::string mutate(const std::vector<std::string>& seeds, std::size_t index, Random& random);

}  // namespace regionmesh::fuzz
