// SPDX-License-Identifier: Apache-2.0
// Changes the page without rebuilding it, and formats numbers for people.

/** Sets a text only if it differs, because an unchanged cell costs nothing. */
export function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

export function setClass(element, name) {
  if (element.getAttribute('class') !== name) element.setAttribute('class', name);
}

export function setAttributes(element, attributes) {
  for (const [name, value] of Object.entries(attributes))
    if (element.getAttribute(name) !== String(value)) element.setAttribute(name, value);
}

/** Returns an HTML element with a class and a text. */
export function make(tag, className = '', text = '') {
  const element = document.createElement(tag);
  if (className) element.className = className;
  if (text) element.textContent = text;
  return element;
}

export function makeSvg(tag, attributes = {}, text = '') {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  setAttributes(element, attributes);
  if (text) element.textContent = text;
  return element;
}

/**
 * Keeps one child per item and key, in the items' order: creates new ones and removes those without an item.
 * `create` returns an element, `update` writes an item into it.
 */
export class KeyedList {
  constructor(parent, create, update) {
    Object.assign(this, {parent, create, update, elements: new Map()});
  }

  show(items, keyOf) {
    const keys = new Set(items.map(keyOf));
    // Removes first, so that remaining elements are not moved. Moving an element loses the keyboard focus.
    for (const [key, element] of this.elements) {
      if (keys.has(key)) continue;
      element.remove();
      this.elements.delete(key);
    }
    let previous = null;
    for (const item of items) {
      const key = keyOf(item);
      let element = this.elements.get(key);
      if (!element) this.elements.set(key, element = this.create(item));
      const place = previous ? previous.nextSibling : this.parent.firstChild;
      if (place !== element) this.parent.insertBefore(element, place);
      this.update(element, item);
      previous = element;
    }
  }
}

// The monitor may not know a number yet, for example a rate after the first reading. The page shows a dash then.
const isNumber = (value) => typeof value === 'number' && !Number.isNaN(value);

/** Formats a number with this many digits after the point. */
export const fixed = (value, digits) => isNumber(value) ? value.toFixed(digits) : '–';

/** Formats a number with three digits, without an exponent. */
export function number(value) {
  if (!isNumber(value)) return '–';
  if (value === 0) return '0';
  const digits = Math.max(0, Math.min(3, 2 - Math.floor(Math.log10(Math.abs(value)))));
  return value.toFixed(digits).replace(/(\.\d*?)0+$/, '$1').replace(/\.$/, '');
}

/** Formats a counter. */
export const count = (value) => isNumber(value) ? String(value) : '–';

/** Formats nanoseconds in a suitable unit. */
export function duration(ns) {
  if (!isNumber(ns)) return '–';
  if (ns < 1e3) return `${number(ns)} ns`;
  if (ns < 1e6) return `${number(ns / 1e3)} µs`;
  if (ns < 1e9) return `${number(ns / 1e6)} ms`;
  return `${number(ns / 1e9)} s`;
}

export function silence(seconds) {
  if (!isNumber(seconds)) return '–';
  if (seconds < 1) return 'now';
  if (seconds < 120) return `${Math.round(seconds)} s ago`;
  return seconds < 7200 ? `${Math.round(seconds / 60)} min ago` : `${Math.round(seconds / 3600)} h ago`;
}
