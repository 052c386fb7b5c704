// Reads or makes one HDF5 file for another process; README.md describes the protocol.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <sstream>
#include <string>

#include "catalogue.h"
#include "dream3d_file.h"
#include "helper/serve.h"
#include "regionmesh/sandbox.h"

namespace regionmesh::hdf5 {
namespace {

using Json = nlohmann::json;

constexpr helper::Program kProgram{.name = "regionmesh-hdf5", .letters = {'H', '5'}};

/// To the file, if there is one, and to what the library may load: filters, from the folders where they are installed.
void confine(const char* name) {
    SandboxRules rules{.reads_anything = false};
    if (name == nullptr) {
        enter_sandbox(rules);
        return;
    }
    rules.readable = {name, "/usr", "/lib", "/lib64", "/opt", "/etc/ld.so.cache"};
    const char* variable = std::getenv("HDF5_PLUGIN_PATH");
    std::istringstream folders(variable == nullptr ? "" : variable);
    for (std::string folder; std::getline(folders, folder, ':');) rules.readable.emplace_back(folder);
    enter_sandbox(rules);
}

Json to_json(const Entry& entry) {
    return {{"path", entry.path},
            {"is_dataset", entry.is_dataset},
            {"type", entry.type},
            {"shape", entry.shape},
            {"chunk", entry.chunk},
            {"is_integer", entry.is_integer},
            {"stored_bytes", entry.stored_bytes},
            {"obstacle", entry.obstacle},
            {"values", entry.values},
            {"numbers", entry.numbers},
            {"words", entry.words}};
}

void send_entries(Catalogue& file, const Json& request) {
    Json entries = Json::array();
    if (!request.contains("path")) {
        for (const Entry& entry : file.entries()) entries.push_back(to_json(entry));
    } else if (const auto entry = file.entry(request.at("path"))) {
        entries.push_back(to_json(*entry));
    }
    helper::send_answer(kProgram, std::string_view(helper::to_text(entries)));
}

/// The file comes on standard output, whole or not at all.
int write_dream3d() {
    const std::string bytes = make_dream3d();
    const std::uint64_t size = bytes.size();
    if (std::fwrite(&size, sizeof size, 1, stdout) != 1) return helper::kWrongInput;
    return std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size() && std::fflush(stdout) == 0
               ? helper::kDone
               : helper::kWrongInput;
}

int serve(const char* name) {
    std::optional<Catalogue> file;
    return helper::serve(kProgram, [&](const Json& request) {
        if (!file) file.emplace(name);
        if (!request.contains("start")) return send_entries(*file, request);
        const Box box{.start = request.at("start"), .count = request.at("count")};
        helper::send_answer(kProgram, file->read(request.at("path"), box));
    });
}

}  // namespace
}  // namespace regionmesh::hdf5

int main(int count, char** words) {
    using namespace regionmesh;
    if (count == 2 && std::strcmp(words[1], "--version") == 0)
        return std::puts("regionmesh-hdf5 " REGIONMESH_VERSION), 0;
    if (count != 2) {
        std::fputs("regionmesh-hdf5 FILE or --write-dream3d: reads and writes HDF5 for regionmesh, which starts it\n",
                   stderr);
        return helper::kUsage;
    }
    helper::prepare_process();
    const bool is_writing = std::strcmp(words[1], "--write-dream3d") == 0;
    if (!is_writing) helper::limit_memory();
    helper::run(hdf5::kProgram, [&] {
        hdf5::confine(is_writing ? nullptr : words[1]);
        return is_writing ? hdf5::write_dream3d() : hdf5::serve(words[1]);
    });
}
