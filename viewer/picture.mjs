// A picture of a page in headless Chromium, for the docs:
//   node picture.mjs PAGE PICTURE.png|.webp [WIDTHxHEIGHT] [CODE]
// CODE runs in the page first; `regionmesh` holds stage, regions, tools and act (main.js).
import { resolve } from "node:path";
import { launch, open } from "../tests/viewer/browser.mjs";

const [path, picture, size = "1200x760", code] = process.argv.slice(2);
const [width, height] = size.split("x").map(Number);
const errors = [], browser = await launch(resolve(import.meta.dirname, ".."));
try {
    const page = await open(browser, resolve(path), errors, { width, height });
    if (code) await page.evaluate(code);
    await new Promise((done) => setTimeout(done, 1500));  // the whole model after the coarse one
    await page.evaluate("regionmesh.stage?.renderNow()");
    await page.screenshot({ path: picture, ...(picture.endsWith(".webp") && { type: "webp", quality: 90 }) });
} finally {
    await browser.close();
}
for (const error of errors) console.error(error);
