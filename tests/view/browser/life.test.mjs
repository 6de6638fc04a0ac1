// Several tabs, files that change, slow links, and the end of the program.
import assert from "node:assert/strict";
import {rmSync, writeFileSync} from "node:fs";
import {after, before, test} from "node:test";
import {room, storeRoom} from "./room.mjs";
import {Folder, Viewer, assertEqualPictures, assertShowsItsCommand, canvasOf, complaints, openBrowser, open, patience,
        settle, stateOf, until} from "./viewer.mjs";

const folder = new Folder;
let browser, viewer, page;
before(async () => {
    storeRoom(folder);
    [browser, viewer] = await Promise.all([openBrowser(), Viewer.start(folder, "room.json", "--device", "cpu")]);
    page = await open(browser, viewer);
    await settle(page);
});
after(async () => {
    await browser?.close();
    await viewer?.end();
    folder.remove();
});

// Turns the camera, which must arrive.
async function turn(page) {
    const {position} = (await stateOf(page)).camera;
    await page.focus("#picture");
    await page.keyboard.press("ArrowRight");
    await until(page, (now, before) => JSON.stringify(now.camera.position) !== JSON.stringify(before), position);
    return settle(page);
}

test("a tab follows another", async () => {
    const other = await open(browser, viewer);
    await settle(other);
    const before = await canvasOf(page);
    await turn(other);
    await settle(page);
    const seen = await canvasOf(page);
    assertEqualPictures(seen, await canvasOf(other), "both tabs");
    assert.notDeepEqual(seen.pixels, before.pixels);
    await other.close();
    await turn(page);
});

test("a browser has room for eight tabs", async () => {
    const tabs = [];
    for (let i = 0; i < 8; ++i) { // of one profile, which has six connections
        tabs.push(await browser.newPage());
        await tabs[i].goto(viewer.url);
        await settle(tabs[i]);
    }
    await tabs[0].bringToFront();
    await turn(tabs[0]);
    for (const tab of tabs)
        await tab.close();
    await page.bringToFront();
    await turn(page);
});

test("a browser that is killed leaves the viewer answering", async () => {
    const other = await openBrowser();
    await settle(await open(other, viewer));
    other.process().kill("SIGKILL");
    await turn(page);
    await assertShowsItsCommand(page, folder, "after the kill");
});

test("a file that changes is shown anew, and its faults are told", async () => {
    const fault = () => page.$eval("#fault", each => each.hidden ? "" : each.textContent);
    const {view} = await settle(page);
    storeRoom(folder, {albedo: [0.1, 0.2, 0.9]});
    await until(page, (now, view) => now.view > view, view);
    await assertShowsItsCommand(page, folder, "the changed file");
    const seen = await canvasOf(page);
    for (const text of ["{", JSON.stringify({...room(), spheres: 7})]) {
        writeFileSync(folder.of("room.json"), text);
        await page.waitForFunction(() => !element("fault").hidden, {timeout: patience});
        assert.match(await fault(), /room\.json/);
        assert.deepEqual((await canvasOf(page)).pixels, seen.pixels, "the old picture stays");
        storeRoom(folder, {albedo: [0.1, 0.2, 0.9]});
        await page.waitForFunction(() => element("fault").hidden, {timeout: patience});
    }
    rmSync(folder.of("floor.obj"));
    await page.waitForFunction(() => !element("fault").hidden, {timeout: patience});
    assert.match(await fault(), /floor\.obj/);
    storeRoom(folder);
    await page.waitForFunction(() => element("fault").hidden, {timeout: patience});
    await assertShowsItsCommand(page, folder, "the mended file");
});

test("a slow link leaves the page usable, and ends at the last view", async () => {
    const client = await page.createCDPSession();
    await client.send("Network.enable");
    const limit = (latency, bytes) => client.send("Network.emulateNetworkConditions", {
        offline: false, latency, downloadThroughput: bytes, uploadThroughput: bytes});
    await limit(150, 100_000);
    const {x, y, width, height} = await (await page.$("#picture")).boundingBox();
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.down();
    let slowest = 0;
    for (let i = 1; i <= 30; ++i) {
        const start = performance.now();
        await page.mouse.move(x + width * (0.5 + 0.01 * i), y + height / 2);
        await page.evaluate(() => new Promise(requestAnimationFrame));
        slowest = Math.max(slowest, performance.now() - start);
    }
    await page.mouse.up();
    assert.ok(slowest < 1000, `the page answers within ${slowest} ms`);
    const wished = await page.evaluate(() => orbit.position);
    const now = await settle(page);
    await limit(0, -1);
    now.camera.position.forEach((value, i) => assert.ok(Math.abs(value - wished[i]) < 1e-6));
    await assertShowsItsCommand(page, folder, "the last view");
});

test("nothing was complained of", () => assert.deepEqual(complaints, []));

for (const [signal, status, options] of [["SIGINT", 130, ["--device", "cpu"]], ["SIGTERM", 143, []]])
    test(`${signal} ends a viewer within a second that renders, with pages open`, async () => {
        storeRoom(folder, {settings: {spp: 65536}}, "long.json");
        const long = await Viewer.start(folder, "long.json", ...options);
        const pages = [await open(browser, long, {mayFail: true}), await open(browser, long, {mayFail: true})];
        await pages[0].waitForFunction(() => state?.renderers.length > 0);
        if (options.length > 0) // else a driver is still compiling
            await pages[0].waitForFunction(() => state.renderers[0].samples > 0);
        const {code, millis} = await long.end(signal);
        assert.equal(code, status);
        assert.ok(millis < 1000, `${millis} ms`);
        for (const each of pages) {
            await each.waitForFunction(() => element("fault").textContent.includes("does not answer"),
                                       {timeout: patience});
            await each.close();
        }
    });
