// The picture: camera, section plane, exploded view, and one or two models side by side under the same camera.
import * as three from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { DrawnModel } from "./drawn_model.js";
import { pick } from "./pick.js";

const kAxes = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
const kFieldOfView = 30;
const kSlow = 60;  // milliseconds a frame
const kRest = 250;  // milliseconds after the last move

/** 1, or what brings the height of flat strata to a quarter of their width: 1, 2 or 5 times 10^n. */
function flatnessOf(models) {
    const [x, y, z] = [0, 1, 2].map((axis) => Math.max(...models.map(({ low, high }) => high[axis] - low[axis])));
    if (!(z > 0) || 5 * z > Math.max(x, y)) return 1;
    const wanted = Math.max(x, y) / z / 4, power = 10 ** Math.floor(Math.log10(wanted));
    return [5, 2, 1].find((digit) => digit * power <= wanted) * power;
}

export class Stage extends EventTarget {
    /** The models lie in `box`, and are relative to its centre. `areStrata`: flat ones are shown higher than they are. */
    constructor(canvas, models, box, areStrata) {
        super();
        this.canvas = canvas;
        this.box = box;
        this.renderer = new three.WebGLRenderer({ canvas, antialias: true, stencil: true });
        this.renderer.outputColorSpace = three.LinearSRGBColorSpace;  // colours are written as they are read
        three.ColorManagement.enabled = false;
        this.renderer.autoClear = false;
        this.camera = new three.PerspectiveCamera(kFieldOfView, 1, 0.1, 1000);
        this.camera.up.set(0, 0, 1);
        this.shared = {
            plane: { value: new three.Vector4(0, 0, 1, 0) }, isCut: { value: false }, isFlat: { value: false },
            edges: { value: 0 }, explode: { value: 0 }, eye: { value: new three.Vector3() }, isOutside: { value: true }, stretch: { value: 1 },
        };
        this.shared.stretch.value = areStrata ? flatnessOf(models) : 1;
        this.drawn = models.map((model) => new DrawnModel(model, this.shared));
        this.colouring = "region";
        this.frames = 0;
        this.frameTime = 0;
        this.isCoarse = false;
        this.controls = new OrbitControls(this.camera, canvas);
        this.controls.addEventListener("change", () => this.moved());
        this.controls.zoomToCursor = true;
        this.setDirection([-0.65, -0.9, 0.5]);
        new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
        this.resize();
    }

    /** Half the diagonal of the box. */
    get radius() {
        const size = this.box.high.map((x, axis) => x - this.box.low[axis]);
        return Math.max(Math.hypot(...this.stretched(size)) / 2, 1e-9);
    }

    /** Half the height of what the camera sees at a distance of 1. */
    get halfHeight() { return Math.tan((kFieldOfView * Math.PI) / 360) / this.camera.zoom; }

    /** A place relative to the centre of the box, as it is in the picture; and back. */
    stretched([x, y, z]) { return [x, y, z * this.shared.stretch.value]; }
    unstretched([x, y, z]) { return [x, y, z / this.shared.stretch.value]; }

    setStretch(factor) {
        this.shared.stretch.value = factor;
        this.render();
    }

    resize() {
        const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
        if (!width || !height) return;
        this.renderer.setPixelRatio(this.pixelRatio);
        this.renderer.setSize(width, height, false);
        this.camera.aspect = width / this.drawn.length / height;
        // A narrower picture shows as much from side to side as the one that the model was fitted to.
        this.camera.zoom = this.fittedAspect ? Math.min(1, this.camera.aspect / this.fittedAspect) : 1;
        this.camera.updateProjectionMatrix();
        this.render();
    }

    /** While the camera moves on a slow machine, a coarse stand-in is drawn; the whole follows when it rests. */
    moved() {
        const canBeCoarse = this.drawn.every(({ level, uniforms }) => level === "fine" && uniforms.mode.value < 2);
        if (this.frameTime > kSlow && canBeCoarse) this.setCoarse(true);
        if (this.isCoarse) {
            clearTimeout(this.resting);
            this.resting = setTimeout(() => this.setCoarse(false), kRest);
        }
        this.render();
    }

    setCoarse(isCoarse) {
        clearTimeout(this.resting);
        this.isCoarse = isCoarse;
        const most = Math.max(5000, (this.faceCount * kSlow) / this.frameTime / 2);
        for (const drawn of this.drawn) drawn.useLevel(isCoarse ? "coarse" : "fine", most);
        this.renderer.setPixelRatio(this.pixelRatio * (isCoarse ? 0.5 : 1));
        this.render();
    }

    get pixelRatio() { return Math.min(window.devicePixelRatio || 1, 2); }

    get faceCount() { return this.drawn.reduce((sum, { model }) => sum + model.surface.faces, 0); }

    render() {
        if (this.isWaiting) return;  // one picture a frame
        this.isWaiting = true;
        requestAnimationFrame(() => {
            this.isWaiting = false;
            this.renderNow();
        });
    }

    renderNow() {
        const { camera, renderer } = this, radius = this.radius * (1 + 1.3 * this.shared.explode.value);
        const distance = camera.position.length();  // from the centre of the box
        camera.near = Math.max(distance - radius, radius / 1000);
        camera.far = distance + radius;
        camera.updateProjectionMatrix();
        camera.updateMatrixWorld();
        this.shared.eye.value.copy(camera.position);
        // From outside a closed region only its front is seen.
        this.shared.isOutside.value = !this.isOpen && distance >= radius;
        const showsInside = this.shared.isCut.value || !this.shared.isOutside.value;
        for (const drawn of this.drawn) drawn.passes[1].visible = showsInside;
        const size = renderer.getSize(new three.Vector2()), width = size.x / this.drawn.length;
        renderer.setScissorTest(true);
        const begin = performance.now();
        this.drawn.forEach((drawn, n) => {
            renderer.setViewport(n * width, 0, width, size.y);
            renderer.setScissor(n * width, 0, width, size.y);
            renderer.setClearColor(this.background ?? 0xffffff, 1);
            renderer.clear();
            renderer.render(drawn.scene, camera);
        });
        ++this.frames;
        this.measure(begin);
        this.dispatchEvent(new Event("drawn"));
    }

    /** Keeps the time until a whole frame is complete; the first frame also compiles, and does not count. */
    measure(begin) {
        const gl = this.renderer.getContext();
        if (gl.isContextLost()) return;
        const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
        gl.flush();
        const isWhole = this.frames > 1 && !this.isCoarse;
        const poll = () => {
            if (gl.clientWaitSync(fence, 0, 0) === gl.TIMEOUT_EXPIRED) return void setTimeout(poll, 4);
            gl.deleteSync(fence);
            if (isWhole) this.frameTime = performance.now() - begin;
        };
        setTimeout(poll, 0);
    }

    setBackground(colour) {
        this.background = new three.Color(colour).getHex();
        this.render();
    }

    /** Looks along the opposite of `direction`, from outside. */
    setDirection(direction) {
        const distance = this.camera.position.distanceTo(this.controls.target) || 1;
        this.camera.position.copy(this.controls.target).addScaledVector(new three.Vector3(...direction).normalize(), distance);
        this.controls.update();
        this.moved();
    }

    /** Turns by angles around the vertical axis and towards it. */
    turn(around, towards) {
        const offset = this.camera.position.clone().sub(this.controls.target);
        const place = new three.Spherical().setFromVector3(new three.Vector3(offset.x, offset.z, -offset.y));
        place.theta += around;
        place.phi = Math.min(Math.max(place.phi + towards, 0.01), Math.PI - 0.01);
        const made = new three.Vector3().setFromSpherical(place);
        this.camera.position.copy(this.controls.target).add(new three.Vector3(made.x, -made.z, made.y));
        this.controls.update();
        this.moved();
    }

    zoom(factor) {
        const offset = this.camera.position.clone().sub(this.controls.target).multiplyScalar(factor);
        this.camera.position.copy(this.controls.target).add(offset);
        this.controls.update();
        this.moved();
    }

    /** Moves the picture by shares of its height. */
    pan(right, up) {
        const length = 2 * this.halfHeight * this.camera.position.distanceTo(this.controls.target);
        const [x, y] = [new three.Vector3(), new three.Vector3()];
        this.camera.matrix.extractBasis(x, y, new three.Vector3());
        const step = x.multiplyScalar(-right * length).addScaledVector(y, -up * length);
        this.camera.position.add(step);
        this.controls.target.add(step);
        this.controls.update();
        this.moved();
    }

    /** The places of all vertices that are shown, in the picture. */
    forShown(isShown, visit) {
        const explode = this.shared.explode.value, stretch = this.shared.stretch.value;
        this.drawn.forEach(({ model }, which) => {
            const { source, labels } = model.surface, { positions } = model, offsets = explode ? this.offsets[which] : null;
            for (let v = 0; v < source.length; ++v) {
                const label = labels[2 * v], at = 3 * source[v], offset = offsets?.[label];
                if (isShown && !isShown[which][label]) continue;
                const [x, y, z] = offset ?? [0, 0, 0];
                visit(positions[at] + explode * x, positions[at + 1] + explode * y, stretch * (positions[at + 2] + explode * z));
            }
        });
    }

    /** The whole of what is shown, from the present direction. */
    fit(isShown) {
        const box = new three.Box3(), p = new three.Vector3();
        this.forShown(isShown, (x, y, z) => box.expandByPoint(p.set(x, y, z)));
        if (box.isEmpty()) return;
        const { target } = this.controls, back = this.camera.position.clone().sub(target).normalize();
        box.getCenter(target);
        const right = new three.Vector3().crossVectors(this.camera.up, back).normalize();
        const up = new three.Vector3().crossVectors(back, right);
        this.fittedAspect = this.camera.aspect;
        this.camera.zoom = 1;
        const tall = this.halfHeight * 0.92, wide = tall * this.camera.aspect;
        let distance = this.radius / 1e4;
        this.forShown(isShown, (x, y, z) => {
            p.set(x, y, z).sub(target);
            distance = Math.max(distance, p.dot(back) + Math.max(Math.abs(p.dot(right)) / wide, Math.abs(p.dot(up)) / tall));
        });
        this.camera.position.copy(target).addScaledVector(back, distance);
        this.controls.update();
        this.moved();
    }

    /** `place`: relative to the centre of the box; `from`: direction of the eye, or null for the present one. */
    lookAt(place, radius, from = null) {
        const direction = from ? new three.Vector3(...from) : this.camera.position.clone().sub(this.controls.target);
        direction.normalize();
        this.controls.target.set(...this.stretched(place));
        this.camera.position.copy(this.controls.target).addScaledVector(direction, radius / (this.halfHeight * Math.min(1, this.camera.aspect)));
        this.controls.update();
        this.moved();
    }

    /** Keeps the part below `share` of the extent along `axis`, or above it if `isTurned`; no axis: everything. */
    setSection(axis, share = 0.5, isTurned = false) {
        if (this.shared.isCut.value !== (axis in kAxes)) for (const drawn of this.drawn) drawn.setCut(axis in kAxes);
        this.shared.isCut.value = axis in kAxes;
        if (axis in kAxes) {
            const { low, high, centre } = this.box, n = Object.keys(kAxes).indexOf(axis);
            const height = (share - 0.5) * (high[n] - low[n]) * 1.0002, sign = isTurned ? -1 : 1;
            const shown = axis === "z" ? height * this.shared.stretch.value : height;
            this.shared.plane.value.set(...kAxes[axis].map((x) => sign * x), sign * shown);
            this.sectionPlace = centre[n] + height;
        }
        this.render();
    }

    /** Is the camera on the low side of the centre? Then the upper part of a section shows its cut. */
    looksFromBelow(axis) { return this.camera.position[axis] < this.controls.target[axis]; }

    /** Displacements of all labels of each model at 1. */
    setOffsets(offsets) {
        this.offsets = offsets;
        offsets.forEach((ofModel, which) => this.drawn[which].setOffsets(ofModel));
    }

    setExplode(share) {
        this.shared.explode.value = share;
        for (const drawn of this.drawn) {
            drawn.useLevel(drawn.level);
            drawn.placeMarkers();
        }
        this.render();
    }

    colourBy(what) {
        this.colouring = what;
        if (this.isCoarse) this.setCoarse(false);
        const found = this.drawn.map((drawn) => drawn.colourBy(what, this.shared.edges.value > 0)).filter(Boolean);
        this.render();
        if (found.length === 0) return null;
        const low = Math.min(...found.map((one) => one.low)), high = Math.max(...found.map((one) => one.high));
        for (const drawn of this.drawn) drawn.uniforms.range.value.set(low, high);
        return { ...found[0], low, high };
    }

    showEdges(isShown) {
        this.shared.edges.value = isShown ? 1.1 : 0;
        this.colourBy(this.colouring);
    }

    showFlat(isShown) {
        this.shared.isFlat.value = isShown;
        this.render();
    }

    /** The face under a point of the window as pick() gives it, and `which` model it belongs to; or null. */
    pickAt(clientX, clientY) {
        const box = this.canvas.getBoundingClientRect(), width = box.width / this.drawn.length;
        const which = Math.min(Math.floor((clientX - box.left) / width), this.drawn.length - 1);
        const x = ((clientX - box.left - which * width) / width) * 2 - 1, y = 1 - ((clientY - box.top) / box.height) * 2;
        const from = this.camera.position, to = new three.Vector3(x, y, 0.5).unproject(this.camera).sub(from).normalize();
        const { plane, isCut, explode, stretch, isOutside } = this.shared, [a, b, c, d] = plane.value.toArray();
        const offsets = explode.value && this.offsets ? this.offsets[which].map((o) => o.map((x) => x * explode.value)) : null;
        const hit = pick(this.drawn[which], this.unstretched(from.toArray()), this.unstretched(to.toArray()),
            { offsets, plane: isCut.value ? [a, b, c * stretch.value, d] : null, showsInside: !isOutside.value });
        return hit && { ...hit, which };
    }

    /** Calls `done` with a PNG. */
    screenshot(done) {
        this.renderWhole();
        this.canvas.toBlob(done, "image/png");
    }

    /** The picture as it would be now, as a canvas of its own. */
    copied() {
        this.renderWhole();
        const copy = document.createElement("canvas");
        [copy.width, copy.height] = [this.canvas.width, this.canvas.height];
        copy.getContext("2d").drawImage(this.canvas, 0, 0);
        return copy;
    }

    renderWhole() {
        if (this.isCoarse) this.setCoarse(false);
        this.renderNow();
    }
}
