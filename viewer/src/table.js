// The table of regions: sorted by any column, and as CSV and JSON with the numbers of the report.
import { byId, download, element, grouped, inOrder, labelNumber, short } from "./dom.js";
import { areaText, lengthText, unitText, volumeText } from "./units.js";

const kFirstRows = 200;

/** Columns of a report of one model: [name in files, title, value of a row, text]. */
const kColumns = [
    ["label", "Label", (row) => row.label, (value) => value],
    ["name", "Name", (row) => row.name, (value) => value],
    ["volume_unsmoothed", "Volume before", (row) => row.volume_unsmoothed, volumeText],
    ["volume", "Volume", (row) => row.volume, volumeText],
    ["volume_change", "Change", (row) => row.volume_change, (value) => `${value >= 0 ? "+" : ""}${(100 * value).toFixed(3)} %`],
    ["dice", "Dice", (row) => row.dice, (value) => value.toFixed(5)],
    ["area", "Area", (row) => row.area, areaText],
    ["neighbours", "Neighbours", (row) => row.neighbours, (value) => grouped(value)],
    ["euler", "Euler", (row) => row.euler, (value) => String(value)],
    ["components", "Parts", (row) => row.components, (value) => grouped(value)],
];

const kCompareColumns = [
    ["label", "Label", (row) => row.label, (value) => value],
    ["name", "Name", (row) => row.name, (value) => value],
    ["volume_a", "Volume A", (row) => row.a?.volume, volumeText],
    ["volume_b", "Volume B", (row) => row.b?.volume, volumeText],
    ["area_a", "Area A", (row) => row.a?.area, areaText],
    ["area_b", "Area B", (row) => row.b?.area, areaText],
    ["euler_a", "Euler A", (row) => row.a?.euler, (value) => String(value)],
    ["euler_b", "Euler B", (row) => row.b?.euler, (value) => String(value)],
    ["rms", "Distance, rms", (row) => row.distance?.both?.rms, lengthText],
    ["quantile_95", "95 %", (row) => row.distance?.both?.quantile_95, lengthText],
    ["max", "Largest", (row) => row.distance?.both?.max, lengthText],
];

function rowsOf({ report, models }, regions) {
    const dice = new Map((report.dice_of_regions ?? []).map((row) => [row.label, row.dice]));
    return report.regions.map((row) => {
        const region = regions.byLabel.get(row.label);
        const made = { ...row, name: row.name ?? region?.name ?? "" };
        if (models.length > 1) return made;
        if (dice.has(row.label)) made.dice = dice.get(row.label);
        if (region) made.neighbours = region.measures.neighbours.size;
        return made;
    });
}

/** A cell of CSV (RFC 4180). A leading sign of a formula gets an apostrophe: spreadsheets would run it. */
function csvCell(value) {
    if (value === null || value === undefined) return "";
    if (typeof value === "number") return String(value);
    const text = /^[=+@\t\r]|^-(?!\d+$)/.test(value) ? `'${value}` : value;
    return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

export function csvOf(columns, rows) {
    const lines = [columns.map(([name]) => name), ...rows.map((row) => columns.map(([, , value]) => csvCell(value(row))))];
    return lines.map((cells) => cells.join(",") + "\r\n").join("");
}

/** The report as it was written: the page holds labels as text, since a number of JavaScript has 53 bits. */
export function reportText(report) {
    const mark = (label) => (/^-?\d+$/.test(label) ? `\u0001${label}\u0001` : label);
    const marked = (value) => {
        if (Array.isArray(value)) return value.map(marked);
        if (value === null || typeof value !== "object") return value;
        return Object.fromEntries(Object.entries(value).map(([key, item]) => {
            if (key === "options") return [key, item];
            if (key === "label") return [key, mark(item)];
            return [key, key === "labels" && Array.isArray(item) ? item.map(mark) : marked(item)];
        }));
    };
    return JSON.stringify(marked(report), null, 2).replace(/"\\u0001(-?\d+)\\u0001"/g, "$1") + "\n";
}

function jsonOf(columns, rows) {
    const objects = rows.map((row) => Object.fromEntries(columns.map(([name, , value]) => [name, value(row) ?? null])));
    return JSON.stringify(objects, null, 2) + "\n";
}

/** Upwards or, with the sign -1, downwards; what a row does not have comes last either way. */
const compare = (a, b, sign) => (a === undefined || a === null) - (b === undefined || b === null) || sign * inOrder(a, b);

/** `goTo(region)` shows it in the picture; none where there is no picture. */
export function showTable(data, regions, goTo) {
    if (!data.report) return;
    const all = rowsOf(data, regions), columns = (data.models.length > 1 ? kCompareColumns : kColumns)
        .filter(([, , value]) => all.some((row) => value(row) !== undefined && value(row) !== null && value(row) !== ""));
    let [order, sign, shown] = [0, 1, kFirstRows];
    const section = byId("table"), body = element("tbody"), more = element("button", { type: "button" });
    const keyOf = (row) => {
        const value = columns[order][2](row);
        return columns[order][0] === "label" ? labelNumber(value) : value;
    };
    const heads = columns.map(([name, title], n) =>
        element("th", { scope: "col", "data-column": name }, element("button", { type: "button", onclick: () => sortBy(n) }, title)));
    const draw = () => {
        const sorted = [...all].sort((a, b) => compare(keyOf(a), keyOf(b), sign));
        body.replaceChildren(...sorted.slice(0, shown).map((row) => tableRow(row, columns, regions, goTo, data)));
        heads.forEach((head, n) => head.setAttribute("aria-sort", n !== order ? "none" : sign > 0 ? "ascending" : "descending"));
        more.hidden = shown >= all.length;
        more.textContent = `Show all ${grouped(all.length)} rows`;
    };
    const sortBy = (n) => {
        sign = n === order ? -sign : ["label", "name"].includes(columns[n][0]) ? 1 : -1;
        order = n;
        draw();
    };
    const showAll = () => {
        shown = all.length;
        draw();
    };
    more.addEventListener("click", showAll);
    window.addEventListener("beforeprint", () => shown < all.length && showAll());
    const name = data.models[0].title.replace(/[^\w.-]+/g, "_");
    section.append(element("h2", {}, "Regions"),
        element("p", { class: "hint", hidden: !data.boundary_is_open }, "The model is open at the box: volumes of regions that reach it mean nothing."),
        element("p", { class: "hint" }, unitText(data)),
        element("div", { class: "buttons" },
            element("button", { type: "button", id: "csv", onclick: () => download(`${name}.regions.csv`, "text/csv", csvOf(columns, all)) }, "Download CSV"),
            element("button", { type: "button", id: "json", onclick: () => download(`${name}.regions.json`, "application/json", jsonOf(columns, all)) }, "Download JSON"),
            element("button", { type: "button", id: "report", onclick: () => download(`${name}.report.json`, "application/json", reportText(data.report)) }, "Download the whole report")),
        element("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": "Table of regions, scrolls" },
            element("table", { id: "region-table" }, element("thead", {}, element("tr", {}, ...heads)), body)), more);
    draw();
}

function tableRow(row, columns, regions, goTo, data) {
    const region = regions.byLabel.get(row.label);
    const cells = columns.map(([name, , value, text]) => {
        const found = value(row);
        const shown = found === undefined || found === null ? "–" : text(found, data);
        if (name !== "label" || !region) return element("td", { "data-column": name }, shown);
        const swatch = element("span", { class: "swatch" });
        swatch.style.background = region.colour;
        if (!goTo) return element("td", {}, swatch, shown);
        const label = `Show ${region.title} in the picture`;
        return element("td", {}, element("button", { type: "button", class: "go", title: label, "aria-label": label, onclick: () => goTo(region) }, swatch, shown));
    });
    return element("tr", {}, ...cells);
}
