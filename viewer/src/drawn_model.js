// One model as three.js objects. Regions are hidden, coloured and moved by two small textures, so that a change costs
// the same for ten regions and for ten thousand.
import * as three from "three";
import { overlayFragment, overlayVertex, surfaceFragment, surfaceVertex } from "./shaders.js";
import { coarsened, Level, separated } from "./levels.js";
import { linesOf } from "./measures.js";
import { rampTexture } from "./ramps.js";
import { curvatures, faceValues, quantile } from "./values.js";

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
    object.material.stencilWrite = true;  // only tests it
    object.material.stencilFunc = three.EqualStencilFunc;
    object.renderOrder = 2;
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
        this.levels = { fine: new Level(this.fineArrays()) };
        this.level = "fine";
        this.isSolid = [];
        this.isShown = [];
        this.passes = [this.addPass(three.FrontSide, false), this.addPass(three.BackSide, false), this.addPass(three.FrontSide, true)];
        this.values = new Map();
    }

    fineArrays() {
        const { surface, positions } = this.model;
        const places = new Float32Array(3 * surface.vertices);
        for (let v = 0; v < surface.vertices; ++v)
            for (let k = 0; k < 3; ++k) places[3 * v + k] = positions[3 * surface.source[v] + k];
        this.places = places;
        return { places, normals: surface.normals, labels: surface.labels, corners: surface.corners };
    }

    /** Made when it is first needed: "fine", "separate" (three vertices a face) or "coarse" (at most `faces` faces). */
    levelOf(name, faces) {
        if (this.levels[name]) return this.levels[name];
        const { fine } = this.levels, arrays = { ...fine, normals: this.model.surface.normals };
        const size = Math.max(...this.model.high.map((x, axis) => x - this.model.low[axis]));
        const made = new Level(name === "separate" ? separated(arrays) : coarsened(arrays, size, faces));
        made.setOuter(this.isSolid);
        return (this.levels[name] = made);
    }

    /** Draws this level. In an exploded view all faces can be seen; else the inner ones only by their back, in a section. */
    useLevel(name, faces) {
        this.level = name;
        const { full, outer } = this.levelOf(name, faces);
        const front = this.shared.explode.value > 0 ? full : outer;
        this.passes.forEach((pass, n) => (pass.geometry = n === 1 ? full : front));
    }

    addPass(side, isGhost) {
        const isInside = side === three.BackSide;
        const material = new three.ShaderMaterial({
            glslVersion: three.GLSL3, vertexShader: surfaceVertex, fragmentShader: surfaceFragment, side,
            transparent: isGhost, depthWrite: !isGhost, polygonOffset: isInside, defines: isInside ? { INSIDE: 1 } : {},
            uniforms: { ...this.uniforms, isGhost: { value: isGhost }, wantedState: { value: isGhost ? 0.5 : 1 } },
        });
        // A section is marked in the stencil: lines behind it are not drawn over it.
        material.stencilWrite = isInside;
        material.stencilRef = 1;
        material.stencilZPass = three.ReplaceStencilOp;
        const mesh = new three.Mesh(this.levels.fine.full, material);
        mesh.frustumCulled = false;
        mesh.renderOrder = isGhost ? 3 : isInside ? 1 : 0;
        this.scene.add(mesh);
        return mesh;
    }

    /** With a section, faces seen from inside win over those of neighbours at the same place; else they lose. */
    setCut(isCut) {
        for (const { material } of this.passes) {
            if (isCut) material.defines.CUT = 1;
            else delete material.defines.CUT;
            material.polygonOffsetUnits = isCut ? -8 : 8;
            material.needsUpdate = true;
        }
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
        this.isShown = [...regions.map(({ state }) => state !== "hidden"), false];
        this.isSolid = [...regions.map(({ state }) => state === "solid"), false];
        for (const level of Object.values(this.levels)) level.setOuter(this.isSolid);
        this.useLevel(this.level);
        this.hideLines();
        this.placeMarkers();
    }

    /** Displacements of labels for the exploded view at 1. */
    setOffsets(offsets) {
        offsets.forEach((offset, label) => this.offsets.image.data.set(offset, 4 * label));
        this.offsets.needsUpdate = true;
    }

    /** Returns the values with their range, or null where regions or interfaces have colours. */
    colourBy(what, showsEdges) {
        const isFaceValue = what === "quality";
        this.useLevel(isFaceValue || showsEdges ? "separate" : "fine");
        const { mode, range, ramp } = this.uniforms;
        mode.value = what === "region" ? 0 : what === "interface" ? 1 : 2;
        if (mode.value < 2) return null;
        const found = this.valuesOf(what);
        if (!found) {
            mode.value = 0;
            return null;
        }
        this.fillValues(found.values, isFaceValue);
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

    fillValues(values, isFaceValue) {
        const attribute = this.levels[this.level].full.getAttribute("value"), to = attribute.array, { corners } = this.model.surface;
        if (isFaceValue) for (let n = 0; n < to.length; ++n) to[n] = values[(n / 3) | 0];
        else if (this.level === "fine") to.set(values);
        else for (let n = 0; n < to.length; ++n) to[n] = values[corners[n]];
        attribute.needsUpdate = true;
    }

    showLines(isShown) { this.showOverlay("lines", isShown, () => this.lineObjects().lines); }
    showPoints(isShown) { this.showOverlay("points", isShown, () => this.lineObjects().points); }

    lineObjects() {
        if (this.lineParts) return this.lineParts;
        const { edges, points } = linesOf(this.model), { positions } = this.model;
        const at = (found) => {
            const places = new Float32Array(found.flatMap((one) => one.at.flatMap((v) => [...positions.subarray(3 * v, 3 * v + 3)])));
            return new three.BufferGeometry().setAttribute("position", new three.BufferAttribute(places, 3));
        };
        this.lineParts = {
            edges,
            lines: overlay(new three.LineSegments(at(edges)), this.shared, "#111111", 1),
            points: overlay(new three.Points(at(points)), this.shared, "#d00000", 9),
            edgeCount: edges.length, pointCount: points.length, labelsOfPoints: points.map(({ labels }) => labels),
        };
        this.hideLines();
        return this.lineParts;
    }

    /** Leaves out lines and points of hidden regions only. */
    hideLines() {
        if (!this.lineParts) return;
        const { edges, labelsOfPoints, lines, points } = this.lineParts;
        const isShown = (labels) => labels.some((label) => this.isShown[label]);
        const index = (object, numbers) => object.geometry.setIndex(new three.BufferAttribute(Uint32Array.from(numbers), 1));
        index(lines, edges.flatMap(({ labels }, n) => (isShown(labels) ? [2 * n, 2 * n + 1] : [])));
        index(points, labelsOfPoints.flatMap((labels, n) => (isShown(labels) ? [n] : [])));
    }

    showOverlay(name, isShown, make) {
        if (!isShown && !this[name]) return;
        if (!this[name]) this.scene.add((this[name] = make()));
        this[name].visible = isShown;
    }

    /** Markers, each { at: place relative to the centre of the box, labels: of the regions that it belongs to }. */
    showMarkers(marks) {
        this.marks = marks;
        if (!this.markers) {
            this.markers = overlay(new three.Points(), this.shared, "#ff2020", 14);
            this.markers.material.depthTest = this.markers.material.stencilWrite = false;
            this.markers.renderOrder = 9;
            this.scene.add(this.markers);
        }
        this.placeMarkers();
    }

    /** In an exploded view a marker goes along with each of its regions, and is hidden with it. */
    placeMarkers() {
        if (!this.markers) return;
        const isWhole = this.shared.explode.value === 0;
        const places = this.marks.flatMap(({ at, labels }) =>
            isWhole || labels.length === 0 ? [at] : labels.filter((label) => this.isShown[label]).map((label) => this.moved(label, at)));
        this.markers.geometry.dispose();
        this.markers.geometry = new three.BufferGeometry();
        this.markers.geometry.setAttribute("position", new three.BufferAttribute(Float32Array.from(places.flat()), 3));
    }

    /** A place on a region, as the exploded view displaces it. */
    moved(label, at) {
        const { data } = this.offsets.image;
        return at.map((x, axis) => x + this.shared.explode.value * data[4 * label + axis]);
    }
}

function distances(model) {
    if (!model.distances) return null;
    const values = Float32Array.from(model.surface.source, (v) => model.distances[v]);
    return { values, low: 0, high: quantile(values, 0.99) || model.largest_distance || 1, ramp: "viridis", title: "distance to the other model; the largest 1 % have one colour" };
}
