// Two renderers: which bits differ, and how the page shows it.
import assert from "node:assert/strict";
import {readFileSync} from "node:fs";
import {after, before, test} from "node:test";
import {storeRoom} from "./room.mjs";
import {Folder, Viewer, assertEqualPictures, canvasOf, complaints, openBrowser, open, settle} from "./viewer.mjs";

const folder = new Folder;
let browser, scene;
before(async () => {
    scene = storeRoom(folder);
    browser = await openBrowser();
});
after(async () => {
    await browser?.close();
    folder.remove();
});

async function withPage(first, second, body) {
    const viewer = await Viewer.start(folder, scene, "--device", first, "--against", second);
    const page = await open(browser, viewer);
    try {
        await settle(page);
        await page.waitForFunction(() => state.difference.samples === state.samplesPerPixel);
        await page.focus("#picture");
        await body(page);
    } finally {
        await page.close();
        await viewer.end();
    }
}

const text = page => page.$eval("#difference", each => [each.textContent, each.classList.contains("is-wrong")]);

// Three floats for each pixel, in hexadecimal, from the top.
async function framePixels(page, renderer) {
    const text = await page.evaluate(async renderer => {
        const bytes = new Uint8Array(await (await fetch(`/frame?renderer=${renderer}`)).arrayBuffer());
        return Array.from(bytes, byte => byte.toString(16).padStart(2, "0")).join("");
    }, renderer);
    const floats = text.slice(-96 * 64 * 24);
    return Array.from({length: 96 * 64}, (_, i) => floats.slice(24 * i, 24 * (i + 1)));
}

async function pfmPixels(device) {
    await folder.run(`hyalite render ${scene} --device=${device} --quiet -o picture.pfm`);
    const floats = readFileSync(folder.of("picture.pfm")).subarray(-96 * 64 * 12);
    const at = i => 12 * ((63 - Math.floor(i / 96)) * 96 + i % 96); // rows are from the bottom
    return Array.from({length: 96 * 64}, (_, i) => floats.toString("hex", at(i), at(i) + 12));
}

test("a device and the CPU: no bit differs", () => withPage("llvmpipe", "cpu", async page => {
    assert.deepEqual(await text(page), ["At 8 samples none of 6144 pixels differs in any bit.", false]);
    const seen = await canvasOf(page);
    await page.keyboard.press("f");
    await settle(page);
    assertEqualPictures(await canvasOf(page), seen, "the second");
    await page.keyboard.press("b");
    assert.ok((await canvasOf(page)).pixels.every(value => value === 0), "the map of bits is black");
}));

test("the CPU in double precision is told, and shown where", () => withPage("cpu", "cpu-double", async page => {
    const [single, double] = [await framePixels(page, 0), await framePixels(page, 1)];
    assert.deepEqual(single, await pfmPixels("cpu"));
    const differs = single.map((pixel, i) => pixel !== double[i]);
    const count = differs.filter(each => each).length;
    assert.ok(count > 0 && count < 96 * 64, `${count} pixels differ`);
    assert.deepEqual(await text(page), [`At 8 samples ${count} of 6144 pixels differ in any bit.`, true]);
    await page.keyboard.press("b");
    const {pixels} = await canvasOf(page);
    assert.ok(differs.every((each, i) => pixels[3 * i] === (each ? 255 : 0) && pixels[3 * i + 1] === 0), "red there");
    assert.equal(await page.$eval('[data-mode="bits"]', button => button.getAttribute("aria-pressed")), "true");
}));

test("flip and slider show what they say", () => withPage("cpu", "cpu-double", async page => {
    const shown = {};
    for (const name of ["cpu", "cpu-double"]) {
        await settle(page);
        shown[name] = await canvasOf(page);
        const command = await page.$eval("#command", area => area.value);
        assertEqualPictures(shown[name], await folder.picture(command), `${name}: ${command}`);
        await page.keyboard.press("f");
    }
    await page.keyboard.press("s");
    assert.ok(await page.$eval("#split", split => split.offsetHeight > 0 && split.matches(":not([hidden])")));
    for (const [key, begin] of [["Home", 0], ["End", 96]]) {
        await page.focus("#split");
        await page.keyboard.press(key);
        assertEqualPictures(await canvasOf(page), shown[begin === 0 ? "cpu-double" : "cpu"], key);
    }
    const box = await (await page.$("#split")).boundingBox();
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    const split = await page.$eval("#split", each => Number(each.value));
    assert.ok(Math.abs(split - 0.5) < 0.05);
    const {pixels} = await canvasOf(page);
    for (let i = 0; i < 96 * 64; ++i)
        assert.equal(pixels[3 * i], shown[i % 96 < Math.round(96 * split) ? "cpu" : "cpu-double"].pixels[3 * i]);
}));

test("nothing was complained of", () => assert.deepEqual(complaints, []));
