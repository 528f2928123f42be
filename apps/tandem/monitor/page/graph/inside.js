// SPDX-License-Identifier: Apache-2.0
// Adds to the graph what hosts list of themselves: components without a link, their ports, and the connections inside hosts and
// between them that are no links.

/** Limit per host of components that share no port. */
const mostInside = 40;
/** With more ports than this, the ports that no link shares are left out. */
const mostPorts = 200;
/** The ports of these components are mirrors, which the graph shows beside the link. */
const proxyTypes = new Set(['AdaptorComp', 'InterceptorComp']);

const isSource = ({direction}) => direction === 'output' || direction === 'required';
const portIdOf = (box, name) => `${box.id}/${name}`;

/** Returns the ports of a component in a link that is a host's own or a mirror: names there may begin with the component's. */
const findPort = (boxes, component, name) => {
  for (const box of boxes)
    for (const port of box.ports) if (port.name === name || port.name === `${component}.${name}`) return port;
  return undefined;
};

class Inside {
  constructor(hosts, rows) {
    Object.assign(this, {hosts, rows, hidden: 0, ends: new Map()});
    const count = hosts.reduce((sum, {inventory}) => sum + (inventory?.ports.length ?? 0), 0);
    this.hiddenPorts = count > mostPorts ? count : 0;
  }

  /** Adds components that share no port, failed ones first if there are many. Other components get their state. */
  addComponents(host) {
    const own = host.components.filter(({mirror}) => !mirror), listed = new Map();
    for (const component of host.inventory?.components ?? []) listed.set(component.name, component);
    const states = this.rows.filter(({pid}) => pid === host.pid);
    const names = new Set([...listed.keys(), ...states.filter(({state}) => state !== null).map(({name}) => name)]);
    const inside = [];
    for (const name of names) {
      const found = states.filter((row) => row.name === name), shared = own.filter(({base}) => base === name);
      const part = listed.get(name) ?? null, contexts = (host.inventory?.contexts ?? []).filter(({components}) => components.includes(name));
      for (const box of shared) Object.assign(box, {row: found[0], part, contexts});
      if (shared.length > 0) continue;
      for (const row of found.length > 0 ? found : [undefined])
        inside.push({id: `${host.id}/inside/${row?.key ?? name}`, name, base: name, mirror: false, inside: true, ports: [], row, part, contexts});
    }
    this.hidden += Math.max(0, inside.length - mostInside);
    const urgency = inside.length > mostInside ? ({row}) => row?.state === 'error' || row?.tick?.hang ? 1 : 0 : () => 0;
    host.components.push(...inside.sort((a, b) => urgency(b) - urgency(a)).slice(0, mostInside));
  }

  /** Adds the ports of proxies, after those of other components: the graph has most of them as mirrors already. */
  addPorts(host, ofProxies) {
    const mirrors = host.components.filter(({mirror}) => mirror);
    for (const listed of host.inventory?.ports ?? []) {
      const boxes = host.components.filter(({mirror, base}) => !mirror && base === listed.component);
      const proxy = boxes.some(({part}) => proxyTypes.has(part?.type));
      if (proxy !== ofProxies) continue;
      let port = findPort(proxy ? mirrors : boxes, listed.component, listed.name);
      const mirror = proxy && port !== undefined, drawn = !proxy || this.reachesInside(listed);
      if (!port && drawn && boxes.length > 0 && this.hiddenPorts === 0) {
        port = {id: portIdOf(boxes[0], listed.name), name: listed.name, kind: kindOf(listed), type: listed.type, out: isSource(listed), inside: true};
        boxes[0].ports.push(port);
      }
      if (!port) continue;
      port.connections = listed.connections.length;
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
  edges() {
    const edges = [];
    for (const [id, ends] of [...this.ends].sort(([a], [b]) => a < b ? -1 : 1))
      for (const from of ends.filter(({source}) => source))
        for (const to of ends.filter(({source}) => !source)) edges.push(edgeOf(id, from, to));
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
  return {id: `${id} ${from.port.id} ${to.port.id}`, left, right, inside: true, service: from.service, toRight,
    title: `${from.port.name} → ${to.port.name} ${from.port.type ?? ''}${from.host === to.host ? '' : ', between two hosts without a link'}`};
}

/** Adds to the hosts of links, and adds hosts without a link. `listed`: the hosts of the state. Returns the new edges, and notes. */
export function addInside(hosts, listed, rows) {
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
  const edges = inside.edges();
  for (const {components} of hosts)
    for (const {ports} of components)
      for (const port of ports) port.side ??= port.out ? 'first' : 'second';
  const notes = [];
  if (inside.hidden > 0) notes.push(`${inside.hidden} more components are listed in the view "Components"`);
  if (inside.hiddenPorts > 0) notes.push(`the ports without a link are not drawn, because the hosts have ${inside.hiddenPorts} ports`);
  return {edges, notes};
}

/** Hosts without a link keep their order when one of them is started again. */
const firstName = ({inventory}) => inventory?.components[0]?.name ?? '';
const byName = (a, b) => firstName(a) < firstName(b) ? -1 : firstName(a) > firstName(b) ? 1 : a.pid - b.pid;
const modelOf = ({components}) => components.some(({execution}) => execution) ? 'OPRoS' : 'RTM';
