// What convert writes for Neuroglancer, in Neuroglancer.  neuroglancer_test.mjs PROGRAM REPOSITORY FOLDER [PICTURE]
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { launch, skip } from "./browser.mjs";
import { bundle } from "../../viewer/neuroglancer/bundle.mjs";
import { serve } from "./serve.mjs";

const [program, repository, folder, kept] = process.argv.slice(2);
const kRed = [255, 0, 0], kBlue = [0, 0, 255];

if (!existsSync(`${repository}/viewer/neuroglancer/node_modules/neuroglancer`))
    skip("neuroglancer is not installed: npm ci --ignore-scripts in viewer/neuroglancer");
if (!existsSync(`${repository}/viewer/node_modules/esbuild`)) skip("esbuild is not installed: npm ci in viewer");

const run = (...words) => execFileSync(program, words, { encoding: "utf8" });

/** A folder of pieces, whose regions 1 to 10 are called "grain 1" and so on. The odd ones are red, the even ones blue. */
function make_model() {
    rmSync(folder, { recursive: true, force: true });
    mkdirSync(folder, { recursive: true });
    let names = "label,name,colour\n";
    for (let label = 1; label <= 10; ++label) names += `${label},grain ${label},${label % 2 ? "#ff0000" : "#0000ff"}\n`;
    writeFileSync(`${folder}/names.csv`, names);
    run("reconstruct", `${repository}/tests/data/solvers/polycrystal.nii.gz`, "-o", `${folder}/model/`, "--names", `${folder}/names.csv`,
        "--reduce", "80%", "--block-size", "20", "--quiet");
}

/**
 * Opens a state in the viewer and waits until all that is in view is loaded. `errors` gets all that the console says, and
 * requests that fail or leave this machine; requests that the viewer itself withdraws, to make others first, do not fail.
 */
async function open(browser, server, state, errors) {
    const base = `http://127.0.0.1:${server.address().port}`;
    const page = await browser.newPage();
    await page.setViewport({ width: 900, height: 700 });
    page.on("console", (message) => ["error", "warn"].includes(message.type()) && errors.push(message.text()));
    page.on("pageerror", (error) => errors.push(error.message));
    page.on("requestfailed", (request) => {
        const why = request.failure()?.errorText;
        if (why !== "net::ERR_ABORTED") errors.push(`${request.url()}: ${why}`);
    });
    page.loaded = 0;
    page.on("response", (response) => {
        if (response.status() >= 400) errors.push(`${response.url()}: ${response.status()}`);
        if (response.url().includes("/model.precomputed/")) page.loaded += Number(response.headers()["content-length"]);
    });
    page.on("request", (request) => {
        const url = request.url();
        if (!url.startsWith(base) && !/^(data|blob):/.test(url)) errors.push(`asks for ${url}`);
    });
    await page.goto(`${base}/viewer/index.html#!${encodeURIComponent(JSON.stringify(state(base)))}`);
    await page.waitForFunction("viewer.chunkQueueManager.flushPendingChunkUpdates(), viewer.isReady()", { timeout: 120000, polling: 200 })
        .catch((error) => assert.fail(`${error.message}: ${errors.join("; ")}`));
    return page;
}

/** The number of pixels of each colour, whatever the shading, in a picture of the page. */
async function count(page, colours) {
    const data = await page.screenshot({ encoding: "base64" });
    return page.evaluate(async (source, wanted) => {
        const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${source}`)).blob());
        const canvas = new OffscreenCanvas(image.width, image.height).getContext("2d");
        canvas.drawImage(image, 0, 0);
        const { data: pixels } = canvas.getImageData(0, 0, image.width, image.height);
        return wanted.map((colour) => {
            let found = 0;
            for (let n = 0; n < pixels.length; n += 4) {
                const most = Math.max(pixels[n], pixels[n + 1], pixels[n + 2]);
                const fits = (axis) => Math.abs(pixels[n + axis] - (most * colour[axis]) / 255) <= 0.1 * most;
                if (most > 40 && fits(0) && fits(1) && fits(2)) ++found;
            }
            return found;
        });
    }, data, colours);
}

/** The state that convert writes, with this server, from `times` as far. */
const state_written = (times) => (base) => {
    const state = JSON.parse(readFileSync(`${folder}/model.precomputed/state.json`, "utf8"));
    state.layers[0].source = state.layers[0].source.replace("http://localhost:8080", base);
    state.projectionOrientation = [0.3, 0.3, 0, 0.9];
    state.projectionScale *= times;
    return state;
};

/** Returns the bytes of the meshes that were loaded. */
async function shows_colours_and_names(browser, server, name) {
    const errors = [], page = await open(browser, server, state_written(1), errors);
    const counts = await count(page, [kRed, kBlue]);
    assert.ok(counts.every((found) => found > 5000), `red and blue fill ${counts} pixels; ${errors.join("; ")}`);
    const told = await page.evaluate("document.querySelector('.neuroglancer-side-panel').textContent");
    for (const word of ["grain 1", "grain 10", "10/10 visible"]) assert.ok(told.includes(word), `${word} is not in the list: ${told}`);
    assert.deepEqual(errors, []);
    if (kept) await page.screenshot({ path: kept.replace(".png", `-${name}.png`) });
    await page.close();
    return page.loaded;
}

/** From afar the coarsest level is enough. */
async function loads_less_from_afar(browser, server, near) {
    const errors = [], page = await open(browser, server, state_written(100), errors);
    assert.deepEqual(errors, []);
    assert.ok(page.loaded > 0 && page.loaded < near / 3, `${page.loaded} bytes from afar, ${near} from near`);
    await page.close();
}

await bundle(repository, `${folder}-viewer`);
make_model();
const browser = await launch(repository);
const server = await serve({ "/viewer": `${folder}-viewer`, "/model.precomputed": `${folder}/model.precomputed` });
try {
    for (const [name, ...options] of [["legacy", "--precomputed", "legacy"], ["multi", "--levels", "2"], ["sharded", "--levels", "2", "--sharded"]]) {
        rmSync(`${folder}/model.precomputed`, { recursive: true, force: true });
        run("convert", `${folder}/model`, `${folder}/model.precomputed`, "--units", "um",
            "--quiet", ...options);
        const near = await shows_colours_and_names(browser, server, name);
        if (name === "sharded") await loads_less_from_afar(browser, server, near);
        console.log(`ok ${name}: ${JSON.parse(readFileSync(`${folder}/model.precomputed/info`, "utf8"))["@type"]}`);
    }
} finally {
    await browser.close();
    server.close();
}
