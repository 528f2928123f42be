// SPDX-License-Identifier: Apache-2.0
// The tables of ports and call queues. Each has one row that is updated.
import {KeyedList, count, duration, make, makeSvg, number, setAttributes, setClass, setText, silence} from './dom.js';
import {Sorter} from './sort.js';

const find = (id) => document.getElementById(id);

/** Returns a key that identifies a port: link, owner and name. */
export const keyOfPort = (link, port) => `${link.name}/${port.owner}/${port.name}`;

const otherSide = {first: 'second', second: 'first'};

/** Returns who sends and who receives: models, or the program if a link belongs to no host. */
export function direction(link, port) {
  const [from, to] = [port.writer, otherSide[port.writer]].map((side) => link.sides[side]), name = ({model, program}) => model === 'unknown' ? program || '–' : model;
  return from.model === 'unknown' && from.pid === to.pid ? name(from) : `${name(from)} → ${name(to)}`;
}

/** Writes cells into a row, from column `first`. A cell is a text with a class, or a histogram. */
export function fill(row, first, cells) {
  while (row.children.length < first + cells.length) {
    const cell = make('td');
    cell.dataset.label = row.closest('table').tHead.rows[0].cells[row.children.length].textContent; // shown on a narrow page
    row.append(cell);
  }
  cells.forEach((content, i) => {
    const cell = row.children[first + i];
    if (!Array.isArray(content)) return fillHistogram(cell, content.histogram);
    setText(cell, content[0]);
    setClass(cell, content[1]);
  });
}

const firstOctave = 7, octaves = 24, barWidth = 5, barHeight = 20; // from 2^7 ns

/** Draws a histogram of octaves; `times` may be null. Heights are logarithms of the numbers of samples. */
function fillHistogram(cell, times) {
  if (cell.firstElementChild?.tagName !== 'svg') {
    cell.replaceChildren(makeSvg('svg', {viewBox: `0 0 ${octaves * barWidth} ${barHeight + 1}`, class: 'histogram', role: 'img'}));
    cell.firstChild.append(makeSvg('path', {class: 'base', d: `M 0 ${barHeight + 0.5} H ${octaves * barWidth}`}),
      makeSvg('path', {class: 'bars'}), makeSvg('title'));
  }
  const [, bars, title] = cell.firstChild.children;
  const counts = new Map();
  for (const [end, samples] of times?.octaves ?? []) {
    const octave = Math.max(0, Math.min(octaves - 1, Math.round(Math.log2(end)) - firstOctave));
    counts.set(octave, (counts.get(octave) ?? 0) + samples);
  }
  const highest = Math.log2(1 + Math.max(1, ...counts.values()));
  setAttributes(bars, {d: [...counts].map(([octave, samples]) =>
    `M ${octave * barWidth} ${barHeight} v ${-(Math.log2(1 + samples) / highest * barHeight).toFixed(1)} h ${barWidth - 1} V ${barHeight} z`).join(' ')});
  setText(title, (times?.octaves ?? []).map(([end, samples]) => `below ${duration(end)}: ${samples}`).join('\n') || 'no samples in the last seconds');
}

export const time = (times, which) => [duration(times?.[which]), 'number'];

/** With more rows than this, the page contains only those in view. */
const mostRows = 100;

/** The rows of a long table in view, and some around them. Empty bodies replace the others. */
export class RowWindow {
  constructor(table, changed) {
    Object.assign(this, {table, view: table.closest('.scroll'), spaces: null});
    this.view.addEventListener('scroll', () => { if (this.spaces) changed(); }, {passive: true});
  }

  /** Returns the items to show, and sets the heights of the empty bodies. */
  of(items) {
    if (items.length <= mostRows) {
      this.spaces?.forEach((space) => space.remove());
      this.spaces = null;
      return items;
    }
    const body = this.table.tBodies[this.spaces ? 1 : 0];
    this.height = body.rows[0]?.offsetHeight || this.height || 32;
    if (!this.spaces) {
      this.spaces = [0, 1].map(() => make('tbody', 'space'));
      for (const space of this.spaces) space.append(make('tr')), space.rows[0].append(make('td'));
      body.before(this.spaces[0]);
      body.after(this.spaces[1]);
    }
    const rows = Math.ceil(this.view.clientHeight / this.height) + 20;
    const first = Math.max(0, Math.min(items.length - rows, Math.floor(this.view.scrollTop / this.height) - 10));
    const shown = items.slice(first, first + rows);
    [first, items.length - first - shown.length].forEach((count, i) => {
      const height = `${count * this.height}px`;
      if (this.spaces[i].style.height !== height) this.spaces[i].style.height = this.spaces[i].rows[0].cells[0].style.height = height;
    });
    setAttributes(this.table, {'aria-rowcount': items.length + 1});
    this.first = first;
    return shown;
  }

  /** Keeps the columns from becoming narrower while other rows are in view. */
  keepWidths() {
    if (!this.spaces) return;
    for (const head of this.table.tHead.rows[0].cells) {
      const width = `${head.offsetWidth}px`;
      if (parseFloat(head.style.minWidth || 0) < head.offsetWidth) head.style.minWidth = width;
    }
  }
}

/** Shortens a type for people: `IDL:RTC/TimedDouble:1.0` becomes TimedDouble. */
const shortType = (type) => type.replace(/^IDL:/, '').replace(/:[\d.]+$/, '').split('/').pop();

export class PortTable {
  /** `choose` is called with a port's key. `chosen`: key of the selected port, or empty. */
  constructor(choose) {
    this.chosen = '';
    this.window = new RowWindow(find('ports'), () => this.draw());
    this.items = [];
    this.sorter = new Sorter(find('ports'), {
      0: ({port}) => port.name, 1: ({port}) => port.sent_per_s, 2: ({port}) => port.silent_s, 3: ({port}) => port.lost,
      4: ({port}) => port.age?.p50_ns, 5: ({port}) => port.age?.p99_ns, 6: ({port}) => port.age?.max_ns, 8: ({port}) => port.waiting,
      9: ({link, port}) => port.damage ? '' : direction(link, port), 10: ({link}) => link.name, 11: ({port}) => shortType(port.type ?? ''),
    }, () => this.show(this.links));
    this.list = new KeyedList(find('ports').tBodies[0], ({key, port}) => this.createRow(key, port, choose),
      (row, item) => this.updateRow(row, item));
  }

  createRow(key, port, choose) {
    const row = make('tr');
    const head = make('th');
    head.scope = 'row';
    const button = make('button', '', port.name);
    button.type = 'button';
    button.addEventListener('click', () => choose(key));
    head.append(button);
    row.append(head);
    return row;
  }

  updateRow(row, {key, link, port}) {
    const head = row.firstChild;
    setAttributes(head.firstChild, {'aria-pressed': key === this.chosen});
    if (port.component && head.title !== port.component) head.title = port.component;
    if (port.damage) return fill(row, 1, [...Array(9).fill(['', '']), [link.name, ''], [`damaged: ${port.damage}`, 'bad']]);
    const lost = count(port.lost), {recently = {}} = port;
    fill(row, 1, [
      [number(port.sent_per_s), 'number'],
      [recently.missed_deadlines > 0 ? `◷ ${silence(port.silent_s)}` : silence(port.silent_s), recently.missed_deadlines > 0 ? 'number warn' : 'number'],
      [recently.lost > 0 ? `▼ ${lost}` : lost, recently.lost > 0 ? 'number bad' : 'number'],
      time(port.age, 'p50_ns'), time(port.age, 'p99_ns'), time(port.age, 'max_ns'),
      {histogram: port.age},
      [count(port.waiting), 'number'],
      [direction(link, port), ''], [link.name, ''], [shortType(port.type ?? ''), ''],
    ]);
  }

  /** Draws the part of the table in view. */
  draw() {
    this.list.show(this.window.of(this.items), (item) => item.key);
    this.window.keepWidths();
  }

  show(links) {
    this.links = links;
    const wanted = find('filter').value.toLowerCase();
    const items = [];
    let all = 0;
    for (const link of links)
      for (const port of link.ports) {
        ++all;
        const text = `${port.name} ${port.component ?? ''} ${port.type ?? ''}`.toLowerCase();
        if (text.includes(wanted)) items.push({key: keyOfPort(link, port), link, port});
      }
    this.items = this.sorter.sort(items);
    this.draw();
    setText(find('ports-count'), items.length === all ? `${all} ports` : `${items.length} of ${all} ports`);
  }
}

export class CallTable {
  constructor() {
    const times = (which) => ({queue}) => queue.round_trip?.[which];
    this.sorter = new Sorter(find('calls'), {0: ({link, queue}) => queue.damage ? '' : link.sides[queue.callers].model, 1: ({link}) => link.name,
      2: ({queue}) => queue.calls_per_s, 3: ({queue}) => queue.answered_per_s, 4: ({queue}) => queue.open_calls, 5: times('p50_ns'),
      6: times('p99_ns'), 7: times('max_ns'), 9: ({queue}) => queue.calls, 10: ({queue}) => queue.timeouts, 11: ({queue}) => queue.overloads,
      12: ({queue}) => queue.cancels}, () => this.show(this.links));
    this.list = new KeyedList(find('calls').tBodies[0], () => make('tr'), (row, {link, queue}) => {
      if (queue.damage) return fill(row, 0, [[queue.name, ''], [link.name, ''], [`damaged: ${queue.damage}`, 'bad']]);
      const failing = queue.recently?.failed > 0 ? 'number bad' : 'number';
      fill(row, 0, [
        [`${link.sides[queue.callers].model} host`, ''], [link.name, ''],
        [number(queue.calls_per_s), 'number'], [number(queue.answered_per_s), 'number'],
        [count(queue.open_calls), 'number'],
        time(queue.round_trip, 'p50_ns'), time(queue.round_trip, 'p99_ns'),
        time(queue.round_trip, 'max_ns'), {histogram: queue.round_trip},
        [count(queue.calls), 'number'], [count(queue.timeouts), failing], [count(queue.overloads), failing],
        [count(queue.cancels), 'number'],
      ]);
    });
  }

  show(links) {
    this.links = links;
    const queues = this.sorter.sort(links.flatMap((link) => link.call_queues.map((queue) => ({link, queue}))));
    this.list.show(queues, ({link, queue}) => `${link.name}/${queue.owner}/${queue.name}`);
    find('calls-empty').hidden = queues.length > 0;
    find('calls').hidden = queues.length === 0;
  }
}
