// The page: what it shows, and how it is used.

const report = JSON.parse(document.getElementById('report').textContent);
const { page } = report;
const byId = id => document.getElementById(id);

// Text of files: clean as by host/base/clean_text.h.
const cleanText = text => String(text).replace(/[\p{Cc}\p{Bidi_Control}\u2028\u2029]/gu, '\ufffd');

// Text enters the page as text nodes alone, so that no markup can be in it.
function element(tag, attributes = {}, ...children) {
  const node = Object.assign(document.createElement(tag), attributes);
  node.append(...children.flat().map(child => child instanceof Node ? child : cleanText(child)));
  return node;
}
const row = (cells, cell = 'td') => element('tr', {}, cells.map(text => element(cell, {}, text ?? '–')));
const headOf = names =>
  element('thead', {}, element('tr', {}, names.map(name => element('th', { scope: 'col' }, name))));

// ---- Pictures

const [x0, x1, y0, y1] = page.window;
const width = x1 - x0;
const height = y1 - y0;
const first = decodedPicture(page.pictures[0].pixels, width, height, page.channels);
const second = page.pictures[1].pixels === null
  ? first : decodedPicture(page.pictures[1].pixels, width, height, page.channels);
const flip = page.flip ? decodedPicture(page.flip, width, height, 1).values : new Float32Array(width * height);
const colours = bytesOf(page.colours);
const ulps = pixelUlps(first, second);
const largestUlps = ulps.reduce((most, count) => Math.max(most, count), 0);
const isLinear = report.encoding === 'linear';
const roles = page.pictures.map(picture => picture.role);

const state = { view: 'first', curve: isLinear ? 'gamma' : 'display', stops: 0, times: 8, wipe: 0.5,
                x: width / 2, y: height / 2, zoom: 1, pixel: null, swapsByHover: false, isHovered: false };

const views = {
  first: { name: roles[0], levels: () => toneMap(first.values, first.channels, state.curve, state.stops) },
  second: { name: roles[1], levels: () => toneMap(second.values, second.channels, state.curve, state.stops) },
  flip: { name: 'FLIP', levels: () => errorLevels(flip.length, i => flip[i], colours) },
  difference: { name: 'difference', levels: () => differenceLevels(first, second, state.times) },
  ulps: { name: 'ULPs', levels: () => errorLevels(ulps.length, i => ulpError(ulps[i], largestUlps), colours) },
  wipe: { name: 'wipe' },
};

// A picture of each view, made anew when what it depends on has changed.
function layerOf(view) {
  const key = view === 'difference' ? state.times : `${state.stops} ${state.curve}`;
  const layer = views[view];
  if (layer.canvas && (layer.key === key || view === 'flip' || view === 'ulps')) return layer.canvas;
  layer.canvas ??= element('canvas', { width, height });
  layer.key = key;
  layer.canvas.getContext('2d').putImageData(new ImageData(layer.levels(), width, height), 0, 0);
  return layer.canvas;
}

const otherOf = view => ({ first: 'second', second: 'first' })[view] ?? view;
const shownView = () => state.swapsByHover && state.isHovered ? otherOf(state.view) : state.view;

// ---- The canvas: `zoom` is its pixels for each of the picture; (x, y) of the picture is in its middle.

const canvas = byId('canvas');
const context = canvas.getContext('2d');
const leftOf = () => canvas.width / 2 - state.x * state.zoom;
const topOf = () => canvas.height / 2 - state.y * state.zoom;

function draw() {
  context.fillStyle = '#101114';
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.imageSmoothingEnabled = state.zoom < 1;
  const show = view => context.drawImage(layerOf(view), leftOf(), topOf(), width * state.zoom, height * state.zoom);
  if (state.view === 'wipe') {
    const edge = Math.round(state.wipe * canvas.width);
    for (const [view, from, to] of [['first', 0, edge], ['second', edge, canvas.width]]) {
      context.save();
      context.beginPath();
      context.rect(from, 0, to - from, canvas.height);
      context.clip();
      show(view);
      context.restore();
    }
    context.fillStyle = '#fff';
    context.fillRect(edge - devicePixelRatio, 0, 2 * devicePixelRatio, canvas.height);
    context.beginPath();
    context.arc(edge, canvas.height / 2, 9 * devicePixelRatio, 0, 2 * Math.PI);
    context.fill();
  } else {
    show(shownView());
  }
  if (state.pixel) {
    const side = Math.max(state.zoom, 6 * devicePixelRatio);
    const middle = (start, place) => start + (place + 0.5) * state.zoom - side / 2;
    const [left, top] = [middle(leftOf(), state.pixel.x), middle(topOf(), state.pixel.y)];
    for (const [colour, line] of [['#000', 3], ['#fff', 1]]) {
      context.strokeStyle = colour;
      context.lineWidth = line * devicePixelRatio;
      context.strokeRect(left, top, side, side);
    }
  }
}

let isDrawing = false;
function drawSoon() {
  if (isDrawing) return;
  isDrawing = true;
  requestAnimationFrame(() => {
    isDrawing = false;
    draw();
  });
}

const fittingZoom = () => {
  const zoom = Math.min(canvas.width / width, canvas.height / height);
  return zoom > 2 ? Math.floor(zoom) : zoom;
};

function fit() {
  Object.assign(state, { x: width / 2, y: height / 2, zoom: fittingZoom() });
  drawSoon();
}

// Changes the zoom around a point of the canvas, by default its middle.
function zoomTo(zoom, atX = canvas.width / 2, atY = canvas.height / 2) {
  const [x, y] = [(atX - leftOf()) / state.zoom, (atY - topOf()) / state.zoom];
  state.zoom = Math.min(Math.max(zoom, Math.min(fittingZoom(), 1) / 2), 128 * devicePixelRatio);
  state.x = x - (atX - canvas.width / 2) / state.zoom;
  state.y = y - (atY - canvas.height / 2) / state.zoom;
  keepInside();
}

function keepInside() {
  state.x = Math.min(Math.max(state.x, 0), width);
  state.y = Math.min(Math.max(state.y, 0), height);
  drawSoon();
}

// ---- The pixel that is read

const channelNames = ['R', 'G', 'B', 'A'].slice(0, page.channels);

function read(x, y) {
  state.pixel = { x: Math.min(Math.max(x, 0), width - 1), y: Math.min(Math.max(y, 0), height - 1) };
  const index = state.pixel.y * width + state.pixel.x;
  const place = `Pixel (${page.corner[0] + x0 + state.pixel.x}, ${page.corner[1] + y0 + state.pixel.y})`;
  byId('reading').textContent = (ulps[index] ? `${place}: ${ulps[index]} ULP at most` : `${place}: equal`) +
    (flip[index] ? `, FLIP ${flip[index].toFixed(4)}` : '');
  const number = (picture, i) => [floatText(picture.values[i]), element('span', {}, hexText(picture.bits[i]))];
  byId('probe').replaceChildren(headOf(['', ...roles, 'difference', 'ULP']), element('tbody', {},
    channelNames.map((name, k) => {
      const i = index * page.channels + k;
      const distance = ulpDistance(first.bits[i], second.bits[i]);
      const difference = differenceOf(first.values[i], second.values[i], distance);
      return element('tr', { className: distance ? 'differs' : '' }, element('th', { scope: 'row' }, name),
        element('td', {}, number(first, i)), element('td', {}, number(second, i)),
        element('td', {}, String(Number(difference.toPrecision(3)))), element('td', {}, distance));
    })));
  drawSoon();
}

// Shows a pixel, large enough to be seen.
function show(x, y) {
  state.zoom = Math.max(state.zoom, 8 * devicePixelRatio);
  Object.assign(state, { x: x + 0.5, y: y + 0.5 });
  read(x, y);
}

function showDifference(step) {
  const from = state.pixel ? state.pixel.y * width + state.pixel.x : step > 0 ? -1 : 0;
  const index = nextDifference(ulps, from, step);
  if (index >= 0) show(index % width, Math.floor(index / width));
}

function showLargest() {
  const index = largestDifference(first, second);
  if (index >= 0) show(index % width, Math.floor(index / width));
  else showDifference(1);
}

// ---- What is set

function setView(view) {
  state.view = view;
  document.querySelector(`input[value="${view}"]`).checked = true;
  canvas.setAttribute('aria-label', `Shown: ${views[view].name}. Arrow keys move the pixel that is read.`);
  drawSoon();
}
function setStops(stops) {
  state.stops = Math.min(Math.max(stops, -12), 12);
  byId('exposure').value = state.stops;
  byId('exposureText').textContent = `${state.stops > 0 ? '+' : ''}${state.stops} stops`;
  drawSoon();
}
function setTimes(power) {
  const bounds = Math.min(Math.max(power, 0), 24);
  state.times = 2 ** bounds;
  byId('gain').value = bounds;
  byId('gainText').textContent = `× ${state.times}`;
  drawSoon();
}
function setWipe(share) {
  state.wipe = Math.min(Math.max(share, 0), 1);
  byId('wipe').value = 100 * state.wipe;
  byId('wipeText').textContent = `${Math.round(100 * state.wipe)} %`;
  drawSoon();
}
function setCurve(curve) {
  state.curve = curve;
  byId('curve').value = curve;
  drawSoon();
}
function setHover(swaps) {
  state.swapsByHover = swaps;
  byId('hover').checked = swaps;
  if (swaps && otherOf(state.view) === state.view) setView('first');
  drawSoon();
}
const swap = () => setView(state.view === 'first' ? 'second' : 'first');

const curves = isLinear ? ['gamma', 'srgb', 'aces', 'agx'] : ['display'];
byId('curve').append(...curves.map(curve => element('option', { value: curve }, curve)));
byId('curve').disabled = !isLinear;
byId('curve').addEventListener('change', event => setCurve(event.target.value));
byId('exposure').addEventListener('input', event => setStops(Number(event.target.value)));
byId('hover').addEventListener('change', event => setHover(event.target.checked));
byId('gain').addEventListener('input', event => {
  setTimes(Number(event.target.value));
  setView('difference');
});
byId('wipe').addEventListener('input', event => {
  setWipe(Number(event.target.value) / 100);
  setView('wipe');
});
byId('views').append(...Object.entries(views).map(([view, { name }], index) => {
  const input = element('input', { type: 'radio', name: 'view', value: view });
  input.addEventListener('change', () => setView(view));
  return element('label', {}, input, name, element('kbd', { ariaHidden: 'true' }, index + 1));
}));
const clicks = {
  fit, whole: () => zoomTo(1), in: () => zoomTo(2 * state.zoom), out: () => zoomTo(state.zoom / 2),
  next: () => showDifference(1), previous: () => showDifference(-1), largest: showLargest,
};
for (const [id, action] of Object.entries(clicks)) byId(id).addEventListener('click', action);
for (const id of ['next', 'previous', 'largest']) byId(id).disabled = largestUlps === 0;

// ---- Keys

const move = (x, y) => event => {
  const by = event.shiftKey ? 10 : 1;
  const from = state.pixel ?? { x: Math.floor(state.x), y: Math.floor(state.y) };
  read(from.x + x * by, from.y + y * by);
  // What is read stays in sight.
  const [atX, atY] = [leftOf() + (state.pixel.x + 0.5) * state.zoom, topOf() + (state.pixel.y + 0.5) * state.zoom];
  if (atX < 0 || atX > canvas.width) state.x = state.pixel.x + 0.5;
  if (atY < 0 || atY > canvas.height) state.y = state.pixel.y + 0.5;
};
const keys = {
  ' ': swap, '[': () => setStops(state.stops - 0.5), ']': () => setStops(state.stops + 0.5),
  ',': () => setTimes(Math.log2(state.times) - 1), '.': () => setTimes(Math.log2(state.times) + 1),
  t: () => setCurve(curves[(curves.indexOf(state.curve) + 1) % curves.length]),
  '+': clicks.in, '=': clicks.in, '-': clicks.out, '0': fit, 'z': clicks.whole,
  n: clicks.next, p: clicks.previous, l: clicks.largest, h: () => setHover(!state.swapsByHover),
};
Object.keys(views).forEach((view, index) => { keys[index + 1] = () => setView(view); });
const moves = { ArrowLeft: move(-1, 0), ArrowRight: move(1, 0), ArrowUp: move(0, -1), ArrowDown: move(0, 1) };

document.addEventListener('keydown', event => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const action = event.target === canvas && moves[event.key] || keys[event.key];
  const isTaken = event.target.matches('select') || event.key === ' ' && event.target.matches('button, summary');
  if (!action || isTaken) return;
  event.preventDefault();
  action(event);
});
byId('keys').append(...[
  ['1 to 6', 'what is shown'], ['Space', 'one picture, then the other'],
  ['h', 'swap them while the pointer is over the picture'],
  ['+ − 0 z', 'zoom: in, out, all, pixel by pixel'],
  ['Arrows', 'move the pixel that is read; with Shift by 10'], ['n p l', 'next, previous, largest difference'],
  ['[ ]', 'exposure'], [', .', 'factor of the difference'], ['t', 'tone curve'],
  ['Pointer', 'reads a pixel; wheel or two fingers zoom, dragging moves'],
].flatMap(([key, meaning]) => [element('dt', {}, element('kbd', {}, key)), element('dd', {}, meaning)]));

// ---- Pointer, fingers and wheel

const pointers = new Map();
let isWiping = false;
const placeOn = event => {
  const box = canvas.getBoundingClientRect();
  return { x: (event.clientX - box.left) * canvas.width / box.width,
           y: (event.clientY - box.top) * canvas.height / box.height };
};
function readAt({ x, y }) {
  const [column, line] = [Math.floor((x - leftOf()) / state.zoom), Math.floor((y - topOf()) / state.zoom)];
  if (column >= 0 && column < width && line >= 0 && line < height) read(column, line);
}

for (const [name, isHovered] of [['pointerenter', true], ['pointerleave', false]])
  canvas.addEventListener(name, () => {
    state.isHovered = isHovered;
    drawSoon();
  });
canvas.addEventListener('pointerdown', event => {
  const place = placeOn(event);
  canvas.setPointerCapture(event.pointerId);
  pointers.set(event.pointerId, place);
  isWiping = state.view === 'wipe' && pointers.size === 1 &&
    Math.abs(place.x - state.wipe * canvas.width) < 24 * devicePixelRatio;
  readAt(place);
});
canvas.addEventListener('pointermove', event => {
  const place = placeOn(event);
  const before = pointers.get(event.pointerId);
  if (!before) {
    readAt(place);
    return;
  }
  const others = [...pointers].filter(([id]) => id !== event.pointerId).map(([, other]) => other);
  pointers.set(event.pointerId, place);
  if (others.length === 1) { // two fingers: their middle stays where it is in the picture
    const distance = point => Math.hypot(point.x - others[0].x, point.y - others[0].y);
    const middle = point => [(point.x + others[0].x) / 2, (point.y + others[0].y) / 2];
    state.x -= (place.x - before.x) / 2 / state.zoom;
    state.y -= (place.y - before.y) / 2 / state.zoom;
    zoomTo(state.zoom * distance(place) / Math.max(distance(before), 1), ...middle(place));
  } else if (isWiping) {
    setWipe(place.x / canvas.width);
  } else {
    state.x -= (place.x - before.x) / state.zoom;
    state.y -= (place.y - before.y) / state.zoom;
    keepInside();
  }
});
for (const end of ['pointerup', 'pointercancel'])
  canvas.addEventListener(end, event => pointers.delete(event.pointerId));
canvas.addEventListener('wheel', event => {
  event.preventDefault();
  const place = placeOn(event);
  zoomTo(state.zoom * 2 ** (-event.deltaY / 200), place.x, place.y);
}, { passive: false });

canvas.style.aspectRatio = `${width} / ${height}`;
let isFitted = false;
new ResizeObserver(() => {
  canvas.width = Math.max(Math.round(canvas.clientWidth * devicePixelRatio), 1);
  canvas.height = Math.max(Math.round(canvas.clientHeight * devicePixelRatio), 1);
  if (!isFitted) fit();
  isFitted = true;
  draw();
}).observe(canvas);

// ---- Figures

const ofText = (count, total) => `${count} of ${total}`;
const valueCount = page.ulps.reduce((sum, [, , count]) => sum + count, 0);
const number = (value, digits) =>
  value === null || value === undefined ? undefined : String(Number(Number(value).toPrecision(digits)));
// JSON has null for what is infinite.
const decibels = value =>
  value !== null ? `${value.toFixed(2)} dB` : report.differingPixelCount === 0 ? '∞ dB' : '−∞ dB';

const figures = {
  'differing pixels': ofText(report.differingPixelCount, report.pixelCount),
  'differing values': ofText(valueCount - page.ulps[0][2], valueCount),
  'largest difference': report.maxDifference === null ? '∞' : number(report.maxDifference, 6),
  'largest distance': report.maxUlpDistance === undefined ? undefined : `${report.maxUlpDistance} ULP`,
  'PSNR': decibels(report.psnrDecibels),
  'SSIM': report.ssim === null ? 'not available' : report.ssim.toFixed(6),
  [`${report.flip.kind}-FLIP, mean`]: report.flip.mean.toFixed(6),
  [`${report.flip.kind}-FLIP, largest`]: report.flip.max.toFixed(6),
  'mean absolute difference': report.meanAbsoluteDifference === null ? '∞' : number(report.meanAbsoluteDifference, 6),
  'not finite': report.nonFiniteCount ? `${report.nonFiniteCount} pixels` : undefined,
  'outliers': report.outliers ?? (report.outlierThreshold ? report.outlierCount : undefined),
  'unexplained outliers': report.unexplainedOutliers,
  'alpha differs': report.alpha ? `${report.alpha.differingPixelCount} pixels` : undefined,
  'layers of light differ': report.differingLight === undefined ? undefined : `${report.differingLight} pixels`,
  'rays': report.areRayCountsEqual === undefined ? undefined : report.areRayCountsEqual ? 'as many' : 'counts differ',
  'mask': report.mask,
  'tone-mapped': report.toneMapped,
  ...Object.fromEntries((report.gates ?? []).map(gate =>
    [`${gate.option} ${gate.limit}`, `${gate.passed ? 'passed' : 'FAILED'}, ${number(gate.value, 6) ?? '∞'}`])),
};
byId('figures').append(...Object.entries(figures).filter(([, text]) => text !== undefined)
  .map(([name, text]) => element('div', {}, element('dt', {}, name), element('dd', {}, text))));

const mostDiffering = Math.max(...page.ulps.slice(1).map(([, , count]) => count));
byId('histogram').append(headOf(['ULP', 'values', 'share', '']), element('tbody', {},
  page.ulps.map(([least, most, count]) => {
    const bar = element('i');
    bar.style.width = `${100 * count / mostDiffering}%`;
    bar.hidden = count === 0 || most === 0;
    return row([least === most ? least : `${least} to ${most}`, count,
      `${(100 * count / valueCount).toFixed(3)} %`, bar]);
  })));

function differenceSection({ pixel: [x, y], sample, bounce, quantity, first: a, second: b }, traces) {
  const button = element('button', { type: 'button' }, 'Show the pixel');
  button.addEventListener('click', () => {
    show(x - page.corner[0] - x0, y - page.corner[1] - y0);
    canvas.scrollIntoView({ block: 'center' });
  });
  const nodes = [element('h2', {}, 'First step that differs')];
  if (quantity === undefined)
    return [...nodes, element('p', {}, `Pixel (${x}, ${y}): the paths agree in every step; what differs is how work ` +
      'is cut or summed.'), button];
  nodes.push(element('p', {}, `Pixel (${x}, ${y}), sample ${sample}, bounce ${bounce}: ${quantity}`),
    element('p', {}, `${roles[0]}: ${a}`), element('p', {}, `${roles[1]}: ${b}`), element('p', {}, button));
  if (traces) {
    const stepCount = Math.max(traces.first.length, traces.second.length);
    const steps = Array.from({ length: Math.min(stepCount, traces.step + 3) }, (_, i) => {
      const [before, after] = [traces.first[i], traces.second[i]];
      const line = row([(before ?? after)[0], (before ?? after)[1], before?.[2], after?.[2]]);
      line.className = i === traces.step ? 'differs' : '';
      return line;
    });
    nodes.push(element('details', { open: true }, element('summary', {}, 'Both paths up to there'),
      element('div', { className: 'table' }, element('table', { id: 'trace' },
        headOf(['bounce', 'quantity', ...roles]), element('tbody', {}, steps)))));
  }
  return nodes;
}
if (report.divergence) byId('difference').append(...differenceSection(report.divergence, report.traces));

// ---- Origin

function* texts(value, path) {
  if (value !== null && typeof value === 'object' && !Array.isArray(value))
    for (const [key, part] of Object.entries(value)) yield* texts(part, path ? `${path}.${key}` : key);
  else yield [path, Array.isArray(value) ? value.join(', ') : String(value)];
}
const ofBoth = Object.fromEntries(
  ['program', 'commandLine', 'scene', 'sceneHash', 'triangles', 'origin', 'image', 'settings']
    .flatMap(key => key in report ? [...texts(report[key], key)] : []));
const origins = page.pictures.map(({ name, origin }) => ({ name, ...Object.fromEntries(origin) }));
// What differs comes first; what is equal stands there once.
const originKeys = [...new Set(origins.flatMap(Object.keys))];
const differs = key => origins[0][key] !== origins[1][key];
const sharedRow = ([key, text]) => element('tr', {}, element('td', {}, key), element('td', { colSpan: 2 }, text));
byId('origin').append(headOf(['', ...roles]), element('tbody', {},
  originKeys.filter(differs).map(key =>
    Object.assign(row([key, origins[0][key], origins[1][key]]), { className: 'differs' })),
  originKeys.filter(key => !differs(key)).map(key => sharedRow([key, origins[0][key]])),
  Object.entries(ofBoth).map(sharedRow)));

document.title = cleanText(`${page.title}: ${page.verdict}`);
byId('title').textContent = cleanText(page.title);
byId('summary').textContent = cleanText(page.verdict);
byId('names').textContent = cleanText(page.pictures.map(({ role, name }) => `${role}: ${name}`).join('; '));
byId('summary').className = report.passed ? 'passed' : '';
if (width < report.width || height < report.height) {
  byId('part').hidden = false;
  byId('part').textContent = `The pictures have ${report.width} by ${report.height} pixels. This page has ${width} ` +
    `by ${height} of them, around the largest difference: columns ${x0} to ${x1 - 1}, rows ${y0} to ${y1 - 1}. ` +
    'Figures are of the whole.';
}
setView('first');
setStops(0);
setTimes(3);
setWipe(0.5);
setCurve(state.curve);
if (largestUlps > 0) showDifferenceWithoutZoom();
else read(Math.floor(width / 2), Math.floor(height / 2));

// The pixel that is read first: the first that differs, with all of the picture in sight.
function showDifferenceWithoutZoom() {
  const index = nextDifference(ulps, -1, 1);
  read(index % width, Math.floor(index / width));
}
