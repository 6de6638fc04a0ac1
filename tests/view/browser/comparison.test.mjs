// The page of `compare --html` and `diff --html`, opened from disk: what it shows, and what is under the pointer.
import assert from "node:assert/strict";
import {after, before, test} from "node:test";
import {storeRoom} from "./room.mjs";
import {Folder, assertEqualPictures, canvasOf, complaints, open, openBrowser, readPng} from "./viewer.mjs";

const folder = new Folder;
let browser, page, first, second;
before(async () => {
    const room = storeRoom(folder);
    const render = (name, exposure) =>
        folder.run(`hyalite render ${room} --device cpu --spp 2 --exposure ${exposure} --quiet -o ${name}.png`);
    [browser] = await Promise.all([openBrowser(), render("first", 0), render("second", 1)]);
    await folder.run("hyalite diff first.png second.png --html page.html || test $? = 1");
    [first, second] = ["first.png", "second.png"].map(name => readPng(folder.of(name)));
    page = await open(browser, {url: `file://${folder.of("page.html")}`, origin: "null"});
    await page.waitForFunction("canvas.width > 1");
    await page.evaluate("canvas.style.width = '96px', canvas.style.minHeight = '0', canvas.style.height = '64px'");
    await page.waitForFunction("canvas.width === 96 && canvas.height === 64");
    await page.evaluate("fit(), state.pixel = null, draw()");
});
after(async () => {
    await browser?.close();
    folder.remove();
});

// Each frame draws what was asked for by the one before.
const shown = async () => {
    await page.evaluate(() => new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve))));
    return page.evaluate("state.pixel = null, draw()").then(() => canvasOf(page));
};
const pointAtPicture = () => page.$eval("#canvas", element => {
    const {left, top, width, height} = element.getBoundingClientRect();
    return [left + width / 2, top + height / 2];
}).then(place => page.mouse.move(...place));

test("keys show either picture", async () => {
    assertEqualPictures(await shown(), first, "at first");
    await page.keyboard.press("2");
    assertEqualPictures(await shown(), second, "after 2");
    await page.keyboard.press(" ");
    assertEqualPictures(await shown(), first, "after Space");
});

test("the pointer swaps them once it is asked to", async () => {
    await pointAtPicture();
    assertEqualPictures(await shown(), first, "under the pointer");
    await page.keyboard.press("h");
    assertEqualPictures(await shown(), second, "under the pointer after h");
    await page.mouse.move(1, 1);
    assertEqualPictures(await shown(), first, "when it has left");
    await page.keyboard.press("2");
    assertEqualPictures(await shown(), second, "the other one is chosen");
    await pointAtPicture();
    assertEqualPictures(await shown(), first, "and swapped");
    await page.click("#hover");
    await pointAtPicture();
    assertEqualPictures(await shown(), second, "no longer");
});

test("nothing is complained of", () => assert.deepEqual(complaints, []));
