// What is fuzzed: one line a format.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fuzz/mutate.h"

namespace regionmesh::fuzz {

struct Format {
    const char* name;
    const char* folder;                   // of tests/data, with those below it
    std::vector<std::string> extensions;  // of the files to change; others lie beside them
    void (*read)(const std::filesystem::path&, Random&);
    const char* store = "";  // extension of directories, of whose files one is changed and all are read
};

std::span<const Format> formats();

}  // namespace regionmesh::fuzz
