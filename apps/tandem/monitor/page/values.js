// SPDX-License-Identifier: Apache-2.0
// Shows the newest message of the chosen port.
import {setText} from './dom.js';
import {keyOfPort} from './tables.js';

const find = (id) => document.getElementById(id);

/** Formats JSON with short lists on one line. */
const textOf = (value) => JSON.stringify(value, null, 1).replace(/\[\s+([^[\]{}]{0,200}?)\s+\]/g,
  (_, inner) => `[${inner.replace(/\s+/g, ' ')}]`);

export class Values {
  constructor() { this.key = null; }

  choose(key) {
    this.key = key;
    find('message').hidden = false;
  }

  show(state) {
    if (this.key === null) return;
    for (const link of state.links)
      for (const port of link.ports)
        if (keyOfPort(link, port) === this.key) return this.showPort(link, port);
    setText(find('value'), 'The port is gone.');
  }

  showPort(link, port) {
    setText(find('values-port'), ` of ${port.name}, link ${link.name}`);
    setText(find('value'), port.value_note || (port.value === null || port.value === undefined
      ? 'No message since the monitor started.' : textOf(port.value)));
  }
}
