// What was proved, and what the run did: from the report in the page.
import { barRow, histogram } from "./charts.js";
import { byId, counted, element, grouped, short } from "./dom.js";
import { lengthText, unitText } from "./units.js";

const sum = (numbers) => Object.values(numbers ?? {}).reduce((a, b) => a + b, 0);
const kOfLabels = ["euler", "quadruple_points", "region_pairs", "nesting"];

/** { name, verdict: "good" | "bad" | "none", said, meaning } */
function certificates(data) {
    const { report } = data;
    return [samplesKept(data, report), violations(data, report), topology(data, report), qualityFloor(data, report), errorBound(data, report), sameBytes(data)];
}

function samplesKept({ boundary_is_open: isOpen }, { samples, samples_wrong: wrong, samples_in_room: changed, dice }) {
    const meaning = "Every sample of the input lies in the region of its label" + (changed ? ", or of the one that --room gave it" : "") + ". Tested for each sample, in exact arithmetic.";
    const room = changed ? ` after --room changed ${grouped(changed)}` : "";
    if (samples === undefined) return { name: "Samples kept", verdict: "none", said: isOpen ? "not tested: the model is open at the box" : "not tested: the input was not at hand", meaning };
    if (wrong === 0) return { name: "Samples kept", verdict: "good", said: `all ${grouped(samples)}${room}`, meaning };
    return { name: "Samples kept", verdict: "bad", said: `${grouped(wrong)} of ${grouped(samples)} lie in another region; Dice ${dice.toFixed(6)}`, meaning };
}

function violations({ boundary_is_open: isOpen }, { violation_counts: counts }) {
    const found = Object.entries(counts).filter(([, count]) => count > 0);
    return {
        name: "Violations", verdict: found.length ? "bad" : "good",
        said: found.length ? found.map(([kind, count]) => `${kind.replaceAll("_", " ")} ${grouped(count)}`).join(", ") : "none",
        meaning: `No cracks, no folds, no crossing faces, no degenerate faces: every region is closed${isOpen ? " but for the sides of the box," : ""} and its faces have one orientation. Crossing is tested in exact arithmetic.`,
    };
}

function topology({ has_labels: has, boundary_is_open: isOpen }, { violation_counts: counts, samples_in_room: changed }) {
    const what = `${isOpen ? "Number" : "Euler characteristic of every region, number"} of quadruple points, and pairs of regions in contact`;
    const meaning = `${what} equal those of the labels${changed ? " after --room" : ""}.${isOpen ? " Euler characteristics are those of closed regions, and not compared." : ""}`;
    if (!has) return { name: "Topology", verdict: "none", said: "not compared with labels", meaning };
    const wrong = kOfLabels.reduce((count, kind) => count + (counts[kind] ?? 0), 0);
    return { name: "Topology", verdict: wrong ? "bad" : "good", said: wrong ? `${counted(wrong, "difference")} from the labels` : "equal to that of the labels", meaning };
}

function qualityFloor({ min_quality: bound }, { quality }) {
    const meaning = "Quality is 0.26 for an equilateral face, 0 for a degenerate one. Decimation makes no face below its bound, measured with z scaled as --scale-z says; faces that were below it may stay.";
    if (!bound) return { name: "Quality floor", verdict: "none", said: `lowest ${short(quality.min, 3)}; no bound of decimation`, meaning };
    if (quality.min >= bound * (1 - 1e-9))
        return { name: "Quality floor", verdict: "good", said: `lowest ${short(quality.min, 3)}, at least the bound ${short(bound)}`, meaning };
    return {
        name: "Quality floor", verdict: "none", meaning,
        said: `lowest ${short(quality.min, 3)}; ${shareBelow(bound, quality.histogram)} of the faces are below the bound ${short(bound)}`,
    };
}

/** A bound inside a bin of the histogram leaves open how many faces of that bin are below it. */
function shareBelow(bound, { bin_width: width, counts }) {
    const bins = bound / width, whole = Math.floor(bins + 1e-9), all = sum(counts) || 1;
    const isInside = bins > whole + 1e-9;
    const below = sum(counts.slice(0, isInside ? whole + 1 : whole));
    return `${isInside ? "at most " : ""}${short((100 * below) / all, 2)} %`;
}

function errorBound(data, { stopped, error_bound: found }) {
    const { max_error: bound } = data;
    const meaning = "No point of the model is farther than this from the surface before decimation, and no point of that surface is farther from the model.";
    if (bound === null) return { name: "Error bound", verdict: "none", said: "none was asked", meaning };
    if (found > bound * (1 + 1e-9))
        return { name: "Error bound", verdict: "none", said: `at most ${lengthText(found, data)}: volumes were restored after decimation to at most ${lengthText(bound, data)}`, meaning };
    return { name: "Error bound", verdict: "good", said: `at most ${lengthText(bound, data)}${stopped === "max_error" ? "; decimation ended there" : ""}`, meaning };
}

function sameBytes({ models }) {
    return {
        name: "Same bytes", verdict: "none", said: `fingerprint ${models.map(({ fingerprint }) => fingerprint).join(", ")}`,
        meaning: "Input and options alone decide the model, not the number of threads. A second run gives the same fingerprint of positions, faces and labels.",
    };
}

const kMarks = { good: "✓", bad: "✗", none: "–" };
const kWords = { good: "proved", bad: "failed", none: "no claim" };

/** Says as well what is not claimed: few claims can be made of a model without its input. */
function summaryOf(all) {
    const named = (wanted) => all.filter(({ verdict }) => verdict === wanted).map(({ name }) => name);
    const [good, bad, none] = ["good", "bad", "none"].map(named);
    const said = bad.length ? `${bad.length} of ${counted(good.length + bad.length, "claim")} failed` : `${counted(good.length, "claim")} proved`;
    return none.length ? `${said}; no claim: ${none.join(", ")}` : said;
}

function certificateBox(data) {
    const all = certificates(data);
    return element("div", { class: "certificates" },
        element("p", { class: "verdict" }, summaryOf(all)),
        element("ul", {}, ...all.map(({ name, verdict, said, meaning }) =>
            element("li", { class: verdict },
                element("span", { class: "mark", role: "img", "aria-label": kWords[verdict] }, kMarks[verdict]),
                element("div", {}, element("strong", {}, name), " ", element("span", { class: "said" }, said), element("p", {}, meaning))))));
}

function card(title, ...children) {
    return element("article", { class: "card" }, element("h3", {}, title), ...children);
}

const kVerdictTexts = {
    accepted: "collapsed", strata: "would change topology (strata)", link: "would change topology (link)", fold: "would fold a face",
    quality: "would make a face of low quality", pinch: "would pinch a region", samples: "would lose a sample", error: "would exceed the error bound", intersect: "would make faces cross",
};

function verdictCard({ verdicts, stopped, refreshes }) {
    const largest = Math.max(...Object.values(verdicts));
    return card("Collapses of edges, by verdict",
        element("table", { class: "bars" }, ...Object.entries(verdicts).map(([kind, count]) =>
            barRow(kVerdictTexts[kind] ?? kind, count, largest, grouped(count), kind === "accepted"))),
        element("p", { class: "hint" }, `Decimation ended: ${stopped.replaceAll("_", " ")}. Candidates gathered again: ${counted(refreshes, "time")}.`));
}

function secondsCard({ seconds, stage_bytes: memory = {}, peak_bytes: bytes }) {
    const { total, ...stages } = seconds, largest = Math.max(...Object.values(stages), 1e-9);
    const rows = Object.entries(stages).sort((a, b) => b[1] - a[1]);
    const text = (stage, time) => (time < 0.001 ? "< 0.001" : short(time, 3)) + (memory[stage] ? `, ${grouped(Math.round(memory[stage] / 1e6))}\u00a0MB` : "");
    return card(Object.keys(memory).length > 0 ? "Seconds and memory by stage" : "Seconds by stage",
        element("table", { class: "bars" }, ...rows.map(([stage, time]) => barRow(stage, time, largest, text(stage, time)))),
        element("p", { class: "hint" }, `${total === undefined ? "" : `${short(total, 3)} s in all. `}${bytes ? `At most ${grouped(bytes / 1e6)} MB of memory.` : ""}`));
}

function qualityCards(qualities) {
    const made = [];
    for (const [name, quality] of qualities) {
        const of = name ? ` of ${name}` : "";
        made.push(
            card(`Quality of faces${of}`, histogram(quality.histogram, "face"),
                element("p", { class: "hint" }, `lowest ${short(quality.min, 3)}, mean ${short(quality.mean, 3)}`)),
            card(`Angles of faces${of}, degrees`, histogram(quality.angles, "angle"),
                element("p", { class: "hint" }, `lowest ${short(quality.min_angle, 3)}, highest ${short(quality.max_angle, 4)}`)));
    }
    return made;
}

function distanceCard(data) {
    const { distance } = data.report;
    const rows = [["A to B", distance.a_to_b], ["B to A", distance.b_to_a], ["both", distance.both]];
    return card("Distance between the models",
        element("table", {}, element("tr", {}, ...["", "rms", "mean", "95 %", "largest"].map((text) => element("th", {}, text))),
            ...rows.map(([name, d]) => element("tr", {}, element("th", {}, name),
                ...[d.rms, d.mean, d.quantile_95, d.max].map((x) => element("td", {}, short(x)))))),
        element("p", { class: "hint" }, unitText(data)));
}

function onlyCard(report) {
    const text = ({ regions, interfaces, lines }) => `${counted(regions.length, "region")}, ${counted(interfaces.length, "interface")}, ${counted(lines.length, "line")}`;
    return card("In one model only", element("p", {}, `A: ${text(report.only_in_a)}`), element("p", {}, `B: ${text(report.only_in_b)}`));
}

function commandCard(data) {
    const copy = element("button", { type: "button", onclick: () => navigator.clipboard?.writeText(data.command_line) }, "Copy");
    return card("Made by", element("pre", {}, data.command_line), copy);
}

/** Shows the report, and a line of certificates below the title. */
export function showProof(data) {
    const { report } = data, section = byId("proof");
    section.append(element("h2", {}, data.command === "compare" ? "Comparison" : "Proof"));
    const cards = element("div", { class: "cards" });
    if (report && data.command === "compare") {
        cards.append(distanceCard(data), onlyCard(report),
            ...qualityCards([["A", report.quality.a], ["B", report.quality.b]]));
    } else if (report) {
        section.append(certificateBox(data));
        showChips(data);
        if (sum(report.verdicts) > 0) cards.append(verdictCard(report));
        cards.append(...qualityCards([["", report.quality]]));
        if (report.seconds) cards.append(secondsCard(report));
    }
    if (data.command_line) cards.append(commandCard(data));
    section.append(cards);
}

function showChips(data) {
    const chips = certificates(data).filter(({ verdict }) => verdict !== "none")
        .map(({ name, verdict, said }) => element("a", { href: "#proof", class: `chip ${verdict}` }, `${kMarks[verdict]} ${name}: ${said}`));
    byId("summary").after(element("p", { id: "chips" }, ...chips));
}
