// A browser for tests of pages: headless Chromium, or the Firefox that FIREFOX names, which has WebGL on a display alone.
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";

const kSkipped = 77;
const kPrograms = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];

/** Ends the test: skipped, or failed where REGIONMESH_REQUIRE_BROWSER is set. */
export function skip(reason) {
    console.log(`${process.env.REGIONMESH_REQUIRE_BROWSER ? "FAILED" : "skipped"}: ${reason}`);
    process.exit(process.env.REGIONMESH_REQUIRE_BROWSER ? 1 : kSkipped);
}

export async function launch(repository, hasWebgl = true) {
    const firefox = process.env.FIREFOX, program = firefox ?? process.env.CHROMIUM ?? kPrograms.find(existsSync);
    if (!program) skip("Chromium is not installed: apt install chromium");
    const modules = createRequire(`${repository}/viewer/package.json`);
    let place;
    try {
        place = modules.resolve("puppeteer-core");
    } catch {
        skip("puppeteer-core is not installed: npm ci in viewer");
    }
    const { default: puppeteer } = await import(pathToFileURL(place));
    if (firefox) {
        const webgl = { "webgl.force-enabled": hasWebgl, "webgl.disabled": !hasWebgl };
        return puppeteer.launch({ browser: "firefox", executablePath: program, headless: false, extraPrefsFirefox: webgl });
    }
    const webgl = hasWebgl ? ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"] : ["--disable-3d-apis"];
    return puppeteer.launch({ executablePath: program, args: ["--no-sandbox", ...webgl] });
}

/** Opens a page of ours and waits for its first picture. `errors` gets all that the console says, and refused requests. */
export async function open(browser, path, errors, size = { width: 1300, height: 850 }) {
    const page = await browser.newPage();
    await page.setViewport(size);
    page.on("console", (message) => ["error", "warn"].includes(message.type()) && errors.push(message.text()));
    page.on("pageerror", (error) => errors.push(error.message));
    page.on("request", (request) => {
        if (!/^(file|data|blob):/.test(request.url())) errors.push(`asks the network for ${request.url()}`);
    });
    await page.goto(`file://${path}`);
    await page.waitForSelector("html[data-ready]", { timeout: 60000 });
    return page;
}

/** The number of different colours, and the share of pixels that are not the background, of the picture. */
export function picture(page) {
    return page.evaluate(() => {
        const { stage } = window.regionmesh;
        stage.renderNow();
        const gl = stage.renderer.getContext(), [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
        const pixels = new Uint8Array(4 * width * height), colours = new Map();
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        let drawn = 0, sum = 0;
        for (let n = 0; n < pixels.length; n += 4) {
            const colour = (pixels[n] << 16) | (pixels[n + 1] << 8) | pixels[n + 2];
            colours.set(colour, (colours.get(colour) ?? 0) + 1);
            if (colour !== stage.background) ++drawn;
            sum = (sum * 31 + colour) >>> 0;
        }
        return { colours: colours.size, drawn: drawn / (width * height), sum };
    });
}
