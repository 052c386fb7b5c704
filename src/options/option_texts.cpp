// Texts about an option in the help.
#include "regionmesh/options.h"

namespace regionmesh {

std::string value_name(const OptionSpec& option) {
    if (!option.value.empty()) return std::string(option.value);
    switch (option.kind) {
        case OptionKind::kFlag:
            return "";
        case OptionKind::kCount:
            return "COUNT";
        case OptionKind::kNumber:
            return "NUMBER";
        case OptionKind::kShare:
            return "SHARE";
        case OptionKind::kBytes:
            return "SIZE";
        case OptionKind::kLabel:
            return "LABEL";
        case OptionKind::kCounts:
        case OptionKind::kNumbers:
            return "X,Y,Z";
        case OptionKind::kText:
            return "TEXT";
        case OptionKind::kFile:
            return "FILE";
        case OptionKind::kWord:
            break;
    }
    std::string words;
    for (const std::string_view word : option.words) words += (words.empty() ? "" : "|") + std::string(word);
    return words;
}

std::string description_of(const OptionSpec& option) {
    std::string notes;
    const auto note = [&](const std::string& text) { notes += (notes.empty() ? " (" : "; ") + text; };
    if (!option.unit.empty()) note(std::string(option.unit));
    if (!option.range.empty()) note(option.range);
    if (!option.default_text.empty()) note("default " + option.default_text);
    return std::string(option.help) + notes + (notes.empty() ? "" : ")");
}

std::string names_of_commands(std::uint32_t commands) {
    std::string names;
    for (const CommandSpec& command : command_table())
        if (commands & command.command) names += (names.empty() ? "" : ", ") + std::string(command.name);
    return names;
}

}  // namespace regionmesh
