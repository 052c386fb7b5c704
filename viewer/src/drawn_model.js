// One model as three.js objects. Regions are hidden, coloured and moved by two small textures, so that a change costs
// the same for ten regions and for ten thousand.
import * as three from "three";
import { overlayFragment, overlayVertex, surfaceFragment, surfaceVertex } from "./shaders.js";
import { linesOf } from "./measures.js";
import { rampTexture } from "./ramps.js";
import { curvatures, faceValues } from "./values.js";

const kWidth = 256;  // of the textures of regions
const kStates = { hidden: 0, ghost: 128, solid: 255 };

function regionTexture(regions, type) {
    const height = Math.max(1, Math.ceil(regions / kWidth));
    const data = type === three.FloatType ? new Float32Array(4 * kWidth * height) : new Uint8Array(4 * kWidth * height);
    const texture = new three.DataTexture(data, kWidth, height, three.RGBAFormat, type);
    texture.needsUpdate = true;
    return texture;
}

function overlay(object, shared, tint, size) {
    object.material = new three.ShaderMaterial({
        glslVersion: three.GLSL3, vertexShader: overlayVertex, fragmentShader: overlayFragment,
        uniforms: { ...shared, tint: { value: new three.Color(tint) }, size: { value: size }, isRound: { value: object.isPoints === true } },
    });
    object.frustumCulled = false;
    return object;
}

export class DrawnModel {
    constructor(model, shared) {
        this.model = model;
        this.shared = shared;
        this.scene = new three.Scene();
        this.states = regionTexture(model.labels.length, three.UnsignedByteType);
        this.offsets = regionTexture(model.labels.length, three.FloatType);
        this.uniforms = {
            ...shared, states: { value: this.states }, offsets: { value: this.offsets }, selected: { value: -1 },
            mode: { value: 0 }, range: { value: new three.Vector2(0, 1) }, ramp: { value: rampTexture("viridis") },
        };
        this.indexed = this.indexedGeometry();
        this.passes = [this.addPass(three.FrontSide, false), this.addPass(three.BackSide, false), this.addPass(three.FrontSide, true)];
        this.values = new Map();
    }

    indexedGeometry() {
        const { surface, positions } = this.model;
        const places = new Float32Array(3 * surface.vertices);
        for (let v = 0; v < surface.vertices; ++v)
            places.set(positions.subarray(3 * surface.source[v], 3 * surface.source[v] + 3), 3 * v);
        this.places = places;
        return this.geometryOf(places, surface.normals, surface.labels, surface.vertices, surface.corners);
    }

    geometryOf(places, normals, labels, vertices, corners) {
        const geometry = new three.BufferGeometry();
        geometry.setAttribute("position", new three.BufferAttribute(places, 3));
        const packed = new three.InterleavedBuffer(normals, 4);
        geometry.setAttribute("normal", new three.InterleavedBufferAttribute(packed, 3, 0, true));
        geometry.setAttribute("labels", new three.BufferAttribute(labels, 2));
        geometry.setAttribute("value", new three.BufferAttribute(new Float32Array(vertices), 1));
        if (corners) geometry.setIndex(new three.BufferAttribute(corners, 1));
        return geometry;
    }

    /** Three vertices a face, for what differs from face to face. Made when it is first needed. */
    get separate() {
        if (this.separateGeometry) return this.separateGeometry;
        const { corners, normals, labels } = this.model.surface, count = corners.length;
        const places = new Float32Array(3 * count), turned = new Int8Array(4 * count), pairs = new Float32Array(2 * count);
        for (let n = 0; n < count; ++n) {
            const v = corners[n];
            for (let k = 0; k < 3; ++k) {
                places[3 * n + k] = this.places[3 * v + k];
                turned[4 * n + k] = normals[4 * v + k];
            }
            pairs[2 * n] = labels[2 * v];
            pairs[2 * n + 1] = labels[2 * v + 1];
        }
        return (this.separateGeometry = this.geometryOf(places, turned, pairs, count, null));
    }

    addPass(side, isGhost) {
        const isInside = side === three.BackSide;
        const material = new three.ShaderMaterial({
            glslVersion: three.GLSL3, vertexShader: surfaceVertex, fragmentShader: surfaceFragment, side,
            transparent: isGhost, depthWrite: !isGhost,
            uniforms: {
                ...this.uniforms, isGhost: { value: isGhost }, isInside: { value: isInside },
                wantedState: { value: isGhost ? 0.5 : 1 },
            },
        });
        const mesh = new three.Mesh(this.indexed, material);
        mesh.frustumCulled = false;
        this.scene.add(mesh);
        return mesh;
    }

    /** `regions`: for each label of the model its colour and state. */
    show(regions) {
        const { data } = this.states.image;
        let ghosts = 0;
        regions.forEach(({ colour, state }, label) => {
            const number = parseInt(colour.slice(1), 16);
            data.set([number >> 16, (number >> 8) & 255, number & 255, kStates[state]], 4 * label);
            ghosts += state === "ghost";
        });
        this.states.needsUpdate = true;
        this.passes[2].visible = ghosts > 0;
    }

    /** Displacements of labels for the exploded view at 1. */
    setOffsets(offsets) {
        offsets.forEach((offset, label) => this.offsets.image.data.set(offset, 4 * label));
        this.offsets.needsUpdate = true;
    }

    /** `isSeparate`: three vertices a face. Returns the range of the values, or null. */
    colourBy(what, showsEdges) {
        const isFaceValue = what === "quality";
        const geometry = isFaceValue || showsEdges ? this.separate : this.indexed;
        for (const pass of this.passes) pass.geometry = geometry;
        const { mode, range, ramp } = this.uniforms;
        mode.value = what === "region" ? 0 : what === "interface" ? 1 : 2;
        if (mode.value < 2) return null;
        const found = this.valuesOf(what);
        if (!found) {
            mode.value = 0;
            return null;
        }
        this.fillValues(geometry, found.values, isFaceValue);
        range.value.set(found.low, found.high);
        ramp.value = rampTexture(found.ramp);
        return found;
    }

    valuesOf(what) {
        if (!this.values.has(what)) {
            const { model } = this;
            const make = { quality: () => faceValues(model), curvature: () => curvatures(model, this.places), distance: () => distances(model) };
            this.values.set(what, make[what]());
        }
        return this.values.get(what);
    }

    fillValues(geometry, values, isFaceValue) {
        const attribute = geometry.getAttribute("value"), to = attribute.array, { corners } = this.model.surface;
        if (isFaceValue) for (let n = 0; n < to.length; ++n) to[n] = values[(n / 3) | 0];
        else if (geometry === this.indexed) to.set(values);
        else for (let n = 0; n < to.length; ++n) to[n] = values[corners[n]];
        attribute.needsUpdate = true;
    }

    showLines(isShown) { this.showOverlay("lines", isShown, () => this.lineObjects().lines); }
    showPoints(isShown) { this.showOverlay("points", isShown, () => this.lineObjects().points); }

    lineObjects() {
        if (this.lineParts) return this.lineParts;
        const found = linesOf(this.model), { positions } = this.model;
        const at = (vertices) => {
            const places = new Float32Array(3 * vertices.length);
            vertices.forEach((v, n) => places.set(positions.subarray(3 * v, 3 * v + 3), 3 * n));
            return new three.BufferGeometry().setAttribute("position", new three.BufferAttribute(places, 3));
        };
        this.lineParts = {
            edgeCount: found.edges.length / 2, pointCount: found.points.length,
            lines: overlay(new three.LineSegments(at(found.edges)), this.shared, "#111111", 1),
            points: overlay(new three.Points(at(found.points)), this.shared, "#d00000", 9),
        };
        return this.lineParts;
    }

    showOverlay(name, isShown, make) {
        if (!isShown && !this[name]) return;
        if (!this[name]) this.scene.add((this[name] = make()));
        this[name].visible = isShown;
    }

    /** Markers at places in the coordinates of the file. */
    showMarkers(places) {
        if (this.markers) this.scene.remove(this.markers);
        const flat = new Float32Array(places.flatMap((p) => p.map((x, axis) => x - this.model.centre[axis])));
        const geometry = new three.BufferGeometry().setAttribute("position", new three.BufferAttribute(flat, 3));
        this.markers = overlay(new three.Points(geometry), this.shared, "#ff2020", 14);
        this.markers.material.depthTest = false;
        this.markers.renderOrder = 9;
        this.scene.add(this.markers);
    }
}

function distances(model) {
    if (!model.distances) return null;
    const values = Float32Array.from(model.surface.source, (v) => model.distances[v]);
    return { values, low: 0, high: model.largest_distance || 1, ramp: "viridis", title: "distance to the other model" };
}
