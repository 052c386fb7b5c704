// A picture of a folder .precomputed in Neuroglancer, for the docs. A server of this folder's parent must run at
// http://localhost:8080.
//   node picture.mjs FOLDER PICTURE.png|.webp [JSON]
// JSON is put over the state that the folder has: '{"projectionOrientation": [0, 0, 0, 1]}'.
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { launch } from "../../tests/viewer/browser.mjs";
import { serve } from "../../tests/viewer/serve.mjs";
import { bundle } from "./bundle.mjs";

const [folder, picture, more = "{}"] = process.argv.slice(2);
const repository = resolve(import.meta.dirname, "../.."), place = mkdtempSync(join(tmpdir(), "neuroglancer-"));
await bundle(repository, place);
const server = await serve({ "/viewer": place }), browser = await launch(repository);
try {
    const page = await browser.newPage();
    await page.setViewport({ width: 1200, height: 760 });
    const state = { ...JSON.parse(readFileSync(join(folder, "state.json"), "utf8")), ...JSON.parse(more) };
    await page.goto(`http://127.0.0.1:${server.address().port}/viewer/index.html#!${encodeURIComponent(JSON.stringify(state))}`);
    await page.waitForFunction("viewer.isReady()", { timeout: 300000, polling: 500 });
    await page.screenshot({ path: picture, ...(picture.endsWith(".webp") && { type: "webp", quality: 90 }) });
} finally {
    await browser.close();
    server.close();
    rmSync(place, { recursive: true });
}
