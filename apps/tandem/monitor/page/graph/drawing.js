// SPDX-License-Identifier: Apache-2.0
// Draws hosts, components, ports and edges at the places of a layout.
import {KeyedList, makeSvg, setAttributes, setClass, setText} from '../dom.js';
import {describe, detailsOf, edgeState, edgeTextOf, labelOf, linesOf, portTextOf, threadsOf, widthOf} from './texts.js';

/** Of a graph with more components, only what is in view is drawn; below this scale without what would be too small to read. */
const mostDrawn = 150, far = 0.3;
const isPlottable = (port) => port.key || port.filter || port.fold;

export class Drawing {
  /** `on`: what clicks and keys do: `port(port, key)`, `fold(box)`, `edge(edge)`. `chosen`, `found` and `mark` may be set before show(). */
  constructor(parent, on) {
    Object.assign(this, {on, layout: null, chosen: '', found: new Set(), control: false, mark: () => ''});
    this.svg = makeSvg('svg', {role: 'group', 'aria-label': 'Hosts, components and ports'});
    const layer = (create, update) => {
      const group = makeSvg('g');
      this.svg.append(group);
      return new KeyedList(group, create, update);
    };
    this.hosts = layer(() => this.createBox(3), (box, host) => this.updateHost(box, host));
    this.components = layer(() => this.createBox(2), (box, component) => this.updateComponent(box, component));
    this.edges = layer(() => this.createEdge(), (edge, item) => this.updateEdge(edge, item));
    this.ports = layer(() => this.createPort(), (element, port) => this.updatePort(element, port));
    parent.append(this.svg);
    this.svg.addEventListener('click', (event) => this.act(event.target));
    this.svg.addEventListener('keydown', (event) => {
      if (!['Enter', ' ', 'c', 'C'].includes(event.key) || event.ctrlKey || event.metaKey || event.altKey) return;
      if (this.act(event.target, event.key.toLowerCase())) event.preventDefault();
    });
  }

  /** Returns whether there is something to do at an element. */
  act(target, key = 'Enter') {
    const element = target.closest('[role=button]');
    if (!element || (key === 'c' && element.kind !== 'port')) return false;
    this.on[element.kind](element.item, key);
    return true;
  }

  /** `view`: the part of the graph that is in view. `scale`: how large it is. */
  show({hosts, edges}, layout, view, scale) {
    this.layout = layout;
    const components = hosts.flatMap((host) => host.components), all = components.length <= mostDrawn || view === null;
    const isIn = ({x, y, width = 0, height = 0}) => x < view.right && x + width > view.left && y < view.bottom && y + height > view.top;
    const seen = all ? components : components.filter(({id}) => isIn(layout.places.get(id))), small = !all && scale < far;
    this.svg.classList.toggle('far', small);
    this.hosts.show(hosts, (host) => host.id);
    this.components.show(seen, (component) => component.id);
    this.edges.show(all ? edges : edges.filter(({id}) => isIn(layout.edges.get(id))), (edge) => edge.id);
    this.ports.show(small ? [] : seen.flatMap((component) => component.ports), (port) => port.id);
  }

  createBox(lines) {
    const box = makeSvg('g');
    box.append(makeSvg('rect', {rx: 6}));
    for (let i = 0; i < lines; ++i) box.append(makeSvg('text', {class: i === 0 ? 'name' : 'detail'}));
    const fold = makeSvg('g', {role: 'button', class: 'fold-box', tabindex: 0});
    fold.append(makeSvg('rect', {width: 24, height: 24, rx: 4}), makeSvg('text', {'text-anchor': 'middle'}));
    box.append(makeSvg('title'), fold);
    return Object.assign(box, {title: box.children[lines + 1], fold});
  }

  updateBox(box, item, className, lines, title) {
    const place = this.layout.places.get(item.id);
    setClass(box, `${className}${this.found.has(item.id) ? ' found' : ''}`);
    if (box.place !== place) {
      const {x, y, width, height} = box.place = place;
      setAttributes(box.firstChild, {x, y, width, height});
      lines.forEach((text, i) => setAttributes(box.children[i + 1], {x: x + 10, y: y + 17 + 17 * i}));
      setAttributes(box.fold.firstChild, {x: x + width - 26, y: y + 2});
      setAttributes(box.fold.lastChild, {x: x + width - 14, y: y + 18});
    }
    lines.forEach((text, i) => setText(box.children[i + 1], text));
    setText(box.title, title);
    this.updateFold(box.fold, item);
  }

  updateFold(fold, item) {
    const shown = item.foldable || item.others ? '' : 'none';
    Object.assign(fold, {item, kind: 'fold'});
    if (fold.style.display !== shown) fold.style.display = shown;
    if (shown === 'none') return;
    setAttributes(fold, {'aria-expanded': String(!item.folded), 'aria-label': `${item.folded ? 'Unfold' : 'Fold'} ${item.title ?? item.name}`});
    setText(fold.lastChild, item.folded ? '▸' : '▾');
  }

  updateHost(box, host) { this.updateBox(box, host, `host ${host.state}`, linesOf(host), threadsOf(host)); }

  updateComponent(box, component) {
    const [detail, className] = describe(component);
    this.updateBox(box, component, className, [component.name, detail], detailsOf(component));
  }

  createEdge() {
    const edge = makeSvg('g');
    edge.append(makeSvg('path', {class: 'hit'}), makeSvg('path', {class: 'line'}), makeSvg('path', {class: 'head'}),
      makeSvg('rect', {rx: 3, height: 16, class: 'back'}), makeSvg('text', {class: 'rate'}), makeSvg('title'));
    return Object.assign(edge, {kind: 'edge'});
  }

  updateEdge(edge, item) {
    const place = this.layout.edges.get(item.id);
    const [hit, line, head, back, rate, title] = edge.children;
    edge.item = item;
    this.setButton(edge, this.control && (item.connection || item.from), `Connection ${item.title}`);
    setClass(edge, `edge ${edgeState(item)}`);
    setText(title, item.title);
    if (edge.place !== place) {
      edge.place = place;
      const d = `M ${place.points.map((point) => point.join(' ')).join(' L ')}`, right = item.toRight, [x, y] = right ? place.points.at(-1) : place.points[0];
      setAttributes(hit, {d});
      setAttributes(line, {d});
      setAttributes(head, {d: `M ${x} ${y} l ${right ? -10 : 10} -5 v 10 z`});
      back.style.display = place.label === null ? 'none' : '';
    }
    if (place.label === null) return;
    const text = edgeTextOf(item), width = widthOf(text) + 4;
    setAttributes(back, {x: place.label[0] - width / 2, y: place.label[1] - 13, width});
    setAttributes(rate, {x: place.label[0], y: place.label[1]});
    setText(rate, text);
  }

  createPort() {
    const group = makeSvg('g');
    group.append(makeSvg('rect', {height: 24, class: 'hit'}), makeSvg('circle', {r: 4.5}), makeSvg('text'), makeSvg('title'));
    return Object.assign(group, {kind: 'port'});
  }

  updatePort(group, port) {
    const place = this.layout.places.get(port.id);
    const [hit, dot, text, title] = group.children;
    group.item = port;
    if (port.listed) setAttributes(group, {'data-port': `${port.listed.component}.${port.listed.name}`});
    this.setButton(group, isPlottable(port) || (this.control && port.listed), port.name);
    const state = port.mismatch ? ' mismatch' : port.inside ? port.connections === 0 ? ' inside unconnected' : ' inside' : '';
    setClass(group, `port${state}${port.key && port.key === this.chosen ? ' chosen' : ''}${this.found.has(port.id) ? ' found' : ''}${this.mark(port)}`);
    if (group.place !== place) {
      group.place = place;
      const left = port.side === 'first', width = widthOf(labelOf(port)) + 20;
      setAttributes(hit, {x: left ? place.x - width + 8 : place.x - 8, y: place.y - 12, width});
      setAttributes(dot, {cx: place.x, cy: place.y});
      setAttributes(text, {x: left ? place.x - 10 : place.x + 10, y: place.y + 4, 'text-anchor': left ? 'end' : 'start'});
    }
    setText(text, portTextOf(port));
    setText(title, port.mismatch ? `${port.name}: ${port.mismatch}` : `${port.name} ${port.type ?? ''}`);
  }

  setButton(element, isButton, label) {
    if (isButton) setAttributes(element, {tabindex: 0, role: 'button', 'aria-label': label});
    else if (element.hasAttribute('role')) for (const name of ['tabindex', 'role', 'aria-label']) element.removeAttribute(name);
  }
}
