// SPDX-License-Identifier: Apache-2.0
// The table of components: the state of each, and its ticks. A tick belongs to one component or to several that tick together.
import {KeyedList, count, duration, make, number} from './dom.js';
import {Sorter} from './sort.js';
import {RowWindow, fill, time} from './tables.js';

const find = (id) => document.getElementById(id);
const stateSigns = {active: '✓ active', inactive: '○ not active', error: '✕ ERROR'};

/** Returns a row for each component, with its tick if it has its own, and one for each tick of several components. */
export function rowsOf({ticks, components}) {
  const rows = [], left = new Map(ticks.map((tick) => [`${tick.pid} ${tick.name}`, []]));
  for (const tick of ticks) left.get(`${tick.pid} ${tick.name}`).push(tick);
  for (const component of components) rows.push({...component, tick: left.get(`${component.pid} ${component.name}`)?.shift() ?? null});
  for (const rest of left.values())
    for (const tick of rest) rows.push({name: tick.name, program: tick.program, pid: tick.pid, state: null, tick});
  const seen = new Map(); // counts equal names
  for (const row of rows) {
    const key = `${row.pid} ${row.name}`;
    seen.set(key, (seen.get(key) ?? 0) + 1);
    row.key = `${key} ${seen.get(key)}`;
  }
  return rows;
}

function tickCells(tick) {
  if (tick === null) return Array(11).fill(['', '']);
  return [
    [duration(tick.period_ns), 'number'],
    tick.hang ? [`! hangs ${duration(tick.hang.seconds * 1e9)}`, 'number bad'] : [number(tick.ticks_per_s), 'number'],
    time(tick.lateness, 'p50_ns'), time(tick.lateness, 'p99_ns'), [duration(tick.latest_ns), 'number'], {histogram: tick.lateness},
    time(tick.execution, 'p50_ns'), time(tick.execution, 'p99_ns'), [duration(tick.longest_ns), 'number'],
    [tick.overruns_recently > 0 ? `◷ ${count(tick.overruns)}` : count(tick.overruns), tick.overruns_recently > 0 ? 'number warn' : 'number'],
    [count(tick.skipped), 'number'],
  ];
}

export class TickTable {
  constructor() {
    const of = (value) => ({tick}) => tick === null ? null : value(tick);
    this.sorter = new Sorter(find('ticks'), {0: ({name}) => name, 1: ({state}) => state ?? '', 2: ({program, pid}) => `${program} ${pid}`,
      3: of((tick) => tick.period_ns), 4: of((tick) => tick.ticks_per_s), 5: of((tick) => tick.lateness?.p50_ns),
      6: of((tick) => tick.lateness?.p99_ns), 7: of((tick) => tick.latest_ns), 9: of((tick) => tick.execution?.p50_ns),
      10: of((tick) => tick.execution?.p99_ns), 11: of((tick) => tick.longest_ns), 12: of((tick) => tick.overruns), 13: of((tick) => tick.skipped)},
    () => this.show(this.state));
    this.list = new KeyedList(find('ticks').tBodies[0], () => make('tr'), (row, item) => fill(row, 0, [
      [item.name || '–', ''], [stateSigns[item.state] ?? '–', item.state === 'error' ? 'bad' : item.state === 'inactive' ? 'warn' : ''],
      [`${item.program}, ${item.pid}`, ''], ...tickCells(item.tick)]));
  }

  /** Draws the part of the table in view. */
  draw() {
    this.list.show(this.window.of(this.rows), (row) => row.key);
    this.window.keepWidths();
  }

  show(state) {
    this.state = state;
    this.rows = this.sorter.sort(rowsOf(state));
    this.window ??= new RowWindow(find('ticks'), () => this.draw());
    this.draw();
    find('ticks-empty').hidden = this.rows.length > 0;
  }
}
