// The page in a browser.  page_test.mjs PROGRAM REPOSITORY FOLDER
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { coordinate } from "../../viewer/src/dom.js";
import { launch, open, picture } from "./browser.mjs";

const [program, repository, folder] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const run = (...words) => execFileSync(program, words, { encoding: "utf8" });

async function shows_lists_and_isolates(browser) {
    run("reconstruct", `${repository}/tests/data/solvers/polycrystal.nii.gz`, "-o", `${folder}/poly.vtp`, "--reduce", "80%", "--quiet");
    run("view", `${folder}/poly.vtp`, "-o", `${folder}/poly.html`);
    const errors = [], page = await open(browser, `${folder}/poly.html`, errors);
    const whole = await picture(page);
    assert.ok(whole.drawn > 0.2, `draws ${whole.drawn} of the picture`);
    assert.ok(whole.colours > 100, `${whole.colours} colours`);
    assert.equal(await page.$$eval("#region-rows .row", (rows) => rows.length), 10);

    await page.click("#region-rows .row:nth-child(3) .row-only");
    const one = await picture(page);
    assert.ok(one.drawn > 0 && one.drawn < whole.drawn, `one region draws ${one.drawn}`);
    assert.equal(await page.$eval("#region-count", (e) => e.textContent), "10 of 10 regions, 9 hidden");
    await page.click("#show-all");
    assert.equal((await picture(page)).sum, whole.sum, "all regions are shown again");

    await page.select("#region-order", "name");
    assert.deepEqual(await page.$$eval(".row-name", (names) => names.map((e) => e.textContent)), Array.from({ length: 10 }, (_, n) => `region ${n + 1}`));
    await page.select("#region-order", "volume");

    await page.type("#region-search", "region 1");
    assert.equal(await page.$eval("#region-count", (e) => e.textContent), "2 of 10 regions");
    assert.deepEqual(errors, []);
    await page.close();
}

async function keys_and_focus_reach_everything(browser) {
    const errors = [], page = await open(browser, `${folder}/poly.html`, errors);
    const before = await picture(page);
    await page.focus("#canvas");
    await page.keyboard.press("ArrowLeft");
    assert.notEqual((await picture(page)).sum, before.sum, "an arrow key turns the picture");
    const stops = () => page.$$eval("#region-rows [role=listitem] button", (found) => found.filter((e) => e.tabIndex === 0).length);
    assert.equal(await stops(), 1, "Tab does not stop at every row");
    await page.focus("#region-rows .row-name");
    await page.keyboard.press("ArrowDown");
    assert.equal(await stops(), 1);
    await page.keyboard.press("Enter");
    assert.equal(await page.evaluate("regionmesh.regions.selected === regionmesh.list.found[1]"), true);
    await page.keyboard.press("i");
    assert.equal(await page.$eval("#region-count", (e) => e.textContent), "10 of 10 regions, 9 hidden");
    await page.keyboard.press("i");
    await page.keyboard.press("/");
    const first = await page.evaluate("regionmesh.list.found[0].label");
    await page.keyboard.press("ArrowDown");
    assert.ok(await page.evaluate("document.activeElement.matches('[aria-posinset=\"1\"] .row-name')"), "from the field into the list");
    await page.keyboard.press("/");
    await page.keyboard.press("Enter");
    assert.equal(await page.evaluate("regionmesh.regions.selected.label"), first);
    const whole = await picture(page);
    await page.keyboard.press("o");
    assert.notEqual((await picture(page)).sum, whole.sum, "looks at the region");
    await page.type("#region-search", "nothing of the kind");
    assert.ok((await page.$eval("#region-count", (e) => e.textContent)).includes("--names TABLE"), "says why a name is not found");
    await page.keyboard.press("?");  // in the field: a letter
    assert.equal(await page.$eval("#keys", (e) => e.open), false);
    await page.focus("#canvas");
    await page.keyboard.press("?");
    assert.ok(await page.$eval("#keys", (e) => e.open));
    await page.keyboard.press("Escape");
    const unnamed = await page.$$eval("button, input, select, canvas", (found) => found.filter((e) =>
        !(e.getAttribute("aria-label") || e.textContent.trim() || e.closest("label")?.textContent.trim())).map((e) => e.outerHTML));
    assert.deepEqual(unnamed, [], "every control has a name");
    assert.deepEqual(errors, []);
    await page.close();
}

async function large_models_are_shown_as_a_preview(browser) {
    run("view", `${folder}/poly.vtp`, "-o", `${folder}/preview.html`, "--preview-faces", "9000");
    const errors = [], page = await open(browser, `${folder}/preview.html`, errors);
    assert.ok((await page.$eval("#summary", (e) => e.textContent)).includes("preview"));
    assert.ok((await picture(page)).drawn > 0.2);
    const faces = await page.evaluate("[regionmesh.models[0].faces, regionmesh.models[0].shown_faces, regionmesh.models[0].geometry.faces]");
    assert.ok(faces[1] <= 9000 && faces[2] === faces[1] && faces[0] > 1.5 * faces[1], `${faces}`);
    const bytes = statSync(`${folder}/poly.html`).size - statSync(`${repository}/viewer/dist/page.html`).size;
    assert.ok(bytes < 12 * faces[0], `${bytes / faces[0]} bytes a face`);
    assert.deepEqual(errors, []);
    await page.close();
}

async function a_click_names_the_region(browser) {
    const errors = [], page = await open(browser, `${folder}/poly.html`, errors);
    const box = await (await page.$("#canvas")).boundingBox();
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    const told = await page.$eval("#info", (e) => e.textContent);
    for (const word of ["Region", "Interface", "Area", "Quality of the face"]) assert.ok(told.includes(word), told);
    const label = await page.evaluate("window.regionmesh.regions.selected.label");
    await page.keyboard.press("h");
    assert.equal(await page.evaluate((l) => window.regionmesh.regions.byLabel.get(l).state, label), "hidden");
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    assert.notEqual(await page.evaluate("window.regionmesh.regions.selected?.label"), label, "a hidden region is not hit");
    assert.deepEqual(errors, []);
    await page.close();
}

/** A ball of regions 1 and 2 of a volume of 40 samples a side; `label` is the truth. */
function ball() {
    const label = (x, y, z) => ((x - 20) ** 2 + (y - 20) ** 2 + (z - 20) ** 2 >= 15 ** 2 ? 0 : x > 22 ? 2 : 1);
    const samples = Uint8Array.from({ length: 40 ** 3 }, (_, n) => label(n % 40, Math.floor(n / 40) % 40, Math.floor(n / 1600)));
    writeFileSync(`${folder}/ball.raw`, samples);
    return { words: [`${folder}/ball.raw`, "--size", "40,40,40", "--type", "uint8"], label };
}

async function a_click_on_a_section_names_the_region_that_it_shows(browser) {
    const { words, label } = ball();
    run("reconstruct", ...words, "-o", `${folder}/ball.vtp`, "--reduce", "60%", "--quiet", "--html", `${folder}/ball.html`);
    const errors = [], page = await open(browser, `${folder}/ball.html`, errors);
    for (const axis of ["x", "y", "z"]) {
        await page.select("#section-axis", axis);
        const hits = await page.evaluate(`(() => {
            const { stage, models } = regionmesh, { camera } = stage, box = stage.canvas.getBoundingClientRect(), hits = [];
            const [a, b, c, d] = stage.shared.plane.value.toArray(), height = ({ x, y, z }) => a * x + b * y + c * z;
            for (let n = 0; n < 400; ++n) {
                const x = (n % 20 + 0.5) / 20, y = (Math.floor(n / 20) + 0.5) / 20;
                const hit = stage.pickAt(box.left + x * box.width, box.top + y * box.height);
                const ray = camera.position.clone().set(2 * x - 1, 1 - 2 * y, 0.5).unproject(camera).sub(camera.position);
                const entry = camera.position.clone().addScaledVector(ray, (d - height(camera.position)) / height(ray));
                hits.push([hit && { ...hit, label: Number(models[0].labels[hit.label].label) }, entry.toArray().map((x, axis) => x + models[0].centre[axis])]);
            }
            return hits;
        })()`);
        let places = 0;
        for (const [hit, at] of hits) {
            const around = [[0, 0, 0], [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
                .map((step) => label(...at.map((x, k) => x + step[k])));
            if (around[0] === 0 || around.some((one) => one !== around[0])) continue;
            assert.ok(hit?.isCap && hit.label === around[0], `${around[0]} at ${at}, section across ${axis}: ${JSON.stringify(hit)}`);
            ++places;
        }
        assert.ok(places > 20, `${places} places on the section across ${axis}`);
    }
    assert.deepEqual(errors, []);
    await page.close();
}

async function an_open_model_claims_what_was_tested(browser) {
    run("reconstruct", ...ball().words, "--boundary", "open", "--roi", "5:30,:,:", "-o", `${folder}/open.vtp`, "--quiet", "--html", `${folder}/open.html`);
    const errors = [], page = await open(browser, `${folder}/open.html`, errors);
    const text = await page.$eval("#proof", (e) => e.textContent);
    for (const said of ["every region is closed but for the sides of the box", "Euler characteristics are those of closed regions, and not compared", "not tested: the model is open"])
        assert.ok(text.includes(said), said);
    const isSaid = (page) => page.$eval("#table .hint", (e) => e.textContent.includes("mean nothing") && !e.hidden);
    assert.ok(await isSaid(page));
    const closed = await open(browser, `${folder}/ball.html`, errors);
    assert.ok(!(await isSaid(closed)), "a closed model has volumes");
    await closed.close();
    assert.ok(await page.evaluate("regionmesh.stage.isOpen"), "its inside is drawn");
    assert.deepEqual(errors, []);
    await page.close();
}

async function tables_equal_the_report(browser) {
    const volume = `${repository}/tests/data/solvers/in100.nii.gz`;
    run("reconstruct", volume, "-o", `${folder}/in.vtp`, "--reduce", "70%", "--quiet", "--report", `${folder}/in.json`, "--html", `${folder}/in.html`);
    const report = JSON.parse(readFileSync(`${folder}/in.json`, "utf8"));
    const errors = [], page = await open(browser, `${folder}/in.html`, errors);
    const rows = (await downloaded(page, "csv")).trim().split("\r\n").map((line) => line.split(","));
    const json = JSON.parse(await downloaded(page, "json"));
    assert.equal(rows.length, report.regions.length + 1);
    const dice = new Map(report.dice_of_regions.map((row) => [row.label, row.dice]));
    report.regions.forEach((region, n) => {
        const cells = Object.fromEntries(rows[0].map((name, column) => [name, rows[n + 1][column]]));
        assert.equal(cells.label, String(region.label));
        assert.equal(json[n].label, String(region.label));
        for (const key of ["volume", "area", "euler", "components", "volume_unsmoothed", "volume_change"]) {
            assert.equal(Number(cells[key]), region[key], key);
            assert.equal(json[n][key], region[key], key);
        }
        assert.equal(Number(cells.dice), dice.get(region.label));
    });
    assert.deepEqual(JSON.parse(await downloaded(page, "report")), report);
    await page.click('#region-table [data-column="volume"] button');
    const volumes = await page.$$eval('#region-table tbody tr td:nth-child(3)', (cells) => cells.map((e) => Number(e.textContent.replaceAll(",", ""))));
    assert.deepEqual(volumes, [...volumes].sort((a, b) => b - a));
    await page.click("#region-table tbody tr:nth-child(3) .go");
    const third = await page.$eval("#region-table tbody tr:nth-child(3) .go", (e) => e.textContent);
    assert.equal(await page.evaluate("regionmesh.regions.selected.label"), third);
    assert.equal(await page.evaluate("document.activeElement.id"), "canvas", "goes to the picture");
    assert.ok(!(await page.$eval("#proof", (e) => e.textContent)).includes("rms distance to the planes"));
    assert.equal(await page.$$eval(".certificates .good", (found) => found.length) >= 3, true);
    assert.equal(await page.$$eval("svg.histogram", (found) => found.length), 2);
    assert.deepEqual(errors, []);
    await page.close();
}

function coordinates_have_the_digits_of_the_page() {
    assert.equal(coordinate(456818.12345, 64), "456,818.1235");
    assert.equal(coordinate(1e9 + 12.3456, 3), "1,000,000,012.3456");
    assert.equal(coordinate(3.2, 2e6), "3");
    assert.equal(coordinate(1e-30, 1e-29), "1e-30");
    assert.equal(coordinate(5, 0), "5");
}

async function a_picture_is_saved(browser) {
    const errors = [], page = await open(browser, `${folder}/poly.html`, errors);
    const [type, head, size] = await page.evaluate(() => new Promise((done) => {
        const make = URL.createObjectURL;
        URL.createObjectURL = (blob) => {
            blob.arrayBuffer().then((bytes) => done([blob.type, [...new Uint8Array(bytes, 1, 3)], blob.size]));
            return make.call(URL, blob);
        };
        document.querySelector('[data-act="screenshot"]').click();
    }));
    assert.deepEqual([type, String.fromCharCode(...head)], ["image/png", "PNG"]);
    assert.ok(size > 5000, `${size} bytes`);
    assert.deepEqual(errors, []);
    await page.close();
}

/** The text of the file that a button saves. */
async function downloaded(page, id) {
    return page.evaluate(async (button) => {
        let blob;
        const make = URL.createObjectURL;
        URL.createObjectURL = (given) => make.call(URL, (blob = given));
        document.getElementById(button).click();
        URL.createObjectURL = make;
        return blob.text();
    }, id);
}

async function a_planted_violation_is_found(browser) {
    // The first face of a text file goes: three open edges.
    run("convert", `${folder}/in.vtp`, `${folder}/in.obj`);
    const lines = readFileSync(`${folder}/in.obj`, "utf8").split("\n");
    lines.splice(lines.findIndex((line) => line.startsWith("f ")), 1);
    writeFileSync(`${folder}/open.obj`, lines.join("\n"));
    assert.equal(lines.length > 100, true);
    run("view", `${folder}/open.obj`, "-o", `${folder}/open.html`);
    const errors = [], page = await open(browser, `${folder}/open.html`, errors);
    assert.ok(await page.$eval(".certificates .bad", (e) => e.textContent.includes("open edge")));
    const before = await picture(page);
    await page.click("#violation-next");
    const told = await page.$eval("#violation", (e) => e.textContent);
    assert.ok(/^1 of \d+: .*edge/.test(told), told);
    assert.notEqual((await picture(page)).sum, before.sum, "goes to the place");
    const solid = () => page.evaluate("regionmesh.regions.all.filter(({ state }) => state === 'solid').map(({ label }) => label)");
    const [, named] = told.match(/region (\d+)/), alone = await solid();
    assert.ok(alone.includes(named) && alone.length <= 4, `region ${named} is among the few that are shown: ${alone}`);
    assert.ok(await page.$eval("#show-edges", (e) => e.checked), "a missing face shows by its edges");
    await page.click("#violation-alone");
    assert.equal((await solid()).length, await page.evaluate("regionmesh.regions.all.length"));
    const first = told;
    await page.keyboard.press("v");
    assert.notEqual(await page.$eval("#violation", (e) => e.textContent), first);
    assert.deepEqual(errors, []);
    await page.close();
}

async function two_models_share_a_camera(browser) {
    run("decimate", `${folder}/in.vtp`, "-o", `${folder}/fewer.vtp`, "--reduce", "50%", "--quiet");
    run("compare", `${folder}/in.vtp`, `${folder}/fewer.vtp`, "--html", `${folder}/compare.html`, "--quiet");
    const errors = [], page = await open(browser, `${folder}/compare.html`, errors);
    const halves = () => page.evaluate(() => {
        const { stage } = window.regionmesh;
        stage.renderNow();
        const gl = stage.renderer.getContext(), [width, height] = [gl.drawingBufferWidth >> 1, gl.drawingBufferHeight];
        return [0, width].map((left) => {
            const pixels = new Uint8Array(4 * width * height);
            gl.readPixels(left, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
            return pixels.filter((_, n) => n % 4 === 1 && pixels[n] !== ((stage.background >> 8) & 255)).length;
        });
    });
    const whole = await halves();
    assert.ok(whole[0] > 1000 && Math.abs(whole[0] - whole[1]) < 0.05 * whole[0], `${whole}`);
    await page.evaluate("window.regionmesh.stage.zoom(1.5)");
    const far = await halves();
    assert.ok(far[0] < 0.6 * whole[0] && far[1] < 0.6 * whole[1], `${far} of ${whole}`);
    await page.select("#colour-by", "distance");
    assert.equal(await page.$eval("#legend", (e) => e.hidden), false);
    await page.click("#go-farthest");
    const largest = await page.evaluate("Math.max(...regionmesh.models.map(({ distances }) => distances.reduce((a, b) => Math.max(a, b))))");
    const said = await page.$eval("#farthest-text", (e) => e.textContent);
    assert.equal(Number(said.split(" ")[0]), Number(largest.toPrecision(4)), said);
    assert.ok(await page.evaluate("regionmesh.regions.all.filter(({ state }) => state === 'solid').length") <= 4);
    await page.click("#show-all");
    await page.click("#region-rows .row .row-only");
    assert.ok((await picture(page)).drawn > 0);
    assert.ok(await page.$eval("#proof", (e) => e.textContent.includes("B to A")));
    assert.deepEqual(errors, []);
    await page.close();
}

async function two_models_keep_their_places_and_their_figures(browser) {
    run("reconstruct", `${repository}/tests/data/solvers/in100.nii.gz`, "-o", `${folder}/part.vtp`, "--roi", "0:20,:,:", "--reduce", "80%", "--quiet");
    run("compare", `${folder}/in.vtp`, `${folder}/part.vtp`, "--html", `${folder}/part.html`, "--quiet");
    const errors = [], page = await open(browser, `${folder}/part.html`, errors);
    const found = await page.evaluate(() => {
        const { models, regions, tools } = window.regionmesh;
        const ends = models.map(({ positions, centre, low, high }) => [0, 1, 2].map((axis) => {
            const all = positions.filter((_, n) => n % 3 === axis);
            return Math.max(Math.abs(Math.min(...all) + centre[axis] - low[axis]), Math.abs(Math.max(...all) + centre[axis] - high[axis]));
        }));
        const region = regions.all.find(({ places: [a, b] }) => a !== undefined && b !== undefined), told = [0, 1].map((which) => {
            tools.describe(region, { which, isCap: true, at: [0, 0, 0] });
            return [document.getElementById("info").textContent.replaceAll(",", ""), regions.measures[which][region.places[which]].faces];
        });
        return { centres: models.map(({ centre }) => [...centre]), size: models[0].high[0] - models[0].low[0], ends, told };
    });
    assert.deepEqual(found.centres[0], found.centres[1]);
    assert.ok(Math.max(...found.ends.flat()) < 1e-4 * found.size, `${found.ends}`);
    found.told.forEach(([text, faces], which) => assert.ok(text.includes(` in ${"AB"[which]}`) && text.includes(`Faces${faces}`), text));
    assert.notEqual(found.told[0][1], found.told[1][1]);
    assert.deepEqual(errors, []);
    await page.close();
}

/** Light, whatever the theme, and with all rows of the table. */
async function paper_is_light_and_complete(browser) {
    writeFileSync(`${folder}/many.raw`, Uint16Array.from({ length: 256 }, (_, n) => n + 1));
    run("reconstruct", `${folder}/many.raw`, "--size", "8,8,4", "--type", "uint16", "-o", `${folder}/many.vtp`, "--quiet", "--html", `${folder}/many.html`);
    const errors = [], page = await open(browser, `${folder}/many.html`, errors);
    const theme = () => page.$eval("html", (e) => e.dataset.theme);
    const rows = async () => (await page.$$("#region-table tbody tr")).length;
    const at = (name) => page.evaluate((event) => void window.dispatchEvent(new Event(event)), name);
    if ((await theme()) === "light") await page.click("#theme");
    assert.ok((await rows()) < 256);
    await at("beforeprint");
    assert.equal(await theme(), "light");
    assert.equal(await rows(), 256);
    assert.deepEqual(await page.evaluate("[...document.getElementById('paper').getContext('2d').getImageData(3, 3, 1, 1).data]"), [0xf4, 0xf5, 0xf7, 255]);
    await at("afterprint");
    assert.equal(await page.$("#paper"), null);
    assert.equal(await theme(), "dark");
    assert.deepEqual(errors, []);
    await page.close();
}

async function without_webgl_the_proof_is_there(repository) {
    const other = await launch(repository, false);
    try {
        const errors = [], page = await open(other, `${folder}/in.html`, errors);
        assert.ok(await page.$eval("#notice", (e) => !e.hidden && e.textContent.includes("hardware acceleration")));
        assert.ok((await page.$$("#region-table tbody tr")).length > 10);
        const links = await page.$$eval("header nav a", (found) => found.filter((e) => !e.hidden).map((e) => e.hash));
        assert.deepEqual(links, ["#proof", "#table"], "no link to a model that is not shown");
    } finally {
        await other.close();
    }
}

async function hostile_names_are_text(browser) {
    const names = ["</script><script>window.hacked=1</script>", "<img src=x onerror=window.hacked=1>", "<!--<script>", "\"'><svg onload=window.hacked=1>"];
    writeFileSync(`${folder}/names.csv`, "label,name\n" + names.map((name, n) => `${n + 1},"${name.replaceAll('"', '""')}"\n`).join(""));
    const model = `${folder}/<b onclick=window.hacked=1>.vtp`;
    run("reconstruct", `${repository}/tests/data/solvers/polycrystal.nii.gz`, "-o", model, "--reduce", "80%", "--quiet");
    run("view", model, "-o", `${folder}/hostile.html`, "--names", `${folder}/names.csv`);
    const errors = [], page = await open(browser, `${folder}/hostile.html`, errors);
    await page.click("#region-rows .row .row-name");
    const texts = await page.$$eval("#region-rows .row-name", (rows) => rows.map((row) => row.textContent));
    for (const name of names) assert.ok(texts.includes(name), `${name} among ${texts.join(" ; ")}`);
    assert.equal(await page.evaluate("window.hacked"), undefined, "text of a file ran");
    assert.equal(await page.$$eval("body img, body b, #region-rows svg", (found) => found.length), 0);
    assert.ok((await page.title()).startsWith("<b onclick"));
    assert.deepEqual(errors, []);
    await page.close();
}

const browser = await launch(repository);
try {
    coordinates_have_the_digits_of_the_page();
    for (const test of [shows_lists_and_isolates, keys_and_focus_reach_everything,
        large_models_are_shown_as_a_preview, a_picture_is_saved, a_click_names_the_region,
        a_click_on_a_section_names_the_region_that_it_shows, an_open_model_claims_what_was_tested, tables_equal_the_report,
        a_planted_violation_is_found, two_models_share_a_camera, two_models_keep_their_places_and_their_figures,
        paper_is_light_and_complete, hostile_names_are_text]) {
        await test(browser);
        console.log(`ok ${test.name}`);
    }
    await without_webgl_the_proof_is_there(repository);
} finally {
    await browser.close();
}
