// Measures of regions, faces and vertices of a loaded model, in the unit of the file.
import { areaVector } from "./geometry.js";

/** Quality Q of a face (docs/explanation/decimate.md): 0.26 for an equilateral face, 0 for a degenerate one. */
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
const edgeKey = (a, b, count) => (a < b ? a * count + b : b * count + a);

/**
 * Edges with three faces or more and vertices where four labels or more meet, each as { at: vertices, labels }: of the
 * edges two vertices each.
 */
export function linesOf(model) {
    const { corners, pairOfFace, vertices } = model.geometry;
    const onBorder = borderVertices(model), found = new Map();
    for (let f = 0; f < pairOfFace.length; ++f)
        for (let k = 0; k < 3; ++k) {
            const a = corners[3 * f + k], b = corners[3 * f + ((k + 1) % 3)];
            if (!onBorder[a] || !onBorder[b]) continue;
            const key = edgeKey(a, b, vertices), pairs = found.get(key);
            if (pairs) pairs.push(pairOfFace[f]);
            else found.set(key, [pairOfFace[f]]);
        }
    const labelsOf = (pairs) => [...new Set(pairs.flatMap((pair) => model.pairs[pair].slice(0, 2)))];
    const edges = [];
    for (const [key, pairs] of found)
        if (pairs.length > 2) edges.push({ at: [Math.floor(key / vertices), key % vertices], labels: labelsOf(pairs) });
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
    const met = new Map();
    for (const { at, labels } of edges)
        for (const v of at) {
            if (!met.has(v)) met.set(v, new Set());
            for (const label of labels) met.get(v).add(label);
        }
    return [...met].filter(([, labels]) => labels.size >= 4).map(([v, labels]) => ({ at: [v], labels: [...labels] }));
}
