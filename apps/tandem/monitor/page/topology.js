// SPDX-License-Identifier: Apache-2.0
// What the graph shows: hosts with their components and those components' ports, and the edges between.
import {keyOfPort} from './tables.js';

/** More ports of a link are in the table only. */
const mostPorts = 40;
const sides = ['first', 'second'];
const other = {first: 'second', second: 'first'};

/** A process has one box, also if it has a side of several links. */
const hostId = (link, side) => link.sides[side].pid ? `host ${link.sides[side].pid}` : `host ${link.name}/${side}`;

class Builder {
  hosts = new Map();
  edges = [];
  hidden = 0;
  unreadable = [];

  host(link, side) {
    const id = hostId(link, side), {model, state, pid, program} = link.sides[side];
    // A link with itself: a program that shows values, of neither model.
    const itself = link.sides.first.pid !== 0 && link.sides.first.pid === link.sides.second.pid;
    if (!this.hosts.has(id)) this.hosts.set(id, {id, state, pid, title: itself ? program || 'program' : `${model} host ${program}`.trim(), components: new Map()});
    return this.hosts.get(id);
  }

  component(link, side, name, mirror) {
    const host = this.host(link, side), id = `${host.id}/${link.name}/${mirror ? 'mirror of ' : ''}${name}`;
    if (!host.components.has(id)) host.components.set(id, {id, mirror, name: mirror ? `${name}, mirrored` : name, ports: []});
    return host.components.get(id);
  }

  /** `of`: kind, and for data ports with a ring `port` and its key. */
  addPort(link, owner, component, of) {
    const itself = hostId(link, 'first') === hostId(link, 'second');
    const own = this.component(link, owner, component || '(port table not read)', false);
    const id = `${own.id}/${of.name}`;
    own.ports.push({id, side: owner, alone: itself, ...of});
    if (itself || of.mismatch) return;
    const far = this.component(link, other[owner], component || '(port table not read)', true);
    far.ports.push({id: `${far.id}/${of.name}`, side: other[owner], ...of});
    const ends = owner === 'first' ? [id, `${far.id}/${of.name}`] : [`${far.id}/${of.name}`, id];
    const dead = sides.some((side) => link.sides[side].state !== 'alive');
    const toRight = of.port ? of.port.writer === 'first' : (of.kind === 'required') === (owner === 'first');
    this.edges.push({id: `${link.name} ${id}`, left: ends[0], right: ends[1], port: of.port, service: !of.port, dead, toRight,
      title: `${of.name} ${of.type ?? ''}, link ${link.name}`});
  }

  addLink(link) {
    if (!link.readable) return this.unreadable.push(`${link.name}: ${link.reason}`);
    for (const side of sides) this.host(link, side);
    const data = link.ports.map((port) => ({name: port.name, kind: port.owner === port.writer ? 'out' : 'in', type: port.type,
      port, key: keyOfPort(link, port), owner: port.owner, component: port.component}));
    const all = [...link.shared_ports.filter((port) => port.mismatch), ...data, ...link.shared_ports.filter((port) => !port.mismatch)];
    this.hidden += Math.max(0, all.length - mostPorts);
    for (const {owner, component, ...of} of all.slice(0, mostPorts)) this.addPort(link, owner, component, of);
  }
}

/** `key` changes when a part comes or goes, and not with rates and states. `note`: what is left out. */
export function topologyOf(links) {
  const builder = new Builder();
  for (const link of links) builder.addLink(link);
  const hosts = [...builder.hosts.values()].map((host) => ({...host, components: [...host.components.values()]}));
  const key = JSON.stringify([hosts.map((host) => [host.id, host.title, host.components.map((component) =>
    [component.id, component.ports.map((port) => [port.id, port.mismatch])])]), builder.edges.map((edge) => edge.id)]);
  const notes = [...builder.unreadable];
  if (builder.hidden > 0) notes.push(`${builder.hidden} more ports are in the table below`);
  return {hosts, edges: builder.edges, key, note: notes.join('; ')};
}
