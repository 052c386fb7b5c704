// Bundles the viewer of the npm package neuroglancer into a folder with an index.html:  bundle.mjs REPOSITORY FOLDER
import { copyFileSync, mkdirSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";

/** The workers are scripts of their own, which the main one asks for by name. */
const kEntries = ["main.bundle.js", "chunk_worker.bundle.js", "async_computation.bundle.js"];

const noIcons = {
    name: "no icons",
    setup(build) {
        build.onResolve({ filter: /^ikonate\// }, ({ path }) => ({ path, namespace: "icon" }));
        build.onLoad({ filter: /.*/, namespace: "icon" }, () => ({ contents: "<svg/>", loader: "text" }));
    },
};

export async function bundle(repository, folder) {
    const viewer = createRequire(`${repository}/viewer/package.json`);
    const here = createRequire(`${repository}/viewer/neuroglancer/package.json`);
    const { build } = await import(pathToFileURL(viewer.resolve("esbuild")));
    const place = (file) => here.resolve(`neuroglancer/unstable/${file}`);
    mkdirSync(folder, { recursive: true });
    await build({
        entryPoints: kEntries.map(place),
        entryNames: "[name]",
        outdir: folder,
        bundle: true,
        minify: true,
        format: "esm",
        target: "es2022",
        logLevel: "error",
        loader: { ".svg": "text", ".wasm": "file", ".html": "text" },
        plugins: [noIcons],
    });
    copyFileSync(place("mesh/draco/neuroglancer_draco.wasm"), `${folder}/neuroglancer_draco.wasm`);
    writeFileSync(`${folder}/index.html`, `<!doctype html><meta charset="utf-8"><title>Neuroglancer</title>
<link rel="icon" href="data:,"><link rel="stylesheet" href="main.bundle.css"><body>
<div id="neuroglancer-container"></div><script type="module" src="main.bundle.js"></script>`);
}

if (process.argv[1] === import.meta.filename) await bundle(...process.argv.slice(2));
