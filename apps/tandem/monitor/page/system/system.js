// SPDX-License-Identifier: Apache-2.0
// The components that the page can change, from the answers of `tandem rtm tree` and `tandem opros list`, and which of their ports fit.
// Draws nothing.

/** Returns the JSON in the output of a command, or null; a failure of a part, such as a name server, is a line behind it. */
export function jsonIn(text) {
  const ends = [...text.matchAll(/^(\[\]|\{\}|\]|\})$/gm)].map((line) => line.index + line[0].length);
  for (const end of [text.length, ...ends]) {
    try {
      return JSON.parse(text.slice(0, end));
    } catch (error) {
      if (!(error instanceof SyntaxError)) throw error;
    }
  }
  return null;
}

/** Returns the port's name without that of its component: `out` of `ConsoleIn0.out`. */
const shortName = (instance, name) => name.startsWith(`${instance}.`) ? name.slice(instance.length + 1) : name;

/** Returns all components. `id` names a component in commands. A component in several sources is one. */
export function componentsIn(tree, hosts) {
  const components = new Map();
  for (const source of tree ?? [])
    for (const {instance, address, state, error, ports} of source.components) {
      const before = components.get(instance);
      if (!instance || (before && (source.kind !== 'manager' || before.source === 'manager'))) continue;
      const component = {model: 'RTM', name: instance, id: address, state: error ? 'UNREACHABLE' : state, source: source.kind};
      component.ports = ports.map((port) => ({...port, component: instance, short: shortName(instance, port.name)}));
      components.set(instance, component);
    }
  const opros = (hosts ?? []).flatMap((host) => (host.components ?? []).map((component) => (
    {model: 'OPRoS', name: component.name, id: `${host.pid}/${component.name}`, state: component.state, ports: []})));
  const names = new Set(opros.map(({name}) => name)); // InterceptorComp gives its RTC the name of the OPRoS component
  for (const component of components.values()) component.mirrored = names.has(component.name);
  return [...components.values(), ...opros].sort((a, b) => a.name.localeCompare(b.name));
}

const shortType = (type) => type.replace(/IDL:([\w/]+\/)?(\w+):[\d.]+/g, '$2');
export const portLabel = (port) => `${port.component}.${port.short}  ${shortType(port.type)}`;

const interfacesOf = (port, word) => [...port.type.matchAll(new RegExp(`${word} ([^,]+)`, 'g'))].map((match) => match[1]);

/** Returns why two ports cannot be connected, or an empty text. The hosts check more than this. */
export function whyNot(a, b) {
  if (a.name === b.name) return 'this is the same port';
  const services = a.kind === 'CorbaPort' && b.kind === 'CorbaPort';
  if (!services && (a.kind === 'CorbaPort' || b.kind === 'CorbaPort')) return 'a service port fits only a service port';
  if (a.connections.some(({with: others}) => others.includes(b.name))) return 'they are connected';
  if (services) {
    const served = (one, other) => interfacesOf(one, 'requires').some((type) => interfacesOf(other, 'provides').includes(type));
    return served(a, b) || served(b, a) ? '' : 'neither provides a service that the other requires';
  }
  if (a.kind === b.kind) return `both are ${a.kind === 'DataInPort' ? 'InPorts: one of them must send' : 'OutPorts: one of them must receive'}`;
  const same = a.type === b.type || a.type === 'any' || b.type === 'any';
  return same ? '' : `${a.component}.${a.short} has type ${shortType(a.type)}, ${b.component}.${b.short} has ${shortType(b.type)}`;
}

const choices = (port, key) => (port.properties[`dataport.${key}`] ?? '').split(',').map((text) => text.trim()).filter((text) => text !== '');

/** Returns the values of each property of a connection that both ports support: [[name, [value ...]] ...]. */
export function commonProperties(a, b) {
  if (a.kind === 'CorbaPort') return [];
  return ['dataflow_type', 'subscription_type', 'interface_type'].map((key) => {
    const [first, second] = [choices(a, key), choices(b, key)], any = (list) => list.length === 0 || list.some((each) => /^any$/i.test(each));
    return [key, any(first) ? any(second) ? [] : second : any(second) ? first : first.filter((each) => second.some((other) => other.toLowerCase() === each.toLowerCase()))];
  }).filter(([, values]) => values.length > 0);
}

/** Returns the connections between ports of these components, each once: {id, ports, properties}. */
export function connectionsIn(components) {
  const found = new Map();
  for (const port of components.flatMap(({ports}) => ports))
    for (const connection of port.connections)
      if (!found.has(connection.id))
        found.set(connection.id, {id: connection.id, ports: [port.name, ...connection.with], sends: port.kind !== 'DataInPort', properties: connection.properties});
  for (const connection of found.values()) if (!connection.sends) connection.ports.reverse();
  return [...found.values()].sort((a, b) => a.ports[0].localeCompare(b.ports[0]));
}

/** Returns the properties with which a connection can be made again, KEY=VALUE. */
export function propertiesAgain(properties) {
  return Object.entries(properties).filter(([key]) => /^dataport\.(dataflow_type|subscription_type|interface_type|push_policy|push_rate|skip_count|(inport\.|outport\.)?buffer\.|publisher\.)/.test(key))
    .map(([key, value]) => `${key}=${value}`).slice(0, 16);
}

/** Whether rtc.conf can have a text in a list. Names are those of other programs, and one with a newline would be another setting. */
const isPlain = (text) => /^[^\s\u0000-\u001f\u007f,&?#()"\\]+$/.test(text);

/** Returns the connections and active RT-Components as lines of rtc.conf, for the folder of a `tandem run`. A comment says if
 * some are left out. */
export function rtcConfOf(components) {
  const connections = connectionsIn(components).map(({ports, properties}) => [ports, propertiesAgain(properties).map((each) => each.replace(/^dataport\./, ''))]);
  const active = components.filter(({model, state}) => model === 'RTM' && state === 'ACTIVE').map(({name}) => name);
  const written = connections.filter(([ports, properties]) => ports.length === 2 && [...ports, ...properties].every(isPlain)), plain = active.filter(isPlain);
  const left = connections.length - written.length + active.length - plain.length;
  const lines = written.map(([[from, to], properties]) => [`${from}?port=${to}`, ...properties].join('&'));
  return `manager.components.preconnect: ${lines.join(', ')}\nmanager.components.preactivation: ${plain.join(', ')}\n` +
    (left > 0 ? `# ${left} connections or components are left out: rtc.conf cannot name them.\n` : '');
}

/** What can be done to a component in a state: [command, label, command that undoes it]. */
export function actionsFor({model, state}) {
  const of = {
    RTM: {INACTIVE: ['activate', 'Activate', 'deactivate'], ACTIVE: ['deactivate', 'Deactivate', 'activate'], ERROR: ['reset', 'Reset']},
    OPRoS: {READY: ['start', 'Start', 'stop'], INACTIVE: ['start', 'Start', 'stop'], ACTIVE: ['stop', 'Stop', 'start'], ERROR: ['recover', 'Recover']},
  };
  const action = of[model][state];
  return action ? [action] : [];
}
