// The panel on the right: the selected region or face, colours, section, exploded view, lines, violations.
import { byId, coordinate, counted, element, grouped, isolated, short } from "./dom.js";
import { faceQuality, interfaceMeasures } from "./measures.js";
import { farthestVertex, labelsAround, nearestVertex, outsideAt } from "./places.js";
import { kRamps } from "./ramps.js";
import { areaText, lengthText, volumeText } from "./units.js";

function group(title, ...children) {
    return element("fieldset", {}, element("legend", {}, title), ...children);
}

function choice(id, label, options, onchange) {
    const select = element("select", { id, onchange: () => onchange(select.value) },
        ...options.map(([value, text]) => element("option", { value }, text)));
    return element("label", { class: "field" }, label, select);
}

function slider(id, label, value, oninput) {
    const input = element("input", { id, type: "range", min: 0, max: 1, step: "any", value, oninput: () => oninput(Number(input.value)) });
    return element("label", { class: "field" }, label, input);
}

function toggle(id, label, onchange) {
    const input = element("input", { id, type: "checkbox", onchange: () => onchange(input.checked) });
    return element("label", { class: "toggle" }, input, label);
}

const extentOf = ({ low, high }) => Math.max(...high.map((x, axis) => x - low[axis]));

/** Coordinates of a place that is relative to the centre of the box. */
function placeText(model, at) {
    return at.map((x, axis) => coordinate(x + model.centre[axis], extentOf(model))).join(", ");
}

export class Tools {
    constructor(page) {
        Object.assign(this, page);  // stage, regions, models, fit, lookAt, measure, violations, violationCount, unitText, data
        this.info = element("div", { id: "info", role: "status", "aria-live": "polite" });
        byId("tools").append(
            group("Selected", this.info), this.measureGroup(), this.colourGroup(), this.sectionGroup(), this.shapeGroup(), this.lineGroup());
        this.sayStretch();
        if (this.violations.length > 0) {
            byId("tools").append(this.violationGroup());
            byId("violation-alone").checked = true;
        }
        this.describe(null);
        this.regions.addEventListener("change", () => {
            if (this.described !== this.regions.selected) this.describe(this.regions.selected);
        });
    }

    colourGroup() {
        const options = [["region", "Region"], ["interface", "Interface"], ["quality", "Quality"], ["curvature", "Curvature"]];
        if (this.models.some((model) => model.has_distances)) options.push(["distance", "Distance"]);
        return group("Colour", choice("colour-by", "By ", options, (what) => this.colourBy(what)),
            element("div", { id: "farthest", hidden: true },
                element("button", { type: "button", id: "go-farthest", onclick: () => this.goFarthest() }, "Go to the largest distance"),
                element("p", { id: "farthest-text", class: "hint", role: "status" })));
    }

    colourBy(what) {
        byId("colour-by").value = what;
        const found = this.stage.colourBy(what);
        byId("legend").hidden = !found;
        byId("farthest").hidden = what !== "distance";
        if (!found) return;
        byId("legend-title").textContent = found.title;
        byId("legend-low").textContent = short(found.low, 3);
        byId("legend-high").textContent = short(found.high, 3);
        byId("legend-bar").style.background = `linear-gradient(to right, ${kRamps[found.ramp].join(", ")})`;
    }

    /** Shows the vertex that is farthest from the other model, with a region that has it alone. */
    goFarthest() {
        const found = this.models.flatMap((model, which) => {
            if (!model.has_distances) return [];
            const vertex = farthestVertex(model);
            return [{ which, vertex, distance: model.distances[vertex] }];
        });
        const { which, vertex, distance } = found.reduce((a, b) => (b.distance > a.distance ? b : a));
        const model = this.models[which], at = [...model.positions.subarray(3 * vertex, 3 * vertex + 3)];
        const { label, normal } = outsideAt(model, vertex), drawn = this.stage.drawn[which];
        this.regions.showOnly(which, [label]);
        drawn.showMarkers([{ at, labels: [label] }]);
        this.stage.lookAt(drawn.moved(label, at), this.stage.radius / 5, normal);
        byId("farthest-text").textContent =
            `${lengthText(distance, this.data)} at a vertex of ${"AB"[which]}, ${placeText(model, at)}. Only ${isolated(this.regions.titleAt(which, label))} shown; the key A shows all.`;
    }

    sectionGroup() {
        const place = element("output", { id: "section-place" });
        const update = () => {
            const axis = byId("section-axis").value;
            this.stage.setSection(axis, Number(byId("section-share").value), byId("section-turn").checked);
            place.textContent = axis === "none" ? "" : `${axis} = ${coordinate(this.stage.sectionPlace, extentOf(this.models[0]))}`;
        };
        const chooseAxis = (axis) => {
            if (axis !== "none") byId("section-turn").checked = this.stage.looksFromBelow(axis);
            update();
        };
        this.updateSection = update;
        this.setSection = (axis) => {
            byId("section-axis").value = axis;
            chooseAxis(axis);
        };
        return group("Section",
            choice("section-axis", "Across ", [["none", "no axis"], ["x", "x"], ["y", "y"], ["z", "z"]], chooseAxis),
            slider("section-share", "Place ", 0.5, () => {
                if (byId("section-axis").value === "none") this.setSection("x");
                else update();
            }),
            toggle("section-turn", "Keep the other side", update), place);
    }

    measureGroup() {
        return group("Measure", toggle("measure", "Click points on surfaces (M)", (isOn) => this.measure.turn(isOn)),
            element("p", { id: "measure-text", class: "hint", role: "status" }));
    }

    /** A picture that is not to scale says so. */
    sayStretch() {
        const factor = this.stage.shared.stretch.value;
        byId("stretched").hidden = factor === 1;
        byId("stretched").textContent = `Height × ${short(factor)}: not to scale`;
    }

    shapeGroup() {
        const height = element("input", {
            id: "stretch", type: "number", min: "0.1", max: "1000", step: "any", value: this.stage.shared.stretch.value,
            onchange: () => this.stretch(Math.min(Math.max(Number(height.value) || 1, Number(height.min)), Number(height.max))),
        });
        return group("Shape", slider("explode", "Explode ", 0, (share) => this.explode(share)),
            element("label", { class: "field", title: "For flat models, such as strata" }, "Height × ", height));
    }

    explode(share) {
        byId("explode").value = share;
        if (!this.stage.offsets) this.stage.setOffsets(this.models.map((_, which) => this.regions.offsets(which)));
        this.stage.setExplode(share);
        this.measure.clear();
        this.showLines();
    }

    stretch(factor) {
        byId("stretch").value = factor;
        this.stage.setStretch(factor);
        this.sayStretch();
        this.measure.clear();
        this.updateSection();
        this.fit();
    }

    lineGroup() {
        return group("Show",
            toggle("show-edges", "Edges of faces (E)", (isOn) => this.stage.showEdges(isOn)),
            toggle("show-flat", "Flat faces (L)", (isOn) => this.stage.showFlat(isOn)),
            toggle("show-lines", "Lines where three regions meet (T)", () => this.showLines()),
            toggle("show-points", "Points where four regions meet (Q)", () => this.showLines()),
            element("p", { id: "line-counts", class: "hint", role: "status" }));
    }

    /** Lines stay where they are in an exploded view, so they are not drawn there. */
    showLines() {
        const isWhole = this.stage.shared.explode.value === 0;
        const [lines, points] = [byId("show-lines").checked, byId("show-points").checked];
        for (const drawn of this.stage.drawn) {
            drawn.showLines(lines && isWhole);
            drawn.showPoints(points && isWhole);
        }
        const counts = this.stage.drawn.filter((drawn) => drawn.lineParts)
            .map(({ lineParts }) => `${counted(lineParts.edgeCount, "edge")} on lines, ${counted(lineParts.pointCount, "point")}`);
        byId("line-counts").textContent = lines || points ? (isWhole ? counts.join("; ") : "not drawn in an exploded view") : "";
        this.stage.render();
    }

    violationGroup() {
        const text = element("p", { id: "violation", role: "status" });
        const step = (by) => {
            const { violations } = this, count = violations.length;
            this.violation = ((this.violation ?? (by > 0 ? -1 : 0)) + by + count) % count;
            const found = violations[this.violation];
            const all = this.violationCount > count ? ` that are listed, ${grouped(this.violationCount)} in all` : "";
            text.textContent = `${this.violation + 1} of ${grouped(count)}${all}: ${found.text}`;
            if (found.at) this.goToViolation(found.at);
        };
        this.stepViolation = step;
        this.stage.drawn[0].showMarkers(this.marks());
        return group("Violations",
            element("div", { class: "buttons" },
                element("button", { type: "button", id: "violation-back", onclick: () => step(-1) }, "Previous"),
                element("button", { type: "button", id: "violation-next", onclick: () => step(1) }, "Next (V)")),
            toggle("violation-alone", "Only the regions at its place", (isOn) => !isOn && this.regions.setState(this.regions.all, "solid")), text);
    }

    /** The places of violations, and the regions that each names. */
    marks() {
        const [model] = this.models, placeOf = new Map(model.labels.map(({ label, background }, place) => [label, background ? undefined : place]));
        return this.violations.filter(({ at }) => at).map(({ at, labels = [] }) => ({
            at: at.map((x, axis) => x - model.centre[axis]),
            labels: labels.map((label) => placeOf.get(label)).filter((place) => place !== undefined),
        }));
    }

    /** Other regions would hide it, and without edges a missing face is hard to see. */
    goToViolation(at) {
        const [drawn] = this.stage.drawn, { model } = drawn, place = at.map((x, axis) => x - model.centre[axis]);
        const vertex = nearestVertex(model, place), { label, normal } = outsideAt(model, vertex);
        if (byId("violation-alone").checked) this.regions.showOnly(0, labelsAround(model, vertex));
        if (!byId("show-edges").checked) byId("show-edges").click();
        this.stage.lookAt(drawn.moved(label, place), this.stage.radius / 8, normal);
    }

    /** Shows a region, or the face of a hit. */
    describe(region, hit = null) {
        this.described = region;
        const rows = [];
        if (region) {
            const which = hit?.which ?? region.first, measures = this.regions.measures[which][region.places[which]];
            const title = this.models.length > 1 ? `${region.title}, in ${"AB"[which]}` : region.title;
            rows.push(["Region", title], ["Label", region.label], ["Volume", volumeText(measures.volume, this.data)],
                ["Area", areaText(measures.area, this.data)], ["Faces", grouped(measures.faces)], ["Neighbours", this.neighbourText(which, measures)]);
        }
        if (hit) rows.push(...this.faceRows(hit));
        if (rows.length === 0) {
            this.info.replaceChildren(element("p", { class: "hint" }, "Click a face, or a name in the list."));
            return;
        }
        const list = element("dl", {}, ...rows.flatMap(([name, text]) => [element("dt", {}, name), element("dd", {}, text)]));
        const act = (text, run) => element("button", { type: "button", onclick: run }, text);
        this.info.replaceChildren(list, element("div", { class: "buttons" },
            act("Isolate (I)", () => this.regions.isolate(region)), act("Hide (H)", () => this.regions.setState([region], "hidden")),
            act("Look at it (O)", () => this.lookAt(region)),
            act("See through (G)", () => this.regions.setState([region], region.state === "ghost" ? "solid" : "ghost"))),
            element("p", { class: "hint" }, this.unitText));
    }

    neighbourText(which, { neighbours }) {
        const names = [...neighbours].map((place) => isolated(this.regions.titleAt(which, place)));
        return names.length > 6 ? `${names.slice(0, 6).join(", ")} and ${names.length - 6} more` : names.join(", ");
    }

    faceRows({ which, face, isCap, at }) {
        const { model } = this.stage.drawn[which], place = placeText(model, at);
        if (isCap) return [["Place", place]];
        const f = model.surface.faceOf[face], pair = model.geometry.pairOfFace[f], found = interfaceMeasures(model, pair);
        const names = model.pairs[pair].slice(0, 2).map((label) => isolated(this.regions.titleAt(which, label)));
        const quality = faceQuality(model.positions, ...model.geometry.corners.subarray(3 * f, 3 * f + 3));
        return [["Interface", `${names[0]} | ${names[1]}`], ["Its area", areaText(found.area, this.data)], ["Its faces", grouped(found.faces)],
            ["Quality of the face", short(quality, 3)], ["Place", place]];
    }
}
