// Tone mapping as host/image/tone_map.cpp does it, and with its levels, so that a page shows the pixels of a PNG: numbers
// are the same doubles, and operations are the same, in the same order.

const float64 = new Float64Array(1);
const wordsOfFloat64 = new Uint32Array(float64.buffer);
const float32 = new Float32Array(1);
const bitsOfFloat32 = new Uint32Array(float32.buffer);

function powerOfTwo(exponent) {
    wordsOfFloat64[0] = 0;
    wordsOfFloat64[1] = (exponent + 1023) << 20;
    return float64[0];
}

// 2^x, for |x| <= 1000.
function exp2Portable(x) {
    const whole = x < 0 ? -Math.round(-x) : Math.round(x); // halves away from zero
    const r = (x - whole) * Math.LN2;
    let sum = 1;
    for (let k = 20; k >= 1; --k)
        sum = 1 + r * sum / k;
    return sum * powerOfTwo(whole);
}

// For normal x > 0.
function log2Portable(x) {
    float64[0] = x;
    const exponent = (wordsOfFloat64[1] >>> 20 & 0x7ff) - 1023;
    wordsOfFloat64[1] = wordsOfFloat64[1] & 0xfffff | 1023 << 20;
    const mantissa = float64[0]; // in [1, 2)
    const isUpper = mantissa > 1.4142135623730951;
    const m = isUpper ? mantissa * 0.5 : mantissa;
    const s = (m - 1) / (m + 1);
    let sum = 0;
    for (let k = 23; k >= 1; k -= 2)
        sum = sum * s * s + 1 / k;
    return (isUpper ? exponent + 1 : exponent) + 2 * s * sum / Math.LN2;
}

const levelOf = display => display > 0 ? Math.floor(Math.min(display, 1) * 255 + 0.5) : 0;
const clamp01 = x => Math.min(Math.max(x, 0), 1);
const bounded = radiance => radiance > 0 ? Math.min(radiance, 2 ** 60) : 0; // NaN: 0

function srgbEncoded(linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * exp2Portable(log2Portable(linear) / 2.4) - 0.055;
}

function timesMatrix(rows, x, y, z) {
    return rows.map(row => row[0] * x + row[1] * y + row[2] * z);
}

const acesToFilm = [[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]];
const acesFromFilm = [[1.60475, -0.53108, -0.07367], [-0.10208, 1.10813, -0.00605], [-0.00327, -0.07276, 1.07602]];

function aces(r, g, b) {
    const [x, y, z] = timesMatrix(acesToFilm, r, g, b).map(
        v => (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081));
    return timesMatrix(acesFromFilm, x, y, z).map(c => srgbEncoded(clamp01(c)));
}

const agxInset = [[0.842479062253094, 0.0784335999999992, 0.0792237451477643],
                  [0.0423282422610123, 0.878468636469772, 0.0791661274605434],
                  [0.0423756549057051, 0.0784336, 0.879142973793104]];
const agxOutset = [[1.19687900512017, -0.0980208811401368, -0.0990297440797205],
                   [-0.0528968517574562, 1.15190312990417, -0.0989611768448433],
                   [-0.0529716355144438, -0.0980434501171241, 1.15107367264116]];

function agxContrast(radiance) {
    const minStops = -12.47393;
    const maxStops = 4.026069;
    const stops = radiance > 0 ? log2Portable(radiance) : minStops;
    const x = (Math.min(Math.max(stops, minStops), maxStops) - minStops) / (maxStops - minStops);
    return (((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x - 0.00232;
}

function agx(r, g, b) {
    const [x, y, z] = timesMatrix(agxInset, r, g, b).map(agxContrast);
    return timesMatrix(agxOutset, x, y, z).map(clamp01);
}

// From exposed radiance to display values in [0, 1]; by `gamma` there are levels at once.
const toneCurves = {
    gamma: null,
    srgb: (r, g, b) => [r, g, b].map(c => srgbEncoded(Math.min(bounded(c), 1))),
    aces: (r, g, b) => aces(bounded(r), bounded(g), bounded(b)),
    agx: (r, g, b) => agx(bounded(r), bounded(g), bounded(b)),
    display: (r, g, b) => [r, g, b], // numbers that are encoded already
};

// The level of each of the first floats of a piece: of those with the same upper 16 bits; and where levels begin.
const gammaTables = (() => {
    const thresholds = new Float32Array(255);
    for (let i = 0; i < 255; ++i) {
        const exact = Math.pow((i + 0.5) / 255, 2.2);
        thresholds[i] = exact;
        float32[0] = exact;
        if (float32[0] < exact) {
            ++bitsOfFloat32[0];
            thresholds[i] = float32[0];
        }
    }
    const levels = new Uint8Array(0x3f80);
    let level = 0;
    for (let piece = 0; piece < levels.length; ++piece) {
        bitsOfFloat32[0] = piece << 16;
        while (level < 255 && float32[0] >= thresholds[level])
            ++level;
        levels[piece] = level;
    }
    return {thresholds, levels};
})();

// Of exposed radiance; NaN is 0.
function levelOfGamma(product) {
    if (!(product > 0))
        return 0;
    if (product >= 1)
        return 255;
    float32[0] = product;
    const linear = float32[0];
    if (linear >= 1)
        return 255;
    let level = gammaTables.levels[bitsOfFloat32[0] >>> 16];
    while (level < 255 && linear >= gammaTables.thresholds[level])
        ++level;
    return level;
}

// R, G, B and 255 of each pixel, whose first three values are linear radiance.
function toneMap(values, channels, curve, exposureStops) {
    const levels = new Uint8ClampedArray(values.length / channels * 4).fill(255);
    const scale = exp2Portable(Math.min(Math.max(exposureStops, -300), 300));
    const display = toneCurves[curve];
    for (let from = 0, to = 0; to < levels.length; from += channels, to += 4) {
        const [r, g, b] = [values[from] * scale, values[from + 1] * scale, values[from + 2] * scale];
        if (display === null) {
            levels[to] = levelOfGamma(r);
            levels[to + 1] = levelOfGamma(g);
            levels[to + 2] = levelOfGamma(b);
            continue;
        }
        const shown = display(r, g, b);
        for (let channel = 0; channel < 3; ++channel)
            levels[to + channel] = levelOf(shown[channel]);
    }
    return levels;
}
