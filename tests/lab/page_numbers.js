// Runs the functions of a comparison's page (host/lab/page) without a browser:
//
//   node page_numbers.js PAGE STOPS CURVE...    prints of each pixel three levels of the first picture by each curve, and
//                                               its ULPs
'use strict';
const [, , file, stops, ...curves] = process.argv;
const text = require('fs').readFileSync(file, 'utf8');
const [, data] = text.match(/<script type="application\/json" id="report">([^<]*)<\/script>/);
const [, script] = text.match(/<script>\n(.*?)\n\/\/ The page: /s);
const { decodedPicture, toneMap, pixelUlps } =
  new Function(`${script}\nreturn { decodedPicture, toneMap, pixelUlps };`)();

const { page } = JSON.parse(data);
const [width, height] = [page.window[1] - page.window[0], page.window[3] - page.window[2]];
const [first, second] = page.pictures.map(({ pixels }) => decodedPicture(pixels, width, height, page.channels));
const levels = curves.map(curve => toneMap(first.values, first.channels, curve, Number(stops)));
const rows = [...pixelUlps(first, second)].map((ulps, i) =>
  [...levels.flatMap(all => [...all.subarray(4 * i, 4 * i + 3)]), ulps].join(' '));
console.log(rows.join('\n'));
