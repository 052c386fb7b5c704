// The triangles to draw: all, or a coarse stand-in while the camera moves on a slow machine; and of these all, or those
// that can be seen from outside.
import * as three from "three";

/** Arrays of one level: places, normals (4 bytes), labels (region, other side), corners. */
export class Level {
    constructor({ places, normals, labels, corners }) {
        Object.assign(this, { places, labels, corners });
        this.full = new three.BufferGeometry();
        this.full.setAttribute("position", new three.BufferAttribute(places, 3));
        this.full.setAttribute("normal", new three.InterleavedBufferAttribute(new three.InterleavedBuffer(normals, 4), 3, 0, true));
        this.full.setAttribute("labels", new three.BufferAttribute(labels, 2));
        this.full.setAttribute("value", new three.BufferAttribute(new Float32Array(places.length / 3), 1));
        this.full.setIndex(new three.BufferAttribute(corners, 1));
        this.outer = new three.BufferGeometry();
        this.outer.attributes = this.full.attributes;
        this.outer.setIndex(new three.BufferAttribute(new Uint32Array(corners.length), 1));
    }

    /** `isSolid` by label: a face with a solid region on its other side is not seen from outside. */
    setOuter(isSolid) {
        const { corners, labels } = this, index = this.outer.getIndex(), room = index.array;
        let used = 0;
        for (let n = 0; n < corners.length; n += 3) {
            if (isSolid[labels[2 * corners[n] + 1]]) continue;
            room[used++] = corners[n];
            room[used++] = corners[n + 1];
            room[used++] = corners[n + 2];
        }
        // dispose() would free the buffers that `full` shares.
        index.clearUpdateRanges();
        index.addUpdateRange(0, used);
        index.needsUpdate = true;
        this.outer.setDrawRange(0, used);
    }
}

/** Three vertices a face, for what differs from face to face. */
export function separated({ places, normals, labels, corners }) {
    const count = corners.length;
    const made = { places: new Float32Array(3 * count), normals: new Int8Array(4 * count), labels: new Float32Array(2 * count), corners: new Uint32Array(count) };
    for (let n = 0; n < count; ++n) {
        const v = corners[n];
        for (let k = 0; k < 3; ++k) {
            made.places[3 * n + k] = places[3 * v + k];
            made.normals[4 * n + k] = normals[4 * v + k];
        }
        made.labels[2 * n] = labels[2 * v];
        made.labels[2 * n + 1] = labels[2 * v + 1];
        made.corners[n] = n;
    }
    return made;
}

/** Vertices merged in a grid with `cells` cells along the longest side: at most `most` faces, or a still coarser grid. */
export function coarsened(level, size, most) {
    for (let cells = 128; ; cells /= 2) {
        const made = merged(level, size / cells);
        if (made.corners.length <= 3 * most || cells <= 16) return made;
    }
}

function merged({ places, normals, labels, corners }, step) {
    const count = places.length / 3, cellOf = new Map(), sums = [], copies = new Map(), to = new Uint32Array(count);
    const made = { cells: [], labels: [], normals: [] };
    for (let v = 0; v < count; ++v) {
        const [i, j, k] = [0, 1, 2].map((axis) => Math.floor(places[3 * v + axis] / step) + 512);
        const key = (i * 1024 + j) * 1024 + k;
        let cell = cellOf.get(key);
        if (cell === undefined) {
            cellOf.set(key, (cell = sums.length / 4));
            sums.push(0, 0, 0, 0);
        }
        for (let axis = 0; axis < 3; ++axis) sums[4 * cell + axis] += places[3 * v + axis];
        sums[4 * cell + 3] += 1;
        const copyKey = `${cell} ${labels[2 * v]} ${labels[2 * v + 1]}`;
        let copy = copies.get(copyKey);
        if (copy === undefined) {
            copies.set(copyKey, (copy = made.cells.length));
            made.cells.push(cell);
            made.labels.push(labels[2 * v], labels[2 * v + 1]);
            made.normals.push(...normals.subarray(4 * v, 4 * v + 4));
        }
        to[v] = copy;
    }
    const kept = [];
    for (let n = 0; n < corners.length; n += 3) {
        const [a, b, c] = [to[corners[n]], to[corners[n + 1]], to[corners[n + 2]]];
        if (made.cells[a] !== made.cells[b] && made.cells[b] !== made.cells[c] && made.cells[c] !== made.cells[a]) kept.push(a, b, c);
    }
    return {
        places: Float32Array.from(made.cells.flatMap((cell) => [0, 1, 2].map((axis) => sums[4 * cell + axis] / sums[4 * cell + 3]))),
        normals: Int8Array.from(made.normals), labels: Float32Array.from(made.labels), corners: Uint32Array.from(kept),
    };
}
