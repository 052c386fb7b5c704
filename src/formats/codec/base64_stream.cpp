#include "formats/codec/base64_stream.h"

#include <algorithm>

namespace regionmesh::formats {
namespace {

constexpr std::size_t kTextBytes = std::size_t{64} << 10;

}  // namespace

bool Base64Stream::refill() {
    std::string chunk(std::min<std::uint64_t>(kTextBytes, end_ - place_), '\0');
    chunk.resize(file_.read(place_, std::as_writable_bytes(std::span(chunk))));
    place_ += chunk.size();
    if (const std::size_t end = chunk.find('<'); end != std::string::npos) {
        chunk.resize(end);
        place_ = end_;
    }
    if (chunk.empty()) return false;
    std::erase_if(chunk, [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); });
    letters_ += chunk;
    const std::size_t whole = letters_.size() / 4 * 4;
    text_ = letters_.substr(0, whole);
    letters_.erase(0, whole);
    decoder_ = Base64Decoder(text_);
    return true;
}

std::size_t Base64Stream::read(std::span<std::byte> bytes) {
    std::size_t done = 0;
    while (true) {
        done += decoder_.read(bytes.subspan(done));
        if (done == bytes.size()) return done;
        if (decoder_.has_failed() || !refill()) {
            problem_ = "the base64 text ends early or is damaged; fetch the file again";
            return done;
        }
    }
}

void Base64Stream::rewind() {
    place_ = begin_;
    letters_.clear();
    decoder_ = Base64Decoder(std::string_view());
    problem_.clear();
}

}  // namespace regionmesh::formats
