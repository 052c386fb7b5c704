// Prints src/cells/compact_table.inc.
#include <cstdio>

#include "cells/table/compact_search.h"

int main() {
    constexpr std::size_t kWidth = 116;
    const std::string text = regionmesh::cell_table::compact_table();
    std::puts("// Made by regionmesh_compact_table (src/cells/table/write_compact_table.cpp).");
    for (std::size_t at = 0; at < text.size(); at += kWidth) std::printf("\"%s\"\n", text.substr(at, kWidth).c_str());
}
