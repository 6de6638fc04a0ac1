// A viewer, the browser that looks at it, and what both show.
import assert from "node:assert/strict";
import {spawn, execFile} from "node:child_process";
import {mkdtempSync, readFileSync, rmSync, symlinkSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {promisify} from "node:util";
import {inflateSync} from "node:zlib";
import puppeteer from "puppeteer-core";

const program = process.env.PROGRAM;
export const patience = 60_000; // milliseconds

// A folder of its own, in which the viewer runs and `hyalite` is a command.
export class Folder {
    constructor() {
        this.path = mkdtempSync(join(tmpdir(), "hyalite-view-"));
        symlinkSync(program, this.of("hyalite"));
    }
    of(name) { return join(this.path, name); }
    remove() { rmSync(this.path, {recursive: true}); }

    // What a line of a shell prints.
    async run(line) {
        const environment = {...process.env, PATH: `${this.path}:${process.env.PATH}`};
        const {stdout} = await promisify(execFile)("bash", ["-c", line], {cwd: this.path, env: environment});
        return stdout;
    }
    // The picture that this line writes as picture.png.
    async picture(line) {
        await this.run(line);
        return readPng(this.of("picture.png"));
    }
}

export class Viewer {
    static async start(folder, ...options) {
        const viewer = new Viewer;
        viewer.process = spawn(program, ["view", ...options], {cwd: folder.path, stdio: ["ignore", "pipe", "pipe"]});
        viewer.ended = new Promise(resolve => viewer.process.on("exit", (code, signal) => resolve({code, signal})));
        viewer.errors = "";
        viewer.process.stderr.on("data", data => { viewer.errors += data; });
        viewer.url = await new Promise((resolve, reject) => {
            let text = "";
            viewer.process.stdout.on("data", data => {
                text += data;
                if (text.includes("\n"))
                    resolve(text.trim());
            });
            viewer.ended.then(() => reject(new Error(`no address: ${viewer.errors}`)));
        });
        viewer.origin = new URL(viewer.url).origin;
        return viewer;
    }
    // Returns how it ended, and in how many milliseconds.
    async end(signal = "SIGINT") {
        const start = performance.now();
        this.process.kill(signal);
        const {code} = await this.ended;
        return {code, millis: performance.now() - start};
    }
}

export function openBrowser() {
    return puppeteer.launch({executablePath: "/usr/bin/chromium", headless: true,
                             args: ["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"]});
}

// What went wrong in all pages that open() has opened: messages of the console, exceptions, requests to others.
export const complaints = [];

// A tab of the viewer. `mayFail`: requests may, as of a viewer that has ended.
export async function open(browser, viewer, {width = 1280, height = 900, mayFail = false} = {}) {
    const context = await browser.createBrowserContext();
    const page = await context.newPage();
    await page.setViewport({width, height});
    page.on("console", message => {
        const isOfNetwork = message.text().startsWith("Failed to load resource");
        const isOfTest = message.text().includes("willReadFrequently"); // which reads the canvas often
        if (["error", "warn"].includes(message.type()) && !(mayFail && isOfNetwork) && !isOfTest)
            complaints.push(`console: ${message.text()}`);
    });
    page.on("pageerror", error => complaints.push(`exception: ${error.message}`));
    page.on("request", request => {
        const url = new URL(request.url());
        if (url.origin !== viewer.origin && !["data:", "blob:"].includes(url.protocol))
            complaints.push(`request to ${url}`);
    });
    await page.goto(viewer.url);
    return page;
}

// ---- What the page shows

export const stateOf = page => page.evaluate(async () => (await fetch("/state")).json());

// Waits for a state of the viewer that is meant, by a function that runs in the page.
export async function until(page, isMeant, ...values) {
    await page.waitForFunction(`(async () => {
        const now = await (await fetch("/state")).json();
        return !isSending && (${isMeant})(now, ...${JSON.stringify(values)});
    })()`, {polling: 50, timeout: patience});
    return stateOf(page);
}

// Waits until everything is rendered and shown.
export async function settle(page) {
    return until(page, now => {
        const shown = now.renderers[mode === "second" ? 1 : 0];
        const number = now.clean && now.canBeClean ? shown.clean : shown.raw;
        return !now.isChanging && !isMoving && orbit && !orbit.isGuess && number > 0 &&
               now.renderers.every(each => each.isFinished) &&
               frames.every((frame, i) => i >= now.renderers.length || frame?.view === now.view) &&
               canvas.dataset.number === String(number) && canvas.dataset.view === String(now.view);
    });
}

// Red, green and blue of the canvas, or of some rows.
export async function canvasOf(page, firstRow = 0, rowCount = undefined) {
    const {width, height, text} = await page.evaluate((firstRow, rowCount) => {
        const image = context.getImageData(0, firstRow, canvas.width, rowCount ?? canvas.height);
        let text = "";
        for (let i = 0; i < image.data.length; i += 4)
            text += String.fromCharCode(image.data[i], image.data[i + 1], image.data[i + 2]);
        return {width: image.width, height: image.height, text: btoa(text)};
    }, firstRow, rowCount);
    return {width, height, pixels: Buffer.from(text, "base64")};
}

export function assertEqualPictures(shown, expected, what, mayBeBlank = false) {
    assert.deepEqual([shown.width, shown.height], [expected.width, expected.height], what);
    let count = 0;
    for (let i = 0; i < shown.pixels.length; ++i)
        count += shown.pixels[i] !== expected.pixels[i];
    assert.equal(count, 0, `${what}: values that differ`);
    assert.ok(mayBeBlank || new Set(shown.pixels).size > 1, `${what}: there is something to see`);
}

export const commandOf = page => page.$eval("#command", area => area.value);

// The canvas shows the picture that the command in the page makes.
export async function assertShowsItsCommand(page, folder, what, mayBeBlank = false) {
    await settle(page);
    const command = await commandOf(page);
    assertEqualPictures(await canvasOf(page), await folder.picture(command), `${what}: ${command}`, mayBeBlank);
}

// ---- Files

function paeth(left, up, upLeft) {
    const fromLeft = Math.abs(up - upLeft);
    const fromUp = Math.abs(left - upLeft);
    const fromBoth = Math.abs(left + up - 2 * upLeft);
    return fromLeft <= fromUp && fromLeft <= fromBoth ? left : fromUp <= fromBoth ? up : upLeft;
}

// Of 8 bits and not interlaced, as the program writes them; without alpha.
export function readPng(file) {
    const bytes = readFileSync(file);
    let header = null;
    const data = [];
    for (let at = 8; at < bytes.length;) {
        const length = bytes.readUInt32BE(at);
        const type = bytes.toString("latin1", at + 4, at + 8);
        const body = bytes.subarray(at + 8, at + 8 + length);
        if (type === "IHDR")
            header = {width: body.readUInt32BE(0), height: body.readUInt32BE(4), depth: body[8], colour: body[9]};
        if (type === "IDAT")
            data.push(body);
        at += length + 12;
    }
    const channels = {2: 3, 6: 4}[header.colour];
    assert.ok(channels && header.depth === 8, "a PNG of 8 bits and in colour");
    const raw = inflateSync(Buffer.concat(data));
    const stride = channels * header.width;
    const lines = Buffer.alloc(stride * header.height);
    for (let y = 0; y < header.height; ++y) {
        const filter = raw[y * (stride + 1)];
        for (let i = 0, at = y * stride; i < stride; ++i, ++at) {
            const left = i >= channels ? lines[at - channels] : 0;
            const up = y > 0 ? lines[at - stride] : 0;
            const upLeft = y > 0 && i >= channels ? lines[at - stride - channels] : 0;
            const guess = filter === 0 ? 0 : filter === 1 ? left : filter === 2 ? up
                : filter === 3 ? (left + up) >> 1 : paeth(left, up, upLeft);
            lines[at] = raw[at + y + 1] + guess;
        }
    }
    const pixels = Buffer.alloc(3 * header.width * header.height);
    for (let i = 0; i < header.width * header.height; ++i)
        lines.copy(pixels, 3 * i, channels * i, channels * i + 3);
    return {width: header.width, height: header.height, pixels};
}
