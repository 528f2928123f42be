// SPDX-License-Identifier: Apache-2.0
// Adds to the graph what hosts list of themselves: components without a link, their ports, and the connections inside hosts and
// between them that are not links.
import {groupsOf} from './groups.js';

/** The ports of these components are mirrors, which the graph shows beside the link. */
const proxyTypes = new Set(['AdaptorComp', 'InterceptorComp']);

/** A host may list any number of ports with one connection, which is drawn from each source to each of the others. */
const mostEdges = 10_000;

const isSource = ({direction}) => direction === 'output' || direction === 'required';
const portIdOf = (box, name) => `${box.id}/${name}`;

/** Returns the ports of a component in a link that is a host's own or a mirror: names there may begin with the component's. */
const findPort = (boxes, component, name) => {
  for (const box of boxes)
    for (const port of box.ports) if (port.name === name || port.name === `${component}.${name}`) return port;
  return undefined;
};

/** Whether a port stands for one of the other model, and no connection of a link shows it. */
const isFree = (boxes, {connections}) => connections.length === 0 && boxes.some(({part}) => part?.type === 'InterceptorComp');

class Inside {
  constructor(hosts, rows) {
    Object.assign(this, {hosts, rows: groupsOf(rows, ({pid}) => pid), ends: new Map()});
  }

  /** Adds components that share no port. Other components get their state. */
  addComponents(host) {
    const own = groupsOf(host.components.filter(({mirror}) => !mirror), ({base}) => base), listed = new Map();
    for (const component of host.inventory?.components ?? []) listed.set(component.name, component);
    const states = groupsOf(this.rows.get(host.pid) ?? [], ({name}) => name), contextsOf = new Map();
    for (const context of host.inventory?.contexts ?? [])
      for (const name of context.components) contextsOf.set(name, [...contextsOf.get(name) ?? [], context]);
    const stated = [...states].filter(([, rows]) => rows.some(({state}) => state !== null)).map(([name]) => name);
    for (const name of new Set([...listed.keys(), ...stated])) {
      const found = states.get(name) ?? [], shared = own.get(name) ?? [], part = listed.get(name) ?? null, contexts = contextsOf.get(name) ?? [];
      for (const box of shared) Object.assign(box, {row: found[0], part, contexts});
      if (shared.length > 0) continue;
      for (const row of found.length > 0 ? found : [undefined])
        host.components.push({id: `${host.id}/inside/${row?.key ?? name}`, name, base: name, mirror: false, inside: true, ports: [], row, part, contexts});
    }
  }

  /** Adds the ports of proxies, after those of other components: the graph has most of them as mirrors already. */
  addPorts(host, ofProxies) {
    const mirrors = host.components.filter(({mirror}) => mirror), own = groupsOf(host.components.filter(({mirror}) => !mirror), ({base}) => base);
    for (const listed of host.inventory?.ports ?? []) {
      const boxes = own.get(listed.component) ?? [];
      const proxy = boxes.some(({part}) => proxyTypes.has(part?.type));
      if (proxy !== ofProxies) continue;
      let port = findPort(proxy ? mirrors : boxes, listed.component, listed.name);
      const mirror = proxy && port !== undefined, drawn = !proxy || isFree(boxes, listed) || this.reachesInside(listed);
      if (!port && drawn && boxes.length > 0) {
        port = {id: portIdOf(boxes[0], listed.name), name: listed.name, kind: kindOf(listed), type: listed.type, out: isSource(listed), inside: true};
        boxes[0].ports.push(port);
      }
      if (!port) continue;
      Object.assign(port, {listed, connections: listed.connections.length});
      for (const id of listed.connections) {
        if (!this.ends.has(id)) this.ends.set(id, []);
        this.ends.get(id).push({host, port, mirror, source: isSource(listed), service: listed.kind === 'service'});
      }
    }
  }

  /** Whether a port is connected to one that no link shares. The other connections of a proxy are part of a link. */
  reachesInside({connections}) {
    return connections.some((id) => this.ends.get(id)?.some(({port}) => port.inside));
  }

  /** Returns the edges of connections with two ends that are drawn. A link draws the connections between its ports and mirrors. */
  edges(notes) {
    const edges = [];
    let undrawn = 0;
    for (const [id, ends] of [...this.ends].sort(([a], [b]) => a < b ? -1 : 1)) {
      const others = ends.filter(({source}) => !source);
      for (const from of ends.filter(({source}) => source)) {
        const drawn = others.slice(0, mostEdges - edges.length);
        undrawn += others.length - drawn.length;
        for (const to of drawn) edges.push(edgeOf(id, from, to));
      }
    }
    if (undrawn > 0) notes.push(`${undrawn} more connections inside hosts are not drawn`);
    return edges;
  }
}

const kindOf = ({kind, direction}) => kind === 'service' ? direction : kind === 'event' ? 'event' : direction === 'output' ? 'out' : 'in';

/** The layout places a mirror between the link and the components of its host, so an edge may run against the data. */
function edgeOf(id, from, to) {
  const mirror = from.mirror ? from : to.mirror ? to : null, near = mirror === from ? to : from;
  let left = from.port.id, right = to.port.id;
  if (mirror !== null && mirror.host === near.host) {
    const inner = `${mirror.port.id} inside`;
    mirror.port.inner = inner;
    if (near.port.inside) near.port.side = mirror.port.side;
    [left, right] = mirror.port.side === 'first' ? [near.port.id, inner] : [inner, near.port.id];
  }
  const toRight = right === to.port.id || (to === mirror && right === to.port.inner);
  return {id: `${id} ${from.port.id} ${to.port.id}`, connection: id, from: from.port, to: to.port, left, right, inside: true, service: from.service, toRight,
    title: `${from.port.name} → ${to.port.name} ${from.port.type ?? ''}${from.host === to.host ? '' : ', between two hosts without a link'}`};
}

/** Adds to the hosts of links, and adds hosts without a link. `listed`: the hosts of the state. Returns the new edges,
 *  and adds to `notes` what cannot be shown. */
export function addInside(hosts, listed, rows, notes) {
  for (const {pid, program, inventory, stopped} of [...listed].sort(byName))
    if (!hosts.some((host) => host.pid === pid) && inventory)
      hosts.push({id: `host ${pid}`, pid, state: stopped ? 'stopped' : 'alive', ended: false, title: `${modelOf(inventory)} host ${program}`, components: []});
  for (const host of hosts) {
    host.listed = listed.find(({pid}) => pid === host.pid) ?? null;
    host.inventory = host.listed?.inventory ?? null;
  }
  const inside = new Inside(hosts, rows);
  for (const host of hosts) inside.addComponents(host);
  for (const ofProxies of [false, true]) for (const host of hosts) inside.addPorts(host, ofProxies);
  const edges = inside.edges(notes);
  for (const {components} of hosts)
    for (const {ports} of components)
      for (const port of ports) port.side ??= port.out ? 'first' : 'second';
  return edges;
}

/** Hosts without a link keep their order when one of them is started again. */
const firstName = ({inventory}) => inventory?.components[0]?.name ?? '';
const byName = (a, b) => firstName(a) < firstName(b) ? -1 : firstName(a) > firstName(b) ? 1 : a.pid - b.pid;
const modelOf = ({components}) => components.some(({execution}) => execution) ? 'OPRoS' : 'RTM';
