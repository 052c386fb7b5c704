// Sets whose members lie in several parts of a surface, joined part by part.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace regionmesh {

/// Each part adds its sets and names the members that other parts have as well. Holds 4 bytes for each set, and the
/// members that later parts have.
class SeamSets {
public:
    std::uint32_t add() {
        up_.push_back(static_cast<std::uint32_t>(up_.size()));
        return up_.back();
    }

    /// Two sets that became one: its number, and the number that is no longer used. Equal where there was one set.
    struct Joined {
        std::uint32_t kept, gone;
    };

    /// Says that `set` has a member that several parts have; joins it with the set of which an earlier part said so.
    Joined meet(std::uint64_t member, std::uint32_t set, bool is_last_part) {
        const auto [at, is_new] = sets_.try_emplace(member, set);
        const Joined joined = is_new ? Joined{set, set} : join(at->second, set);
        if (is_last_part) sets_.erase(at);
        return joined;
    }

private:
    std::uint32_t find(std::uint32_t set) {
        while (up_[set] != set) set = up_[set] = up_[up_[set]];
        return set;
    }
    Joined join(std::uint32_t a, std::uint32_t b) {
        a = find(a), b = find(b);
        if (a > b) std::swap(a, b);
        up_[b] = a;
        return {a, b};
    }

    std::vector<std::uint32_t> up_;
    std::unordered_map<std::uint64_t, std::uint32_t> sets_;  // key: member
};

}  // namespace regionmesh
