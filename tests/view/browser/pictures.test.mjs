// The canvas shows, to the last level, the picture that the command in the page makes.
import {after, before, test} from "node:test";
import {storeRoom} from "./room.mjs";
import {Folder, Viewer, assertShowsItsCommand, openBrowser, open, settle, stateOf, until} from "./viewer.mjs";

const folder = new Folder;
let browser, viewer, page;
before(async () => {
    [browser, viewer] = await Promise.all([openBrowser(),
        Viewer.start(folder, storeRoom(folder), "--device", "cpu", "--max-depth", "4")]);
    page = await open(browser, viewer);
});
after(async () => {
    await browser?.close();
    await viewer?.end();
    folder.remove();
});

test("raw", () => assertShowsItsCommand(page, folder, "raw"));

test("clean", async () => {
    await page.click("#clean");
    await until(page, now => now.clean);
    await assertShowsItsCommand(page, folder, "clean");
    await page.keyboard.press("4"); // which no denoiser cleans
    await until(page, now => now.show !== null && !now.canBeClean);
    await assertShowsItsCommand(page, folder, "a layer");
    await page.keyboard.press("0");
    await until(page, now => now.show === null);
    await page.keyboard.press("c");
    await until(page, now => !now.clean);
});

test("tone curves and exposures", async () => {
    for (const tone of ["gamma", "srgb", "aces", "agx"]) {
        await page.select("#tone", tone);
        for (const key of ["e", "E"]) {
            await page.focus("#picture");
            await page.keyboard.press(key);
            await assertShowsItsCommand(page, folder, `${tone} after ${key}`);
        }
    }
    await page.select("#tone", "gamma");
});

test("layers by number", async () => {
    const {integrators} = await stateOf(page);
    for (const [index, {name}] of integrators.entries()) {
        await page.focus("#picture");
        await page.keyboard.press(String(index + 1));
        await until(page, (now, name) => now.show === name, name);
        await assertShowsItsCommand(page, folder, name);
    }
    await page.keyboard.press("0");
    await until(page, now => now.show === null);
    await settle(page);
});
