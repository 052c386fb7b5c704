// Builds dist/page.html: the skeleton with the style and the compressed script inside. Needs `npm ci` in this folder.
//   node build.mjs          writes dist/page.html
//   node build.mjs --check  fails where dist/page.html is not what the sources give
import { build } from "esbuild";
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { deflateSync } from "node:zlib";

const folder = dirname(fileURLToPath(import.meta.url));
const common = { bundle: true, minify: true, write: false, legalComments: "none", target: "es2022", charset: "ascii" };

async function bundled(entry, more = {}) {
    const made = await build({ ...common, entryPoints: [join(folder, "src", entry)], ...more });
    return made.outputFiles[0].text.trim();
}

const script = await bundled("main.js", { format: "iife" });
const style = await bundled("page.css");
const packed = deflateSync(script, { level: 9 }).toString("base64");
const [complete, loader] = await Promise.all(["complete.js", "loader.js"].map((entry) => bundled(entry, { format: "iife" })));
const page = readFileSync(join(folder, "src/page.html"), "utf8")
    .replace("<!--COMPLETE-->", () => `<script>${complete}</script>`)
    .replace("<!--STYLE-->", () => `<style>${style}</style>`)
    .replace("<!--SCRIPT-->", () => `<script type="text/plain" id="viewer">${packed}</script>\n<script>${loader}</script>`);

const target = join(folder, "dist/page.html");
if (process.argv.includes("--check")) {
    if (readFileSync(target, "utf8") !== page) {
        console.error("viewer/dist/page.html is older than its sources: run script/viewer");
        process.exit(1);
    }
} else {
    writeFileSync(target, page);
    console.log(`${target}: ${page.length} bytes, the script ${script.length} before compression`);
}
