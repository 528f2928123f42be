// SPDX-License-Identifier: Apache-2.0
// The words of the graph about hosts, components, ports and edges, and their width.
import {count, duration, fixed, number} from '../dom.js';

/** Seconds without a message until an edge becomes grey. */
const stale = 2;
const letter = 7.2, boldLetter = 8.6;
const kindSigns = {provided: '◉ ', required: '◡ ', event: '⚑ ', in: '', out: ''};
const sideSigns = {alive: '✓', stopped: '❚❚', dead: '✕', gone: '✕', absent: '…'};
const stateTexts = {active: '✓ active', inactive: '○ not active', error: '✕ ERROR'};

export const widthOf = (text) => Math.ceil(text.length * letter);
export const boldWidthOf = (text) => Math.ceil(text.length * boldLetter);

/** Returns when a component runs that has no ticks of its own; empty if that is unknown. */
function executionOf({base, part, contexts = []}) {
  if (part?.execution) return part.period_ns > 0 ? duration(part.period_ns) : part.execution === 'passive' ? '' : part.execution;
  const context = contexts.find(({running}) => running) ?? contexts[0];
  if (!context) return '';
  const when = context.kind === 'periodic' ? duration(context.period_ns) : 'triggered';
  return context.owner === base ? when : `${when} of ${context.owner}`;
}

const periodOf = (component) => component.row.tick ? duration(component.row.tick.period_ns) : executionOf(component);
const withPeriod = (state, period) => `${state}${period ? `, ${period}` : ''}`;

/** Returns a component's state and period for people, and the class of its box. */
export function describe(component) {
  const {mirror, row: published, states} = component;
  if (states) return [states, 'component others'];
  if (mirror || !published) return ['', mirror ? 'component mirror' : 'component'];
  const {state, tick} = published;
  if (tick?.hang) return [`! hangs ${duration(tick.hang.seconds * 1e9)}`, 'component failed'];
  return [withPeriod(stateTexts[state] ?? '–', periodOf(component)), `component${state === 'error' ? ' failed' : state === 'inactive' ? ' inactive' : ''}`];
}

/** Returns the width of a component's longest state, so that a change of state changes no layout. */
export const widestStateOf = (component) => component.states ? widthOf(component.states) :
  component.row && !component.mirror ? widthOf(withPeriod(stateTexts.inactive, periodOf(component))) : 0;

/** Returns what there is to know about a component, one line each. */
export function detailsOf({base, part, contexts = [], row, names}) {
  if (names) return names.join('\n');
  const lines = [part?.type ? `${base}, of type ${part.type}` : base];
  if (part?.execution) lines.push(`executed: ${part.execution}${part.period_ns > 0 ? `, every ${duration(part.period_ns)}` : ''}`);
  for (const {owner, kind, period_ns: period, running, components} of contexts) {
    const members = components.filter((name) => name !== owner);
    lines.push(`context of ${owner}: ${kind}, ${duration(period)}${running ? '' : ', not running'}${members.length > 0 ? `, with ${members.join(', ')}` : ''}`);
  }
  if (row?.tick?.execution) lines.push(`cycle: p50 ${duration(row.tick.execution.p50_ns)}, p99 ${duration(row.tick.execution.p99_ns)}`);
  if (part?.names?.length > 0) lines.push(`named ${part.names.join(', ')}`);
  return lines.join('\n');
}

/** Returns the lines of a host: its title, its state, its processor time and memory. */
export function linesOf({title, state, ended, pid, listed}) {
  const word = state !== 'dead' && state !== 'gone' ? state : ended ? 'ended cleanly' : 'died';
  const usage = listed && (state === 'alive' || state === 'stopped') ? `${fixed(listed.cpu_percent, 0)} % CPU, ${fixed(listed.resident_bytes / 2 ** 20, 0)} MiB` : '';
  return [title, `${sideSigns[state] ?? '?'} ${word}${pid ? `, pid ${pid}` : ''}`, usage];
}

export const threadsOf = ({listed}) => listed ? `${count(listed.threads)} threads; the busiest: ${(listed.busiest_threads ?? []).slice(0, 8)
  .map(({name, cpu_percent: share}) => `${name} ${fixed(share, 1)} %`).join(', ')}` : '';

export const labelOf = (port) => `${kindSigns[port.kind] ?? ''}${port.name}`;
const rateOf = (port) => port.damage ? '✕ damaged' : `${port.recently?.lost > 0 ? '▼ ' : ''}${number(port.sent_per_s)}/s`;
export const portTextOf = (port) => `${port.mismatch ? '✕ ' : ''}${labelOf(port)}${port.alone && port.port ? `  ${rateOf(port.port)}` : ''}`;
export const edgeTextOf = ({refused, service, dead, port}) => refused ? '✕ refused' : service ? 'calls' : dead ? '–' : rateOf(port);

export function edgeState({port, dead, service, refused, inside}) {
  if (inside) return service ? 'inside service' : 'inside';
  if (dead) return 'dead';
  if (refused) return 'refused';
  if (service) return 'service';
  if (port.damage || port.recently?.lost > 0) return 'lost';
  return !(port.silent_s <= stale) ? 'stale' : 'live';
}
