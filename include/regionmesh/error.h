// The one exception of the library: wrong input, an unusable file, a full disk.
#pragma once

#include <stdexcept>
#include <string>

namespace regionmesh {

enum class ErrorCode { kInput, kOutput, kUsage };

/// Thrown for what the user can mend. The text is one line that names file, section and value, and says what to do.
class Error : public std::runtime_error {
public:
    Error(ErrorCode code, const std::string& text) : std::runtime_error(text), code_(code) {}
    ErrorCode code() const { return code_; }

private:
    ErrorCode code_;
};

}  // namespace regionmesh
