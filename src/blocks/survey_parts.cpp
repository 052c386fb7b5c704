#include "blocks/survey_parts.h"

#include <fmt/ranges.h>

#include <vector>

#include "base/fingerprint.h"
#include "blocks/begin_run.h"
#include "formats/input_file.h"

namespace regionmesh {

namespace fs = std::filesystem;

fs::path part_path(const fs::path& folder, const IndexBox& box) {
    return folder / fmt::format("{}{}-{}.part", kSurveyPart, fmt::join(box.low, "-"), fmt::join(box.high, "-"));
}

std::uint64_t fingerprint_of(std::span<const std::uint64_t> numbers) {
    Fingerprint fingerprint;
    for (const std::uint64_t number : numbers) fingerprint.add(number);
    return fingerprint.value();
}

void write_part(const PartSurvey& part, const fs::path& path, const OutputOptions& options) {
    std::vector<std::uint64_t> numbers{part.faces};
    for (const auto& [label, place] : part.labels) {
        numbers.push_back(static_cast<std::uint64_t>(label));
        numbers.push_back(place);
    }
    std::vector<std::uint64_t> sums(part.hashes.sums().begin(), part.hashes.sums().end());
    sums.resize(part.hashes.count());  // the last section may belong to the next part
    numbers.insert(numbers.end(), sums.begin(), sums.end());
    numbers.push_back(fingerprint_of(numbers));
    OutputFile file(path, options);
    file.write({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof numbers[0]});
    file.commit();
}

std::optional<PartSurvey> find_part(const fs::path& path, const VolumeInfo& volume, const IndexBox& box) {
    if (!fs::exists(path)) return {};
    const formats::InputFile file(path);
    PartSurvey part{.labels = {}, .hashes = hashes_of_part(volume, box)};
    std::vector<std::uint64_t> numbers(file.size() / sizeof(std::uint64_t));
    const std::uint64_t hashes = part.hashes.count(), others = 2;  // faces and the fingerprint
    if (numbers.size() < hashes + others || (numbers.size() - hashes - others) % 2 != 0) return {};
    file.read(0, std::as_writable_bytes(std::span(numbers)));
    if (fingerprint_of(std::span(numbers).first(numbers.size() - 1)) != numbers.back()) return {};
    part.faces = numbers[0];
    const auto first_hash = numbers.end() - 1 - static_cast<std::ptrdiff_t>(hashes);
    for (auto at = numbers.begin() + 1; at != first_hash; at += 2)
        part.labels.push_back({static_cast<InputLabel>(at[0]), at[1]});
    part.hashes.sums().assign(first_hash, numbers.end() - 1);
    return part;
}

}  // namespace regionmesh
