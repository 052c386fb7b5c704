#include "formats/array/header_fields.h"

#include <fmt/format.h>

#include <cmath>

#include "formats/input_file.h"
#include "formats/text/header_text.h"

namespace regionmesh::formats {

void HeaderFields::add(std::string_view key, std::string_view value) { values_.emplace(key, trim(value)); }

std::string_view HeaderFields::text(Keys keys, std::string_view otherwise) const {
    for (const std::string_view key : keys)
        if (const auto found = values_.find(key); found != values_.end()) return found->second;
    return otherwise;
}

std::uint64_t HeaderFields::size(std::string_view key, std::string_view otherwise) const {
    const auto number = parse_size(text({key}, otherwise));
    if (!number) refuse(key, "a count is needed");
    return *number;
}

std::int64_t HeaderFields::integer(std::string_view key, std::int64_t otherwise) const {
    const std::string_view word = text({key});
    const auto number = word.empty() ? otherwise : parse_integer(word);
    if (!number) refuse(key, "a whole number is needed");
    return *number;
}

double HeaderFields::real(std::string_view key, std::string_view otherwise) const {
    const auto number = parse_real(text({key}, otherwise));
    if (!number || std::isnan(*number)) refuse(key, "a number is needed");
    return *number;
}

bool HeaderFields::flag(Keys keys, bool otherwise) const {
    const std::string_view word = text(keys);
    return word.empty() ? otherwise : word[0] == 'T' || word[0] == 't' || word[0] == '1';
}

std::optional<std::vector<double>> HeaderFields::reals(Keys keys, std::size_t count) const {
    const std::string_view words = text(keys);
    if (words.empty()) return std::nullopt;
    auto numbers = parse_reals(words);
    if (!numbers || numbers->size() != count)
        fail(path_, fmt::format("{} is '{}': {} numbers are needed", *keys.begin(), shown(words), count));
    return numbers;
}

void HeaderFields::refuse(std::string_view key, std::string_view wanted) const {
    fail(path_, fmt::format("{} is '{}': {}", key, shown(text({key})), wanted));
}

}  // namespace regionmesh::formats
