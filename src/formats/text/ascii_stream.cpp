#include "formats/text/ascii_stream.h"

#include <algorithm>
#include <cstring>

#include "formats/text/header_text.h"
#include "regionmesh/read_sections.h"

namespace regionmesh::formats {

bool AsciiStream::take_number() {
    const auto word = words_.take_word();
    if (!word) problem_ = "the numbers end early; the file is truncated, fetch it again";
    if (word && is_real_) return take_real(*word);
    const auto number = word ? parse_label(*word) : std::nullopt;
    if (word && !number) problem_ = "'" + shown(*word) + "' is no label; labels must be whole numbers";
    if (!number) return false;
    if (!range_of(type_).holds(*number, word->starts_with('-'))) {
        problem_ = "'" + shown(*word) + "' is no number of type " + to_string(type_) + "; correct it, or the type";
        return false;
    }
    put(*number);
    return true;
}

bool AsciiStream::take_real(std::string_view word) {
    const auto number = parse_real(word);
    if (!number) problem_ = "'" + shown(word) + "' is no finite number; labels must be whole numbers";
    if (number) put(*number);
    return number.has_value();
}

template <class Number>
void AsciiStream::put(Number number) {
    static_assert(sizeof number == sizeof number_);
    std::memcpy(number_, &number, sizeof number_);
    number_place_ = 0;
    ++taken_;
}

bool AsciiStream::finish() {
    const auto word = taken_ < count_ ? std::nullopt : words_.take_word();
    if (word)
        problem_ = "'" + shown(*word) + "' stands behind the last number that the size asks for; correct one of them";
    return !word;
}

std::size_t AsciiStream::read(std::span<std::byte> bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        if (number_place_ == sizeof number_ && !take_number()) break;
        const std::size_t count = std::min(bytes.size() - done, sizeof number_ - number_place_);
        std::memcpy(bytes.data() + done, number_ + number_place_, count);
        number_place_ += count;
        done += count;
    }
    return done;
}

void AsciiStream::rewind() {
    words_.go_to(begin_, 0);
    number_place_ = sizeof number_;
    taken_ = 0;
    problem_.clear();
}

}  // namespace regionmesh::formats
