// SPDX-License-Identifier: Apache-2.0
// Reduces the graph: one box stands for the components of a folded host, and one port for the ports of a folded component that have
// the same kind. Draws nothing.
import {groupsOf} from './groups.js';
import {hasDetail} from './topology.js';

/** With more components than this, hosts with more than a few are initially folded. */
const mostComponents = 60, fewComponents = 10;
/** Components with more ports than this are initially folded; with many ports in all, those with more than a few. */
const mostPorts = 40, manyPorts = 320, fewPorts = 8;
/** So many failed and found components of a folded host are drawn. */
const mostApart = 20;
const mostNamed = 30;
const kinds = {in: 'ports in', out: 'ports out', event: 'events', provided: 'provided', required: 'required', mismatch: 'not joined'};

/** What a person has folded and unfolded, by names that survive a restart of the host. */
export class Folds {
  chosen = new Map();

  isFolded(name, byDefault) { return this.chosen.get(name) ?? byDefault; }

  choose(names, isFolded) { for (const name of names) this.chosen.set(name, isFolded); }
}

const hasFailed = ({row}) => row?.state === 'error' || Boolean(row?.tick?.hang);

function statesOf(components) {
  const count = (wanted) => components.filter(({row}) => wanted(row)).length;
  const failed = components.filter(hasFailed).length, inactive = count((row) => row?.state === 'inactive'), active = count((row) => row?.state === 'active');
  return [failed > 0 ? `✕ ${failed} failed` : '', inactive > 0 ? `○ ${inactive} not active` : '', active > 0 ? `✓ ${active} active` : ''].filter(Boolean).join(', ');
}

/** Returns one data port of a link for several, or undefined. */
function sumOf(ports) {
  const sound = ports.filter((port) => !port.damage), silent = sound.map((port) => port.silent_s).filter((seconds) => Number.isFinite(seconds));
  const sum = (value) => sound.reduce((all, port) => all + value(port), 0);
  return ports.length === 0 ? undefined : {damage: sound.length === 0 ? ports[0].damage : '', sent_per_s: sum((port) => port.sent_per_s),
    recently: {lost: sum((port) => port.recently?.lost ?? 0)}, silent_s: silent.length > 0 ? Math.min(...silent) : null};
}

class Folder {
  boxes = new Map(); // of ports
  stands = new Map(); // the port that stands for others, by their ids
  merged = new Set(); // ports that stand for others
  folded = new Set(); // boxes whose inside is not drawn

  constructor(topology) {
    this.topology = topology;
    for (const {components} of topology.hosts)
      for (const component of components) for (const port of component.ports) this.place(port, component.id);
  }

  place(port, box) {
    this.boxes.set(port.id, box);
    if (port.inner) this.boxes.set(port.inner, box);
  }

  /** Returns one port for all ports of a side and kind. `more`: members of it. */
  merge(box, ports, more) {
    this.folded.add(box);
    const groups = groupsOf(ports, ({side, kind, mismatch}) => `${side} ${mismatch ? 'mismatch' : kind}`);
    return [...groups].map(([key, members]) => {
      const [first] = members, id = `${box}/${key}`, kind = first.mismatch ? 'mismatch' : first.kind;
      for (const port of members) this.place(port, box);
      if (members.length === 1) return first;
      const merged = {id, side: first.side, kind: first.kind, name: `${members.length} ${kinds[kind]}`, mismatch: first.mismatch, alone: first.alone,
        inside: members.every(({inside}) => inside), connections: members.reduce((sum, {connections}) => sum + (connections ?? 1), 0),
        type: members.slice(0, mostNamed).map(({name}) => name).join(', '), port: sumOf(members.map(({port}) => port).filter(Boolean)), ...more};
      if (members.some(({inner}) => inner)) merged.inner = `${id} inside`;
      for (const port of members) {
        this.stands.set(port.id, id);
        if (port.inner) this.stands.set(port.inner, merged.inner);
      }
      this.merged.add(id).add(merged.inner);
      this.place(merged, box);
      return merged;
    });
  }

  /** Replaces all components of a host but those that have failed or are found. */
  foldHost(host, isFound) {
    const apart = new Set(host.components.filter((component) => isFound(component) || hasFailed(component)).slice(0, mostApart));
    const others = host.components.filter((component) => !apart.has(component)), id = `${host.id}/others`;
    if (others.length < 2) return;
    const inside = new Set(others.map((component) => component.id)), leaving = new Set();
    for (const {left, right} of this.topology.edges) {
      const [a, b] = [this.boxes.get(left), this.boxes.get(right)];
      if (inside.has(a) !== inside.has(b)) leaving.add(left).add(right);
    }
    const ports = others.flatMap((component) => component.ports).filter((port) => port.mismatch || leaving.has(port.id) || leaving.has(port.inner));
    for (const component of others) for (const port of component.ports) this.place(port, id);
    host.components = [...apart, {id, fold: host.fold, folded: true, states: statesOf(others) || 'no states', names: namesOf(others), others, base: '',
      name: `${others.length} ${apart.size > 0 ? 'more ' : ''}components`, ports: this.merge(id, ports, {fold: host.fold})}];
  }

  /** Returns the edges between what is drawn; those with the same ends are one. */
  edges() {
    const moved = this.topology.edges.map((edge) => ({...edge, left: this.stands.get(edge.left) ?? edge.left, right: this.stands.get(edge.right) ?? edge.right}));
    const drawn = moved.filter(({left, right}) => this.boxes.get(left) !== this.boxes.get(right) || !this.folded.has(this.boxes.get(left)));
    const groups = groupsOf(drawn, ({id, left, right, service, toRight, inside}) => this.merged.has(left) || this.merged.has(right) ? JSON.stringify([left, right, service, toRight, inside]) : id);
    return [...groups].map(([id, members]) => members.length === 1 ? members[0] : {...members[0], id, connection: undefined, from: undefined, to: undefined,
      port: sumOf(members.map(({port}) => port).filter(Boolean)), dead: members.some(({dead}) => dead), refused: members.find(({refused}) => refused)?.refused,
      title: members.find(({refused}) => refused)?.title ?? `${members.length} connections: ${members.slice(0, mostNamed).map(({title}) => title).join('; ')}`});
  }
}

const namesOf = (components) => [...components.slice(0, mostNamed).map(({name}) => name), ...components.length > mostNamed ? ['...'] : []];

const keyOf = ({hosts, edges}) => JSON.stringify([hosts.map((host) => [host.id, host.title, host.folded, host.components.map((component) =>
  [component.id, component.name, hasDetail(component), component.ports.map((port) => [port.id, port.name, port.side, port.mismatch, port.inner])])]), edges.map((edge) => edge.id)]);

/**
 * Returns the topology with what is folded, and its `key`, which changes when a part comes or goes, but not with rates and states.
 * `isFound`: whether a component is searched for. Sets `fold` (a name for Folds) and `folded` of hosts and components.
 */
export function foldedTopology(topology, folds, isFound = () => false) {
  const folder = new Folder(topology), total = topology.hosts.reduce((sum, {components}) => sum + components.length, 0);
  const many = topology.hosts.reduce((sum, {components}) => sum + components.reduce((all, {ports}) => all + ports.length, 0), 0) > manyPorts;
  for (const host of topology.hosts) {
    host.fold = `host ${host.title} ${host.components[0]?.base ?? ''}`;
    host.folded = host.components.length > 1 && folds.isFolded(host.fold, total > mostComponents && host.components.length > fewComponents);
    host.foldable = host.components.length > 1;
    if (host.folded) folder.foldHost(host, isFound);
    for (const component of host.components.filter(({others}) => !others)) {
      component.fold = `component ${host.fold} ${component.link} ${component.name}`;
      component.foldable = component.ports.length > 1;
      component.folded = component.foldable && folds.isFolded(component.fold, component.ports.length > (many ? fewPorts : mostPorts));
      if (component.folded) component.ports = folder.merge(component.id, component.ports, {filter: component.base});
    }
  }
  const notes = [...topology.notes], folded = topology.hosts.filter((host) => host.folded).length;
  if (folded > 0) notes.push(`${folded} of ${topology.hosts.length} hosts are folded; all hosts have ${total} components`);
  if (topology.hosts.some(({components}) => components.some((component) => component.folded && !component.others)))
    notes.push('Of a folded component, one line stands for all ports of a kind; the view "Ports and calls" lists each');
  const reduced = {hosts: topology.hosts, edges: folder.edges()};
  return {...reduced, key: keyOf(reduced), note: notes.join('. ')};
}
