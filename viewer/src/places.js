// What lies at a place of a model.

/** The number of the vertex of a region nearest to a place, which is relative to the centre of the box. */
export function nearestVertex({ positions, surface }, place) {
    let best = 0, least = Infinity;
    for (const vertex of surface.source) {
        const distance = place.reduce((sum, x, axis) => sum + (positions[3 * vertex + axis] - x) ** 2, 0);
        if (distance < least) [best, least] = [vertex, distance];
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

/** The vertex of a region with the largest distance to the other model. */
export function farthestVertex({ distances, surface }) {
    return surface.source.reduce((best, vertex) => (distances[vertex] > distances[best] ? vertex : best), surface.source[0]);
}
