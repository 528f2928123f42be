// SPDX-License-Identifier: Apache-2.0
// Selects the contents of the graph: hosts with their components and ports, and the edges between them.
import {addInside} from './inside.js';
import {keyOfPort} from '../tables.js';

const sides = ['first', 'second'];
const other = {first: 'second', second: 'first'};

/** A process has one box, even if it is on several links. */
const hostId = (link, side) => link.sides[side].pid ? `host ${link.sides[side].pid}` : `host ${link.name}/${side}`;

/** Returns the reasons for refused connections of mirrors, by the keys of mirrorEnds(). */
function refusalsOf(refused) {
  const reasons = new Map(), portOf = (name) => name.slice(name.lastIndexOf('.') + 1);
  for (const {pid, from, to, reason} of refused) {
    const text = `${from} and ${to} are not connected: ${reason}`;
    reasons.set(`${pid} to ${portOf(to)}`, text).set(`${pid} from ${portOf(from)}`, text);
  }
  return reasons;
}

/** Returns the possible ends of a mirror's connections in a host: one for a data port, both for a service. */
function mirrorEnds(pid, {name, port}, owner) {
  const ends = port ? [port.writer === owner ? 'from' : 'to'] : ['from', 'to'];
  return ends.map((end) => `${pid} ${end} ${name}`);
}

class Builder {
  constructor(refused) { this.refusals = refusalsOf(refused); }

  hosts = new Map();
  edges = [];
  unreadable = [];

  host(link, side) {
    const id = hostId(link, side), {model, state, pid, pid_in_other_namespace: inner, program, ended_in_order: ended} = link.sides[side];
    // A link of a process with itself belongs to a program that shows values, not to a model.
    const itself = link.sides.first.pid !== 0 && link.sides.first.pid === link.sides.second.pid;
    if (!this.hosts.has(id)) this.hosts.set(id, {id, state, ended, pid: pid || (inner ? `${inner} of another namespace` : 0), title: itself ? program || 'program' : `${model} host ${program}`.trim(), components: new Map()});
    return this.hosts.get(id);
  }

  component(link, side, name, mirror) {
    const host = this.host(link, side), id = `${host.id}/${link.name}/${mirror ? 'mirror of ' : ''}${name}`;
    if (!host.components.has(id)) host.components.set(id, {id, link: link.name, mirror, base: name, name: mirror ? `${name}, mirrored` : name, ports: []});
    return host.components.get(id);
  }

  /** `of`: kind, and for data ports with a ring also `port` and its key. A port and its mirror are twins. */
  addPort(link, owner, component, of) {
    const itself = hostId(link, 'first') === hostId(link, 'second');
    const own = this.component(link, owner, component || '(port table not read)', false);
    const id = `${own.id}/${of.name}`;
    const near = {id, side: owner, alone: itself, ...of};
    own.ports.push(near);
    if (itself || of.mismatch) return;
    const far = this.component(link, other[owner], component || '(port table not read)', true);
    const refused = mirrorEnds(link.sides[other[owner]].pid, of, owner).map((end) => this.refusals.get(end)).find((reason) => reason);
    const mirror = {id: `${far.id}/${of.name}`, side: other[owner], ...of, mismatch: refused, twin: near};
    near.twin = mirror;
    far.ports.push(mirror);
    const ends = owner === 'first' ? [id, mirror.id] : [mirror.id, id];
    const dead = sides.some((side) => link.sides[side].state !== 'alive');
    const toRight = of.port ? of.port.writer === 'first' : (of.kind === 'required') === (owner === 'first');
    this.edges.push({id: `${link.name} ${id}`, left: ends[0], right: ends[1], from: near, to: mirror, port: of.port, service: !of.port, dead, toRight,
      refused, title: refused ?? `${of.name} ${of.type ?? ''}, link ${link.name}`});
  }

  addLink(link) {
    if (!link.readable) return this.unreadable.push(`${link.name}: ${link.reason}`);
    for (const side of sides) this.host(link, side);
    const data = link.ports.map((port) => ({name: port.name, kind: port.owner === port.writer ? 'out' : 'in', type: port.type,
      port, key: keyOfPort(link, port), owner: port.owner, component: port.component}));
    const all = [...link.shared_ports.filter((port) => port.mismatch), ...data, ...link.shared_ports.filter((port) => !port.mismatch)];
    for (const {owner, component, ...of} of all) this.addPort(link, owner, component, of);
  }
}

/** Whether the host tells more of a component than its name. */
export const hasDetail = ({row, part}) => Boolean(row || part);

/** Returns {hosts, edges, notes} of all parts; fold.js reduces them. `notes`: what cannot be shown. */
export function topologyOf(links, refused, rows = [], listed = []) {
  const builder = new Builder(refused);
  for (const link of links) builder.addLink(link);
  const hosts = [...builder.hosts.values()].map((host) => ({...host, components: [...host.components.values()]}));
  const edges = [...builder.edges, ...addInside(hosts, listed, rows, builder.unreadable)];
  // For a host with several links, adds the link's name to the component.
  for (const {components} of hosts)
    if (new Set(components.filter(({inside}) => !inside).map((component) => component.link)).size > 1)
      for (const component of components.filter(({inside}) => !inside)) component.name += `, link ${component.link}`;
  return {hosts, edges, notes: builder.unreadable};
}
