#include "base/option_range.h"

#include <cstdio>
#include <string>

#include "regionmesh/error.h"

namespace regionmesh {

void require_number(const char* option, double number, const OptionRange& range) {
    if (number >= range.least && number <= range.most) return;
    char text[32];
    std::snprintf(text, sizeof text, "%g", number);
    throw Error(ErrorCode::kUsage,
                std::string(option) + ": " + text + " is not a number of " + range.text + "; give one");
}

}  // namespace regionmesh
