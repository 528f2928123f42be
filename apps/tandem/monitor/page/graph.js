// SPDX-License-Identifier: Apache-2.0
// Draws each link: the boxes of its two hosts, and an arrow for each port between them.
import {KeyedList, make, makeSvg, number, setAttributes, setClass, setText} from './dom.js';
import {keyOfPort} from './tables.js';

const top = 12, rowHeight = 26, mostRows = 24;
/** Seconds without a message after which an arrow is grey. */
const stale = 2;

const sideSigns = {alive: '✓', stopped: '❚❚', dead: '✕', absent: '…'};

class Host {
  constructor(parent) {
    this.box = makeSvg('rect', {y: top, rx: 6});
    this.lines = [0, 1, 2].map((i) => makeSvg('text', {class: i === 0 ? 'name' : 'detail'}));
    parent.append(this.box, ...this.lines);
  }

  show(side, x, width, height) {
    setClass(this.box, `host ${side.state}`);
    setAttributes(this.box, {x, width, height});
    const middle = top + height / 2;
    const state = `${sideSigns[side.state] ?? '?'} ${side.state}${side.pid ? `, ${side.pid}` : ''}`;
    [`${side.model} host`, side.program || '–', state].forEach((text, i) => {
      setAttributes(this.lines[i], {x: x + width / 2, y: middle - 14 + 18 * i});
      setText(this.lines[i], text);
    });
  }
}

/** An arrow with its port's name and rate. */
function createEdge() {
  const edge = makeSvg('g');
  edge.append(makeSvg('line'), makeSvg('path'), makeSvg('text', {class: 'port'}), makeSvg('text', {class: 'rate'}),
    makeSvg('title'));
  return edge;
}

function updateEdge(edge, {port, row, dead, left, right}) {
  const [line, head, name, rate, title] = edge.children;
  const y = top + 22 + row * rowHeight, letters = Math.floor((right - left - 90) / 8);
  const state = dead ? 'dead' : port.damage || port.recently.lost > 0 ? 'lost'
    : port.silent_s === null || port.silent_s > stale ? 'stale' : 'live';
  setClass(edge, `edge ${state}`);
  setAttributes(line, {x1: left, x2: right, y1: y, y2: y});
  const tip = port.writer === 'first' ? right : left, back = port.writer === 'first' ? -9 : 9;
  setAttributes(head, {d: `M ${tip} ${y} l ${back} -5 v 10 z`});
  setAttributes(name, {x: left + 14, y: y - 5});
  setText(name, port.name.length > letters ? `${port.name.slice(0, letters - 1)}…` : port.name);
  setAttributes(rate, {x: right - 14, y: y - 5});
  setText(rate, port.damage ? 'damaged' : `${port.recently.lost > 0 ? '▼ ' : ''}${number(port.sent_per_s)}/s`);
  setText(title, `${port.name} ${port.type ?? ''}`);
}

class Link {
  constructor() {
    this.element = make('figure', 'link');
    this.caption = make('figcaption');
    this.svg = makeSvg('svg', {role: 'img'});
    this.element.append(this.caption, this.svg);
    this.hosts = {first: new Host(this.svg), second: new Host(this.svg)};
    const edges = makeSvg('g');
    this.svg.append(edges);
    this.edges = new KeyedList(edges, createEdge, updateEdge);
  }

  show(link) {
    const shown = link.readable ? link.ports.slice(0, mostRows) : [];
    const more = link.ports.length - shown.length;
    setText(this.caption, `${link.name}, generation ${link.generation}${link.readable ? '' : `: ${link.reason}`}` +
      (more > 0 ? `; ${more} more ports are in the table` : ''));
    this.svg.toggleAttribute('hidden', !link.readable);
    if (!link.readable) return;
    // Drawn for the width that there is, so that letters keep their size.
    const width = Math.max(320, Math.min(800, this.element.clientWidth || 800)), box = width < 560 ? 104 : 150;
    const height = Math.max(76, 22 + shown.length * rowHeight);
    setAttributes(this.svg, {viewBox: `0 0 ${width} ${height + top + 4}`,
      'aria-label': `Link ${link.name}: OPRoS host ${link.sides.first.state}, RTM host ${link.sides.second.state}`});
    this.hosts.first.show(link.sides.first, 2, box, height);
    this.hosts.second.show(link.sides.second, width - box - 2, box, height);
    const dead = Object.values(link.sides).some((side) => side.state !== 'alive');
    this.edges.show(shown.map((port, row) => ({port, row, dead, left: box + 8, right: width - box - 8})), ({port}) => keyOfPort(link, port));
  }
}

export class Graph {
  constructor(parent) {
    this.empty = parent.querySelector('.empty');
    this.links = new Map();
    const box = make('div', 'links');
    parent.append(box);
    this.list = new KeyedList(box, (link) => {
      const drawn = new Link();
      this.links.set(drawn.element, drawn);
      return drawn.element;
    }, (element, link) => this.links.get(element).show(link));
  }

  show(links) {
    this.empty.hidden = links.length > 0;
    this.list.show(links, (link) => link.name);
    for (const element of this.links.keys()) if (!element.isConnected) this.links.delete(element);
  }
}
