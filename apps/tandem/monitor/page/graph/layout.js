// SPDX-License-Identifier: Apache-2.0
// Lays out the graph with elkjs, which works in a worker.
import {loading} from './elk.js';
import {boldWidthOf, describe, labelOf, widestStateOf, widthOf} from './texts.js';
import {hasDetail} from './topology.js';
import {fittingScale} from './zoom.js';

const row = 24, dot = 8;
const layerGap = 30, groupGap = 14, widestGap = 420, mostFitted = 40; // edges: a layout of more takes long
/** Components without an edge, from this number on, are packed beside the others instead of one below the other. */
const packed = 7;
const manyNodes = 150;

/** The height above a component's ports: its name, and its state if the host publishes it. */
const headOf = (component) => hasDetail(component) || component.states ? 44 : 28;

/** Returns a component's node, at least so wide. */
function nodeOf(c, least = 120) {
  const width = Math.max(least, boldWidthOf(c.name) + 40, describe(c)[0] ? widestStateOf(c) + 24 : 0, ...c.ports.map((p) => widthOf(labelOf(p)) + (p.alone ? 90 : 24)));
  // The inner end of a mirror's port has no dot, so that its arrow ends at the box.
  const port = (id, right, i, size = dot) => ({id, width: size, height: size, x: right ? width - size / 2 : -size / 2, y: headOf(c) + row * i + 9 - size / 2,
    layoutOptions: {'elk.port.side': right ? 'EAST' : 'WEST'}});
  const ports = c.ports.flatMap((p, i) => [port(p.id, p.side === 'first', i), ...p.inner ? [port(p.inner, p.side !== 'first', i, 1)] : []]);
  return {id: c.id, width, height: headOf(c) + 6 + row * c.ports.length, ports, layoutOptions: {'elk.portConstraints': 'FIXED_POS'}};
}

/** Returns nodes. elkjs makes a host as wide as its components, so one of them must be as wide as the host's title. */
function wideNodesOf(components, title) {
  const nodes = components.map((component) => nodeOf(component)), least = boldWidthOf(title) + 20;
  if (nodes.length > 0 && nodes.every(({width}) => width < least)) nodes[0] = nodeOf(components[0], least);
  return nodes;
}

/** Returns the nodes of a host's components. Many without an edge are in a node of their own, which is not drawn. */
function nodesOf(host, connected, width) {
  const free = host.components.filter(({ports}) => !ports.some(({id, inner}) => connected.has(id) || connected.has(inner)));
  if (free.length < packed) return wideNodesOf(host.components, host.title);
  const others = host.components.filter((component) => !free.includes(component));
  return [...wideNodesOf(others, host.title), {id: `${host.id} free`, children: free.map((c) => nodeOf(c)),
    layoutOptions: {'elk.algorithm': 'rectpacking', 'elk.hierarchyHandling': 'SEPARATE_CHILDREN', 'elk.aspectRatio': others.length > 0 ? '0.6' : '1.6',
      'elk.rectpacking.widthApproximation.targetWidth': others.length > 0 ? '-1' : String(Math.max(300, width - 60)),
      'elk.spacing.nodeNode': '12', 'elk.padding': '[top=0,left=0,bottom=0,right=0]'}}];
}

/** Returns {hosts, edges} for each group of hosts that are connected with each other. */
function connectedGroups({hosts, edges}) {
  const groupOf = new Map(hosts.map((host) => [host, {hosts: [host], edges: []}])), hostOf = new Map(); // by ports
  for (const host of hosts)
    for (const {ports} of host.components) for (const {id, inner} of ports) hostOf.set(id, host).set(inner, host);
  for (const edge of edges) {
    const [into, from] = [edge.left, edge.right].map((id) => groupOf.get(hostOf.get(id)));
    into.edges.push(edge);
    if (into === from) continue;
    into.hosts.push(...from.hosts);
    into.edges.push(...from.edges);
    for (const host of from.hosts) groupOf.set(host, into);
  }
  return [...new Set(groupOf.values())];
}

/** Returns the input of elkjs. Groups of hosts without a connection between them stand side by side, as far as the page is wide. */
function elkGraph(topology, groups, gap, width) {
  const connected = new Set(topology.edges.flatMap(({left, right}) => [left, right]));
  const node = (id, group) => groupNode(id, group, connected, gap, width);
  if (groups.length < 2) return node('root', topology);
  return {
    id: 'root',
    layoutOptions: {'elk.algorithm': 'rectpacking', 'elk.hierarchyHandling': 'SEPARATE_CHILDREN', 'elk.spacing.nodeNode': String(groupGap), 'elk.padding': '[top=0,left=0,bottom=0,right=0]',
      'elk.rectpacking.widthApproximation.strategy': 'TARGET_WIDTH', 'elk.rectpacking.widthApproximation.targetWidth': String(width - 2 * groupGap)},
    children: groups.map((group, i) => node(`group ${i}`, group)),
  };
}

/** Returns a node with hosts: first sides left, second sides right, data in both directions in between. `gap`: between layers. */
function groupNode(id, {hosts, edges}, connected, gap, width) {
  const count = hosts.reduce((sum, {components}) => sum + components.length, 0);
  return {
    id,
    layoutOptions: {'elk.algorithm': 'layered', 'elk.direction': 'RIGHT', 'elk.hierarchyHandling': 'INCLUDE_CHILDREN',
      'elk.layered.considerModelOrder.strategy': 'NODES_AND_EDGES', 'elk.layered.spacing.nodeNodeBetweenLayers': String(gap),
      'elk.spacing.nodeNode': '18', 'elk.spacing.edgeLabel': '0', 'elk.spacing.labelLabel': '0', 'elk.spacing.edgeEdge': '4',
      'elk.spacing.edgeNode': '4', 'elk.spacing.labelNode': '0', 'elk.padding': '[top=4,left=4,bottom=4,right=4]',
      'elk.layered.nodePlacement.strategy': count > manyNodes ? 'BRANDES_KOEPF' : 'NETWORK_SIMPLEX'},
    children: hosts.map((host) => ({id: host.id, children: nodesOf(host, connected, width),
      layoutOptions: {'elk.padding': '[top=63,left=14,bottom=14,right=14]', 'elk.nodeSize.constraints': 'MINIMUM_SIZE',
        'elk.nodeSize.minimum': `(${boldWidthOf(host.title) + 46},60)`}})),
    edges: edges.map((edge) => ({id: edge.id, sources: [edge.left], targets: [edge.right],
      labels: edge.inside ? [] : [{id: `${edge.id} label`, text: 'rate', width: 84, height: 16, layoutOptions: {'elk.edgeLabels.inline': 'true'}}]})),
  };
}

/** Returns the absolute positions of all parts by their ids. */
function placesOf(layout) {
  const places = new Map(), edges = new Map();
  const walk = (node, x, y) => {
    places.set(node.id, {x, y, width: node.width, height: node.height});
    for (const port of node.ports ?? []) places.set(port.id, {x: x + port.x + port.width / 2, y: y + port.y + port.height / 2});
    for (const child of node.children ?? []) walk(child, x + child.x, y + child.y);
  };
  walk(layout, 0, 0);
  // An edge's points are relative to its container in elkjs.
  for (const edge of [layout, ...layout.children].flatMap((node) => node.edges ?? [])) {
    const from = places.get(edge.container ?? layout.id);
    const move = ({x, y}) => [x + from.x, y + from.y];
    const [section] = edge.sections, label = edge.labels?.[0];
    const points = [section.startPoint, ...(section.bendPoints ?? []), section.endPoint].map(move), [xs, ys] = [0, 1].map((i) => points.map((point) => point[i]));
    edges.set(edge.id, {points, x: Math.min(...xs), y: Math.min(...ys), width: Math.max(...xs) - Math.min(...xs), height: Math.max(...ys) - Math.min(...ys),
      label: label ? move({x: label.x + label.width / 2, y: label.y + 12}) : null});
  }
  return {places, edges, width: layout.width, height: layout.height};
}

/**
 * Returns the places of all parts. A small graph is drawn larger, as far as the page has room. The gaps between layers fill the rest
 * of its width; the graph's width grows with them in proportion.
 */
export async function layOut(topology, page) {
  const elk = await loading;
  const groups = connectedGroups(topology), lay = (gap) => elk.layout(elkGraph(topology, groups, gap, page.width)), narrow = await lay(layerGap);
  const width = page.width / Math.max(1, fittingScale(narrow, page)), missing = width - narrow.width - 4;
  if (missing < 20 || groups.length > 1 || topology.edges.length > mostFitted || topology.edges.length === 0) return placesOf(narrow);
  const wide = await lay(layerGap + missing), slope = (wide.width - narrow.width) / missing;
  return placesOf(slope > 0 ? await lay(Math.min(widestGap, layerGap + missing / slope)) : narrow);
}
