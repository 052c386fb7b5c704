// The options in a report of an earlier run.
#include "formats/text/json_text.h"
#include "regionmesh/error.h"
#include "regionmesh/options.h"

namespace regionmesh {

OptionValues options_of_report(const std::string& path, const CommandSpec& command) {
    const auto json = formats::read_json(path);
    if (!json) throw Error(ErrorCode::kInput, path + ": no such file; check the path");
    return formats::reading(path, [&] {
        if (!json->contains("options"))
            throw Error(ErrorCode::kInput, path +
                                               ": has no options; give a report that reconstruct, decimate or smooth "
                                               "wrote, or a .toml file");
        const auto made_by = json->at("command").get<std::string>();
        if (made_by != command.name)
            throw Error(ErrorCode::kUsage,
                        path + ": holds the options of " + made_by + ", not of " + std::string(command.name));
        OptionValues values;
        for (const auto& [name, value] : json->at("options").items())
            for (const auto& text : value.is_array() ? value : nlohmann::json::array({value}))
                values.emplace_back(name, text.get<std::string>());
        return values;
    });
}

}  // namespace regionmesh
