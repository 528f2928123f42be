// SPDX-License-Identifier: Apache-2.0
// Lines of the hosts' logs: which process and component wrote them, and at which level. Draws nothing.

const mostLines = 5000;
const ranks = {trace: 0, debug: 0, info: 1, warn: 2, warning: 2, error: 3, critical: 3, err: 3};

/**
 * Returns what a line of a log says: {at, time, level, rank, program, component, text}; `at` with the date. Other programs write
 * other lines, which have only a text. `program` is the host that `tandem run` names before each line of a host; else it is empty.
 */
export function lineIn(line) {
  const [, program = '', text] = line.match(/^(?:(rtm_host|opros_host) +\| )?(.*)$/);
  const found = text.match(/^\[(\d{4}-\d\d-\d\d) (\d\d:\d\d:\d\d\.\d+)\] \[(\w+)\] ([^:]*): (.*)$/);
  if (!found) return {at: '', time: '', level: '', rank: 1, program, component: '', text};
  const [, date, time, level, component, rest] = found;
  return {at: `${date} ${time}`, time, level, rank: ranks[level.toLowerCase()] ?? 1, program, component, text: rest};
}

/** Returns the hosts, each with its process id, that may have written a line of their common log. */
function writersOf({program}, hosts) {
  if (program === '') return hosts.join(', ');
  return hosts.filter((host) => host.startsWith(`${program} `)).join(', ') || program; // the host may have ended since
}

export class LogStore {
  constructor() { Object.assign(this, {lines: [], offsets: {}, next: 1}); }

  /** Takes an answer to the request `log`. Returns whether there are new lines. */
  take(logs) {
    const before = this.next;
    for (const {id, hosts, text: lines, next} of logs) {
      this.offsets[id] = next;
      let at = this.lines.at(-1)?.at ?? ''; // of a line without a time: that of the line before
      for (const text of lines.split('\n').filter((each) => each !== '')) {
        const line = lineIn(text);
        at = line.at ||= at;
        this.lines.push({number: this.next++, host: writersOf(line, hosts), ...line});
      }
    }
    if (this.next === before) return false;
    this.lines.sort((a, b) => a.at === b.at ? a.number - b.number : a.at < b.at ? -1 : 1);
    this.lines = this.lines.slice(-mostLines);
    return true;
  }

  /** Returns the last lines at this rank or above that contain a text, newest first. */
  select(rank, text, most) {
    const wanted = text.toLowerCase();
    const chosen = this.lines.filter((line) => line.rank >= rank && `${line.host} ${line.component} ${line.text}`.toLowerCase().includes(wanted));
    return {lines: chosen.slice(-most).reverse(), count: chosen.length};
  }
}
