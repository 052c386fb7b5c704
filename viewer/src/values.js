// Numbers by which the surface is coloured.
import { areaVector } from "./geometry.js";
import { faceQuality } from "./measures.js";

const kNone = 1e30;  // no value here: the shader draws grey

/** The quality of each face of the surfaces of regions. */
export function faceValues(model) {
    const { corners, faceOf } = model.surface, { geometry, positions } = model;
    const values = new Float32Array(corners.length / 3);
    for (let f = 0; f < values.length; ++f)
        values[f] = faceQuality(positions, ...geometry.corners.subarray(3 * faceOf[f], 3 * faceOf[f] + 3));
    return { values, low: 0, high: 0.26, ramp: "viridis", title: "quality of faces" };
}

/**
 * The mean curvature at each vertex of the surfaces of regions, positive where the region is convex: the Laplacian with
 * cotangents as weights. None on lines, where an interface ends.
 */
export function curvatures(model, places) {
    const { corners, vertices, normals } = model.surface;
    const sums = new Float64Array(3 * vertices), areas = new Float64Array(vertices), turns = new Int32Array(vertices);
    for (let n = 0; n < corners.length; n += 3) {
        const area = Math.hypot(...areaVector(places, corners[n], corners[n + 1], corners[n + 2]));
        for (let k = 0; k < 3; ++k) {
            const a = corners[n + k], b = corners[n + ((k + 1) % 3)], c = corners[n + ((k + 2) % 3)];
            turns[a] += b - c;  // 0 where the faces close around the vertex
            areas[a] += area / 6;
            addCotangent(sums, places, b, c, a, area);
        }
    }
    const values = new Float32Array(vertices);
    for (let v = 0; v < vertices; ++v) {
        let along = 0;
        for (let k = 0; k < 3; ++k) along += (sums[3 * v + k] * normals[4 * v + k]) / 127;
        values[v] = turns[v] !== 0 || areas[v] === 0 ? kNone : -along / (4 * areas[v]);
    }
    const bound = quantile(values, 0.95) || 1;
    return { values, low: -bound, high: bound, ramp: "vik", title: "mean curvature, 1 / model unit; convex is positive, grey has none" };
}

/** Adds cot(angle at `apex`) times the edge from b to c, in both directions. */
function addCotangent(sums, p, b, c, apex, doubleArea) {
    let dot = 0;
    for (let k = 0; k < 3; ++k) dot += (p[3 * b + k] - p[3 * apex + k]) * (p[3 * c + k] - p[3 * apex + k]);
    const cotangent = doubleArea > 0 ? dot / doubleArea : 0;
    for (let k = 0; k < 3; ++k) {
        const edge = cotangent * (p[3 * c + k] - p[3 * b + k]);
        sums[3 * b + k] += edge;
        sums[3 * c + k] -= edge;
    }
}

/** Of the absolute values, without those that are none. */
export function quantile(values, share) {
    const sizes = Float32Array.from(values.filter((value) => value < kNone / 2), Math.abs).sort();
    return sizes.length ? sizes[Math.floor(share * (sizes.length - 1))] : 0;
}
