// The face under the mouse: every face of every shown region is tried, which takes milliseconds.

const kRounding = 1e-6;  // of the distance from the eye

/**
 * The first face that the ray meets, as { face, label, at, seen, isCap }: face of the surfaces of regions, label of its
 * region, place in the model and, displaced by the exploded view, in the picture. A ray goes through transparent regions:
 * one is hit where no solid region is. `offsets`: displacement of each label, or null; `plane`: [x, y, z, d] or null;
 * `showsInside`: whether faces can be seen from inside without a section.
 */
export function pick(drawn, origin, direction, { offsets, plane, showsInside }) {
    const from = plane ? entryOf(plane, origin, direction) : 0;
    if (from === null) return null;
    const ray = { origin, direction, from, plane, offsets }, { isShown, isSolid } = drawn;
    return firstHit(drawn, ray, isSolid, showsInside || from > 0)
        ?? firstHit(drawn, ray, isShown.map((shown, label) => shown && !isSolid[label]), false);
}

/**
 * Among the regions that are `wanted`. Where two of them touch, it is the one that the picture shows: the face seen from
 * inside, if insides are seen.
 */
function firstHit(drawn, { origin, direction, from, plane, offsets }, wanted, showsInside) {
    const { corners, labels } = drawn.model.surface, p = drawn.places;
    let best = Infinity, found = null;
    for (let n = 0; n < corners.length; n += 3) {
        const label = labels[2 * corners[n]];
        if (!wanted[label]) continue;
        const hit = meet(p, corners, n, offsets ? offsets[label] : null, origin, direction);
        if (hit === null || hit.t < from || (hit.isInside && !showsInside)) continue;
        const rounding = kRounding * hit.t;
        if (hit.t >= best + (hit.isInside && !found?.isInside ? rounding : -rounding)) continue;
        if (plane && heightOf(plane, origin, direction, hit.t) > rounding) continue;
        best = hit.t;
        found = { face: n / 3, label, isInside: hit.isInside };
    }
    if (!found) return null;
    const { face, label } = found, isCap = found.isInside && from > 0, t = isCap ? from : best;
    const seen = origin.map((x, axis) => x + t * direction[axis]), offset = offsets?.[label] ?? [0, 0, 0];
    return { face, label, isCap, seen, at: seen.map((x, axis) => x - offset[axis]) };
}

const heightOf = ([x, y, z, d], origin, direction, t) =>
    x * (origin[0] + t * direction[0]) + y * (origin[1] + t * direction[1]) + z * (origin[2] + t * direction[2]) - d;

/** Where the ray enters the side that is kept; null where it never does. */
function entryOf(plane, origin, direction) {
    const height = heightOf(plane, origin, direction, 0);
    if (height <= 0) return 0;
    const change = plane[0] * direction[0] + plane[1] * direction[1] + plane[2] * direction[2];
    return change < 0 ? -height / change : null;
}

/** Moeller and Trumbore (1997). */
function meet(p, corners, n, offset, o, d) {
    const a = 3 * corners[n], b = 3 * corners[n + 1], c = 3 * corners[n + 2];
    const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
    const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
    const hx = d[1] * vz - d[2] * vy, hy = d[2] * vx - d[0] * vz, hz = d[0] * vy - d[1] * vx;
    const det = ux * hx + uy * hy + uz * hz;
    if (det === 0) return null;
    const sx = o[0] - p[a] - (offset ? offset[0] : 0), sy = o[1] - p[a + 1] - (offset ? offset[1] : 0);
    const sz = o[2] - p[a + 2] - (offset ? offset[2] : 0);
    const u = (sx * hx + sy * hy + sz * hz) / det;
    if (u < 0 || u > 1) return null;
    const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux;
    const v = (d[0] * qx + d[1] * qy + d[2] * qz) / det;
    if (v < 0 || u + v > 1) return null;
    const t = (vx * qx + vy * qy + vz * qz) / det;
    return t > 0 ? { t, isInside: det < 0 } : null;
}
