// The one exception of the library: wrong input, an unusable file, a full disk.
#pragma once

#include <stdexcept>
#include <string>

namespace regionmesh {

enum class ErrorCode { kInput, kOutput, kUsage };

/// Thrown for errors that the user can correct. The text is one line: file, section, value, what to do.
class Error : public std::runtime_error {
public:
    Error(ErrorCode code, const std::string& text) : std::runtime_error(text), code_(code) {}
    ErrorCode code() const { return code_; }

private:
    ErrorCode code_;
};

}  // namespace regionmesh
