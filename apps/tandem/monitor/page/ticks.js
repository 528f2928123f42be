// SPDX-License-Identifier: Apache-2.0
// The table of ticks. A tick belongs to one component or to several that tick together.
import {KeyedList, duration, make, number} from './dom.js';
import {fill, time} from './tables.js';

const find = (id) => document.getElementById(id);

export class TickTable {
  constructor() {
    this.list = new KeyedList(find('ticks').tBodies[0], () => make('tr'), (row, tick) => fill(row, 0, [
      [tick.name || '–', ''], [`${tick.program}, ${tick.pid}`, ''], [duration(tick.period_ns), 'number'],
      tick.hang ? [`! hangs ${duration(tick.hang.seconds * 1e9)}`, 'number bad'] : [number(tick.ticks_per_s), 'number'],
      time(tick.lateness, 'p50_ns'), time(tick.lateness, 'p99_ns'), [duration(tick.latest_ns), 'number'], {histogram: tick.lateness},
      [tick.overruns_recently > 0 ? `◷ ${tick.overruns}` : String(tick.overruns), tick.overruns_recently > 0 ? 'number warn' : 'number'],
      [String(tick.skipped), 'number'],
    ]));
  }

  show(ticks) {
    const seen = new Map(); // counts equal names
    this.list.show(ticks.map((tick) => {
      const key = `${tick.pid} ${tick.name}`;
      seen.set(key, (seen.get(key) ?? 0) + 1);
      return {...tick, key: `${key} ${seen.get(key)}`};
    }), (tick) => tick.key);
    find('ticks-section').hidden = find('ticks-anchor').hidden = ticks.length === 0;
  }
}
