#include "formats/text/json_text.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "formats/text/header_text.h"

namespace regionmesh::formats {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{64} << 20;
constexpr int kMaxDepth = 100;

bool is_too_deep(const std::string& text) {
    int depth = 0;
    bool is_word = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') is_word = !is_word;
        if (is_word && c == '\\') ++i;
        if (is_word) continue;
        if (c == '[' || c == '{') ++depth;
        if (c == ']' || c == '}') --depth;
        if (depth > kMaxDepth) return true;
    }
    return false;
}

}  // namespace

nlohmann::json parse_json(const std::filesystem::path& path, const std::string& text) {
    if (is_too_deep(text))
        fail(path, "the metadata are nested deeper than " + std::to_string(kMaxDepth) + "; check the file");
    return nlohmann::json::parse(text);
}

std::uint64_t whole_number(const std::filesystem::path& path, const nlohmann::json& json, std::uint64_t most) {
    constexpr double kExact = 1ull << 53;
    const auto refuse = [&] {
        fail(path, "has " + shown(json.dump()) + " for a whole number" +
                       (most < UINT64_MAX ? " up to " + std::to_string(most) : "") + "; write the file again");
    };
    std::uint64_t number = 0;
    if (json.is_number_unsigned()) {
        number = json.get<std::uint64_t>();
    } else {
        const double real = json.is_number_float() ? json.get<double>() : -1;
        if (!(real >= 0 && real <= kExact && real == std::floor(real))) refuse();
        number = static_cast<std::uint64_t>(real);
    }
    if (number > most) refuse();
    return number;
}

std::vector<std::uint64_t> whole_numbers(const std::filesystem::path& path, const nlohmann::json& list) {
    std::vector<std::uint64_t> numbers;
    for (const nlohmann::json& number : list.get_ref<const nlohmann::json::array_t&>())
        numbers.push_back(whole_number(path, number));
    return numbers;
}

std::string problem_text(const nlohmann::json::exception& problem) {
    const std::string_view text = problem.what();
    return std::string(text.substr(std::min(text.find("] ") + 2, text.size())));
}

std::optional<nlohmann::json> read_json(const std::filesystem::path& path) {
    std::error_code ignored;
    if (std::filesystem::status(path, ignored).type() == std::filesystem::file_type::not_found) return std::nullopt;
    const InputFile file(path);
    if (file.size() > kMaxBytes)
        fail(path, "the metadata take " + std::to_string(file.size()) + " bytes; check the file");
    return reading(path, [&] { return parse_json(path, file.text()); });
}

}  // namespace regionmesh::formats
