// Runs of the program in which something fails.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace regionmesh::faults {

/// The program runs in a folder for its outputs; its inputs lie in ../in.
struct Scenario {
    std::string name;
    std::vector<std::string> arguments;
    std::map<std::string, std::string> inputs;  // bytes by name
};

std::vector<Scenario> all_scenarios();

}  // namespace regionmesh::faults
