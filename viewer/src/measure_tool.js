// Distances and angles between points that are clicked on surfaces.
import * as three from "three";
import { byId, short } from "./dom.js";
import { lengthText } from "./units.js";

const minus = (a, b) => a.map((x, axis) => x - b[axis]);
const dot = (a, b) => a.reduce((sum, x, axis) => sum + x * b[axis], 0);

/** In degrees, at the second of three points. */
export function angleAt([a, b, c]) {
    const u = minus(a, b), v = minus(c, b), size = Math.hypot(...u) * Math.hypot(...v);
    return size > 0 ? (Math.acos(Math.min(1, Math.max(-1, dot(u, v) / size))) * 180) / Math.PI : 0;
}

export class MeasureTool {
    constructor(stage, data) {
        Object.assign(this, { stage, data, hits: [], isOn: false });
        stage.addEventListener("drawn", () => this.draw());
    }

    turn(isOn) {
        this.isOn = isOn;
        byId("measure").checked = isOn;
        this.stage.canvas.classList.toggle("measuring", isOn);
        this.clear();
    }

    clear() {
        this.hits = [];
        this.show();
    }

    /** A third point makes an angle; the next one begins again, as does one in the other model. */
    add(hit) {
        if (!hit) return;
        if (this.hits.length === 3 || (this.hits.length > 0 && this.hits[0].which !== hit.which)) this.hits = [];
        this.hits.push(hit);
        this.show();
    }

    get text() {
        const places = this.hits.map(({ at }) => at), length = (a, b) => lengthText(Math.hypot(...minus(a, b)), this.data);
        if (!this.isOn) return "";
        if (places.length === 0) return "Click two points for a distance, three for an angle.";
        if (places.length === 1) return "One point: click another.";
        if (places.length === 2) return `Distance ${length(...places)}. A third point gives an angle.`;
        return `Angle ${short(angleAt(places), 3)}°, between ${length(places[0], places[1])} and ${length(places[1], places[2])}.`;
    }

    show() {
        byId("measure-text").textContent = this.text;
        this.stage.render();
    }

    draw() {
        const { stage } = this, width = stage.canvas.clientWidth / stage.drawn.length, height = stage.canvas.clientHeight, p = new three.Vector3();
        const points = this.hits.map(({ seen, which }) => {
            const [x, y, z] = stage.stretched(seen);
            p.set(x, y, z).project(stage.camera);
            return [which * width + ((p.x + 1) / 2) * width, ((1 - p.y) / 2) * height].map((pixel) => pixel.toFixed(1)).join();
        });
        byId("measure-line").setAttribute("points", points.join(" "));
    }
}
