// Runs the script of a profile's page (host/report/profile.html) without a browser:
//
//   node page_script.js PAGE            prints the title and the markup that the script makes of the report
//   node page_script.js PAGE unshown    prints the path of each value of the report that can change without being seen
'use strict';
const [, , file, mode] = process.argv;
const [, data, script] = require('fs').readFileSync(file, 'utf8').match(
  /<script type="application\/json" id="report">([^<]*)<\/script>\s*<script>(.*)<\/script>/s);

function shown(report) {
  const main = {};
  const document = { getElementById: () => ({ textContent: JSON.stringify(report) }), querySelector: () => main };
  new Function('document', script)(document);
  return `${document.title}\n${main.innerHTML}`;
}

function* pathsIn(value, path = []) {
  if (typeof value !== 'object') yield path;
  else for (const key of Object.keys(value)) yield* pathsIn(value[key], [...path, key]);
}

function changed(report, path) {
  const copy = structuredClone(report);
  const key = path.at(-1);
  const parent = path.slice(0, -1).reduce((value, step) => value[step], copy);
  const value = parent[key];
  parent[key] = typeof value === 'number' ? 2 * value + 1 : typeof value === 'boolean' ? !value : `${value}+`;
  return copy;
}

const report = JSON.parse(data);
if (mode === 'unshown')
  for (const path of pathsIn(report)) {
    if (shown(changed(report, path)) === shown(report)) console.log(path.join('.'));
  }
else
  console.log(shown(report));
