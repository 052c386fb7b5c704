#include "formats/surface/file_regions.h"

#include <algorithm>
#include <set>

namespace regionmesh {
namespace {

constexpr std::size_t kLongestWord = 60;  // with prefixes and suffixes still below 80, the limit of Abaqus

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A label in a word: "3", "minus3".
std::string word_of_label(const std::string& text) { return text[0] == '-' ? "minus" + text.substr(1) : text; }

/// The letters and digits of a name, with '_' for each run of other characters; empty where it has none.
std::string word_of_name(const std::string& name) {
    std::string word;
    for (const char c : name) {
        if (word.size() == kLongestWord) break;
        if (is_letter(c) || is_digit(c))
            word += c;
        else if (!word.empty() && word.back() != '_')
            word += '_';
    }
    while (!word.empty() && word.back() == '_') word.pop_back();
    if (!word.empty() && !is_letter(word[0])) word = ("region_" + word).substr(0, kLongestWord);
    return word;
}

/// In lower case: two words must also differ for programs that ignore case.
std::string folded(std::string word) {
    for (char& c : word)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
    return word;
}

}  // namespace

FileRegions::FileRegions(const FileView& view) : view_(view), numbers_(view.labels().size()) {
    std::map<Key, std::uint32_t> counts;
    std::vector<bool> has_faces(view.labels().size());
    std::map<Key, FaceId> examples;
    view.for_faces([&](FaceId f) {
        const Key key = key_of(f);
        if (++counts[key] == 1) examples[key] = f;
        for (const Label label : view.mesh()[f].labels)
            if (!is_exterior(label)) has_faces[label] = true;
    });
    std::set<std::string> taken;
    for (const auto& [key, count] : counts) {
        const FaceId f = examples[key];
        std::array<Label, 2> labels = view.mesh()[f].labels;
        if (view.is_turned(f)) std::swap(labels[0], labels[1]);
        std::string name = "interface";
        for (Label& label : labels) {
            if (is_exterior(label)) label = exterior(0);
            name += '_' + (is_exterior(label) ? "exterior" : word_of_label(view.label_text(label)));
        }
        taken.insert(name);
        interfaces_.push_back({labels, name, count});
        interface_numbers_[key] = static_cast<std::uint32_t>(interfaces_.size());
    }
    for (const Label label : view.ordered_labels()) {
        if (!has_faces[label] || view.is_background(label)) continue;
        const std::string text = view.label_text(label), plain = "region_" + word_of_label(text);
        const std::string name = view.name(label);
        std::string word = word_of_name(name);
        if (word.empty()) word = plain;
        if (!taken.insert(folded(word)).second) {
            const std::string behind = "_" + word_of_label(text);
            word = word.substr(0, kLongestWord - std::min(kLongestWord, behind.size())) + behind;
            while (!taken.insert(folded(word)).second) word += '_';
        }
        regions_.push_back({label, "region_" + text + (name.empty() ? "" : " " + name), word});
        numbers_[label] = static_cast<std::uint32_t>(regions_.size());
    }
    set_tags();
}

void FileRegions::set_tags() {
    constexpr std::uint64_t kMost = 0x7FFFFFFF;
    std::set<std::uint32_t> taken;
    const auto own = [&](const FileRegion& region) -> std::optional<std::uint32_t> {
        const auto label = static_cast<std::uint64_t>(view_.labels().input(region.label));
        return label >= 1 && label <= kMost ? std::optional(static_cast<std::uint32_t>(label)) : std::nullopt;
    };
    for (const FileRegion& region : regions_)
        if (const auto label = own(region)) taken.insert(*label);
    std::uint32_t free = 0;
    for (const FileRegion& region : regions_) {
        const auto label = own(region);
        if (!label)
            while (taken.contains(++free)) continue;
        tags_.push_back(label.value_or(free));
    }
}

FileRegions::Key FileRegions::key_of(FaceId f) const {
    const auto& [first, second] = view_.mesh()[f].labels;
    const std::uint32_t a = view_.rank(first), b = view_.rank(second);
    return {std::min(a, b), std::max(a, b)};
}

std::uint32_t FileRegions::interface_number(FaceId f) const { return interface_numbers_.at(key_of(f)); }

GroupedFaces faces_by_region(const FileView& view, const FileRegions& regions) {
    return GroupedFaces(view, regions.all().size(), [&](FaceId f, auto&& add) {
        for (std::uint32_t side = 0; side < 2; ++side)
            if (const std::uint32_t number = regions.number(view.mesh()[f].labels[side])) add(number - 1, side);
    });
}

}  // namespace regionmesh
