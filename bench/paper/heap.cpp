// What a heap of edges does with equal costs: heap COUNT KIND fills it with COUNT edges, empties it, and prints the
// nanoseconds an edge. KIND is random, few (seven different costs), equal, perturbed (equal, and up to 1e-7 at random),
// or list: equal costs in a list that is searched from its head, as the worst that a heap can become.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <forward_list>
#include <random>
#include <string>
#include <vector>

#include "simplify/rank/edge_heap.h"

using namespace regionmesh;

std::vector<float> costs_of(std::uint32_t count, const std::string& kind) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<float> costs(count);
    for (float& cost : costs)
        cost = kind == "random"      ? unit(random)
               : kind == "few"       ? static_cast<float>(random() % 7)
               : kind == "perturbed" ? 1e-7f * unit(random)
                                     : 0;
    return costs;
}

void through_heap(const std::vector<float>& costs) {
    const auto count = static_cast<std::uint32_t>(costs.size());
    EdgeHeap heap(count);
    for (std::uint32_t v = 0; v < count; ++v) heap.set(VertexId{v}, costs[v]);
    while (!heap.empty()) heap.remove(heap.top());
}

/// In order of cost, each behind those that cost as much: what a heap becomes that goes one way on equal costs.
void through_list(const std::vector<float>& costs) {
    std::forward_list<float> list;
    for (const float cost : costs) {
        auto before = list.before_begin();
        for (auto place = list.begin(); place != list.end() && *place <= cost; ++place) before = place;
        list.insert_after(before, cost);
    }
    while (!list.empty()) list.pop_front();
}

int main(int, char** words) {
    const std::string kind = words[2];
    const std::vector<float> costs = costs_of(static_cast<std::uint32_t>(std::atol(words[1])), kind);
    const auto start = std::chrono::steady_clock::now();
    kind == "list" ? through_list(costs) : through_heap(costs);
    const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - start;
    std::printf("%.3f\n", spent.count() / static_cast<double>(costs.size()));
}
