// SPDX-License-Identifier: Apache-2.0
// Shows the newest message of the selected port, and plots its numbers over the last minute.
import {setText} from './dom.js';
import {Plot} from './plot.js';
import {keyOfPort} from './tables.js';

const find = (id) => document.getElementById(id);

/** Yields the numbers of a message with their names, such as `pose.x`. Omits the time of RTM messages. */
function* numbersOf(value, name = '') {
  if (typeof value === 'number') yield [name || 'value', value];
  else if (value !== null && typeof value === 'object')
    for (const [key, member] of Object.entries(value)) {
      if (name === '' && key === 'tm') continue;
      yield* numbersOf(member, Array.isArray(value) ? `${name}[${key}]` : name ? `${name}.${key}` : key);
    }
}

/** Formats JSON with short lists on one line. */
const textOf = (value) => JSON.stringify(value, null, 1).replace(/\[\s+([^[\]{}]{0,200}?)\s+\]/g,
  (_, inner) => `[${inner.replace(/\s+/g, ' ')}]`);

export class Values {
  constructor() {
    this.key = null;
    this.plot = new Plot(find('plot'), find('legend'), 60);
  }

  choose(key) {
    this.key = key;
    this.plot.clear();
    find('values-hint').hidden = true;
    find('values').hidden = false;
    if (this.newest) this.show(this.newest);
  }

  show(state) {
    this.newest = state;
    if (this.key === null) return;
    for (const link of state.links)
      for (const port of link.ports)
        if (keyOfPort(link, port) === this.key) return this.showPort(state.time_ms, link, port);
    setText(find('value'), 'The port is gone.');
  }

  showPort(time, link, port) {
    setText(find('values-port'), ` of ${port.name}, link ${link.name}`);
    setText(find('value'), port.value_note || (port.value === null || port.value === undefined
      ? 'No message since the monitor started.' : textOf(port.value)));
    this.plot.add(time, numbersOf(port.value ?? null));
  }
}
