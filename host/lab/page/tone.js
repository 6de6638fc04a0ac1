// Tone curves of host/image/tone_curve.h, from linear light to levels of 0 to 255.

// Levels by a monotonous encoding of [0, 1], of which `decoded` is the inverse. Level i is shown from threshold i - 1
// on; a table of pieces, 32 a power of two from 2^-20 on, has the level at the lower end of each.
function levelFinder(decoded) {
  const number = new Float32Array(1);
  const bits = new Uint32Array(number.buffer);
  const thresholds = new Float32Array(255);
  for (let i = 0; i < 255; ++i) {
    const exact = decoded((i + 0.5) / 255);
    number[0] = exact;
    if (number[0] < exact) ++bits[0];
    thresholds[i] = number[0];
  }
  const firstPiece = (127 - 20) << 5;
  const levels = new Uint8Array(20 << 5);
  for (let piece = 0; piece < levels.length; ++piece) {
    bits[0] = (firstPiece + piece) << 18;
    levels[piece] = thresholds.filter(threshold => threshold <= number[0]).length;
  }
  return linear => {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 255;
    number[0] = linear;
    const piece = (bits[0] >>> 18) - firstPiece;
    if (piece < 0) return 0;
    if (piece >= levels.length) return 255;
    let level = levels[piece];
    while (level < 255 && number[0] >= thresholds[level]) ++level;
    return level;
  };
}

const gammaLevel = levelFinder(encoded => encoded ** 2.2);
const srgbLevel = levelFinder(encoded => encoded <= 0.04045 ? encoded / 12.92 : ((encoded + 0.055) / 1.055) ** 2.4);
const levelOf = display => display > 0 ? Math.floor(Math.min(display, 1) * 255 + 0.5) : 0;
const bounded = radiance => radiance > 0 ? Math.min(radiance, 2 ** 60) : 0;

const acesFit = v => (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);

function agxContrast(radiance) {
  const least = -12.47393;
  const most = 4.026069;
  const stops = radiance > 0 ? Math.min(Math.max(Math.log2(radiance), least), most) : least;
  const x = (stops - least) / (most - least);
  return (((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x - 0.00232;
}

// From exposed radiance to three levels, which are stored from `at` on.
const toneCurves = {
  gamma(levels, at, r, g, b) {
    levels[at] = gammaLevel(r);
    levels[at + 1] = gammaLevel(g);
    levels[at + 2] = gammaLevel(b);
  },
  srgb(levels, at, r, g, b) {
    levels[at] = srgbLevel(r);
    levels[at + 1] = srgbLevel(g);
    levels[at + 2] = srgbLevel(b);
  },
  aces(levels, at, red, green, blue) {
    const [r, g, b] = [bounded(red), bounded(green), bounded(blue)];
    const x = acesFit(0.59719 * r + 0.35458 * g + 0.04823 * b);
    const y = acesFit(0.07600 * r + 0.90834 * g + 0.01566 * b);
    const z = acesFit(0.02840 * r + 0.13383 * g + 0.83777 * b);
    levels[at] = srgbLevel(1.60475 * x - 0.53108 * y - 0.07367 * z);
    levels[at + 1] = srgbLevel(-0.10208 * x + 1.10813 * y - 0.00605 * z);
    levels[at + 2] = srgbLevel(-0.00327 * x - 0.07276 * y + 1.07602 * z);
  },
  agx(levels, at, red, green, blue) {
    const [r, g, b] = [bounded(red), bounded(green), bounded(blue)];
    const x = agxContrast(0.842479062253094 * r + 0.0784335999999992 * g + 0.0792237451477643 * b);
    const y = agxContrast(0.0423282422610123 * r + 0.878468636469772 * g + 0.0791661274605434 * b);
    const z = agxContrast(0.0423756549057051 * r + 0.0784336 * g + 0.879142973793104 * b);
    levels[at] = levelOf(1.19687900512017 * x - 0.0980208811401368 * y - 0.0990297440797205 * z);
    levels[at + 1] = levelOf(-0.0528968517574562 * x + 1.15190312990417 * y - 0.0989611768448433 * z);
    levels[at + 2] = levelOf(-0.0529716355144438 * x - 0.0980434501171241 * y + 1.15107367264116 * z);
  },
  display(levels, at, r, g, b) { // numbers that are encoded already
    levels[at] = levelOf(r);
    levels[at + 1] = levelOf(g);
    levels[at + 2] = levelOf(b);
  },
};
