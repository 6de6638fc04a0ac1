// Mouse, wheel, keys and fingers move the camera as they are meant to.
import assert from "node:assert/strict";
import {after, before, beforeEach, test} from "node:test";
import {storeRoom} from "./room.mjs";
import {Folder, Viewer, assertShowsItsCommand, complaints, openBrowser, open, patience, settle, stateOf,
        until} from "./viewer.mjs";

const folder = new Folder;
const camera = {aperture: 0.5, focusDistance: 6};
let browser, viewer, page, atFirst, box;
before(async () => {
    const scene = storeRoom(folder, {camera, settings: {spp: 1}});
    [browser, viewer] = await Promise.all([openBrowser(), Viewer.start(folder, scene, "--device", "cpu")]);
    page = await open(browser, viewer);
    atFirst = (await settle(page)).camera;
    box = await (await page.$("#picture")).boundingBox();
});
after(async () => {
    await browser?.close();
    await viewer?.end();
    folder.remove();
});

beforeEach(async () => { // `r` brings back the camera
    if (JSON.stringify((await stateOf(page)).camera) !== JSON.stringify(atFirst))
        await reset();
    await settle(page);
});

const subtract = (a, b) => a.map((x, i) => x - b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const normalized = a => a.map(x => x / Math.hypot(...a));
const along = (camera, distance) => camera.position.map((x, i) => x + distance * camera.direction[i]);
const near = (a, b, allowed, what) => [a].flat().forEach(
    (x, i) => assert.ok(Math.abs(x - [b].flat()[i]) <= allowed, `${what}: ${a} and ${b}`));

const pick = (x, y) => page.evaluate(async (x, y) => (await fetch(`/pick?x=${x}&y=${y}`)).json(), x, y);
const at = (x, y) => [box.x + x * box.width, box.y + y * box.height];
const moved = async () => {
    await until(page, (now, first) => JSON.stringify(now.camera) !== JSON.stringify(first), atFirst);
    return (await settle(page)).camera;
};
async function drag(from, to, options = {}) {
    await page.mouse.move(...at(...from));
    await page.mouse.down(options);
    await page.mouse.move(...at(...to), {steps: 5});
    await page.mouse.up(options);
}
async function press(...keys) {
    await page.focus("#picture");
    for (const key of keys)
        await page.keyboard.press(key);
}

// About the point in the middle of the first picture, by so many radians, to the right and up.
async function assertOrbited(right, up) {
    const middle = along(atFirst, (await pickAtFirst()).depth);
    const now = await moved();
    const arms = [atFirst, now].map(camera => subtract(camera.position, middle));
    near(Math.hypot(...arms[1]), Math.hypot(...arms[0]), 1e-6, "the distance of what it turns about");
    near(now.direction, normalized(arms[1]).map(x => -x), 1e-6, "it looks there");
    const angles = arms.map(arm => [Math.atan2(arm[0], arm[2]), Math.asin(arm[1] / Math.hypot(...arm))]);
    near(angles[1][0] - angles[0][0], -right, 0.02, "to the right");
    near(angles[1][1] - angles[0][1], up, 0.02, "up");
}
let first = null;
const pickAtFirst = async () => first ??= await pick(0.5, 0.5);

async function reset() {
    await press("r");
    await until(page, (now, first) => JSON.stringify(now.camera) === JSON.stringify(first), atFirst);
    await settle(page);
}

// What lies in the middle of the first picture is now at these shares of width and height.
async function assertPanned(x, y, allowed = 2e-3) {
    const {depth} = await pickAtFirst();
    const now = await moved();
    near(now.direction, atFirst.direction, 1e-9, "the direction");
    const right = normalized(cross(now.direction, now.up));
    const arm = subtract(along(atFirst, depth), now.position);
    const width = 2 * depth * Math.tan(now.fov * Math.PI / 360);
    near(dot(arm, now.direction), depth, 1e-6, "the depth");
    near(dot(arm, right) / width, x - 0.5, allowed, "x");
    near(-dot(arm, cross(right, now.direction)) / width * box.width / box.height, y - 0.5, allowed, "y");
}

async function assertCameNearer(factor, allowed = 1e-6) {
    const {depth} = await pickAtFirst();
    const now = await moved();
    near(now.direction, atFirst.direction, 1e-9, "the direction");
    near(Math.hypot(...subtract(along(atFirst, depth), now.position)) / depth, factor, allowed, "the distance");
}

test("a drag turns about the middle", async () => {
    await pickAtFirst();
    await drag([0.5, 0.5], [0.6, 0.55]);
    await assertOrbited(0.1 * Math.PI, 0.05 * Math.PI * box.height / box.width);
});

test("a drag with Shift, and by the right button, moves to the side", async () => {
    await page.keyboard.down("Shift");
    await drag([0.5, 0.5], [0.6, 0.4]);
    await page.keyboard.up("Shift");
    await assertPanned(0.6, 0.4);
    await reset();
    await drag([0.5, 0.5], [0.45, 0.6], {button: "right"});
    await assertPanned(0.45, 0.6);
});

test("the wheel comes nearer", async () => {
    await page.mouse.move(...at(0.5, 0.5));
    await page.mouse.wheel({deltaY: -120});
    await assertCameNearer(Math.exp(-0.15));
});

test("+ and - come nearer and go back", async () => {
    await press("+", "+", "-");
    await assertCameNearer(0.9);
});

test("arrows turn, and with Shift move to the side", async () => {
    await press("ArrowLeft", "ArrowUp");
    await assertOrbited(-Math.PI / 36, Math.PI / 36);
    await reset();
    await page.keyboard.down("Shift");
    await press("ArrowRight");
    await page.keyboard.up("Shift");
    await assertPanned(0.55, 0.5);
});

test("[ and ] change the field of view", async () => {
    await press("[", "[", "]");
    const now = await moved();
    near(now.fov, atFirst.fov - 5, 1e-9, "degrees");
    near(now.position, atFirst.position, 0, "the position");
});

test("a double-click looks at what is there", async () => {
    const {position, distance} = await pick(0.3, 0.7);
    await page.mouse.click(...at(0.3, 0.7), {count: 2});
    const now = await moved();
    near(now.direction, normalized(subtract(position, now.position)), 1e-6, "the direction");
    near(now.position, atFirst.position, 1e-9, "the position");
    const middle = await pick(0.5, 0.5);
    near(middle.position, position, 0.02 * distance, "what is in the middle");
    await drag([0.5, 0.5], [0.55, 0.5]);
    const then = await until(page, (now, before) => JSON.stringify(now.camera) !== JSON.stringify(before), now);
    near(Math.hypot(...subtract(then.camera.position, position)), distance, 1e-5, "the distance after a turn");
});

test("a click tells what is there, and with Alt focuses on it", async () => {
    await page.mouse.click(...at(0.5, 0.5));
    await page.waitForFunction(() => element("point").textContent.startsWith("Pixel 48, 32"), {timeout: patience});
    const text = await page.$eval("#point", point => point.textContent);
    assert.match(text, /^Pixel 48, 32: \d.*\n.*clay, \d/);
    assert.deepEqual((await stateOf(page)).camera, atFirst);
    const {depth} = await pick(0.3, 0.7);
    await page.keyboard.down("Alt");
    await page.mouse.click(...at(0.3, 0.7));
    await page.keyboard.up("Alt");
    const now = await moved();
    near(now.focusDistance, depth, 1e-9, "the focus");
    near(now.position, atFirst.position, 0, "the position");
});

test("fingers: one turns; two move to the side, and come nearer", async () => {
    const client = await page.createCDPSession();
    const touch = (type, ...points) => client.send("Input.dispatchTouchEvent", {type, touchPoints: points.map(
        ([x, y], id) => ({x: at(x, y)[0], y: at(x, y)[1], id}))});
    await touch("touchStart", [0.5, 0.5]);
    for (const x of [0.52, 0.55, 0.58, 0.6])
        await touch("touchMove", [x, 0.5]);
    await touch("touchEnd");
    await assertOrbited(0.1 * Math.PI, 0);

    await reset();
    await touch("touchStart", [0.4, 0.5], [0.6, 0.5]);
    for (const d of [0.02, 0.04, 0.06, 0.08, 0.1])
        await touch("touchMove", [0.4 + d, 0.5 - d], [0.6 + d, 0.5 - d]);
    await touch("touchEnd");
    await assertPanned(0.6, 0.4, 0.01); // one finger moves, and then the other

    await reset();
    await touch("touchStart", [0.4, 0.5], [0.6, 0.5]);
    for (const d of [0.02, 0.04, 0.06, 0.08, 0.1])
        await touch("touchMove", [0.4 - d, 0.5], [0.6 + d, 0.5]);
    await touch("touchEnd");
    await assertCameNearer(0.5, 1e-3);
});

test("answers that come after all news leave the hands the camera", async () => {
    await press("]");
    await moved();
    await page.evaluate(() => {
        const fetchNow = window.fetch;
        window.fetch = async (address, options) => {
            const response = await fetchNow(address, options);
            await new Promise(resolve => setTimeout(resolve, options?.method === "POST" ? 500 : 0));
            return response;
        };
    });
    await reset();
    await press("ArrowUp");
    await assertOrbited(0, Math.PI / 36);
});


test("the wheel makes an orthographic camera show less, and r all of it again", async () => {
    const scene = storeRoom(folder, {camera: {type: "orthographic", viewWidth: 8, horizontalFov: undefined}, settings: {spp: 1}},
                            "orthographic.json");
    const own = await Viewer.start(folder, scene, "--device", "cpu");
    const tab = await open(browser, own);
    try {
        const before = (await settle(tab)).camera;
        near(before.viewWidth, 8, 0, "the width of the scene");
        await tab.focus("#picture");
        await tab.keyboard.press("+");
        await until(tab, now => now.camera.viewWidth < 8);
        const now = (await settle(tab)).camera;
        near(now.viewWidth, 7.2, 1e-9, "the width");
        near(now.position, before.position, 1e-9, "the place");
        await assertShowsItsCommand(tab, folder, "zoomed");
        await tab.keyboard.press("r");
        await until(tab, now => now.camera.viewWidth === 8);
    } finally {
        await tab.close();
        await own.end();
    }
});

test("nothing was complained of", () => assert.deepEqual(complaints, []));
