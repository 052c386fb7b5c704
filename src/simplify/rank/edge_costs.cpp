#include "simplify/rank/edge_costs.h"

#include <cstddef>

#include "base/lanes.h"

namespace regionmesh {
namespace {

/// Four quadrics side by side.
struct Quadrics {
    Float4 xx, xy, xz, yy, yz, zz;
    Lanes3<Float4> b;
    Float4 c;

    Lanes3<Float4> times(const Lanes3<Float4>& p) const {
        return {xx * p.x + xy * p.y + xz * p.z, xy * p.x + yy * p.y + yz * p.z, xz * p.x + yz * p.y + zz * p.z};
    }
};

Quadrics side_by_side(const PackedQuadric& p, const PackedQuadric& q, const PackedQuadric& r, const PackedQuadric& s) {
    const auto four = [&](std::size_t first) {
        const auto of = [&](const PackedQuadric& quadric) {
            return load<Float4>(reinterpret_cast<const char*>(&quadric) + first);
        };
        return transposed(of(p), of(q), of(r), of(s));
    };
    const auto [xx, xy, xz, yy] = four(offsetof(PackedQuadric, xx));
    const auto [yz, zz, bx, by] = four(offsetof(PackedQuadric, yz));
    return {xx, xy, xz, yy, yz, zz, {bx, by, Float4{p.bz, q.bz, r.bz, s.bz}}, Float4{p.c, q.c, r.c, s.c}};
}

/// Where sides of the box keep the coordinates of the merged vertices: relative to the middle of the edge.
struct Locks {
    bool any = false;
    Mask4 x{}, y{}, z{};
    Lanes3<Float4> at{};

    void put(int lane, SideSet own, SideSet other, const Lanes3<Float4>& way) {
        if ((own | other) == 0) return;
        any = true;
        const auto lock = [&](int axis, Mask4& is_locked, Float4& value, const Float4& step) {
            if (((own | other) >> (2 * axis) & 3) == 0) return;
            is_locked[lane] = -1;
            value[lane] = (own >> (2 * axis) & 3) != 0 ? -0.5f * step[lane] : 0.5f * step[lane];
        };
        lock(0, x, at.x, way.x);
        lock(1, y, at.y, way.y);
        lock(2, z, at.z, way.z);
    }
};

/// Four symmetric systems of equations.
struct Systems {
    Float4 xx, xy, xz, yy, yz, zz;
    Lanes3<Float4> right;

    /// Takes coordinates out by setting them to what they are locked to.
    void lock(const Locks& locks) {
        const Float4 zero{}, one = all_four(1);
        const auto take_out = [&](Mask4 m, Float4 value, Float4& own, Float4& first, Float4& second, Float4& own_right,
                                  Float4& first_right, Float4& second_right) {
            own_right = m ? value : own_right;
            first_right = m ? first_right - first * value : first_right;
            second_right = m ? second_right - second * value : second_right;
            own = m ? one : own;
            first = m ? zero : first;
            second = m ? zero : second;
        };
        take_out(locks.x, locks.at.x, xx, xy, xz, right.x, right.y, right.z);
        take_out(locks.y, locks.at.y, yy, xy, yz, right.y, right.x, right.z);
        take_out(locks.z, locks.at.z, zz, xz, yz, right.z, right.x, right.y);
    }
    /// By Cramer's rule.
    Lanes3<Float4> solve() const {
        const Float4 c00 = yy * zz - yz * yz, c01 = xz * yz - xy * zz, c02 = xy * yz - xz * yy, c11 = xx * zz - xz * xz,
                     c12 = xy * xz - xx * yz, c22 = xx * yy - xy * xy;
        const Float4 inverse = all_four(1) / (xx * c00 + xy * c01 + xz * c02);
        return {inverse * (c00 * right.x + c01 * right.y + c02 * right.z),
                inverse * (c01 * right.x + c11 * right.y + c12 * right.z),
                inverse * (c02 * right.x + c12 * right.y + c22 * right.z)};
    }
};

/// The least of the quadrics of v and of four neighbours, `way` from v, drawn toward the middle as in least_cost().
Float4 least_costs(const Quadrics& own, const Quadrics& other, const Lanes3<Float4>& way, const Locks& locks,
                   Float4& weight) {
    const Lanes3<Float4> half{all_four(0.5f) * way.x, all_four(0.5f) * way.y, all_four(0.5f) * way.z};
    // Seen from the middle: own from half a way ahead, the other from half a way back.
    const Lanes3<Float4> own_half = own.times(half), other_half = other.times(half);
    Quadrics sum;
    sum.xx = own.xx + other.xx, sum.xy = own.xy + other.xy, sum.xz = own.xz + other.xz;
    sum.yy = own.yy + other.yy, sum.yz = own.yz + other.yz, sum.zz = own.zz + other.zz;
    sum.b = {own.b.x + own_half.x + other.b.x - other_half.x, own.b.y + own_half.y + other.b.y - other_half.y,
             own.b.z + own_half.z + other.b.z - other_half.z};
    sum.c = own.c + all_four(2) * dot(own.b, half) + dot(half, own_half) + other.c - all_four(2) * dot(other.b, half) +
            dot(half, other_half);
    weight = sum.xx + sum.yy + sum.zz;
    // In units of the weight, which keeps floats in range.
    const Float4 unit = all_four(1) / (weight + all_four(1e-37f)), pull = all_four(static_cast<float>(kRegularisation));
    Systems systems{sum.xx * unit + pull,
                    sum.xy * unit,
                    sum.xz * unit,
                    sum.yy * unit + pull,
                    sum.yz * unit,
                    sum.zz * unit + pull,
                    {-sum.b.x * unit, -sum.b.y * unit, -sum.b.z * unit}};
    if (locks.any) systems.lock(locks);
    const Lanes3<Float4> step = systems.solve();
    return greatest(sum.c + all_four(2) * dot(sum.b, step) + dot(step, sum.times(step)), Float4{});
}

}  // namespace

void find_edge_costs(const Mesh& mesh, const VertexQuadrics& quadrics, VertexId v, std::span<const VertexId> to,
                     std::vector<EdgeCost>& costs) {
    const Vec3 at = mesh.position(v);
    const PackedQuadric& q = quadrics[v];
    const Quadrics own = side_by_side(q, q, q, q);
    const SideSet own_sides = mesh[v].sides;
    costs.resize((to.size() + 3) / 4 * 4);
    for (std::size_t first = 0; first < to.size(); first += 4) {
        const PackedQuadric* others[4];
        Lanes3<Float4> way{};
        Locks locks;
        for (int lane = 0; lane < 4; ++lane) {
            const VertexId w = to[std::min(first + lane, to.size() - 1)];
            others[lane] = &quadrics[w];
            const Vec3 step = mesh.position(w) - at;
            way.x[lane] = static_cast<float>(step.x);
            way.y[lane] = static_cast<float>(step.y);
            way.z[lane] = static_cast<float>(step.z);
            locks.put(lane, own_sides, mesh[w].sides, way);
        }
        Float4 weight{};
        const Float4 cost =
            least_costs(own, side_by_side(*others[0], *others[1], *others[2], *others[3]), way, locks, weight);
        const Float4 draw = weight * dot(way, way) * all_four(static_cast<float>(kLengthShare));
        for (int lane = 0; lane < 4; ++lane) costs[first + lane] = {cost[lane], weight[lane], cost[lane] + draw[lane]};
    }
}

}  // namespace regionmesh
