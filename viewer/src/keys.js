// Keys of the page.
import { byId, element } from "./dom.js";

const kStep = Math.PI / 24, kMove = 0.08;

/** [keys as shown, keys of events, what, act]. */
function tableOf({ stage, regions, tools, act }) {
    const selected = (run) => () => regions.selected && run(regions.selected);
    const press = (id) => () => byId(id)?.click();
    return [
        ["← → ↑ ↓", null, "turn; with Shift: move"],
        ["+ −", ["+", "=", "-"], "zoom", (key) => stage.zoom(key === "-" ? 1.15 : 1 / 1.15)],
        ["F", ["f"], "fit what is shown", act.fit],
        ["1 2 3", ["1", "2", "3"], "from the front, the side, above", (key) => act[["front", "side", "top"][key - 1]]()],
        ["I", ["i"], "isolate the selected region, or show all again", selected((region) => regions.isolate(region))],
        ["H", ["h"], "hide the selected region", selected((region) => regions.setState([region], "hidden"))],
        ["G", ["g"], "see through the selected region", selected((region) => regions.setState([region], region.state === "ghost" ? "solid" : "ghost"))],
        ["O", ["o"], "look at the selected region", selected((region) => tools.lookAt(region))],
        ["A", ["a"], "show all regions", press("show-all")],
        ["X Y Z", ["x", "y", "z"], "section across an axis; again: none", (key) => tools.setSection(byId("section-axis").value === key ? "none" : key)],
        ["E", ["e"], "edges of faces", press("show-edges")],
        ["L", ["l"], "flat faces", press("show-flat")],
        ["T", ["t"], "lines where three regions meet", press("show-lines")],
        ["Q", ["q"], "points where four regions meet", press("show-points")],
        ["M", ["m"], "measure: click points on surfaces; again: no more", press("measure")],
        ["V", ["v"], "next violation", press("violation-next")],
        ["P", ["p"], "save a picture", act.screenshot],
        ["/", ["/"], "find a region", () => byId("region-search").focus()],
        ["?", ["?"], "this list", act.keys],
        ["● ◌ ◉", null, "in the list: hide or show, see through, isolate"],
        ["mouse", null, "left turns, right moves, wheel zooms, click selects, double click looks at the place"],
    ];
}

export function addKeys(page) {
    const rows = tableOf(page), { stage } = page;
    byId("keys").append(
        element("h2", {}, "Keys"),
        element("table", {}, ...rows.map(([keys, , what]) => element("tr", {}, element("th", {}, keys), element("td", {}, what)))),
        element("button", { type: "button", onclick: () => byId("keys").close() }, "Close"));
    const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    document.addEventListener("keydown", (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        if (event.target.closest?.("input:not([type=checkbox]), select, dialog")) return;
        if (event.key in turns) {
            if (event.target !== stage.canvas) return;  // elsewhere they scroll the page
            const [x, y] = turns[event.key];
            if (event.shiftKey) stage.pan(x * kMove, -y * kMove);
            else stage.turn(x * kStep, y * kStep);
            event.preventDefault();
            return;
        }
        const key = event.key.toLowerCase(), row = rows.find(([, keys]) => keys?.includes(key));
        if (!row) return;
        event.preventDefault();
        row[3](key);
    });
}
