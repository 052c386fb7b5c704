// Volumes and options drawn at random, for whole runs of the program.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace regionmesh::random {

using Words = std::vector<std::string>;

/// One run: everything in it follows from a seed.
struct Case {
    std::string text;       // of the volume, for messages
    std::string npy;        // the bytes of the volume
    Words input;            // options that say how the volume is read: of reconstruct and of check
    Words both;             // other options of reconstruct and of check
    Words options;          // those of reconstruct alone
    std::string model;      // name of the file to write
    bool is_open;           // no faces on the sides of the box
    bool has_room;          // --room changes labels before the surface is made
    bool keeps_samples;     // no sample may be in another region
    bool is_decimated;      // the result may depend on --memory
    std::uint64_t threads;  // of the second run
    double memory;          // times the least --memory that is accepted; 0: the default
};

Case draw_case(std::mt19937_64& random);

}  // namespace regionmesh::random
