// viewer/dist/page.html is what viewer/src gives.  bundle_test.mjs REPOSITORY
import { spawnSync } from "node:child_process";
import { existsSync } from "node:fs";
import { skip } from "./browser.mjs";

const folder = `${process.argv[2]}/viewer`;
if (!existsSync(`${folder}/node_modules/esbuild`)) skip("esbuild is not installed: npm ci in viewer");
process.exit(spawnSync(process.execPath, [`${folder}/build.mjs`, "--check"], { stdio: "inherit" }).status);
