// Runs the script of a comparison's page (host/lab/page) without a browser, over elements that keep what they are given:
//
//   node page_text.js PAGE [KEY...]    presses the keys, and prints the title and the text of each element with an id
'use strict';
const [, , file, ...keys] = process.argv;
const text = require('fs').readFileSync(file, 'utf8');
const [, data] = text.match(/<script type="application\/json" id="report">([^<]*)<\/script>/);
const [, script] = text.match(/<script>\n(.*?)<\/script>/s);

class Node {
  children = [];
  style = {};
  clientWidth = 100;
  clientHeight = 80;
  append(...nodes) { this.children.push(...nodes); }
  replaceChildren(...nodes) { this.children = nodes; }
  set textContent(content) { this.children = [content]; }
  get textContent() { return this.children.map(child => child instanceof Node ? child.textContent : child).join(' '); }
  addEventListener() {}
  setAttribute() {}
  matches() { return false; }
  getContext() { return new Proxy({}, { get: () => () => {} }); }
}

const elements = new Map([...text.matchAll(/ id="(\w+)"/g)].map(([, id]) => [id, new Node()]));
elements.get('report').textContent = data;
let press;
const document = {
  getElementById: id => elements.get(id),
  createElement: () => new Node(),
  querySelector: () => new Node(),
  addEventListener: (event, listener) => { press = listener; },
};
class ResizeObserver {
  constructor(resized) { this.observe = resized; }
}
class ImageData {
  constructor(levels, width, height) {
    if (levels.length !== 4 * width * height) throw new Error('an image of another size');
  }
}

new Function('document', 'Node', 'ResizeObserver', 'ImageData', 'requestAnimationFrame', 'devicePixelRatio', script)(
  document, Node, ResizeObserver, ImageData, draw => draw(), 1);
for (const key of keys) press({ key, target: elements.get('canvas'), preventDefault() {} });
console.log(document.title);
elements.delete('report');
for (const [id, node] of elements) console.log(`${id}: ${node.textContent}`);
