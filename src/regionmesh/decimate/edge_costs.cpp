#include "regionmesh/decimate/edge_costs.h"

#include "regionmesh/base/lanes.h"
#include "regionmesh/decimate/placement.h"

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
    const auto four = [&](float PackedQuadric::*entry) { return Float4{p.*entry, q.*entry, r.*entry, s.*entry}; };
    using Q = PackedQuadric;
    Quadrics all;
    all.xx = four(&Q::xx), all.xy = four(&Q::xy), all.xz = four(&Q::xz);
    all.yy = four(&Q::yy), all.yz = four(&Q::yz), all.zz = four(&Q::zz);
    all.b = {four(&Q::bx), four(&Q::by), four(&Q::bz)};
    all.c = four(&Q::c);
    return all;
}

/// The least of the quadrics of v and of four neighbours, `way` from v, drawn toward the middle as in place().
Float4 least_costs(const Quadrics& own, const Quadrics& other, const Lanes3<Float4>& way, Float4& weight) {
    const Lanes3<Float4> half{all_four(0.5f) * way.x, all_four(0.5f) * way.y, all_four(0.5f) * way.z};
    // Seen from the middle: own from half a way ahead, the other from half a way back.
    const Lanes3<Float4> own_half = own.times(half), other_half = other.times(half);
    const Lanes3<Float4> b{own.b.x + own_half.x + other.b.x - other_half.x,
                           own.b.y + own_half.y + other.b.y - other_half.y,
                           own.b.z + own_half.z + other.b.z - other_half.z};
    const Float4 c = own.c + all_four(2) * dot(own.b, half) + dot(half, own_half) + other.c -
                     all_four(2) * dot(other.b, half) + dot(half, other_half);
    const Float4 xx = own.xx + other.xx, xy = own.xy + other.xy, xz = own.xz + other.xz, yy = own.yy + other.yy,
                 yz = own.yz + other.yz, zz = own.zz + other.zz;
    weight = xx + yy + zz;
    // In units of the weight, which keeps floats in range: the system is A / weight + regularisation.
    const Float4 unit = all_four(1) / (weight + all_four(1e-37f)), pull = all_four(static_cast<float>(kRegularisation));
    const Float4 sxx = xx * unit + pull, sxy = xy * unit, sxz = xz * unit, syy = yy * unit + pull, syz = yz * unit,
                 szz = zz * unit + pull;
    const Lanes3<Float4> r{b.x * unit, b.y * unit, b.z * unit};
    const Float4 c00 = syy * szz - syz * syz, c01 = sxz * syz - sxy * szz, c02 = sxy * syz - sxz * syy,
                 c11 = sxx * szz - sxz * sxz, c12 = sxy * sxz - sxx * syz, c22 = sxx * syy - sxy * sxy;
    const Float4 inverse = all_four(-1) / (sxx * c00 + sxy * c01 + sxz * c02);
    const Lanes3<Float4> step{inverse * (c00 * r.x + c01 * r.y + c02 * r.z), inverse * (c01 * r.x + c11 * r.y + c12 * r.z),
                              inverse * (c02 * r.x + c12 * r.y + c22 * r.z)};
    const Lanes3<Float4> a_step{xx * step.x + xy * step.y + xz * step.z, xy * step.x + yy * step.y + yz * step.z,
                                xz * step.x + yz * step.y + zz * step.z};
    const Float4 cost = c + all_four(2) * dot(b, step) + dot(step, a_step);
    return greatest(cost, Float4{});
}

}  // namespace

void find_edge_costs(const Model& model, const FlatArray<PackedQuadric>& quadrics, VertexId v,
                     std::span<const VertexId> to, std::vector<EdgeCost>& costs) {
    const Vec3 at = model.position(v);
    const PackedQuadric& q = quadrics[index(v)];
    const Quadrics own = side_by_side(q, q, q, q);
    costs.resize((to.size() + 3) / 4 * 4);
    for (std::size_t first = 0; first < to.size(); first += 4) {
        const PackedQuadric* others[4];
        Lanes3<Float4> way{};
        for (std::size_t lane = 0; lane < 4; ++lane) {
            const VertexId w = to[std::min(first + lane, to.size() - 1)];
            others[lane] = &quadrics[index(w)];
            const Vec3 step = model.position(w) - at;
            way.x[lane] = static_cast<float>(step.x);
            way.y[lane] = static_cast<float>(step.y);
            way.z[lane] = static_cast<float>(step.z);
        }
        Float4 weight{};
        const Float4 cost = least_costs(own, side_by_side(*others[0], *others[1], *others[2], *others[3]), way, weight);
        const Float4 draw = weight * dot(way, way) * all_four(static_cast<float>(kLengthShare));
        for (int lane = 0; lane < 4; ++lane) costs[first + lane] = {cost[lane], weight[lane], cost[lane] + draw[lane]};
    }
}

}  // namespace regionmesh
