// The page in a browser.  page_test.mjs PROGRAM REPOSITORY FOLDER
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
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

    await page.type("#region-search", "region 1");
    assert.equal(await page.$eval("#region-count", (e) => e.textContent), "2 of 10 regions");
    assert.deepEqual(errors, []);
    await page.close();
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
    for (const test of [shows_lists_and_isolates, hostile_names_are_text]) {
        await test(browser);
        console.log(`ok ${test.name}`);
    }
} finally {
    await browser.close();
}
