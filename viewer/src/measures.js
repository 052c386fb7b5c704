// Measures of regions, faces and vertices of a loaded model, in the unit of the file.
import { areaVector } from "./geometry.js";

/** Quality Q of a face (docs/decimate.md): 0.26 for an equilateral face, 0 for a degenerate one. */
export function faceQuality(positions, a, b, c) {
    const area = Math.hypot(...areaVector(positions, a, b, c)) / 2;
    const distance = (i, j) =>
        Math.hypot(positions[3 * i] - positions[3 * j], positions[3 * i + 1] - positions[3 * j + 1],
            positions[3 * i + 2] - positions[3 * j + 2]);
    const [low, middle, high] = [distance(a, b), distance(b, c), distance(c, a)].sort((x, y) => x - y);
    const perimeter = low + middle + high;
    const product = high * middle * (low + (perimeter > 0 ? (8 * area) / perimeter : 0));
    return product > 0 ? area / Math.cbrt(product * product) : 0;
}

/** By label: centroid of the surface, faces, area, volume, labels of neighbours; the outside is labels.length. */
export function regionMeasures(model) {
    const { geometry, positions, pairs } = model;
    const regions = model.labels.map(() => ({ faces: 0, area: 0, volume: 0, centroid: [0, 0, 0], neighbours: new Set() }));
    let face = 0;
    for (const [first, second, count] of pairs) {
        let area = 0, volume = 0;
        const middle = [0, 0, 0];
        for (const end = face + count; face < end; ++face) {
            const [a, b, c] = geometry.corners.subarray(3 * face, 3 * face + 3);
            const normal = areaVector(positions, a, b, c);
            const size = Math.hypot(...normal) / 2;
            area += size;
            for (let k = 0; k < 3; ++k) {
                middle[k] += (size * (positions[3 * a + k] + positions[3 * b + k] + positions[3 * c + k])) / 3;
                volume += (normal[k] * positions[3 * a + k]) / 6;
            }
        }
        for (const [label, other, sign] of [[first, second, 1], [second, first, -1]]) {
            if (label >= regions.length) continue;
            const region = regions[label];
            region.faces += count;
            region.area += area;
            region.volume += sign * volume;
            region.neighbours.add(other);
            for (let k = 0; k < 3; ++k) region.centroid[k] += middle[k];
        }
    }
    for (const region of regions)
        if (region.area > 0) region.centroid = region.centroid.map((sum) => sum / region.area);
    return regions;
}

/** Area of the faces between two labels. */
export function interfaceMeasures(model, pair) {
    let face = 0;
    for (let n = 0; n < pair; ++n) face += model.pairs[n][2];
    let area = 0;
    for (const end = face + model.pairs[pair][2]; face < end; ++face)
        area += Math.hypot(...areaVector(model.positions, ...model.geometry.corners.subarray(3 * face, 3 * face + 3))) / 2;
    return { area, faces: model.pairs[pair][2] };
}

/** One number for an edge. */
const pairKey = (a, b, count) => (a < b ? a * count + b : b * count + a);

/** Edges with three faces or more, as pairs of vertices, and vertices where four labels or more meet. */
export function linesOf(model) {
    const { corners, pairOfFace, vertices } = model.geometry;
    // An edge of a line is on the border of an interface: it occurs once or twice among the edges of one pair.
    const counts = new Map();
    const onBorder = borderVertices(model);
    for (let f = 0; f < pairOfFace.length; ++f)
        for (let k = 0; k < 3; ++k) {
            const a = corners[3 * f + k], b = corners[3 * f + ((k + 1) % 3)];
            if (!onBorder[a] || !onBorder[b]) continue;
            const key = pairKey(a, b, vertices);
            counts.set(key, (counts.get(key) ?? 0) + 1);
        }
    const edges = [];
    for (const [key, count] of counts) if (count > 2) edges.push(Math.floor(key / vertices), key % vertices);
    return { edges, points: quadruplePoints(model, edges) };
}

/** Vertices with faces of more than one pair. */
function borderVertices(model) {
    const { corners, pairOfFace, vertices } = model.geometry;
    const pair = new Int32Array(vertices).fill(-1), onBorder = new Uint8Array(vertices);
    for (let n = 0; n < corners.length; ++n) {
        const p = pairOfFace[(n / 3) | 0], v = corners[n];
        if (pair[v] < 0) pair[v] = p;
        else if (pair[v] !== p) onBorder[v] = 1;
    }
    return onBorder;
}

function quadruplePoints(model, edges) {
    const ends = new Map();
    for (const v of edges) ends.set(v, null);
    const { corners, pairOfFace } = model.geometry;
    for (let n = 0; n < corners.length; ++n) {
        if (!ends.has(corners[n])) continue;
        const labels = ends.get(corners[n]) ?? new Set();
        const [first, second] = model.pairs[pairOfFace[(n / 3) | 0]];
        ends.set(corners[n], labels.add(first).add(second));
    }
    return [...ends].filter(([, labels]) => labels.size >= 4).map(([v]) => v);
}
