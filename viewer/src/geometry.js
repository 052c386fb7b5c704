// The geometry of a page: bytes to arrays (viewer/README.md gives the layout), and the surfaces of regions.
import { unpack } from "./unpack.js";

/** Successive differences, low bytes then high bytes, into every `stride`th place of `numbers`. */
function readDifferences(bytes, at, count, numbers, offset, stride) {
    let last = 0;
    for (let n = 0; n < count; ++n) {
        const step = bytes[at + n] | (bytes[at + count + n] << 8);
        last = (last + ((step >>> 1) ^ -(step & 1))) & 0xffff;
        numbers[offset + n * stride] = last;
    }
    return at + 2 * count;
}

function readFaces(bytes, at, corners) {
    let used = 0;
    for (let n = 0; n < corners.length; ++n) {
        let number = 0, shift = 0, byte;
        do {
            byte = bytes[at++];
            number |= (byte & 0x7f) << shift;
            shift += 7;
        } while (byte & 0x80);
        corners[n] = used - number;
        if (number === 0) ++used;
    }
    return at;
}

/** The arrays of a model: quantised places (4 a vertex, the last unused), corners, and the pair of each face. */
export function readGeometry(bytes, model) {
    const vertices = model.shown_vertices, faces = model.shown_faces;
    const places = new Uint16Array(4 * vertices);
    let at = 0;
    for (let axis = 0; axis < 3; ++axis) at = readDifferences(bytes, at, vertices, places, axis, 4);
    const corners = new Uint32Array(3 * faces);
    at = readFaces(bytes, at, corners);
    const pairOfFace = new Uint32Array(faces);
    let face = 0;
    model.pairs.forEach(([, , count], pair) => {
        pairOfFace.fill(pair, face, face + count);
        face += count;
    });
    let distances = null;
    if (model.has_distances) {
        const numbers = new Uint16Array(vertices);
        readDifferences(bytes, at, vertices, numbers, 0, 1);
        distances = Float32Array.from(numbers, (number) => (number / 65535) * model.largest_distance);
    }
    return { places, corners, pairOfFace, distances, vertices, faces };
}

/** The side of the box that a face lies in, 1 to 6; 0: none. */
function sideOf(places, a, b, c) {
    for (let axis = 0; axis < 3; ++axis) {
        const place = places[4 * a + axis];
        if ((place === 0 || place === 65535) && places[4 * b + axis] === place && places[4 * c + axis] === place)
            return 1 + 2 * axis + (place > 0 ? 1 : 0);
    }
    return 0;
}

/** A copy of each vertex for each pair of labels and each side of the box, so that normals end at lines and edges. */
function splitByPair(geometry, model) {
    const { corners, places, vertices } = geometry;
    const last = new Int32Array(7 * vertices).fill(-1), copy = new Uint32Array(7 * vertices);
    const split = new Uint32Array(corners.length), source = [], pairOf = [];
    let corner = 0;
    model.pairs.forEach(([, , count], pair) => {
        for (const end = corner + 3 * count; corner < end; ++corner) {
            const face = corner - (corner % 3), vertex = corners[corner];
            const at = vertex + vertices * sideOf(places, corners[face], corners[face + 1], corners[face + 2]);
            if (last[at] !== pair) {
                last[at] = pair;
                copy[at] = source.length;
                source.push(vertex);
                pairOf.push(pair);
            }
            split[corner] = copy[at];
        }
    });
    return { split, source: Uint32Array.from(source), pairOf: Uint32Array.from(pairOf) };
}

/** The box of all models that have faces, and its centre: they are drawn at their places in it. */
export function boxOf(models) {
    const drawn = models.filter(({ faces }) => faces > 0), found = drawn.length > 0 ? drawn : models;
    const [low, high] = [["low", Math.min], ["high", Math.max]].map(([side, outer]) =>
        [0, 1, 2].map((axis) => outer(...found.map((model) => model[side][axis]))));
    return { low, high, centre: low.map((x, axis) => (x + high[axis]) / 2) };
}

/** Positions in the unit of the model, relative to `centre`. */
function decodedPositions(geometry, model, centre) {
    const positions = new Float32Array(3 * geometry.vertices);
    for (let axis = 0; axis < 3; ++axis) {
        const length = model.high[axis] - model.low[axis], middle = (model.low[axis] + model.high[axis]) / 2 - centre[axis];
        for (let v = 0; v < geometry.vertices; ++v)
            positions[3 * v + axis] = middle + (geometry.places[4 * v + axis] / 65535 - 0.5) * length;
    }
    return positions;
}

/** Unit normals (components of 8 bits, 4 a vertex) of split vertices, weighted by area. */
function normalsOf(positions, { split, source }) {
    const sums = new Float32Array(3 * source.length);
    for (let n = 0; n < split.length; n += 3) {
        const [nx, ny, nz] = areaVector(positions, source[split[n]], source[split[n + 1]], source[split[n + 2]]);
        for (let k = 0; k < 3; ++k) {
            const at = 3 * split[n + k];
            sums[at] += nx;
            sums[at + 1] += ny;
            sums[at + 2] += nz;
        }
    }
    const normals = new Int8Array(4 * source.length);
    for (let v = 0; v < source.length; ++v) {
        const length = Math.hypot(sums[3 * v], sums[3 * v + 1], sums[3 * v + 2]) || 1;
        for (let k = 0; k < 3; ++k) normals[4 * v + k] = Math.round((127 * sums[3 * v + k]) / length);
    }
    return normals;
}

/** Twice the area of a triangle, along its normal. */
export function areaVector(p, a, b, c) {
    const ux = p[3 * b] - p[3 * a], uy = p[3 * b + 1] - p[3 * a + 1], uz = p[3 * b + 2] - p[3 * a + 2];
    const vx = p[3 * c] - p[3 * a], vy = p[3 * c + 1] - p[3 * a + 1], vz = p[3 * c + 2] - p[3 * a + 2];
    return [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
}

/**
 * The closed surface of every region, faces outward: a face between two regions occurs twice. Per vertex: source
 * vertex, region, the label on the other side, normal. Per face: the face of the geometry.
 */
function regionSurfaces(geometry, model, positions) {
    const parts = splitByPair(geometry, model);
    const normals = normalsOf(positions, parts);
    const isRegion = (label) => label < model.labels.length && !model.labels[label].background;
    const sides = model.pairs.map(([first, second]) => [isRegion(first), isRegion(second)]);
    const firstVertex = [new Int32Array(parts.source.length).fill(-1), new Int32Array(parts.source.length).fill(-1)];
    let vertices = 0, faces = 0;
    parts.pairOf.forEach((pair, v) => {
        for (const side of [0, 1]) if (sides[pair][side]) firstVertex[side][v] = vertices++;
    });
    model.pairs.forEach(([, , count], pair) => (faces += count * (sides[pair][0] + sides[pair][1])));
    const made = {
        vertices, faces, source: new Uint32Array(vertices), labels: new Float32Array(2 * vertices),
        normals: new Int8Array(4 * vertices), corners: new Uint32Array(3 * faces), faceOf: new Uint32Array(faces),
    };
    parts.pairOf.forEach((pair, v) => {
        for (const side of [0, 1]) {
            const to = firstVertex[side][v];
            if (to < 0) continue;
            made.source[to] = parts.source[v];
            made.labels[2 * to] = model.pairs[pair][side];
            made.labels[2 * to + 1] = model.pairs[pair][1 - side];
            for (let k = 0; k < 3; ++k) made.normals[4 * to + k] = side ? -normals[4 * v + k] : normals[4 * v + k];
        }
    });
    let face = 0;
    for (let f = 0; f < geometry.faces; ++f) {
        const [a, b, c] = parts.split.subarray(3 * f, 3 * f + 3);
        for (const side of [0, 1]) {
            if (!sides[geometry.pairOfFace[f]][side]) continue;
            const to = firstVertex[side];
            made.corners.set(side ? [to[a], to[c], to[b]] : [to[a], to[b], to[c]], 3 * face);
            made.faceOf[face++] = f;
        }
    }
    return made;
}

/** Everything that is drawn of model number `n`, relative to `centre`. */
export async function loadModel(n, model, centre) {
    const element = document.getElementById(`geometry-${n}`);
    const geometry = readGeometry(await unpack(element.textContent), model);
    element.remove();
    const positions = decodedPositions(geometry, model, centre);
    const surface = regionSurfaces(geometry, model, positions);
    return { ...model, geometry, positions, surface, centre, distances: geometry.distances };
}
