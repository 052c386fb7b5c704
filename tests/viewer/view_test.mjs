// What the picture of the page shows, in a browser.  view_test.mjs PROGRAM REPOSITORY FOLDER
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { launch, open, picture } from "./browser.mjs";

const [program, repository, folder] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const run = (...words) => execFileSync(program, words, { encoding: "utf8" });

async function cuts_colours_and_explodes(browser) {
    const errors = [], page = await open(browser, `${folder}/poly.html`, errors);
    const seen = new Set([(await picture(page)).sum]);
    const isNew = async (what) => {
        const { sum, drawn } = await picture(page);
        assert.ok(drawn > 0.05, `${what} draws ${drawn}`);
        assert.ok(!seen.has(sum), `${what} changes nothing`);
        seen.add(sum);
    };
    for (const axis of ["x", "y", "z"]) {
        await page.select("#section-axis", axis);
        await isNew(`section across ${axis}`);
    }
    await page.select("#section-axis", "x");
    assert.ok(await capsHoldNoHoles(page), "a section of a solid block has no holes");
    await page.select("#section-axis", "none");
    for (const what of ["interface", "quality", "curvature"]) {
        await page.select("#colour-by", what);
        await isNew(`colours by ${what}`);
        assert.equal(await page.$eval("#legend", (e) => e.hidden), what === "interface");
    }
    await page.select("#colour-by", "region");
    for (const id of ["show-edges", "show-flat", "show-lines", "show-points"]) {
        await page.click(`#${id}`);
        await isNew(id);
    }
    const [found, report] = await page.evaluate("(({ edgeCount, pointCount }) => [{ edgeCount, pointCount }, regionmesh.data.report.quadruple_points_inside])(regionmesh.stage.drawn[0].lineParts)");
    assert.ok(found.edgeCount > 0 && found.pointCount >= report, `${found.pointCount} points, ${report} of them inside`);
    await page.click("#region-rows .row .row-only");
    const [some, all] = await page.evaluate("[regionmesh.stage.drawn[0].lines.geometry.index.count, 2 * regionmesh.stage.drawn[0].lineParts.edgeCount]");
    assert.ok(some > 0 && some < all, "lines of hidden regions are not drawn");
    await page.click("#show-all");
    await page.$eval("#explode", (e) => {
        e.value = 0.5;
        e.dispatchEvent(new Event("input"));
    });
    await isNew("exploded view");
    await page.click("#theme");
    await isNew("other theme");
    assert.deepEqual(errors, []);
    await page.close();
}

/** Looks along the normal of the section: every pixel near the middle is of the cut, none of the background. */
function capsHoldNoHoles(page) {
    return page.evaluate(() => {
        const { stage, tools } = window.regionmesh;
        stage.setDirection([1, 0, 0.0001]);
        tools.setSection("x");
        stage.setCoarse(false);
        stage.renderNow();
        const gl = stage.renderer.getContext(), [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
        const size = 200, pixels = new Uint8Array(4 * size * size);
        gl.readPixels((width - size) / 2, (height - size) / 2, size, size, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        for (let n = 0; n < pixels.length; n += 4)
            if (((pixels[n] << 16) | (pixels[n + 1] << 8) | pixels[n + 2]) === stage.background) return false;
        return true;
    });
}

const explode = (page, share) => page.evaluate(`regionmesh.tools.explode(${share})`);

async function an_exploded_view_has_the_places_of_the_model(browser) {
    const errors = [], page = await open(browser, `${folder}/poly.html`, errors);
    await explode(page, 0.5);
    const outside = await page.evaluate(() => {
        const { stage } = window.regionmesh, [{ model, places }] = stage.drawn, box = stage.canvas.getBoundingClientRect();
        stage.renderNow();
        let hits = 0, farthest = 0;  // from the box of the face
        for (let n = 0; n < 100; ++n) {
            const hit = stage.pickAt(box.left + ((n % 10 + 0.5) / 10) * box.width, box.top + ((Math.floor(n / 10) + 0.5) / 10) * box.height);
            if (!hit) continue;
            ++hits;
            hit.at.forEach((x, axis) => {
                const ends = [0, 1, 2].map((k) => places[3 * model.surface.corners[3 * hit.face + k] + axis]);
                farthest = Math.max(farthest, Math.min(...ends) - x, x - Math.max(...ends));
            });
        }
        return { hits, farthest, size: model.high[0] - model.low[0] };
    });
    assert.ok(outside.hits > 10 && outside.farthest < 1e-4 * outside.size, JSON.stringify(outside));
    assert.deepEqual(errors, []);
    await page.close();
}

/** The places of all marks of a model less those where they were before. */
const marksMoved = (page, which) => page.evaluate((n) => {
    const { stage, regions } = window.regionmesh, drawn = stage.drawn[n], offsets = regions.offsets(n);
    const found = drawn.markers.geometry.getAttribute("position").array;
    const wanted = drawn.marks.flatMap(({ at, labels }) => labels.map((label) => at.map((x, axis) => x + 0.5 * offsets[label][axis])));
    return { found: [...found], wanted: wanted.flat(), moved: drawn.marks.some(({ labels }) => labels.some((label) => Math.hypot(...offsets[label]) > 0)) };
}, which);

async function marks_go_along_with_their_regions(browser) {
    const near = ({ found, wanted, moved }) => {
        assert.ok(moved && found.length === wanted.length && found.length > 0, `${found.length} of ${wanted.length}`);
        found.forEach((x, n) => assert.ok(Math.abs(x - wanted[n]) < 1e-4 * (1 + Math.abs(x)), `${x} for ${wanted[n]}`));
    };
    // The first face of a text file goes: three open edges.
    run("convert", `${folder}/poly.vtp`, `${folder}/whole.obj`);
    const lines = readFileSync(`${folder}/whole.obj`, "utf8").split("\n");
    lines.splice(lines.findIndex((line) => line.startsWith("f ")), 1);
    writeFileSync(`${folder}/open.obj`, lines.join("\n"));
    run("view", `${folder}/open.obj`, "-o", `${folder}/open.html`);
    const errors = [], page = await open(browser, `${folder}/open.html`, errors);
    await explode(page, 0.5);
    near(await marksMoved(page, 0));
    await page.click("#violation-next");
    assert.ok(await page.evaluate(`(() => {
        const { x, y, z } = regionmesh.stage.controls.target, places = [...regionmesh.stage.drawn[0].markers.geometry.getAttribute("position").array];
        return places.some((_, n) => n % 3 === 0 && Math.hypot(places[n] - x, places[n + 1] - y, places[n + 2] - z) < 1e-3);
    })()`), "goes to a mark");
    await page.close();

    run("decimate", `${folder}/poly.vtp`, "-o", `${folder}/fewer.vtp`, "--reduce", "50%", "--quiet");
    run("compare", `${folder}/poly.vtp`, `${folder}/fewer.vtp`, "--html", `${folder}/compare.html`, "--quiet");
    const both = await open(browser, `${folder}/compare.html`, errors);
    await explode(both, 0.5);
    await both.select("#colour-by", "distance");
    await both.click("#go-farthest");
    near(await marksMoved(both, await both.evaluate("regionmesh.stage.drawn.findIndex(({ markers }) => markers)")));
    assert.deepEqual(errors, []);
    await both.close();
}

async function the_legend_is_beside_the_buttons_or_above_them(browser) {
    const errors = [], page = await open(browser, `${folder}/compare.html`, errors);
    await page.select("#colour-by", "distance");
    for (const width of [1400, 1000, 920, 800, 400, 320]) {
        await page.setViewport({ width, height: 800 });
        const [stage, legend, views] = await page.evaluate(`["stage", "legend", "views"].map((id) => {
            const { left, right, top, bottom } = document.getElementById(id).getBoundingClientRect();
            return { left, right, top, bottom };
        })`);
        const overlap = legend.left < views.right && views.left < legend.right && legend.top < views.bottom && views.top < legend.bottom;
        assert.ok(!overlap, `${width}: ${JSON.stringify([legend, views])}`);
        for (const one of [legend, views])
            assert.ok(one.left >= stage.left && one.right <= stage.right && one.bottom <= stage.bottom, `${width}: ${JSON.stringify([stage, one])}`);
    }
    assert.deepEqual(errors, []);
    await page.close();
}

async function a_lost_picture_comes_back(browser) {
    const errors = [], page = await open(browser, `${folder}/poly.html`, errors);
    const before = await picture(page), bottom = () => page.$eval("#views", (e) => e.getBoundingClientRect().bottom), place = await bottom();
    const lose = (how) => page.evaluate((name) => new Promise((done) => {
        const { stage } = window.regionmesh;
        window.loser ??= stage.renderer.getContext().getExtension("WEBGL_lose_context");
        stage.canvas.addEventListener(name === "loseContext" ? "webglcontextlost" : "webglcontextrestored", () => setTimeout(done, 100), { once: true });
        window.loser[name]();
    }), how);
    await lose("loseContext");
    await page.evaluate("regionmesh.stage.renderNow()");
    assert.ok(await page.$eval("#lost", (e) => !e.hidden && e.textContent.includes("comes back")));
    assert.equal(await bottom(), place, "the message moves nothing");
    const frames = await page.evaluate("regionmesh.stage.frames");
    await lose("restoreContext");
    assert.ok(await page.evaluate(`regionmesh.stage.frames > ${frames}`), "is drawn again by itself");
    assert.ok(await page.$eval("#lost", (e) => e.hidden));
    assert.equal((await picture(page)).sum, before.sum);
    assert.deepEqual(errors, []);
    await page.close();
}

/** Gives the page a function for all pixels of the picture: it would take seconds to bring them here. */
const addPixels = (page) => page.evaluate(() => {
    window.pixels = () => {
        const { stage } = window.regionmesh;
        stage.setCoarse(false);
        stage.renderNow();
        const gl = stage.renderer.getContext(), [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
        const found = new Uint8Array(4 * width * height);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, found);
        return found;
    };
});

async function a_selected_region_keeps_the_colours_of_values(browser) {
    const errors = [], page = await open(browser, `${folder}/poly.html`, errors);
    await addPixels(page);
    await page.select("#colour-by", "quality");
    const { drawn, changed } = await page.evaluate(() => {
        const { regions, stage } = window.regionmesh, [region] = regions.all;
        regions.isolate(region);
        const before = window.pixels();
        regions.select(region);
        const after = window.pixels(), found = { drawn: 0, changed: 0 };
        for (let n = 0; n < before.length; n += 4) {
            found.drawn += ((before[n] << 16) | (before[n + 1] << 8) | before[n + 2]) !== stage.background;
            found.changed += before[n] !== after[n] || before[n + 1] !== after[n + 1] || before[n + 2] !== after[n + 2];
        }
        return found;
    });
    assert.ok(drawn > 10000 && changed > 0.05 * drawn && changed < 0.25 * drawn, `${changed} of ${drawn} pixels`);
    assert.deepEqual(errors, []);
    await page.close();
}

async function where_there_is_no_curvature_it_is_grey(browser) {
    const errors = [], page = await open(browser, `${folder}/poly.html`, errors);
    await addPixels(page);
    await page.select("#colour-by", "curvature");
    const { red, light, grey } = await page.evaluate(() => {
        window.regionmesh.stage.drawn[0].uniforms.range.value.set(-1e6, 1e6);  // all values are in the middle
        const found = { red: 0, light: 0, grey: 0 }, pixels = window.pixels();
        for (let n = 0; n < pixels.length; n += 4) {
            const [r, , b] = pixels.subarray(n, n + 3);
            found.red += r > 1.3 * b + 10;
            found.light += r > b + 2 && r > 120;
            found.grey += r === b && r < 160;
        }
        return found;
    });
    assert.ok(light > 10000 && grey > 1000, `${light} of values, ${grey} without`);
    assert.equal(red, 0, "no colour of a large value");
    assert.deepEqual(errors, []);
    await page.close();
}

/** Each region has a hue of its own: at random places, sections, distances and shares of the exploded view. */
async function a_click_hits_the_region_that_the_picture_shows(browser) {
    const errors = [], page = await open(browser, `${folder}/poly.html`, errors);
    const found = await page.evaluate(() => {
        const { stage, regions, tools, models } = window.regionmesh, step = 360 / regions.all.length, wrong = [];
        let seed = 7, same = 0;
        const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
        const channel = (hue, n) => Math.max(0, Math.min((n + hue / 60) % 6, 4 - ((n + hue / 60) % 6), 1));
        regions.all.forEach((region, n) => (region.colour = "#" + [5, 3, 1].map((k) => Math.round(230 - 204 * channel(n * step, k)).toString(16).padStart(2, "0")).join("")));
        const regionOf = ([r, g, b]) => {
            if (((r << 16) | (g << 8) | b) === stage.background) return null;
            const most = Math.max(r, g, b), size = most - Math.min(r, g, b) || 1;
            const hue = 60 * (most === r ? (g - b) / size : most === g ? 2 + (b - r) / size : 4 + (r - g) / size);
            return regions.all[Math.round((hue + 360) / step) % regions.all.length].label;
        };
        for (let round = 0; round < 24; ++round) {
            for (const region of regions.all) region.state = random() < 0.3 ? "hidden" : "solid";
            regions.changed();
            tools.explode(round % 3 === 0 ? 0.7 * random() : 0);
            stage.setSection(["none", "x", "y", "z"][round % 4], 0.2 + 0.6 * random(), random() < 0.5);
            stage.setDirection([random() - 0.5, random() - 0.5, random() - 0.5]);
            stage.fit([regions.shown(0)]);
            if (round % 2) stage.zoom([0.3, 0.06, 0.02][round % 3]);  // also from inside
            stage.setCoarse(false);
            stage.renderNow();
            const gl = stage.renderer.getContext(), height = gl.drawingBufferHeight, pixels = new Uint8Array(100);
            const box = stage.canvas.getBoundingClientRect(), scale = box.height / height;
            for (let n = 0; n < 100; ++n) {
                const x = 3 + Math.floor(random() * (gl.drawingBufferWidth - 6)), y = 3 + Math.floor(random() * (height - 6));
                gl.readPixels(x - 2, height - 3 - y, 5, 5, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
                const seen = Array.from({ length: 25 }, (_, k) => regionOf(pixels.subarray(4 * k, 4 * k + 3)));
                if (seen.some((label) => label !== seen[0])) continue;  // near an edge
                const hit = stage.pickAt(box.left + (x + 0.5) * scale, box.top + (y + 0.5) * scale);
                const label = hit ? models[0].labels[hit.label].label : null;
                if (label === seen[0]) ++same;
                else wrong.push({ round, x, y, seen: seen[0], label });
            }
        }
        return { same, wrong };
    });
    assert.ok(found.same > 1500, `${found.same} places`);
    assert.deepEqual(found.wrong, []);
    assert.deepEqual(errors, []);
    await page.close();
}

/** Two halves of a block, 1 and 2, side by side along x. */
async function a_click_goes_through_transparent_regions(browser) {
    const samples = Uint8Array.from({ length: 20 ** 3 }, (_, n) => (n % 20 < 10 ? 1 : 2));
    writeFileSync(`${folder}/halves.raw`, samples);
    run("reconstruct", `${folder}/halves.raw`, "--size", "20,20,20", "--type", "uint8", "-o", `${folder}/halves.vtp`, "--quiet", "--html", `${folder}/halves.html`);
    const errors = [], page = await open(browser, `${folder}/halves.html`, errors);
    const hits = () => page.evaluate(() => {
        const { stage, models } = window.regionmesh, box = stage.canvas.getBoundingClientRect();
        stage.renderNow();
        return Array.from({ length: 400 }, (_, n) => {
            const hit = stage.pickAt(box.left + ((n % 20 + 0.5) / 20) * box.width, box.top + ((Math.floor(n / 20) + 0.5) / 20) * box.height);
            return hit && { label: models[0].labels[hit.label].label, isCap: hit.isCap, x: hit.at[0] };
        }).filter(Boolean);
    });
    await page.evaluate(`(() => {
        const { regions, stage, act } = regionmesh;
        regions.setState([regions.byLabel.get("2")], "ghost");
        stage.setDirection([1, -0.2, 0.2]);
        act.fit();
    })()`);
    const through = await hits(), behind = through.filter(({ label, x }) => label === "1" && Math.abs(x) < 1);
    assert.ok(behind.length > 20, "the face between both is hit through region 2");
    assert.ok(through.some(({ label }) => label === "2"), "a transparent region is hit where nothing is behind it");
    await page.select("#section-axis", "y");
    await page.evaluate("regionmesh.stage.setDirection([0.5, -1, 0.3])");
    if (await page.$eval("#section-turn", (e) => !e.checked)) await page.click("#section-turn");
    const cut = await hits();
    assert.ok(cut.some(({ label, isCap }) => label === "1" && isCap), "the cut of region 1 is hit");
    assert.ok(!cut.some(({ label, isCap }) => label === "2" && isCap), "region 2 has no cut in the picture");
    assert.ok(cut.some(({ label, x }) => label === "1" && Math.abs(x) < 1), "nor is it in the way of region 1");
    assert.deepEqual(errors, []);
    await page.close();
}

async function an_incomplete_page_says_so(browser) {
    const whole = readFileSync(`${folder}/poly.html`, "utf8"), viewer = whole.indexOf('id="viewer"');
    const ends = [whole.indexOf("</style>") - 10, whole.indexOf('id="geometry-0"') + 1000, viewer - 100, viewer + 5000, whole.lastIndexOf("</script>") - 1];
    for (const end of ends) {
        writeFileSync(`${folder}/part.html`, whole.slice(0, end));
        const page = await browser.newPage();
        await page.goto(`file://${folder}/part.html`);
        assert.match(await page.$eval("body", (e) => e.innerText), /^This page is incomplete[^\n]*$/, `cut at ${end} of ${whole.length}`);
        await page.close();
    }
}

async function claims_are_those_that_were_tested(browser) {
    run("view", `${folder}/halves.vtp`, "-o", `${folder}/claims.html`);
    const errors = [], page = await open(browser, `${folder}/claims.html`, errors);
    assert.equal(await page.$eval(".verdict", (e) => e.textContent),
        "1 claim proved; no claim: Samples kept, Topology, Quality floor, Error bound, Same bytes");
    assert.deepEqual(await page.$$eval(".chip", (found) => found.map((e) => e.textContent)), ["✓ Violations: none"]);
    assert.ok(await page.$eval("#table", (e) => e.textContent.includes("in model units")));
    await page.close();
    run("reconstruct", `${folder}/halves.raw`, "--size", "20,20,20", "--type", "uint8", "--units", "mm", "--max-error", "0.5", "-o", `${folder}/mm.vtp`, "--quiet", "--html", `${folder}/mm.html`);
    const other = await open(browser, `${folder}/mm.html`, errors);
    assert.ok(await other.$eval("#table", (e) => e.textContent.includes("volumes in mm³")), "the unit is known");
    const said = await other.$$eval(".certificates .said", (found) => found.map((e) => e.textContent));
    assert.ok(said.some((text) => text.startsWith("at most 0.5 mm")), said.join("; "));
    assert.deepEqual(errors, []);
    await other.close();
}

async function the_share_of_faces_below_the_bound_is_not_understated(browser) {
    const whole = readFileSync(`${folder}/poly.html`, "utf8"), errors = [];
    const said = async (bound) => {
        writeFileSync(`${folder}/bound.html`, whole.replace('"min_quality":null', `"min_quality":${bound}`));
        const page = await open(browser, `${folder}/bound.html`, errors);
        const texts = await page.$$eval(".certificates .said", (found) => found.map((e) => e.textContent));
        await page.close();
        return texts.find((text) => text.startsWith("lowest "));
    };
    const share = (text, pattern) => Number(pattern.exec(text)?.[1] ?? assert.fail(text));
    const edge = share(await said(0.2), /; ([0-9.]+) % of the faces are below the bound 0.2$/);
    assert.ok(share(await said(0.205), /; at most ([0-9.]+) % of the faces/) > edge, "a bound inside a bin counts all of it");
    assert.match(await said(0), /no bound of decimation$/);
    assert.deepEqual(errors, []);
}

async function the_model_stays_in_the_picture_when_the_window_changes(browser) {
    const errors = [], page = await open(browser, `${folder}/poly.html`, errors);
    const reach = (width, height) => page.setViewport({ width, height }).then(() => page.evaluate(async () => {
        await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));  // the observer has seen it
        const { stage } = window.regionmesh, p = stage.camera.position.clone(), most = [0, 0];
        stage.renderNow();
        stage.forShown(null, (x, y, z) => {
            p.set(x, y, z).project(stage.camera);
            most[0] = Math.max(most[0], Math.abs(p.x));
            most[1] = Math.max(most[1], Math.abs(p.y));
        });
        return most;
    }));
    const wide = await reach(1200, 700);
    assert.ok(Math.max(...wide) > 0.8 && Math.max(...wide) < 1, `fitted: ${wide}`);
    for (const [width, height] of [[700, 700], [500, 800], [1200, 400], [1200, 700]]) {
        const found = await reach(width, height);
        assert.ok(Math.max(...found) < 1, `${width} x ${height}: ${found}`);
    }
    assert.deepEqual(await reach(1200, 700), wide, "as before");
    assert.deepEqual(errors, []);
    await page.close();
}

async function one_is_singular_and_long_labels_are_in_order(browser) {
    writeFileSync(`${folder}/one.raw`, new Uint8Array(8).fill(1));
    run("reconstruct", `${folder}/one.raw`, "--size", "2,2,2", "--type", "uint8", "-o", `${folder}/one.vtp`, "--quiet", "--html", `${folder}/one.html`);
    const errors = [], page = await open(browser, `${folder}/one.html`, errors);
    assert.match(await page.$eval("#summary", (e) => e.textContent), /, 1 region$/);
    assert.equal(await page.$eval("#region-count", (e) => e.textContent), "1 of 1 region");
    await page.close();

    const labels = [0n, 1n, 2n, 3n].map((step) => 2n ** 53n + step);
    writeFileSync(`${folder}/long.raw`, BigUint64Array.from({ length: 4 ** 3 }, (_, n) => labels[n % 4]));
    run("reconstruct", `${folder}/long.raw`, "--size", "4,4,4", "--type", "uint64", "-o", `${folder}/long.vtp`, "--quiet", "--html", `${folder}/long.html`);
    const long = await open(browser, `${folder}/long.html`, errors);
    await long.click('#region-table [data-column="label"] button');  // downwards
    assert.deepEqual(await long.$$eval("#region-table tbody tr td:first-child", (found) => found.map((e) => e.textContent)), labels.map(String).reverse());
    await long.evaluate("regionmesh.regions.all.reverse()");
    await long.select("#region-order", "label");
    assert.deepEqual(await long.evaluate("regionmesh.list.found.map(({ label }) => label)"), labels.map(String));
    assert.deepEqual(errors, []);
    await long.close();
}

/** The interface of two backgrounds is in the model, but in no region that is drawn. */
async function places_that_only_backgrounds_have_are_not_gone_to(browser) {
    for (const [name, border] of [["near", 3], ["far", 6]]) {
        const sample = (x, y, z) => ([x, y, z].every((place) => place > 0 && place < 3) ? 1 : x < border ? 0 : 5);
        writeFileSync(`${folder}/${name}.raw`, Uint8Array.from({ length: 10 ** 3 }, (_, n) => sample(n % 10, Math.floor(n / 10) % 10, Math.floor(n / 100))));
        run("reconstruct", `${folder}/${name}.raw`, "--size", "10,10,10", "--type", "uint8", "-o", `${folder}/${name}.vtp`, "--background", "0,5", "--quiet");
    }
    run("compare", `${folder}/near.vtp`, `${folder}/far.vtp`, "--background", "0,5", "--html", `${folder}/backgrounds.html`);
    const errors = [], page = await open(browser, `${folder}/backgrounds.html`, errors);
    await page.select("#colour-by", "distance");
    await page.click("#go-farthest");
    assert.ok(await page.evaluate("regionmesh.stage.camera.position.toArray().every(Number.isFinite)"));
    assert.ok((await picture(page)).drawn > 0, "a region is shown");
    assert.deepEqual(errors, []);
    await page.close();
}

async function what_readers_of_scans_expect_is_there(browser) {
    const flat = Uint8Array.from({ length: 20 * 20 * 3 }, (_, n) => (n % 20 < 10 ? 1 : 2));
    writeFileSync(`${folder}/flat.raw`, flat);
    run("reconstruct", `${folder}/flat.raw`, "--size", "20,20,3", "--type", "uint8", "--units", "mm", "--space", "lps", "-o", `${folder}/flat.vtp`, "--quiet", "--html", `${folder}/flat.html`);
    const errors = [], page = await open(browser, `${folder}/flat.html`, errors);
    assert.ok(await page.$eval("#stretched", (e) => e.hidden), "a flat scan is shown to scale");
    await page.$eval("#stretch", (e) => {
        e.value = 5;
        e.dispatchEvent(new Event("change"));
    });
    assert.equal(await page.$eval("#stretched", (e) => e.hidden || e.textContent), "Height × 5: not to scale");
    await page.evaluate("regionmesh.tools.stretch(1)");
    assert.deepEqual(await page.$$eval(".cube button", (found) => found.map((e) => e.textContent)), ["R", "L", "A", "P", "I", "S"]);
    await page.evaluate("document.querySelector('.cube button').click()");
    const [x, y, z] = await page.evaluate("regionmesh.stage.camera.position.clone().sub(regionmesh.stage.controls.target).normalize().toArray()");
    assert.ok(x < -0.99 && Math.abs(y) < 0.01 && Math.abs(z) < 0.01, "a click looks from the right");
    await page.evaluate("regionmesh.stage.renderNow()");
    assert.match(await page.$eval("#scale-text", (e) => e.textContent), /^[125]0*(\.\d+)? mm$|^0\.0*[125] mm$/);
    const said = await page.evaluate(() => {
        const { tools } = window.regionmesh, texts = [];
        tools.measure.turn(true);
        for (const at of [[0, 0, 0], [3, 0, 0], [3, 4, 0]]) {
            tools.measure.add({ at, seen: at, which: 0 });
            texts.push(tools.measure.text);
        }
        return texts;
    });
    assert.match(said[1], /^Distance 3 mm\./);
    assert.match(said[2], /^Angle 90°, between 3 mm and 4 mm\.$/);
    assert.match(await page.$eval("#region-rows .row-value", (e) => e.textContent), / mm³$/);
    assert.equal(await page.$eval('#tabs [aria-current="true"]', (e) => e.textContent), "Model");
    assert.deepEqual(errors, []);
    await page.close();
}

async function another_height_keeps_the_side_of_the_section(browser) {
    const errors = [], page = await open(browser, `${folder}/poly.html`, errors);
    await page.select("#section-axis", "z");
    const before = await page.$eval("#section-turn", (e) => e.checked);
    await page.click("#section-turn");
    await page.$eval("#stretch", (e) => {
        e.value = 2;
        e.dispatchEvent(new Event("change"));
    });
    assert.equal(await page.$eval("#section-turn", (e) => e.checked), !before);
    assert.deepEqual(errors, []);
    await page.close();
}

const browser = await launch(repository);
try {
    run("reconstruct", `${repository}/tests/data/solvers/polycrystal.nii.gz`, "-o", `${folder}/poly.vtp`, "--reduce", "80%", "--quiet");
    run("view", `${folder}/poly.vtp`, "-o", `${folder}/poly.html`);
    for (const test of [cuts_colours_and_explodes, what_readers_of_scans_expect_is_there, an_exploded_view_has_the_places_of_the_model,
        marks_go_along_with_their_regions, the_legend_is_beside_the_buttons_or_above_them, a_lost_picture_comes_back,
        a_selected_region_keeps_the_colours_of_values, where_there_is_no_curvature_it_is_grey,
        a_click_hits_the_region_that_the_picture_shows, a_click_goes_through_transparent_regions,
        an_incomplete_page_says_so, claims_are_those_that_were_tested,
        the_share_of_faces_below_the_bound_is_not_understated, the_model_stays_in_the_picture_when_the_window_changes,
        one_is_singular_and_long_labels_are_in_order, places_that_only_backgrounds_have_are_not_gone_to,
        another_height_keeps_the_side_of_the_section]) {
        await test(browser);
        console.log(`ok ${test.name}`);
    }
} finally {
    await browser.close();
}
