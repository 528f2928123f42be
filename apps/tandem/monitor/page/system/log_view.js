// SPDX-License-Identifier: Apache-2.0
// Shows the lines of the hosts' logs beside the events, for a page with the token.
import {KeyedList, make, setText} from '../dom.js';
import {LogStore} from './logs.js';

const find = (id) => document.getElementById(id);
const mostShown = 300, pause = 1000; // lines; ms between two requests
const signs = ['', '', '▲', '✕'];

export class LogView {
  /** `connection`: of control.js. */
  constructor(connection) {
    Object.assign(this, {connection, store: new LogStore(), asks: false, askedAt: 0});
    this.list = new KeyedList(find('log').tBodies[0], (line) => this.createRow(line), () => {});
    for (const id of ['log-level', 'log-filter']) find(id).addEventListener('input', () => this.draw());
  }

  createRow({time, host, component, rank, level, text}) {
    const row = make('tr', ['', '', 'warn', 'bad'][rank]);
    for (const [label, cell] of [['time', time], ['level', `${signs[rank]} ${level}`.trim()], ['component', component || host], ['line', text]]) {
      const element = make('td', '', cell);
      element.dataset.label = label;
      row.append(element);
    }
    row.title = host;
    return row;
  }

  /** Called with each state while the view is shown. */
  show(state) {
    find('log-part').hidden = !state.control.allowed;
    find('log-token').hidden = this.connection.open;
    if (this.connection.open && !this.asks && performance.now() - this.askedAt > pause) this.ask();
  }

  async ask() {
    Object.assign(this, {asks: true, askedAt: performance.now()});
    const reply = await this.connection.ask({op: 'log', from: this.store.offsets});
    this.asks = false;
    if (!reply.ok) return setText(find('log-note'), `✕ The log cannot be read: ${reply.text}`);
    const known = reply.log.length > 0;
    if (this.store.take(reply.log) || !known || find('log-note').textContent.startsWith('✕')) this.draw();
    find('log-where').hidden = known || this.store.lines.length > 0;
  }

  draw() {
    const {lines, count} = this.store.select(Number(find('log-level').value), find('log-filter').value, mostShown);
    this.list.show(lines, ({number}) => number);
    setText(find('log-note'), count > lines.length ? `the newest ${lines.length} of ${count} lines` : '');
  }
}
