// SPDX-License-Identifier: Apache-2.0
// The tree of links, ports and the numbers in their messages, from which people choose curves.
import {curveId} from './curves.js';
import {KeyedList, make, setAttributes, setText} from './dom.js';
import {kindByName} from './samples.js';
import {keyOfPort} from './tables.js';

/** With more ports, the tree asks for a filter. */
const mostPorts = 100;

/** Yields the names of the numbers in a decoded message, such as `pose.x`. */
function* namesIn(value, name = '') {
  if (typeof value === 'number' || typeof value === 'boolean') yield name || 'value';
  else if (value !== null && typeof value === 'object')
    for (const [key, member] of Object.entries(value))
      yield* namesIn(member, Array.isArray(value) ? `${name}[${key}]` : name ? `${name}.${key}` : key);
}

export class MemberTree {
  /** `toggle`: called with a curve. `has`: whether the current plot has a curve. `open`: called with a port's key to plot it. */
  constructor(parent, filter, note, store, {toggle, has, open}) {
    Object.assign(this, {filter, note, store, toggle, has, expanded: new Set()});
    this.list = new KeyedList(parent, ({key}) => this.createPort(key, open), (element, port) => this.updatePort(element, port));
    filter.addEventListener('input', () => this.state && this.show(this.state));
  }

  createPort(key, open) {
    const item = make('li'), fold = make('button', 'fold'), plot = make('button', 'port-name'), members = make('ul');
    fold.type = plot.type = 'button';
    fold.addEventListener('click', () => {
      if (!this.expanded.delete(key)) this.expanded.add(key);
      this.show(this.state);
    });
    plot.addEventListener('click', () => open(key));
    item.append(fold, plot, members);
    item.members = new KeyedList(members, ({curve}) => this.createMember(curve), (element, member) => this.updateMember(element, member));
    return item;
  }

  updatePort(item, {key, link, port}) {
    const [fold, plot, members] = item.children, open = this.expanded.has(key);
    setText(fold, open ? '▾' : '▸');
    setAttributes(fold, {'aria-expanded': open, 'aria-label': `numbers of ${port.name}`});
    setText(plot, port.name);
    setAttributes(plot, {title: `${port.component ? `${port.component}, ` : ''}link ${link.name}: plot the port`});
    members.hidden = !open;
    item.members.show(open ? this.membersOf(key, port) : [], ({curve}) => curveId(curve));
  }

  /** In the order of the message, so that nothing moves under the mouse when the values have shown the kinds. */
  membersOf(key, port) {
    const track = this.store.tracks.get(key);
    const names = track?.names.length ? track.names : [...namesIn(port.value ?? null)];
    return names.slice(0, 64).map((name) => ({curve: {key, name, form: 'value'}, kind: track?.kindOf(name) ?? kindByName(name)}));
  }

  createMember(curve) {
    const item = make('li'), button = make('button');
    button.type = 'button';
    button.draggable = true;
    button.addEventListener('click', () => this.toggle(curve));
    button.addEventListener('dragstart', (event) => event.dataTransfer.setData('application/x-tandem-curve', JSON.stringify(curve)));
    button.append(make('span', '', curve.name), make('i'));
    item.append(button);
    return item;
  }

  updateMember(item, {curve, kind}) {
    const button = item.firstChild;
    setAttributes(button, {'aria-pressed': this.has(curve), class: kind});
    setText(button.lastChild, {time: ' time stamp', sequence: ' sequence number'}[kind] ?? '');
  }

  show(state) {
    this.state = state;
    const wanted = this.filter.value.toLowerCase(), ports = [];
    for (const link of state.links)
      for (const port of link.ports)
        if (!port.damage && `${port.name} ${port.component} ${link.name}`.toLowerCase().includes(wanted))
          ports.push({key: keyOfPort(link, port), link, port});
    this.list.show(ports.slice(0, mostPorts), ({key}) => key);
    setText(this.note, ports.length === 0 ? wanted ? 'No port has this name.' : 'There is no port.' : ports.length > mostPorts ? `${ports.length - mostPorts} more ports are not listed: type a part of a name above.` : '');
  }
}
