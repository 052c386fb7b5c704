// Bars and histograms, as tables and SVG that a screen reader can read.
import { counted, element, short } from "./dom.js";

export function barRow(name, value, largest, text, isGood = false) {
    const bar = element("span", { class: isGood ? "bar good" : "bar" });
    bar.style.width = `${(100 * value) / largest}%`;
    return element("tr", {}, element("th", { scope: "row" }, name), element("td", { class: "bar-cell" }, bar), element("td", {}, text));
}

const kSvg = "http://www.w3.org/2000/svg";

function svg(tag, attributes, text) {
    const made = document.createElementNS(kSvg, tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    if (text !== undefined) made.textContent = text;
    return made;
}

/** `counts` in bins of `bin_width` from 0. */
export function histogram({ bin_width: width, counts }, unit) {
    const largest = Math.max(...counts, 1), all = counts.reduce((a, b) => a + b, 0) || 1, bins = counts.length;
    const [height, step] = [110, 300 / bins];
    const chart = svg("svg", { viewBox: `0 0 300 ${height + 18}`, role: "img", class: "histogram" });
    chart.setAttribute("aria-label", counts.map((count, n) => [count, n]).filter(([count]) => count > 0)
        .map(([count, n]) => `${short(n * width)} to ${short((n + 1) * width)}: ${short((100 * count) / all, 3)} %`).join("; "));
    counts.forEach((count, n) => {
        const tall = (height * count) / largest;
        const bar = svg("rect", { x: n * step + 0.5, y: height - tall, width: step - 1, height: Math.max(tall, count > 0 ? 0.7 : 0) });
        bar.append(svg("title", {}, `${short(n * width)} to ${short((n + 1) * width)}: ${counted(count, unit)}`));
        chart.append(bar);
    });
    const ticks = bins > 20 ? 7 : 6;
    for (let n = 0; n <= bins; n += Math.round(bins / ticks))
        chart.append(svg("text", { x: Math.min(Math.max(n * step, 8), 290), y: height + 13, "text-anchor": "middle" }, short(n * width)));
    return element("figure", {}, chart);
}
