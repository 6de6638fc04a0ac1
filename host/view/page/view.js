// The page of the viewer: it shows the pictures that the program makes, and tells it what is wished.
"use strict";

const element = id => document.getElementById(id);
const canvas = element("picture");
const context = canvas.getContext("2d");

let state = null;         // of the program
let orbit = null;         // null until the first state
let isMoving = false;     // a hand has the camera
let hasOwnCamera = false; // a wish for it is on its way
let mode = "first";       // "first", "second", "slider" or "bits"
let exposure = null;      // null: as the scene says
const frames = [null, null];
const loading = [false, false];

// ---- Pictures

async function loadFrame(renderer) {
    const told = state.renderers[renderer];
    const isClean = state.clean && told.clean > 0;
    const newest = isClean ? told.clean : told.raw;
    if (loading[renderer] || newest === 0 || frames[renderer]?.number === newest)
        return;
    loading[renderer] = true;
    try {
        const response = await fetch(`/frame?renderer=${renderer}&clean=${isClean ? 1 : 0}`);
        if (!response.ok)
            return;
        const bytes = await response.arrayBuffer();
        const end = new Uint8Array(bytes, 0, Math.min(bytes.byteLength, 4096)).indexOf(10) + 1;
        const frame = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 0, end)));
        frame.pixels = new Float32Array(bytes, end, 3 * frame.width * frame.height);
        frame.bits = new Uint32Array(bytes, end, 3 * frame.width * frame.height);
        frames[renderer] = frame;
        draw();
    } finally {
        loading[renderer] = false;
    }
    loadFrame(renderer);
}

function exposureNow() { return exposure ?? state.exposure; }

// Its levels by the present curve, as it was asked for last.
function levelsOf(frame) {
    const key = `${element("tone").value} ${exposureNow()}`;
    if (frame.key !== key) {
        frame.levels = toneMap(frame.pixels, 3, element("tone").value, exposureNow());
        frame.key = key;
    }
    return frame.levels;
}

function isSameStage(a, b) {
    return a && b && a.samples > 0 && a.view === b.view && a.width === b.width && a.height === b.height && a.samples === b.samples;
}

// Left of the split that of the first.
function splitLevels(first, second, split) {
    const levels = new Uint8ClampedArray(levelsOf(first));
    const begin = Math.round(split * first.width);
    const others = levelsOf(second);
    for (let y = 0; y < first.height; ++y)
        levels.set(others.subarray(4 * (y * first.width + begin), 4 * (y + 1) * first.width),
                   4 * (y * first.width + begin));
    return levels;
}

// Red where any bit of a pixel differs.
function differingBits(first, second) {
    const levels = new Uint8ClampedArray(4 * first.width * first.height);
    for (let i = 0; i < first.width * first.height; ++i) {
        const differs = first.bits[3 * i] !== second.bits[3 * i] || first.bits[3 * i + 1] !== second.bits[3 * i + 1] ||
                        first.bits[3 * i + 2] !== second.bits[3 * i + 2];
        levels[4 * i] = differs ? 255 : 0;
        levels[4 * i + 3] = 255;
    }
    return levels;
}

function draw() {
    const [first, second] = frames;
    const shown = mode === "second" ? second ?? first : first ?? second;
    if (!shown)
        return;
    let levels = null;
    if ((mode === "slider" || mode === "bits") && first && second && first.width === second.width &&
        first.height === second.height) {
        if (mode === "slider")
            levels = splitLevels(first, second, Number(element("split").value));
        else if (isSameStage(first, second))
            levels = differingBits(first, second);
        else
            return; // the last one stays until both are there
    }
    levels ??= levelsOf(shown);
    if (canvas.width !== shown.width || canvas.height !== shown.height) {
        canvas.width = shown.width;
        canvas.height = shown.height;
        fitCanvas();
    }
    canvas.style.imageRendering = shown.isPreview ? "auto" : "pixelated";
    context.putImageData(new ImageData(levels, shown.width, shown.height), 0, 0);
    canvas.dataset.number = shown.number;
    canvas.dataset.samples = shown.samples;
    canvas.dataset.view = shown.view;
}

function fitCanvas() {
    if (!state)
        return;
    const stage = element("stage");
    const scale = Math.min(stage.clientWidth / state.width, stage.clientHeight / state.height);
    canvas.style.width = `${state.width * scale}px`;
    canvas.style.height = `${state.height * scale}px`;
}

// ---- Wishes

let wishes = null;
let isSending = false;

// Those that are made while others are on their way are sent together.
async function send(more) {
    wishes = {...wishes, ...more};
    if (isSending)
        return;
    isSending = true;
    try {
        while (wishes) {
            const body = JSON.stringify(wishes);
            wishes = null;
            const response = await fetch("/change", {method: "POST", body});
            showFault(response.ok ? "" : await response.text());
            if (response.ok)
                takeState(await response.json());
        }
    } catch {
        showFault("the viewer does not answer");
    }
    isSending = false;
    hasOwnCamera = isMoving;
    if (state)
        takeState(state); // the last news may have come while the camera was this page's
}

function sendCamera() {
    hasOwnCamera = true;
    send({...orbit.options(), ...(wishedWidth ? {"view-width": wishedWidth} : {})});
}

let ownFault = "";

function showFault(text) {
    ownFault = text;
    showFaults();
}

function showFaults() {
    const text = [ownFault, state?.fault, ...(state?.renderers ?? []).map(renderer => renderer.failure)]
        .filter(each => each).join("\n");
    element("fault").textContent = text;
    element("fault").hidden = text === "";
}

// ---- The state of the program

function fillSelect(select, values, chosen) {
    const key = JSON.stringify(values);
    if (select.dataset.values !== key) {
        select.replaceChildren(...values.map(([value, text]) => new Option(text, value)));
        select.dataset.values = key;
    }
    select.value = chosen;
}

// What a person is typing stays.
function setValue(input, value) {
    if (document.activeElement !== input)
        input.value = value;
}

function figuresOf(renderer) {
    const figures = [`${renderer.samples} samples`];
    if (renderer.noise > 0)
        figures.push(`noise ${(100 * renderer.noise).toFixed(1)} %`);
    if (renderer.megaraysPerSecond > 0)
        figures.push(`${renderer.megaraysPerSecond.toFixed(2)} Mray/s`);
    if (renderer.dispatchMillis > 0)
        figures.push(`${renderer.dispatches} dispatches, the last of ${renderer.dispatchMillis.toFixed(1)} ms`);
    figures.push(`${renderer.seconds.toFixed(1)} s; the first picture after ${renderer.firstMillis.toFixed(0)} ms`);
    return figures.join(" · ");
}

function showRenderers() {
    element("renderers").replaceChildren(...state.renderers.map(renderer => {
        const card = document.createElement("div");
        card.className = "renderer";
        card.title = renderer.description;
        card.append(document.createElement("strong"), document.createElement("span"));
        card.firstChild.textContent = renderer.name;
        card.lastChild.textContent = figuresOf(renderer);
        return card;
    }));
    element("told").replaceChildren(...state.told.map(text => {
        const item = document.createElement("li");
        item.textContent = text;
        return item;
    }));
}

function showComparison() {
    element("compare").hidden = state.renderers.length < 2;
    if (state.renderers.length < 2)
        return;
    const {samples, pixels} = state.difference;
    const count = state.width * state.height;
    element("difference").textContent = samples === 0 ? "Nothing is compared yet."
        : `At ${samples} samples ${pixels === 0 ? "none" : pixels} of ${count} pixels ${pixels > 1 ? "differ" : "differs"} in any bit.`;
    element("difference").classList.toggle("is-wrong", pixels > 0);
    for (const button of element("modes").children)
        button.setAttribute("aria-pressed", button.dataset.mode === mode);
    element("split").hidden = mode !== "slider";
}

function showStatus() {
    const renderer = state.renderers[mode === "second" ? 1 : 0];
    const wanted = state.noise > 0 ? `noise ${(100 * state.noise).toFixed(1)} %` : `${state.samplesPerPixel} samples`;
    element("status").textContent = renderer.isFinished
        ? `${state.width} x ${state.height}, ${wanted}: finished`
        : `${state.width} x ${state.height}, ${renderer.samples} of ${wanted}`;
}

function takeCamera() {
    const camera = state.camera;
    if (state.isChanging || isMoving || hasOwnCamera || isSending) // to another camera, maybe one of this page
        return;
    const near = orbit && lengthOf(subtract(orbit.position, camera.position)) < 1e-6 * orbit.distance &&
                 dot(orbit.direction, camera.direction) > 1 - 1e-9;
    if (near)
        return;
    const size = lengthOf(subtract(state.bounds[1], state.bounds[0]));
    const middle = times(add(state.bounds[0], state.bounds[1]), 0.5);
    const along = dot(subtract(middle, camera.position), camera.direction);
    orbit = new Orbit(camera.position, camera.direction, camera.up, along > 0.05 * size ? along : 0.5 * size || 1);
    const taken = orbit;
    taken.isGuess = true;
    pickAt(0.5, 0.5).then(pick => {
        taken.isGuess = false;
        if (pick && orbit === taken && !isMoving && !hasOwnCamera)
            orbit.pivot = add(orbit.position, times(orbit.direction, pick.depth));
    });
}

function takeState(now) {
    if (now.number < state?.number)
        return; // overtaken by news
    state = now;
    if (!state.isChanging && !isSending)
        wishedFov = wishedWidth = null;
    document.title = `${state.scene} - Hyalite`;
    element("scene").textContent = state.scene;
    fillSelect(element("show"), [["", `${state.integrator} (the scene's)`], ...state.integrators.map(
        ({name, help}) => [name, `${name}: ${help}`])], state.show ?? "");
    element("clean").checked = state.clean;
    element("clean").disabled = !state.canBeClean;
    setValue(element("samples"), state.samplesPerPixel);
    setValue(element("width"), state.width);
    setValue(element("height"), state.height);
    setValue(element("fov"), state.camera.fov);
    element("fov-value").textContent = `${state.camera.fov.toFixed(0)}°`;
    setValue(element("aperture"), state.camera.aperture);
    const isPerspective = state.camera.type === "perspective";
    element("fov").disabled = element("aperture").disabled = !isPerspective;
    element("cameras-label").hidden = state.cameras.length < 2;
    fillSelect(element("cameras"), [["", "the first"], ...state.cameras.map(name => [name, name])],
               element("cameras").value);
    setValue(element("exposure"), exposureNow());
    element("exposure-value").textContent = exposureNow().toFixed(2);
    showRenderers();
    showComparison();
    showStatus();
    showFaults();
    showLinks();
    takeCamera();
    fitCanvas();
    for (let renderer = 0; renderer < state.renderers.length; ++renderer)
        loadFrame(renderer);
}

// The program knows neither the exposure nor the curve of a page.
function commandNow() {
    const own = [];
    let command = state.renderers[mode === "second" ? 1 : 0].command;
    if (exposureNow() !== state.exposure) {
        command = command.replace(/ --exposure=\S+/, "");
        own.push(`--exposure=${exposureNow()}`);
    }
    if (element("tone").value !== "gamma")
        own.push(`--tone=${element("tone").value}`);
    return command.replace(/(?= -o picture\.png$)/, own.map(word => ` ${word}`).join(""));
}

function showLinks() {
    element("command").value = commandNow();
    const stem = state.scene.replace(/\.[^.]*$/, "");
    const shared = `renderer=${mode === "second" ? 1 : 0}&clean=${state.clean ? 1 : 0}`;
    element("png").href = `/picture.png?${shared}&tone=${element("tone").value}&exposure=${exposureNow()}`;
    element("png").download = `${stem}.png`;
    element("exr").href = `/picture.exr?${shared}`;
    element("exr").download = `${stem}.exr`;
    element("json").download = `${stem}-view.json`;
}

// ---- Points

async function pickAt(x, y) {
    const response = await fetch(`/pick?x=${x}&y=${y}`);
    return response.ok ? response.json() : null;
}

function shareOf(event) {
    const box = canvas.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height]
        .map(share => Math.min(Math.max(share, 0), 0.999999));
}

function showPoint(pick, [x, y]) {
    const frame = frames[mode === "second" ? 1 : 0];
    const px = Math.floor(x * state.width);
    const py = Math.floor(y * state.height);
    const lines = [`Pixel ${px}, ${py}`];
    if (frame && !frame.isPreview) {
        const at = 3 * (py * frame.width + px);
        lines[0] += `: ${Array.from(frame.pixels.subarray(at, at + 3), value => value.toPrecision(6)).join(", ")}`;
    }
    lines.push(pick ? `${pick.object || "unnamed"}${pick.material ? `, ${pick.material}` : ""}, ${pick.distance.toPrecision(5)} away, ` +
                      `at ${pick.position.map(value => value.toPrecision(5)).join(", ")}`
                    : "nothing is there");
    element("point").textContent = lines.join("\n");
}

async function clickAt(event) {
    const place = shareOf(event);
    const pick = await pickAt(...place);
    showPoint(pick, place);
    if (pick && event.altKey && state.camera.type === "perspective")
        send({"focus-distance": pick.depth});
}

// ---- Hands

const pointers = new Map();
let travelled = 0;

const turnPerWidth = Math.PI; // of the canvas
let wishedWidth = null; // of an orthographic view

function widthShown() {
    if (state.camera.type === "orthographic")
        return wishedWidth ?? state.camera.viewWidth;
    return orbit.widthShown(state.camera.type === "perspective" ? state.camera.fov : 60);
}

// Below 1: nearer. An orthographic camera shows less instead.
function zoom(factor) {
    if (state.camera.type === "orthographic")
        wishedWidth = widthShown() * factor;
    else
        orbit.dolly(factor);
}

function moveBy(dx, dy, isPanning) {
    const width = canvas.clientWidth;
    if (isPanning)
        orbit.pan(dx / width, -dy / width, widthShown());
    else
        orbit.turn(dx / width * turnPerWidth, dy / width * turnPerWidth);
    sendCamera();
}

canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    canvas.focus();
    pointers.set(event.pointerId, event);
    travelled = pointers.size > 1 ? Infinity : 0;
    isMoving = true;
    canvas.classList.add("is-moving");
    event.preventDefault();
});

canvas.addEventListener("pointermove", event => {
    const before = pointers.get(event.pointerId);
    if (!before || !orbit)
        return;
    const [dx, dy] = [event.clientX - before.clientX, event.clientY - before.clientY];
    if (travelled + Math.abs(dx) + Math.abs(dy) < 4)
        return; // the hand of a click
    travelled += Math.abs(dx) + Math.abs(dy);
    if (pointers.size === 2) {
        const other = [...pointers.values()].find(pointer => pointer.pointerId !== event.pointerId);
        const spread = pointer => Math.hypot(pointer.clientX - other.clientX, pointer.clientY - other.clientY);
        zoom(Math.min(Math.max(spread(before) / Math.max(spread(event), 1), 0.5), 2));
        moveBy(dx / 2, dy / 2, true);
    } else {
        moveBy(dx, dy, event.shiftKey || (event.buttons & 6) !== 0);
    }
    pointers.set(event.pointerId, event);
});

function release(event) {
    if (!pointers.delete(event.pointerId) || pointers.size > 0)
        return;
    isMoving = false;
    hasOwnCamera = isSending;
    canvas.classList.remove("is-moving");
    if (event.type === "pointerup" && travelled < 4 && event.button === 0)
        clickAt(event);
}
canvas.addEventListener("pointerup", release);
canvas.addEventListener("pointercancel", release);
canvas.addEventListener("contextmenu", event => event.preventDefault());

canvas.addEventListener("dblclick", async event => {
    const pick = await pickAt(...shareOf(event));
    if (!pick || !orbit)
        return;
    orbit.lookAt(pick.position);
    sendCamera();
});

canvas.addEventListener("wheel", event => {
    event.preventDefault();
    if (!orbit)
        return;
    const lines = event.deltaMode === 1 ? event.deltaY : event.deltaY / 40;
    zoom(Math.exp(0.05 * Math.min(Math.max(lines, -10), 10)));
    sendCamera();
}, {passive: false});

// ---- Controls

function setMode(wanted) {
    if (state && state.renderers.length > 1) {
        mode = wanted;
        showComparison();
        showStatus();
        showLinks();
        draw();
    }
}

function setExposure(stops) {
    exposure = Math.min(Math.max(stops, -10), 10);
    element("exposure").value = exposure;
    element("exposure-value").textContent = exposure.toFixed(2);
    showLinks();
    draw();
}

let wishedFov = null;

function setFov(degrees) {
    if (state.camera.type !== "perspective")
        return;
    wishedFov = Math.min(Math.max(degrees, 1), 170);
    send({"fov": wishedFov});
}

function fovNow() { return wishedFov ?? state.camera.fov; }

function show(name) { send({"show": name || null}); }

function reset() {
    orbit = null;
    send({"camera-position": null, "look-at": null, "up": null, "fov": null, "focus-distance": null, "aperture": null,
          "view-width": null});
}

element("show").addEventListener("change", event => show(event.target.value));
element("clean").addEventListener("change", event => send({"clean": event.target.checked}));
element("exposure").addEventListener("input", event => setExposure(Number(event.target.value)));
element("tone").addEventListener("change", () => { showLinks(); draw(); });
for (const [id, option] of [["samples", "spp"], ["width", "width"], ["height", "height"], ["aperture", "aperture"]])
    element(id).addEventListener("change", event => {
        if (event.target.value !== "")
            send({[option]: Number(event.target.value)});
        event.target.blur();
    });
element("fit").addEventListener("click", () => {
    const stage = element("stage");
    const scale = window.devicePixelRatio;
    send({"width": Math.min(Math.round(stage.clientWidth * scale), 4096),
          "height": Math.min(Math.round(stage.clientHeight * scale), 4096)});
});
element("fov").addEventListener("input", event => setFov(Number(event.target.value)));
element("cameras").addEventListener("change", event => {
    orbit = null;
    send({"camera": event.target.value || null, "camera-position": null, "look-at": null, "up": null, "fov": null, "view-width": null});
});
element("reset").addEventListener("click", reset);
element("split").addEventListener("input", draw);
element("modes").addEventListener("click", event => {
    if (event.target.dataset.mode)
        setMode(event.target.dataset.mode);
});
element("copy").addEventListener("click", () => {
    element("command").select();
    document.execCommand("copy"); // the clipboard's newer interface needs a secure address
});
element("help-button").addEventListener("click", () => element("help").showModal());

function handleKey(event) {
    const step = Math.PI / 36;
    const turn = (right, up) => {
        if (!orbit)
            return;
        if (event.shiftKey)
            orbit.pan(right / 2, up / 2, widthShown());
        else
            orbit.turn(right * step * 10, up * step * 10);
        sendCamera();
    };
    const dolly = factor => {
        if (!orbit)
            return;
        zoom(factor);
        sendCamera();
    };
    const keys = {
        ArrowLeft: () => turn(-0.1, 0),
        ArrowRight: () => turn(0.1, 0),
        ArrowUp: () => turn(0, 0.1),
        ArrowDown: () => turn(0, -0.1),
        "+": () => dolly(0.9),
        "=": () => dolly(0.9),
        "-": () => dolly(1 / 0.9),
        "[": () => setFov(fovNow() - 5),
        "]": () => setFov(fovNow() + 5),
        c: () => state.canBeClean && send({"clean": !state.clean}),
        e: () => setExposure(exposureNow() + 0.5),
        E: () => setExposure(exposureNow() - 0.5),
        t: () => {
            const tone = element("tone");
            tone.selectedIndex = (tone.selectedIndex + 1) % tone.length;
            showLinks();
            draw();
        },
        f: () => setMode(mode === "first" ? "second" : "first"),
        s: () => setMode(mode === "slider" ? "first" : "slider"),
        b: () => setMode(mode === "bits" ? "first" : "bits"),
        r: reset,
        "?": () => element("help").showModal(),
    };
    if (/^[0-9]$/.test(event.key)) {
        const index = Number(event.key);
        if (index <= state.integrators.length)
            show(index === 0 ? null : state.integrators[index - 1].name);
    } else if (keys[event.key]) {
        keys[event.key]();
    } else {
        return;
    }
    event.preventDefault();
}

// A control has the keys that mean something to it.
function isForControl(event) {
    return event.target.matches('input[type="number"], select, textarea') ||
           (event.target.matches('input[type="range"]') && event.key.startsWith("Arrow")) || element("help").open;
}

document.addEventListener("keydown", event => {
    if (state && !isForControl(event) && !event.ctrlKey && !event.metaKey && !event.altKey)
        handleKey(event);
});

new ResizeObserver(fitCanvas).observe(element("stage"));

// ---- News

let events = null;

function listen() {
    events?.close();
    if (document.hidden)
        return;
    events = new EventSource("/events");
    events.onopen = () => showFault("");
    events.onmessage = event => takeState(JSON.parse(event.data));
    events.onerror = () => {
        showFault("The viewer does not answer: it has ended, or the connection is lost.");
        if (events.readyState === EventSource.CLOSED)
            setTimeout(listen, 3000);
    };
}
// A browser has six connections to a program for all tabs, and news takes one: hidden tabs have none.
document.addEventListener("visibilitychange", listen);
listen();
