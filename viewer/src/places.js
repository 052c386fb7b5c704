// What lies at a place of a model.

/** The number of the vertex nearest to a place, which is relative to the centre of the box. */
export function nearestVertex({ positions }, place) {
    let best = 0, least = Infinity;
    for (let at = 0; at < positions.length; at += 3) {
        const distance = (positions[at] - place[0]) ** 2 + (positions[at + 1] - place[1]) ** 2 + (positions[at + 2] - place[2]) ** 2;
        if (distance < least) [best, least] = [at / 3, distance];
    }
    return best;
}

/** The labels of the regions that have the vertex. */
export function labelsAround({ surface }, vertex) {
    const labels = new Set();
    surface.source.forEach((source, n) => source === vertex && labels.add(surface.labels[2 * n]));
    return labels;
}

/** A region that has the vertex, and the direction out of it there: from there its surface is seen. */
export function outsideAt({ surface }, vertex) {
    const n = surface.source.indexOf(vertex), normal = [...surface.normals.subarray(4 * n, 4 * n + 3)];
    return { label: surface.labels[2 * n], normal: normal.some((x) => x !== 0) ? normal : null };
}

/** The vertex with the largest distance to the other model. */
export function farthestVertex({ distances }) {
    return distances.reduce((best, distance, vertex) => (distance > distances[best] ? vertex : best), 0);
}
