'use strict';
// Floats and their bits.

const bytesOf = base64 => {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
};

// Place of a float on the number line -NaN, -inf, ..., -0, +0, ..., +inf, +NaN, by its bits.
const placeOf = bits => (bits >>> 31 ? ~bits : bits | 0x80000000) >>> 0;

// Steps between neighbouring floats from one to the other, of their bits: host/image/metrics.h.
const ulpDistance = (a, b) => Math.abs(placeOf(a) - placeOf(b));

const hexText = bits => `0x${(bits >>> 0).toString(16).padStart(8, '0')}`;

// Nine digits tell all floats apart.
const floatText = value => Object.is(value, -0) ? '-0' : String(Number(value.toPrecision(9)));

// Differences of values as host/image/metrics.h has them: none of equal bits, infinite where either is not finite.
const differenceOf = (a, b, ulps) =>
  ulps === 0 ? 0 : Number.isFinite(a) && Number.isFinite(b) ? b - a : Infinity;
