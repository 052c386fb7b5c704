// Puts the page together.
import { byId, counted, download, element, grouped } from "./dom.js";
import { boxOf, loadModel } from "./geometry.js";
import { addKeys } from "./keys.js";
import { MeasureTool } from "./measure_tool.js";
import { addOrientation } from "./orientation.js";
import { showProof } from "./proof.js";
import { addScaleBar } from "./scale_bar.js";
import { RegionList } from "./region_list.js";
import { Regions } from "./regions.js";
import { Stage } from "./stage.js";
import { showTable } from "./table.js";
import { addTheme } from "./theme.js";
import { Tools } from "./tools.js";
import { unitText } from "./units.js";

/** In RAS the front of a patient is at y; elsewhere, and in LPS, at -y. */
const viewsOf = (space) => {
    const front = space === "RAS" ? 1 : -1;
    return { front: [0, front, 0.0001], side: [1, 0, 0.0001], top: [0, 0.0001 * front, 1], first: [0.65 * front, 0.9 * front, 0.5] };
};

function say(text) {
    byId("notice").textContent = text;
    byId("notice").hidden = false;
}

function hasWebGl() {
    try {
        return Boolean(document.createElement("canvas").getContext("webgl2"));
    } catch {
        return false;
    }
}

function showHead(data, models) {
    byId("title").textContent = models.map(({ title }) => title).join(" and ");
    const texts = models.map((model) => {
        const regions = model.labels.filter(({ background }) => !background).length;
        const preview = model.shown_faces < model.faces
            ? ` (picture, list and selection show a preview with ${counted(model.shown_faces, "face")}; proof and table are of the whole model)` : "";
        return `${counted(model.faces, "face")}, ${counted(model.vertices, "vertex", "vertices")}, ${counted(regions, "region")}${preview}`;
    });
    byId("summary").textContent = texts.join("; ");
    if (models.length > 1)
        byId("names").append(...models.map(({ title }, n) => element("span", {}, `${"AB"[n]}  ${title}`)));
}

function actions(stage, regions, title, space) {
    const views = viewsOf(space);
    const shown = () => stage.drawn.map((_, which) => regions.shown(which));
    const view = (direction) => () => {
        stage.setDirection(direction);
        stage.fit(shown());
    };
    return {
        look: (direction) => view(direction)(),
        fit: () => stage.fit(shown()),
        front: view(views.front), side: view(views.side), top: view(views.top), first: view(views.first),
        screenshot: () => stage.screenshot((blob) => download(`${title.replace(/[^\w.-]+/g, "_")}.png`, "image/png", blob)),
        keys: () => byId("keys").showModal(),
    };
}

/** A click is a press without a move; it selects a region and describes the face. */
function addPicking(stage, regions, tools, list) {
    let press = null;
    const hitOf = (event) => stage.pickAt(event.clientX, event.clientY);
    stage.canvas.addEventListener("pointerdown", (event) => (press = [event.clientX, event.clientY, event.button]));
    stage.canvas.addEventListener("pointerup", (event) => {
        if (!press || press[2] !== 0 || Math.hypot(event.clientX - press[0], event.clientY - press[1]) > 4) return;
        const hit = hitOf(event);
        if (tools.measure.isOn) return tools.measure.add(hit);
        const region = hit ? regions.at(hit.which, hit.label) : null;
        tools.describe(region, hit);
        regions.select(region);
        if (region) list.reveal(region);
    });
    stage.canvas.addEventListener("dblclick", (event) => {
        const hit = hitOf(event);
        if (hit) stage.lookAt(hit.seen, stage.radius / 6);
    });
}

/** The model fills the window below the head, which is as high as its texts need. */
function fillWindow() {
    const head = document.querySelector("header"), { style } = byId("model");
    new ResizeObserver(() => style.setProperty("--head", `${Math.ceil(head.getBoundingClientRect().height)}px`)).observe(head);
}

/** Paper gets a copy of the picture in the theme for paper: browsers print the picture that was last on the screen. */
function addPaper(stage) {
    let paper = null;
    window.addEventListener("beforeprint", () => {
        paper?.remove();
        paper = stage.copied();
        paper.id = "paper";
        stage.canvas.before(paper);
    });
    window.addEventListener("afterprint", () => paper?.remove());
}

function showModels(data, models, regions, box) {
    const stage = new Stage(byId("canvas"), models, box, areStrata(data));
    stage.isOpen = (data.report?.violations ?? []).length > 0 || data.boundary_is_open;
    const lookAt = ({ first, places }) =>
        stage.fit(stage.drawn.map((_, n) => models[n].labels.map((_, place) => n === first && place === places[first])));
    const list = new RegionList(regions, lookAt, data);
    const act = actions(stage, regions, models[0].title, models[0].space);
    const tools = new Tools({ stage, regions, models, fit: act.fit, lookAt, data, measure: new MeasureTool(stage, data), violations: data.report?.violations ?? [], unitText: unitText(data),
        violationCount: Object.values(data.report?.violation_counts ?? {}).reduce((sum, count) => sum + count, 0) });
    const update = () => {
        stage.drawn.forEach((drawn, which) => {
            drawn.show(regions.drawnStates(which));
            drawn.uniforms.selected.value = regions.selected?.places[which] ?? -1;
        });
        stage.render();
    };
    regions.addEventListener("change", update);
    update();
    addPicking(stage, regions, tools, list);
    stage.canvas.addEventListener("webglcontextlost", () => (byId("lost").hidden = false));
    stage.canvas.addEventListener("webglcontextrestored", () => {
        byId("lost").hidden = true;
        stage.render();
    });
    for (const button of document.querySelectorAll("[data-act]")) button.addEventListener("click", act[button.dataset.act]);
    addKeys({ stage, regions, tools, act });
    addTheme((background) => stage.setBackground(background));
    addPaper(stage);
    fillWindow();
    addScaleBar(stage, data);
    addOrientation(stage, data.models[0].space, act.look);
    act.first();
    return { stage, regions, tools, list, act };
}

/** Layers between drill holes are far wider than high. */
const areStrata = ({ command_line: line }) => /(^| )--layers( |$)/.test(line ?? "");

/** The tab of the part that is in the middle of the window is marked. */
function markTabs() {
    const links = [...document.querySelectorAll("#tabs a")];
    const mark = () => {
        const middle = window.innerHeight / 2;
        const seen = links.filter(({ hash, hidden }) => !hidden && document.querySelector(hash).getBoundingClientRect().top <= middle);
        for (const link of links) link.setAttribute("aria-current", String(link === (seen.at(-1) ?? links[0])));
    };
    window.addEventListener("scroll", mark, { passive: true });
    mark();
}

/** Without WebGL there is no model to go to, without a report no table. */
function hideEmptyLinks() {
    for (const link of document.querySelectorAll("header nav a")) {
        const target = document.querySelector(link.hash);
        link.hidden = target.hidden || target.childElementCount === 0;
    }
}

async function start() {
    const data = JSON.parse(byId("page-data").textContent);
    showHead(data, data.models);
    const models = [], box = boxOf(data.models);
    for (const [n, model] of data.models.entries()) models.push(await loadModel(n, model, box.centre));
    const regions = new Regions(models);
    let page = { regions };
    if (hasWebGl()) page = showModels(data, models, regions, box);
    else {
        say("No picture: this browser has no WebGL 2. Turn on hardware acceleration in its settings, or open the page in " +
            "a current Firefox, Chrome, Edge or Safari. The proof and the table below are complete.");
        byId("model").hidden = true;
        addTheme(() => {});
    }
    showProof(data);
    showTable(data, regions, page.list && ((region) => {
        page.list.choose(region);
        page.list.reveal(region);
        page.list.lookAt(region);
        byId("model").scrollIntoView();
        byId("canvas").focus({ preventScroll: true });
    }));
    hideEmptyLinks();
    markTabs();
    page.stage?.renderNow();
    window.regionmesh = { ...page, data, models, readyAfter: performance.now() };
    document.documentElement.dataset.ready = "true";
}

start().catch((error) => {
    console.error(error);
    say(`The page could not be shown: ${error.message}`);
});
