// SPDX-License-Identifier: Apache-2.0
// The newest message of the chosen port, and its numbers over the last minute.
import {KeyedList, make, makeSvg, number, setAttributes, setText} from './dom.js';
import {keyOfPort} from './tables.js';

const find = (id) => document.getElementById(id);
const width = 560, height = 200, left = 56, bottom = 22;
const seconds = 60, mostCurves = 6;

/** The numbers of a message with their names, `pose.x`; the time of RTM's messages is none that one would plot. */
function* numbersOf(value, name = '') {
  if (typeof value === 'number') yield [name || 'value', value];
  else if (value !== null && typeof value === 'object')
    for (const [key, member] of Object.entries(value)) {
      if (name === '' && key === 'tm') continue;
      yield* numbersOf(member, Array.isArray(value) ? `${name}[${key}]` : name ? `${name}.${key}` : key);
    }
}

export class Values {
  constructor() {
    this.key = null;
    this.curves = new Map(); // name: list of [time in ms, value]
    const plot = find('plot');
    setAttributes(plot, {viewBox: `0 0 ${width} ${height}`});
    this.labels = ['low', 'high'].map(() => makeSvg('text', {x: left - 6, class: 'axis', 'text-anchor': 'end'}));
    setAttributes(this.labels[0], {y: height - bottom});
    setAttributes(this.labels[1], {y: 14});
    const axis = makeSvg('path', {class: 'frame', d: `M ${left} 6 V ${height - bottom} H ${width - 4}`});
    const from = makeSvg('text', {x: left, y: height - 5, class: 'axis'}, `${seconds} s ago`);
    const to = makeSvg('text', {x: width - 4, y: height - 5, class: 'axis', 'text-anchor': 'end'}, 'now');
    const lines = makeSvg('g');
    plot.append(axis, from, to, ...this.labels, lines);
    this.lines = new KeyedList(lines, ({index}) => makeSvg('polyline', {class: `curve curve${index}`}),
      (line, {points}) => setAttributes(line, {points}));
    this.legend = new KeyedList(find('legend'), ({name, index}) => {
      const entry = make('span', `entry entry${index}`);
      entry.append(make('span', 'name', name), ' ', make('b'));
      return entry;
    }, (entry, {last}) => setText(entry.lastChild, number(last)));
  }

  choose(key) {
    this.key = key;
    this.curves.clear();
    find('values-hint').hidden = true;
    find('values').hidden = false;
    if (this.newest) this.show(this.newest);
  }

  show(state) {
    this.newest = state;
    if (this.key === null) return;
    for (const link of state.links)
      for (const port of link.ports)
        if (keyOfPort(link, port) === this.key) return this.showPort(state.time_ms, link, port);
    setText(find('value'), 'The port is gone.');
  }

  showPort(time, link, port) {
    setText(find('values-port'), ` of ${port.name}, link ${link.name}`);
    setText(find('value'), port.value_note || (port.value === null || port.value === undefined
      ? 'No message since the monitor started.' : JSON.stringify(port.value, null, 1)));
    for (const [name, value] of numbersOf(port.value ?? null)) {
      if (!this.curves.has(name) && this.curves.size >= mostCurves) continue;
      const points = this.curves.get(name) ?? this.curves.set(name, []).get(name);
      if (points.length > 0 && points.at(-1)[0] === time) continue;
      points.push([time, value]);
    }
    for (const [name, points] of this.curves) {
      while (points.length > 0 && points[0][0] < time - 1000 * seconds) points.shift();
      if (points.length === 0) this.curves.delete(name);
    }
    this.draw(time);
  }

  draw(now) {
    const all = [...this.curves.values()].flat().map(([, value]) => value);
    find('plot').toggleAttribute('hidden', all.length === 0);
    let low = Math.min(...all), high = Math.max(...all);
    if (low === high) [low, high] = [low - 1, high + 1];
    setText(this.labels[0], number(low));
    setText(this.labels[1], number(high));
    const x = (time) => left + (width - 4 - left) * (1 - (now - time) / 1000 / seconds);
    const y = (value) => 8 + (height - bottom - 10) * (high - value) / (high - low);
    const curves = [...this.curves].map(([name, points], index) => ({name, index, last: points.at(-1)[1],
      points: points.map(([time, value]) => `${x(time).toFixed(1)},${y(value).toFixed(1)}`).join(' ')}));
    this.lines.show(curves, ({name}) => name);
    this.legend.show(curves, ({name}) => name);
  }
}
