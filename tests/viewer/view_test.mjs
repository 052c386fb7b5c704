// What the picture of the page shows, in a browser.  view_test.mjs PROGRAM REPOSITORY FOLDER
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync } from "node:fs";
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

const browser = await launch(repository);
try {
    run("reconstruct", `${repository}/tests/data/solvers/polycrystal.nii.gz`, "-o", `${folder}/poly.vtp`, "--reduce", "80%", "--quiet");
    run("view", `${folder}/poly.vtp`, "-o", `${folder}/poly.html`);
    for (const test of [cuts_colours_and_explodes]) {
        await test(browser);
        console.log(`ok ${test.name}`);
    }
} finally {
    await browser.close();
}
