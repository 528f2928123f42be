// SPDX-License-Identifier: Apache-2.0
// Plots numbers over time.
import {KeyedList, make, makeSvg, number, setAttributes, setText} from './dom.js';

const height = 200, left = 56, bottom = 22;
const mostCurves = 6;

/** Curves of the last `seconds` in an <svg>. Entries in `legend` show names and newest values, and toggle curves. */
export class Plot {
  constructor(svg, legend, seconds) {
    Object.assign(this, {svg, seconds, curves: new Map(), hidden: new Set()}); // name: list of [time in ms, value]
    setAttributes(svg, {class: 'plot'});
    this.labels = [0, 1].map(() => makeSvg('text', {x: left - 6, class: 'axis', 'text-anchor': 'end'}));
    setAttributes(this.labels[0], {y: height - bottom});
    setAttributes(this.labels[1], {y: 14});
    this.axis = makeSvg('path', {class: 'frame'});
    const from = makeSvg('text', {x: left, y: height - 5, class: 'axis'}, `${seconds} s ago`);
    this.to = makeSvg('text', {y: height - 5, class: 'axis', 'text-anchor': 'end'}, 'now');
    const lines = makeSvg('g');
    svg.append(this.axis, from, this.to, ...this.labels, lines);
    this.lines = new KeyedList(lines, ({index}) => makeSvg('polyline', {class: `curve curve${index}`}),
      (line, {points}) => setAttributes(line, {points}));
    this.legend = new KeyedList(legend, ({name, index}) => {
      const entry = make('button', `entry entry${index}`);
      entry.type = 'button';
      entry.addEventListener('click', () => {
        if (!this.hidden.delete(name)) this.hidden.add(name);
        this.draw(this.time);
      });
      const line = makeSvg('svg', {viewBox: '0 0 26 8', width: 26, height: 8, 'aria-hidden': 'true'});
      line.append(makeSvg('line', {class: `curve curve${index}`, x1: 0, x2: 26, y1: 4, y2: 4}));
      entry.append(line, ' ', make('span', 'name', name), ' ', make('b'));
      return entry;
    }, (entry, {name, last}) => {
      setText(entry.lastChild, number(last));
      setAttributes(entry, {'aria-pressed': !this.hidden.has(name), title: this.hidden.has(name) ? 'show' : 'hide'});
    });
  }

  clear() {
    this.curves.clear();
    this.hidden.clear();
  }

  /** `numbers`: pairs of name and value at `time` in ms. The first names get the curves. */
  add(time, numbers) {
    for (const [name, value] of numbers) {
      if (!this.curves.has(name) && this.curves.size >= mostCurves) continue;
      const points = this.curves.get(name) ?? this.curves.set(name, []).get(name);
      if (points.length === 0 || points.at(-1)[0] < time) points.push([time, value]);
    }
    for (const [name, points] of this.curves) {
      while (points.length > 0 && points[0][0] < time - 1000 * this.seconds) points.shift();
      if (points.length === 0) this.curves.delete(name);
    }
    this.draw(time);
  }

  draw(now) {
    this.time = now;
    const all = [...this.curves].filter(([name]) => !this.hidden.has(name)).flatMap(([, points]) => points.map(([, value]) => value));
    this.svg.toggleAttribute('hidden', this.curves.size === 0);
    if (all.length === 0) all.push(0);
    let low = Math.min(...all), high = Math.max(...all);
    if (low === high) [low, high] = [low - 1, high + 1];
    setText(this.labels[0], number(low));
    setText(this.labels[1], number(high));
    // Uses the current width, so that the font size stays the same.
    const width = Math.max(240, this.svg.clientWidth || 560);
    setAttributes(this.svg, {viewBox: `0 0 ${width} ${height}`});
    setAttributes(this.axis, {d: `M ${left} 6 V ${height - bottom} H ${width - 4}`});
    setAttributes(this.to, {x: width - 4});
    const x = (time) => left + (width - 4 - left) * (1 - (now - time) / 1000 / this.seconds);
    const y = (value) => 8 + (height - bottom - 10) * (high - value) / (high - low);
    const curves = [...this.curves].map(([name, points], index) => ({name, index, last: points.at(-1)[1],
      points: points.map(([time, value]) => `${x(time).toFixed(1)},${y(value).toFixed(1)}`).join(' ')}));
    this.lines.show(curves.filter(({name}) => !this.hidden.has(name)), ({name}) => name);
    this.legend.show(curves, ({name}) => name);
  }
}
