// Pictures as arrays: { width, height, channels, values, bits }, row by row from the top left. What is shown of them is
// RGBA, 8 bits each.

function decodedPicture(base64, width, height, channels) {
  const { buffer } = bytesOf(base64);
  return { width, height, channels, values: new Float32Array(buffer), bits: new Uint32Array(buffer) };
}

// |b - a| times a number, by levels in proportion to it.
function differenceLevels(a, b, times) {
  const levels = new Uint8ClampedArray(4 * a.width * a.height).fill(255);
  for (let from = 0, to = 0; to < levels.length; from += a.channels, to += 4)
    for (let k = 0; k < 3; ++k) {
      const ulps = a.bits[from + k] === b.bits[from + k] ? 0 : 1;
      levels[to + k] = 255 * times * Math.abs(differenceOf(a.values[from + k], b.values[from + k], ulps));
    }
  return levels;
}

// The largest distance of the values of each pixel.
function pixelUlps(a, b) {
  const ulps = new Uint32Array(a.width * a.height);
  for (let i = 0, value = 0; i < ulps.length; ++i)
    for (let k = 0; k < a.channels; ++k, ++value)
      if (a.bits[value] !== b.bits[value]) ulps[i] = Math.max(ulps[i], ulpDistance(a.bits[value], b.bits[value]));
  return ulps;
}

// Numbers from 0 to 1 in the colours of errors.
function errorLevels(count, errorOf, colours) {
  const levels = new Uint8ClampedArray(4 * count).fill(255);
  for (let i = 0; i < count; ++i) {
    const colour = 3 * levelOf(errorOf(i));
    for (let k = 0; k < 3; ++k) levels[4 * i + k] = colours[colour + k];
  }
  return levels;
}

// A scale on which one ULP is seen and the largest distance is white: a quarter, and a step for each doubling.
const ulpError = (ulps, largest) =>
  ulps === 0 ? 0 : 0.25 + 0.75 * (largest > 1 ? Math.log2(ulps) / Math.log2(largest) : 1);

// Index of the next pixel with a difference in the order of rows, around the end; -1: none. `step` is 1 or -1.
function nextDifference(ulps, from, step) {
  for (let i = 1; i <= ulps.length; ++i) {
    const index = (from + step * i + 2 * ulps.length) % ulps.length;
    if (ulps[index] > 0) return index;
  }
  return -1;
}

// Index of the first pixel with the largest difference; -1: none.
function largestDifference(a, b) {
  let index = -1;
  for (let i = 0, value = 0, largest = 0; i < a.width * a.height; ++i)
    for (let k = 0; k < a.channels; ++k, ++value) {
      if (a.bits[value] === b.bits[value]) continue;
      const size = Math.abs(differenceOf(a.values[value], b.values[value], 1));
      if (size > largest) [index, largest] = [i, size];
    }
  return index;
}
