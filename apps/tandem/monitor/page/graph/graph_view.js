// SPDX-License-Identifier: Apache-2.0
// The view "System": has the graph laid out when parts come or go, draws it for each state, folds, searches, and saves it.
import {setText} from '../dom.js';
import {rowsOf} from '../ticks.js';
import {Connector} from './connector.js';
import {Drawing} from './drawing.js';
import {Folds, foldedTopology} from './fold.js';
import {layOut} from './layout.js';
import {svgFileOf} from './svg_file.js';
import {topologyOf} from './topology.js';
import {Zoom} from './zoom.js';

const find = (id) => document.getElementById(id);

export class Graph {
  /** `choose`: called with a port's key. `filter`: called with the component of a line of ports. `system`: of system_view.js. */
  constructor(choose, filter, system) {
    Object.assign(this, {parent: find('graph'), choose, filter, key: '', layout: null, state: null, last: new Map(), lastHosts: new Map(), text: '', failure: '', at: -1});
    this.folds = new Folds();
    this.drawing = new Drawing(this.parent, {port: (port, key) => this.choosePort(port, key), fold: (box) => this.fold(box), edge: (edge) => this.connector.edge(edge)});
    this.connector = new Connector(this.drawing, system, () => this.draw());
    this.zoom = new Zoom(this.parent, this.drawing.svg, () => this.draw());
    find('graph-in').addEventListener('click', () => this.zoom.by(1.25));
    find('graph-out').addEventListener('click', () => this.zoom.by(0.8));
    find('graph-fit').addEventListener('click', () => this.zoom.fit());
    find('graph-fold').addEventListener('click', () => this.foldAll());
    find('graph-save').addEventListener('click', () => this.save());
    this.listenToSearch(find('graph-search'));
  }

  set chosen(key) { this.drawing.chosen = key; }

  listenToSearch(field) {
    field.addEventListener('input', () => {
      Object.assign(this, {text: field.value.trim().toLowerCase(), at: -1});
      this.showNext();
    });
    field.addEventListener('keydown', (event) => {
      if (event.key === 'Enter') this.showNext(event.shiftKey ? -1 : 1);
    });
    document.addEventListener('keydown', (event) => {
      if (event.key !== '/' || event.target.closest('input, select, textarea') || this.parent.closest('[role=tabpanel]').hidden) return;
      event.preventDefault();
      field.focus();
    });
  }

  /** A host that disappears removes its ports from the next generation. Keeps the old graph with dead edges. */
  withLastPorts(link) {
    const old = this.last.get(link.name);
    const gone = Object.values(link.sides).some((side) => side.state === 'gone');
    if (gone && link.ports.length === 0 && old) return {...link, ports: old.ports, shared_ports: old.shared_ports};
    this.last.set(link.name, link);
    return link;
  }

  /** A host that has died lists nothing any more. Keeps what it listed last, as long as its link shows it. */
  withLastHosts({links, hosts}) {
    const pids = new Set([...hosts, ...links.flatMap(({sides}) => Object.values(sides))].map(({pid}) => pid));
    for (const pid of this.lastHosts.keys()) if (!pids.has(pid)) this.lastHosts.delete(pid);
    for (const host of hosts) if (host.inventory) this.lastHosts.set(host.pid, host);
    const running = new Set(hosts.map(({pid}) => pid));
    return [...hosts, ...[...this.lastHosts.values()].filter(({pid}) => !running.has(pid))];
  }

  isFound({base, name, part, ports}) {
    const has = (text) => text?.toLowerCase().includes(this.text);
    return this.text !== '' && (has(base) || has(name) || has(part?.type) || ports.some((port) => has(port.name)));
  }

  /** Shows a state, or the last one again. Returns when it is drawn. */
  async show(state = this.state) {
    this.state = state;
    if (this.connector.pressed) return; // the graph holds still below the pointer
    const {links, refused_connections: refused, components, ticks, hosts} = state, known = new Set(links.map(({name}) => name));
    for (const name of this.last.keys()) if (!known.has(name)) this.last.delete(name);
    const all = topologyOf(links.map((link) => this.withLastPorts(link)), refused, rowsOf({components, ticks}), this.withLastHosts({links, hosts}));
    const topology = this.newest = foldedTopology(all, this.folds, (component) => this.isFound(component));
    this.parent.hidden = topology.hosts.length === 0;
    setText(find('graph-note'), topology.hosts.length === 0 ? 'No host.' : topology.note || this.failure);
    find('graph-note').hidden = find('graph-note').textContent === '';
    setText(find('graph-fold'), topology.hosts.some(({folded}) => folded) ? 'Unfold all' : 'Fold all');
    this.connector.show();
    const resized = Math.abs(this.parent.clientWidth - this.width) > 40;
    if (topology.key !== this.key || resized) await this.layOut(topology);
    else this.draw();
  }

  async layOut(topology) {
    this.key = topology.key;
    this.width = this.parent.clientWidth;
    try {
      const layout = await layOut(topology, this.zoom.room);
      if (this.connector.pressed) this.key = '';
      if (this.key !== topology.key) return; // changed or held meanwhile; another layout follows
      this.failure = '';
      const before = this.placeOf(this.anchor);
      this.layout = {key: topology.key, ...layout};
      this.zoom.resize(layout.width, layout.height);
      this.keepInPlace(before);
      this.draw();
    } catch (failure) {
      this.failure = `The graph cannot be laid out: ${failure.message ?? failure}`;
      this.parent.hidden = true;
    }
  }

  draw() {
    const {layout, newest} = this;
    if (layout === null || this.parent.hidden || newest.key !== layout.key) return;
    this.drawing.found = new Set(this.found().map(({id}) => id));
    this.drawing.show(newest, layout, this.zoom.view, this.zoom.scale);
    const count = this.drawing.found.size;
    setText(find('graph-found'), this.text === '' ? '' : count === 0 ? 'nothing found' : `${Math.max(0, this.at) + 1} of ${count}`);
  }

  found() { return this.newest.hosts.flatMap(({components}) => components.filter((component) => !component.others && this.isFound(component))); }

  /** Brings a found component into view: the first, or the next one. */
  async showNext(step = 1) {
    const {text, state} = this;
    if (state === null) return;
    await this.show();
    if (text !== this.text) return; // typed on meanwhile
    const found = this.found();
    this.at = found.length === 0 ? -1 : (this.at + step + found.length) % found.length;
    this.draw();
    const place = found[this.at] && this.layout?.places.get(found[this.at].id);
    if (!place) return;
    if (this.zoom.scale < 0.6) this.zoom.by(1 / this.zoom.scale);
    this.zoom.center(place);
  }

  /** Returns where the box of a host or component is in the window, or null. */
  placeOf(id) {
    const place = this.layout?.places.get(id), box = this.drawing.svg.getBoundingClientRect();
    return place ? {x: box.left + place.x * this.zoom.scale, y: box.top + place.y * this.zoom.scale} : null;
  }

  /** What has been folded stays below the pointer. */
  keepInPlace(before) {
    const after = this.placeOf(this.anchor);
    if (before && after) this.parent.scrollBy(after.x - before.x, after.y - before.y);
    this.anchor = null;
  }

  fold({fold, folded, id}) {
    this.folds.choose([fold], !folded);
    this.anchor = id.replace(/\/others$/, '');
    this.show();
  }

  foldAll() {
    const hosts = this.newest?.hosts ?? [], folded = hosts.some((host) => host.folded);
    this.folds.choose(hosts.map(({fold}) => fold), !folded);
    if (this.state) this.show();
  }

  choosePort(port, key) {
    if (this.connector.port(port, key)) return;
    if (port.fold) this.fold({...port, folded: true, id: ''});
    else if (port.key) this.choose(port.key);
    else if (port.filter) this.filter(port.filter);
  }

  /** Downloads the whole graph. */
  save() {
    if (this.layout === null || this.newest.key !== this.layout.key) return;
    this.drawing.show(this.newest, this.layout, null, 1);
    const text = svgFileOf(this.drawing.svg, getComputedStyle(document.documentElement).getPropertyValue('--panel').trim());
    const link = document.createElement('a');
    Object.assign(link, {href: URL.createObjectURL(new Blob([text], {type: 'image/svg+xml'})), download: 'tandem-graph.svg'});
    link.click();
    this.draw();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }
}
