// SPDX-License-Identifier: Apache-2.0
// Selects the contents of the graph: hosts with their components and ports, and the edges between them.
import {addInside} from './inside.js';
import {keyOfPort} from '../tables.js';

/** Limit per link; further ports are only in the view with the tables. */
const mostPorts = 40;
/** With more ports than this in all links, one line represents the ports of a component and kind. */
const mostDrawn = 160;
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
  hidden = 0;
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

  /** `of`: kind, and for data ports with a ring also `port` and its key. */
  addPort(link, owner, component, of) {
    const itself = hostId(link, 'first') === hostId(link, 'second');
    const own = this.component(link, owner, component || '(port table not read)', false);
    const id = `${own.id}/${of.name}`;
    own.ports.push({id, side: owner, alone: itself, ...of});
    if (itself || of.mismatch) return;
    const far = this.component(link, other[owner], component || '(port table not read)', true);
    const refused = mirrorEnds(link.sides[other[owner]].pid, of, owner).map((end) => this.refusals.get(end)).find((reason) => reason);
    far.ports.push({id: `${far.id}/${of.name}`, side: other[owner], ...of, mismatch: refused});
    const ends = owner === 'first' ? [id, `${far.id}/${of.name}`] : [`${far.id}/${of.name}`, id];
    const dead = sides.some((side) => link.sides[side].state !== 'alive');
    const toRight = of.port ? of.port.writer === 'first' : (of.kind === 'required') === (owner === 'first');
    this.edges.push({id: `${link.name} ${id}`, left: ends[0], right: ends[1], port: of.port, service: !of.port, dead, toRight,
      refused, title: refused ?? `${of.name} ${of.type ?? ''}, link ${link.name}`});
  }

  /** Adds one port for all ports of a component with the same kind and direction. */
  addGroups(link, all) {
    const groups = new Map();
    for (const {owner, component, ...of} of all) {
      const kind = of.mismatch ? 'mismatch' : of.kind, key = JSON.stringify([owner, component, kind]);
      if (!groups.has(key)) groups.set(key, {owner, component, kind, members: []});
      groups.get(key).members.push(of);
    }
    for (const {owner, component, kind, members} of groups.values()) {
      const ports = members.map((of) => of.port).filter((port) => port !== undefined), sound = ports.filter((port) => !port.damage);
      const sum = (value) => sound.reduce((all, port) => all + value(port), 0);
      const silent = sound.map((port) => port.silent_s).filter((seconds) => seconds !== null);
      const what = kind === 'mismatch' ? 'not joined' : ports.length > 0 ? `ports ${kind}` : kind;
      this.addPort(link, owner, component, {
        name: `${members.length} ${what}`, kind: members[0].kind, filter: component || link.name, mismatch: members[0].mismatch,
        port: ports.length === 0 ? undefined : {writer: ports[0].writer, damage: sound.length === 0 ? ports[0].damage : '',
          sent_per_s: sum((port) => port.sent_per_s), recently: {lost: sum((port) => port.recently.lost)},
          silent_s: silent.length > 0 ? Math.min(...silent) : null},
      });
    }
  }

  addLink(link, together) {
    if (!link.readable) return this.unreadable.push(`${link.name}: ${link.reason}`);
    for (const side of sides) this.host(link, side);
    const data = link.ports.map((port) => ({name: port.name, kind: port.owner === port.writer ? 'out' : 'in', type: port.type,
      port, key: keyOfPort(link, port), owner: port.owner, component: port.component}));
    const all = [...link.shared_ports.filter((port) => port.mismatch), ...data, ...link.shared_ports.filter((port) => !port.mismatch)];
    if (together) return this.addGroups(link, all);
    this.hidden += Math.max(0, all.length - mostPorts);
    for (const {owner, component, ...of} of all.slice(0, mostPorts)) this.addPort(link, owner, component, of);
  }
}

/** Whether the host tells more of a component than its name. */
export const hasDetail = ({row, part}) => Boolean(row || part);

/** `key` changes when a part comes or goes, but not with rates and states. `note`: omitted parts. */
export function topologyOf(links, refused, rows = [], listed = []) {
  const builder = new Builder(refused);
  const total = links.reduce((count, link) => count + (link.readable ? link.ports.length + link.shared_ports.length : 0), 0);
  const together = total > mostDrawn;
  for (const link of links) builder.addLink(link, together);
  const hosts = [...builder.hosts.values()].map((host) => ({...host, components: [...host.components.values()]}));
  const inside = addInside(hosts, listed, rows);
  const edges = [...builder.edges, ...inside.edges];
  // For a host with several links, adds the link's name to the component.
  for (const {components} of hosts)
    if (new Set(components.filter(({inside}) => !inside).map((component) => component.link)).size > 1)
      for (const component of components.filter(({inside}) => !inside)) component.name += `, link ${component.link}`;
  const key = JSON.stringify([hosts.map((host) => [host.id, host.title, host.components.map((component) =>
    [component.id, hasDetail(component), component.ports.map((port) => [port.id, port.side, port.mismatch])])]), edges.map((edge) => edge.id)]);
  const notes = [...builder.unreadable];
  if (together) notes.push(`${total} ports: the ports of a component are drawn as one; the view "Ports and calls" lists each`);
  if (builder.hidden > 0) notes.push(`${builder.hidden} more ports are listed in the view "Ports and calls"`);
  notes.push(...inside.notes);
  return {hosts, edges, key, note: notes.join('; ')};
}
