// The page: sizes, controls, downloads, and what it looks like. Screenshots are stored for eyes.
import assert from "node:assert/strict";
import {existsSync, renameSync} from "node:fs";
import {after, before, test} from "node:test";
import {setTimeout as sleep} from "node:timers/promises";
import {storeRoom} from "./room.mjs";
import {Folder, Viewer, assertEqualPictures, assertShowsItsCommand, canvasOf, commandOf, complaints, openBrowser, open,
        readPng, settle, until} from "./viewer.mjs";

const folder = new Folder;
let browser, viewer, page;
before(async () => {
    [browser, viewer] = await Promise.all([openBrowser(),
        Viewer.start(folder, storeRoom(folder), "--device", "cpu", "--against", "cpu-double")]);
    page = await open(browser, viewer);
    await settle(page);
});
after(async () => {
    await browser?.close();
    await viewer?.end();
    folder.remove();
});

// The whole picture, in its proportions.
const assertIsWhole = page => page.evaluate(() => {
    const [picture, stage] = ["picture", "stage"].map(id => element(id).getBoundingClientRect());
    const isInside = picture.left >= stage.left - 0.5 && picture.right <= stage.right + 0.5 &&
                     picture.top >= stage.top - 0.5 && picture.bottom <= stage.bottom + 0.5;
    const bend = picture.width / picture.height / (canvas.width / canvas.height);
    return [isInside, picture.right <= innerWidth, picture.width > 100, Math.abs(bend - 1) < 0.01];
}).then(holds => assert.deepEqual(holds, [true, true, true, true]));

test("the whole picture is there at any size of the window, and nothing overflows", async () => {
    for (const [width, height] of [[1280, 900], [390, 844], [800, 400], [2000, 600], [701, 900], [320, 568]]) {
        await page.setViewport({width, height});
        await sleep(100);
        await assertIsWhole(page);
        const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        assert.ok(overflow <= 0, `${overflow} pixels too wide at ${width}`);
    }
    await page.setViewport({width: 1280, height: 900});
});

test("screenshots", async () => {
    for (const scheme of ["light", "dark"]) {
        await page.emulateMediaFeatures([{name: "prefers-color-scheme", value: scheme}]);
        for (const width of [1280, 390]) {
            await page.setViewport({width, height: 900});
            await sleep(100);
            await page.screenshot({path: `page-${scheme}-${width}.png`, fullPage: width === 390});
        }
    }
    await page.focus("#picture");
    await page.keyboard.press("?");
    await page.screenshot({path: "help-390.png"});
    await page.keyboard.press("Escape");
    await page.emulateMediaFeatures([]);
    await page.setViewport({width: 1280, height: 900});
});

test("the dialog opens and closes by keyboard", async () => {
    const isOpen = () => page.$eval("#help", help => help.open);
    await page.focus("#picture");
    await page.keyboard.press("?");
    assert.ok(await isOpen());
    await page.keyboard.press("Escape");
    assert.ok(!await isOpen());
    await page.focus("#help-button");
    await page.keyboard.press("Enter");
    assert.ok(await isOpen());
    await page.keyboard.press("Enter"); // on "close", which has the focus
    assert.ok(!await isOpen());
});

test("each control has a name, and Tab comes to it", async () => {
    const nodes = [];
    const collect = node => {
        nodes.push(node);
        node.children?.forEach(collect);
    };
    collect(await page.accessibility.snapshot({interestingOnly: false}));
    const roles = ["button", "checkbox", "combobox", "link", "slider", "spinbutton", "textbox"];
    const controls = nodes.filter(node => roles.includes(node.role));
    assert.ok(controls.length >= 20, `${controls.length} controls`);
    for (const control of controls)
        assert.ok(control.name, `${control.role} has a name`);
    await page.focus("#help-button");
    const reached = new Set;
    for (let i = 0; i < 60; ++i) {
        await page.keyboard.press("Tab");
        reached.add(await page.evaluate(() => document.activeElement.id || document.activeElement.dataset.mode));
    }
    for (const id of ["picture", "first", "bits", "show", "clean", "exposure", "tone", "samples", "width", "height", "fit",
                      "fov", "aperture", "reset", "png", "exr", "json", "command", "copy"])
        assert.ok(reached.has(id), id);
});

test("downloads are what is shown", async () => {
    const client = await browser.target().createCDPSession();
    const contexts = await page.browserContext().id;
    await client.send("Browser.setDownloadBehavior", {behavior: "allow", downloadPath: folder.path, browserContextId: contexts});
    const download = async (id, name) => {
        await page.click(id);
        for (let i = 0; i < 100 && !existsSync(folder.of(name)); ++i)
            await sleep(50);
        assert.ok(existsSync(folder.of(name)), name);
    };
    await page.focus("#picture");
    await page.keyboard.press("ArrowLeft");
    await until(page, now => now.renderers[0].command.includes("--camera-position"));
    await page.select("#tone", "agx");
    await settle(page);
    const shown = await canvasOf(page);
    await download("#png", "room.png");
    assertEqualPictures(shown, readPng(folder.of("room.png")), "the PNG");
    await download("#exr", "room.exr");
    await folder.run("hyalite tonemap room.exr picture.png --tone agx");
    assertEqualPictures(shown, readPng(folder.of("picture.png")), "the EXR");
    await download("#json", "room-view.json");
    renameSync(folder.of("room.exr"), folder.of("first.exr"));
    assertEqualPictures(shown, await folder.picture("hyalite render room-view.json --device cpu --tone agx -o picture.png"),
                        "the scene file");
    await folder.run("hyalite render room-view.json --device cpu -o room.exr && hyalite diff first.exr room.exr");
    await page.select("#tone", "gamma");
});

test("a picture as large as the window", async () => {
    await page.select("#show", "albedo"); // soon done
    await until(page, now => now.show === "albedo");
    await page.setViewport({width: 900, height: 400});
    await page.click("#fit");
    const size = await page.$eval("#stage", stage => [stage.clientWidth, stage.clientHeight]);
    await until(page, (now, size) => now.width === size[0] && now.height === size[1], size);
    await assertShowsItsCommand(page, folder, "the size of the window");
    await assertIsWhole(page);
});

test("a picture of 3840 x 2160 arrives", async () => {
    const large = await Viewer.start(folder, "room.json", "--device", "cpu", "--integrator", "albedo", "--spp", "1",
                                     "--width", "3840", "--height", "2160");
    const other = await open(browser, large);
    await settle(other);
    const command = await commandOf(other);
    for (const row of [0, 1500, 2157]) {
        const rows = command.replace(" -o ", ` --crop=0,3840,${row},${row + 3} -o `);
        assertEqualPictures(await canvasOf(other, row, 3), await folder.picture(rows), `rows from ${row}`, true);
    }
    await other.close();
    await large.end();
});

test("an address without its token shows nothing", async () => {
    const context = await browser.createBrowserContext();
    const stranger = await context.newPage();
    for (const path of ["/", "/state", "/picture.png", "/?token=0"]) {
        const response = await stranger.goto(viewer.origin + path);
        assert.equal(response.status(), 403, path);
    }
    assert.match(await stranger.$eval("body", body => body.textContent), /token/);
});

test("nothing was complained of", () => assert.deepEqual(complaints, []));
