// SPDX-License-Identifier: Apache-2.0
// Draws the graph of hosts, components, ports and services. topology.js selects the contents. The library elkjs
// computes the layout in a worker, only when parts come or go.
import {KeyedList, duration, makeSvg, number, setAttributes, setClass, setText} from '../dom.js';
import {rowsOf} from '../ticks.js';
import {hasDetail, topologyOf} from './topology.js';

/** Seconds without a message until an edge becomes grey. */
const stale = 2;
const letter = 7.2, boldLetter = 8.6, row = 24, dot = 8;
const layerGap = 30, widestGap = 420, mostFitted = 40; // edges: a layout of more takes long
const sideSigns = {alive: '✓', stopped: '❚❚', dead: '✕', gone: '✕', absent: '…'};
const kindSigns = {provided: '◉ ', required: '◡ ', event: '⚑ ', in: '', out: ''};

const stateTexts = {active: '✓ active', inactive: '○ not active', error: '✕ ERROR'};
/** The height above a component's ports: its name, and its state if the host publishes it. */
const headOf = (component) => hasDetail(component) ? 44 : 28;

/** Returns when a component runs that has no ticks of its own; empty if that is unknown. */
function executionOf({base, part, contexts = []}) {
  if (part?.execution) return part.period_ns > 0 ? duration(part.period_ns) : part.execution === 'passive' ? '' : part.execution;
  const context = contexts.find(({running}) => running) ?? contexts[0];
  if (!context) return '';
  const when = context.kind === 'periodic' ? duration(context.period_ns) : 'triggered';
  return context.owner === base ? when : `${when} of ${context.owner}`;
}

/** Returns what there is to know about a component, one line each. */
function detailsOf({base, part, contexts = [], row}) {
  const lines = [part?.type ? `${base}, of type ${part.type}` : base];
  if (part?.execution) lines.push(`executed: ${part.execution}${part.period_ns > 0 ? `, every ${duration(part.period_ns)}` : ''}`);
  for (const {owner, kind, period_ns: period, running, components} of contexts) {
    const members = components.filter((name) => name !== owner);
    lines.push(`context of ${owner}: ${kind}, ${duration(period)}${running ? '' : ', not running'}${members.length > 0 ? `, with ${members.join(', ')}` : ''}`);
  }
  if (row?.tick?.execution) lines.push(`cycle: p50 ${duration(row.tick.execution.p50_ns)}, p99 ${duration(row.tick.execution.p99_ns)}`);
  if (part?.names.length > 0) lines.push(`named ${part.names.join(', ')}`);
  return lines.join('\n');
}

/** Returns the processor time and memory of a host. */
const usageOf = ({listed, state}) => listed && (state === 'alive' || state === 'stopped') ? `${listed.cpu_percent.toFixed(0)} % CPU, ${(listed.resident_bytes / 2 ** 20).toFixed(0)} MiB` : '';
const threadsOf = ({listed}) => listed ? `${listed.threads} threads; the busiest: ${listed.busiest_threads.slice(0, 8)
  .map(({name, cpu_percent: share}) => `${name} ${share.toFixed(1)} %`).join(', ')}` : '';

/** Returns a component's state and period for people, and the class of its box. */
function describe(component) {
  const {mirror, row: published} = component;
  if (mirror || !published) return ['', mirror ? 'component mirror' : 'component'];
  const {state, tick} = published, hang = tick?.hang;
  const period = hang ? `! hangs ${duration(hang.seconds * 1e9)}` : tick ? duration(tick.period_ns) : executionOf(component);
  return [`${stateTexts[state] ?? '–'}${period ? `, ${period}` : ''}`, `component${hang || state === 'error' ? ' failed' : state === 'inactive' ? ' inactive' : ''}`];
}

const labelOf = (port) => `${kindSigns[port.kind]}${port.name}`;
const widthOf = (text) => Math.ceil(text.length * letter);
const boldWidthOf = (text) => Math.ceil(text.length * boldLetter);

/** Returns the input of elkjs: first sides left, second sides right, data in both directions in between. `gap`: between layers. */
function elkGraph({hosts, edges}, gap) {
  // elkjs makes a host as wide as its components, so these must be as wide as the host's title.
  const component = (c, host) => {
    const width = Math.max(120, boldWidthOf(host.title), boldWidthOf(c.name) + 24, c.row ? widthOf(describe(c)[0]) + 24 : 0, ...c.ports.map((p) => widthOf(labelOf(p)) + (p.alone ? 90 : 24)));
    const port = (p, i) => ({id: p.id, width: dot, height: dot, x: p.side === 'first' ? width - dot / 2 : -dot / 2,
      y: headOf(c) + row * i + 5, layoutOptions: {'elk.port.side': p.side === 'first' ? 'EAST' : 'WEST'}});
    const inner = (p, i) => ({id: p.inner, width: dot, height: dot, x: p.side === 'first' ? -dot / 2 : width - dot / 2,
      y: headOf(c) + row * i + 5, layoutOptions: {'elk.port.side': p.side === 'first' ? 'WEST' : 'EAST'}});
    const ports = c.ports.flatMap((p, i) => p.inner ? [port(p, i), inner(p, i)] : [port(p, i)]);
    return {id: c.id, width, height: headOf(c) + 6 + row * c.ports.length, ports,
      layoutOptions: {'elk.portConstraints': 'FIXED_POS'}};
  };
  return {
    id: 'root',
    layoutOptions: {'elk.algorithm': 'layered', 'elk.direction': 'RIGHT', 'elk.hierarchyHandling': 'INCLUDE_CHILDREN',
      'elk.layered.considerModelOrder.strategy': 'NODES_AND_EDGES', 'elk.layered.spacing.nodeNodeBetweenLayers': String(gap),
      'elk.spacing.nodeNode': '18', 'elk.spacing.edgeLabel': '0', 'elk.spacing.labelLabel': '0', 'elk.spacing.edgeEdge': '4',
      'elk.spacing.edgeNode': '4', 'elk.spacing.labelNode': '0', 'elk.layered.nodePlacement.strategy': 'NETWORK_SIMPLEX', 'elk.padding': '[top=4,left=4,bottom=4,right=4]'},
    children: hosts.map((host) => ({id: host.id, children: host.components.map((c) => component(c, host)),
      layoutOptions: {'elk.padding': '[top=63,left=14,bottom=14,right=14]', 'elk.nodeSize.constraints': 'MINIMUM_SIZE',
        'elk.nodeSize.minimum': `(${boldWidthOf(host.title) + 30},60)`}})),
    edges: edges.map((edge) => ({id: edge.id, sources: [edge.left], targets: [edge.right],
      labels: edge.inside ? [] : [{id: `${edge.id} label`, text: 'rate', width: 84, height: 16, layoutOptions: {'elk.edgeLabels.inline': 'true'}}]})),
  };
}

/** Returns the absolute positions of all parts by their ids. */
function placesOf(layout) {
  const places = new Map(), edges = new Map();
  const walk = (node, x, y) => {
    places.set(node.id, {x, y, width: node.width, height: node.height});
    for (const port of node.ports ?? []) places.set(port.id, {x: x + port.x + dot / 2, y: y + port.y + dot / 2});
    for (const child of node.children ?? []) walk(child, x + child.x, y + child.y);
  };
  walk(layout, 0, 0);
  // An edge's points are relative to its container in elkjs.
  for (const edge of layout.edges ?? []) {
    const from = places.get(edge.container ?? layout.id);
    const move = ({x, y}) => [x + from.x, y + from.y];
    const [section] = edge.sections, label = edge.labels?.[0];
    edges.set(edge.id, {points: [section.startPoint, ...(section.bendPoints ?? []), section.endPoint].map(move),
      label: label ? move({x: label.x + label.width / 2, y: label.y + 12}) : null});
  }
  return {places, edges, width: layout.width, height: layout.height};
}

function edgeState({port, dead, service, refused, inside}) {
  if (inside) return service ? 'inside service' : 'inside';
  if (dead) return 'dead';
  if (refused) return 'refused';
  if (service) return 'service';
  if (port.damage || port.recently.lost > 0) return 'lost';
  return port.silent_s === null || port.silent_s > stale ? 'stale' : 'live';
}

const rateOf = (port) => port.damage ? '✕ damaged' : `${port.recently.lost > 0 ? '▼ ' : ''}${number(port.sent_per_s)}/s`;

export class Graph {
  /** `note`: text for omitted parts. `choose`: called with a port's key. `filter`: called with a group's component. */
  constructor(parent, note, choose, filter) {
    Object.assign(this, {parent, note, choose, filter, chosen: '', key: '', drawing: null, last: new Map(), lastHosts: new Map()});
    this.svg = makeSvg('svg', {role: 'group', 'aria-label': 'Hosts, components and ports'});
    const layer = (create, update) => {
      const group = makeSvg('g');
      this.svg.append(group);
      return new KeyedList(group, create, update);
    };
    this.hosts = layer(() => this.createBox(3), (box, host) => this.updateHost(box, host));
    this.components = layer(() => this.createBox(2), (box, component) => this.updateComponent(box, component));
    this.edges = layer(() => this.createEdge(), (edge, item) => this.updateEdge(edge, item));
    this.ports = layer((port) => this.createPort(port), (element, port) => this.updatePort(element, port));
    parent.append(this.svg);
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

  show({links, refused_connections: refused, components, ticks, hosts}) {
    const topology = topologyOf(links.map((link) => this.withLastPorts(link)), refused, rowsOf({components, ticks}), this.withLastHosts({links, hosts}));
    this.parent.hidden = topology.hosts.length === 0;
    setText(this.note, topology.hosts.length === 0 ? 'No host.' : topology.note || (this.failure ?? ''));
    this.note.hidden = this.note.textContent === '';
    this.newest = topology;
    const resized = Math.abs(this.parent.clientWidth - this.width) > 40;
    if (topology.key !== this.key || resized) this.layOut(topology);
    else this.draw();
  }

  async layOut(topology) {
    this.key = topology.key;
    try {
      this.elk ??= await loadElk();
      const layout = await this.fit(topology);
      if (this.key !== topology.key) return; // changed meanwhile; another layout follows
      this.drawing = {key: topology.key, ...placesOf(layout)};
      this.draw();
    } catch (failure) {
      this.failure = `The graph cannot be laid out: ${failure.message ?? failure}`;
      this.parent.hidden = true;
    }
  }

  /** Lays the graph out so that the gaps between its layers fill the width of the page. The width grows with them in proportion. */
  async fit(topology) {
    this.width = this.parent.clientWidth;
    const narrow = await this.elk.layout(elkGraph(topology, layerGap)), missing = this.width - narrow.width - 4;
    if (missing < 20 || topology.edges.length > mostFitted) return narrow;
    const wide = await this.elk.layout(elkGraph(topology, layerGap + missing)), slope = (wide.width - narrow.width) / missing;
    return slope > 0 ? this.elk.layout(elkGraph(topology, Math.min(widestGap, layerGap + missing / slope))) : narrow;
  }

  draw() {
    const {drawing, newest} = this;
    if (drawing === null || newest.key !== drawing.key) return;
    setAttributes(this.svg, {viewBox: `0 0 ${Math.ceil(drawing.width)} ${Math.ceil(drawing.height)}`});
    // Somewhat smaller on a narrow page; what still does not fit scrolls.
    this.svg.style.width = `${Math.ceil(Math.max(0.75 * drawing.width, Math.min(drawing.width, this.parent.clientWidth - 2)))}px`;
    const components = newest.hosts.flatMap((host) => host.components);
    this.hosts.show(newest.hosts, (host) => host.id);
    this.components.show(components, (component) => component.id);
    this.edges.show(newest.edges, (edge) => edge.id);
    this.ports.show(components.flatMap((component) => component.ports), (port) => port.id);
  }

  createBox(lines) {
    const box = makeSvg('g');
    box.append(makeSvg('rect', {rx: 6}));
    for (let i = 0; i < lines; ++i) box.append(makeSvg('text', {class: i === 0 ? 'name' : 'detail'}));
    box.append(makeSvg('title'));
    return box;
  }

  updateBox(box, item, className, lines, title) {
    const {x, y, width, height} = this.drawing.places.get(item.id);
    setClass(box, className);
    setAttributes(box.firstChild, {x, y, width, height});
    lines.forEach((text, i) => {
      setAttributes(box.children[i + 1], {x: x + 10, y: y + 17 + 17 * i});
      setText(box.children[i + 1], text);
    });
    setText(box.lastChild, title);
  }

  updateHost(box, host) {
    const word = host.state !== 'dead' && host.state !== 'gone' ? host.state : host.ended ? 'ended in order' : 'died';
    this.updateBox(box, host, `host ${host.state}`, [host.title, `${sideSigns[host.state] ?? '?'} ${word}${host.pid ? `, pid ${host.pid}` : ''}`, usageOf(host)], threadsOf(host));
  }

  updateComponent(box, component) {
    const [detail, className] = describe(component);
    this.updateBox(box, component, className, [component.name, detail], detailsOf(component));
  }

  createEdge() {
    const edge = makeSvg('g');
    edge.append(makeSvg('path', {class: 'line'}), makeSvg('path', {class: 'head'}), makeSvg('rect', {rx: 3, height: 16, class: 'back'}),
      makeSvg('text', {class: 'rate'}), makeSvg('title'));
    return edge;
  }

  updateEdge(edge, item) {
    const {points, label} = this.drawing.edges.get(item.id);
    const [line, head, back, rate, title] = edge.children;
    setClass(edge, `edge ${edgeState(item)}`);
    setAttributes(line, {d: `M ${points.map((point) => point.join(' ')).join(' L ')}`});
    const right = item.toRight, [x, y] = right ? points.at(-1) : points[0];
    setAttributes(head, {d: `M ${x} ${y} l ${right ? -10 : 10} -5 v 10 z`});
    back.style.display = label === null ? 'none' : '';
    setText(title, item.title);
    if (label === null) return;
    const text = item.refused ? '✕ refused' : item.service ? 'calls' : item.dead ? '–' : rateOf(item.port), width = widthOf(text) + 4;
    setAttributes(back, {x: label[0] - width / 2, y: label[1] - 13, width});
    setAttributes(rate, {x: label[0], y: label[1]});
    setText(rate, text);
  }

  createPort(port) {
    const group = makeSvg('g');
    group.append(makeSvg('circle', {r: 4.5}), makeSvg('text'), makeSvg('title'));
    if (!port.key && !port.filter) return group;
    const act = () => port.key ? this.choose(port.key) : this.filter(port.filter);
    setAttributes(group, {tabindex: 0, role: 'button'});
    group.addEventListener('click', act);
    group.addEventListener('keydown', (event) => {
      if (event.key !== 'Enter' && event.key !== ' ') return;
      event.preventDefault();
      act();
    });
    return group;
  }

  updatePort(group, port) {
    const {x, y} = this.drawing.places.get(port.id);
    const [dot, text, title] = group.children;
    if (port.key || port.filter) setAttributes(group, {'aria-label': port.name});
    setClass(group, `port${port.mismatch ? ' mismatch' : port.inside ? port.connections === 0 ? ' inside unconnected' : ' inside' : ''}${port.key && port.key === this.chosen ? ' chosen' : ''}`);
    setAttributes(dot, {cx: x, cy: y});
    const left = port.side === 'first';
    setAttributes(text, {x: left ? x - 10 : x + 10, y: y + 4, 'text-anchor': left ? 'end' : 'start'});
    setText(text, `${port.mismatch ? '✕ ' : ''}${labelOf(port)}${port.alone && port.port ? `  ${rateOf(port.port)}` : ''}`);
    setText(title, port.mismatch ? `${port.name}: ${port.mismatch}` : `${port.name} ${port.type ?? ''}`);
  }
}

/** Loads elkjs with its layout in a worker. It defines the global `ELK`. */
async function loadElk() {
  try {
    await import('../lib/elk-api.js');
  } catch {
    throw new Error('elkjs is not there; build Tandem where npm can install it');
  }
  return new globalThis.ELK({workerUrl: new URL('../lib/elk-worker.min.js', import.meta.url).href});
}
