// The picture: camera, section plane, exploded view, and one or two models side by side under the same camera.
import * as three from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { DrawnModel } from "./drawn_model.js";
import { pick } from "./pick.js";

const kAxes = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
const kFieldOfView = 30;

export class Stage extends EventTarget {
    constructor(canvas, models) {
        super();
        this.canvas = canvas;
        this.renderer = new three.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: false });
        this.renderer.outputColorSpace = three.LinearSRGBColorSpace;  // colours are written as they are read
        three.ColorManagement.enabled = false;
        this.renderer.autoClear = false;
        this.camera = new three.PerspectiveCamera(kFieldOfView, 1, 0.1, 1000);
        this.camera.up.set(0, 0, 1);
        this.shared = {
            plane: { value: new three.Vector4(0, 0, 1, 0) }, isCut: { value: false }, isFlat: { value: false },
            edges: { value: 0 }, explode: { value: 0 }, eye: { value: new three.Vector3() }, toClip: { value: new three.Matrix4() },
        };
        this.drawn = models.map((model) => new DrawnModel(model, this.shared));
        this.colouring = "region";
        this.frames = 0;
        this.controls = new OrbitControls(this.camera, canvas);
        this.controls.addEventListener("change", () => this.render());
        this.controls.zoomToCursor = true;
        this.setDirection([-0.65, -0.9, 0.5]);
        new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
        this.resize();
    }

    /** Half the diagonal of the largest model. */
    get radius() {
        return Math.max(...this.drawn.map(({ model }) => Math.hypot(...model.high.map((x, axis) => x - model.low[axis])) / 2), 1e-9);
    }

    resize() {
        const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
        if (!width || !height) return;
        this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
        this.renderer.setSize(width, height, false);
        this.camera.aspect = width / this.drawn.length / height;
        this.camera.updateProjectionMatrix();
        this.render();
    }

    render() {
        if (this.isWaiting) return;
        this.isWaiting = true;
        requestAnimationFrame(() => {
            this.isWaiting = false;
            this.renderNow();
        });
    }

    renderNow() {
        const { camera, renderer } = this, distance = camera.position.distanceTo(this.controls.target), radius = this.radius;
        camera.near = Math.max(distance - 4 * radius, distance / 200, radius / 2000);
        camera.far = distance + 4 * radius + this.shared.explode.value * 4 * radius;
        camera.updateProjectionMatrix();
        camera.updateMatrixWorld();
        this.shared.eye.value.copy(camera.position);
        this.shared.toClip.value.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
        const size = renderer.getSize(new three.Vector2()), width = size.x / this.drawn.length;
        renderer.setScissorTest(true);
        this.drawn.forEach((drawn, n) => {
            renderer.setViewport(n * width, 0, width, size.y);
            renderer.setScissor(n * width, 0, width, size.y);
            renderer.setClearColor(this.background ?? 0xffffff, 1);
            renderer.clear();
            renderer.render(drawn.scene, camera);
        });
        ++this.frames;
        this.dispatchEvent(new Event("drawn"));
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
        this.render();
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
        this.render();
    }

    zoom(factor) {
        const offset = this.camera.position.clone().sub(this.controls.target).multiplyScalar(factor);
        this.camera.position.copy(this.controls.target).add(offset);
        this.controls.update();
        this.render();
    }

    /** Moves the picture by shares of its height. */
    pan(right, up) {
        const length = 2 * Math.tan((kFieldOfView * Math.PI) / 360) * this.camera.position.distanceTo(this.controls.target);
        const [x, y] = [new three.Vector3(), new three.Vector3()];
        this.camera.matrix.extractBasis(x, y, new three.Vector3());
        const step = x.multiplyScalar(-right * length).addScaledVector(y, -up * length);
        this.camera.position.add(step);
        this.controls.target.add(step);
        this.controls.update();
        this.render();
    }

    /** The whole of what is shown, from the present direction. */
    fit(isShown) {
        const box = new three.Box3(), p = new three.Vector3();
        this.drawn.forEach((drawn, which) => {
            const { source, labels } = drawn.model.surface, { positions } = drawn.model, offsets = this.offsets?.[which];
            for (let v = 0; v < source.length; ++v) {
                if (isShown && !isShown[which][labels[2 * v]]) continue;
                p.fromArray(positions, 3 * source[v]);
                if (offsets) p.addScaledVector(new three.Vector3(...offsets[labels[2 * v]]), this.shared.explode.value);
                box.expandByPoint(p);
            }
        });
        if (box.isEmpty()) return;
        const radius = Math.max(box.getSize(p).length() / 2, this.radius / 1e4);
        const angle = (kFieldOfView * Math.PI) / 360, narrow = Math.min(1, this.camera.aspect);
        const direction = this.camera.position.clone().sub(this.controls.target).normalize();
        box.getCenter(this.controls.target);
        this.camera.position.copy(this.controls.target).addScaledVector(direction, (0.95 * radius) / Math.sin(Math.atan(Math.tan(angle) * narrow)));
        this.controls.update();
        this.render();
    }

    lookAt(place, radius) {
        const direction = this.camera.position.clone().sub(this.controls.target).normalize();
        this.controls.target.set(...place);
        this.camera.position.copy(this.controls.target).addScaledVector(direction, radius / Math.tan((kFieldOfView * Math.PI) / 360));
        this.controls.update();
        this.render();
    }

    /** Keeps the part below `share` of the extent along `axis`, or above it if `isTurned`; no axis: everything. */
    setSection(axis, share = 0.5, isTurned = false) {
        this.shared.isCut.value = axis in kAxes;
        if (axis in kAxes) {
            const { model } = this.drawn[0], n = Object.keys(kAxes).indexOf(axis);
            const height = (share - 0.5) * (model.high[n] - model.low[n]) * 1.0002, sign = isTurned ? -1 : 1;
            this.shared.plane.value.set(...kAxes[axis].map((x) => sign * x), sign * height);
            this.sectionPlace = model.centre[n] + height;
        }
        this.render();
    }

    /** Displacements of all labels of each model at 1. */
    setOffsets(offsets) {
        this.offsets = offsets;
        offsets.forEach((ofModel, which) => this.drawn[which].setOffsets(ofModel));
    }

    setExplode(share) {
        this.shared.explode.value = share;
        this.render();
    }

    colourBy(what) {
        this.colouring = what;
        const found = this.drawn.map((drawn) => drawn.colourBy(what, this.shared.edges.value > 0));
        this.render();
        return found[0] ?? found[1] ?? null;
    }

    showEdges(isShown) {
        this.shared.edges.value = isShown ? 1.1 : 0;
        this.colourBy(this.colouring);
    }

    showFlat(isShown) {
        this.shared.isFlat.value = isShown;
        this.render();
    }

    /** The face under a point of the window, and the model that it belongs to; or null. */
    pickAt(clientX, clientY, isShown) {
        const box = this.canvas.getBoundingClientRect(), width = box.width / this.drawn.length;
        const which = Math.min(Math.floor((clientX - box.left) / width), this.drawn.length - 1);
        const x = ((clientX - box.left - which * width) / width) * 2 - 1, y = 1 - ((clientY - box.top) / box.height) * 2;
        const from = this.camera.position, to = new three.Vector3(x, y, 0.5).unproject(this.camera).sub(from).normalize();
        const { plane, isCut, explode } = this.shared;
        const offsets = explode.value && this.offsets ? this.offsets[which].map((o) => o.map((x) => x * explode.value)) : null;
        const hit = pick(this.drawn[which], from.toArray(), to.toArray(),
            { offsets, isShown: isShown[which], plane: isCut.value ? plane.value.toArray() : null });
        return hit && { ...hit, which };
    }

    /** Calls `done` with a PNG. */
    screenshot(done) {
        this.renderNow();
        this.canvas.toBlob(done, "image/png");
    }
}
