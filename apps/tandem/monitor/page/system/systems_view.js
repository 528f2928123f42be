// SPDX-License-Identifier: Apache-2.0
// The systems in the monitor's folder (`--systems`): creates, saves, starts and stops them, and shows their logs.
import {KeyedList, make, setClass, setText} from '../dom.js';
import {tellFailure} from '../top.js';
import {jsonIn} from './system.js';
import {hostGroups, partsOf, runText} from './systems.js';

const find = (id) => document.getElementById(id);
const pause = 1000, mostOfEach = 20; // ms between two requests for a log; instances of a component

export class SystemsView {
  /** `connection`: of control.js. */
  constructor(connection) {
    Object.assign(this, {connection, names: [], counts: {}, runs: [], seen: null, logged: null, askedAt: 0});
    this.list = new KeyedList(find('systems'), (name) => this.createItem(name), (item, name) => this.updateItem(item, name));
    this.parts = new KeyedList(find('system-parts'), (part) => this.createPart(part), () => {});
    find('system-new-form').addEventListener('submit', (event) => {
      event.preventDefault();
      this.create(find('system-new-name').value);
    });
    find('system-save-form').addEventListener('submit', (event) => {
      event.preventDefault();
      this.save(find('system-save-name').value);
    });
    find('system-save-name').addEventListener('input', () => this.showReplace());
  }

  /** Called with each state while the view is shown. */
  show(state) {
    const runs = state.control.systems;
    find('systems-part').hidden = !runs;
    if (!runs || !this.connection.open) return;
    this.runs = runs;
    this.groups = hostGroups(state.hosts);
    this.fillHosts();
    const seen = runs.map(({name, running}) => `${name} ${running}`).join('\n');
    if (seen !== this.seen) this.read();
    else this.draw();
    this.seen = seen;
    if (this.logged && performance.now() - this.askedAt > pause) this.readLog();
  }

  async read() {
    const reply = await this.connection.ask({op: 'system', command: 'list'}), found = reply.ok ? jsonIn(reply.text) : null;
    if (found === null) return this.tell(false, `The systems in the folder cannot be listed: ${reply.text.trim() || 'the answer cannot be read'}`);
    this.names = found.systems;
    const known = new Set(found.components.map(({name}) => name));
    this.counts = Object.fromEntries(Object.entries(this.counts).filter(([name]) => known.has(name)));
    this.parts.show(found.components, ({name, model}) => `${name} ${model}`);
    find('system-parts-empty').hidden = found.components.length > 0;
    this.draw();
  }

  draw() {
    this.list.show(this.names, (name) => name);
    find('systems-empty').hidden = this.names.length > 0;
    this.showReplace();
  }

  createItem(name) {
    const item = make('li'), buttons = [['Start', () => this.command('start', name)], ['Stop', () => this.command('stop', name)], ['Log', () => this.showLog(name)]];
    item.append(make('b', '', name), make('span', 'empty'), ...buttons.map(([text, act]) => {
      const button = make('button', 'raised', text);
      Object.assign(button, {type: 'button', ariaLabel: `${text} ${name}`});
      button.addEventListener('click', act);
      return button;
    }));
    return item;
  }

  updateItem(item, name) {
    const run = this.runs.find((each) => each.name === name), [, state, start, stop, log] = item.children;
    setText(state, runText(run));
    setClass(state, run && !run.running && run.end !== 'exited with 0' ? 'bad' : 'empty');
    start.hidden = Boolean(run?.running);
    stop.hidden = !run?.running;
    log.hidden = !run;
  }

  createPart({name, model}) {
    const item = make('li'), label = make('label'), input = make('input');
    Object.assign(input, {type: 'number', min: 0, max: mostOfEach, value: this.counts[name] ?? 0});
    input.addEventListener('input', () => { this.counts[name] = Math.max(0, Math.min(mostOfEach, Math.trunc(Number(input.value)) || 0)); });
    label.append(input, ` ${name} (${model})`);
    item.append(label);
    return item;
  }

  fillHosts() {
    const select = find('system-save-hosts'), key = this.groups.map(({label}) => label).join('\n');
    if (select.key === key) return;
    const chosen = select.value;
    select.key = key;
    select.replaceChildren(...this.groups.map(({label}) => new Option(label, label)));
    if (this.groups.some(({label}) => label === chosen)) select.value = chosen;
  }

  /** Asks before files are changed: only the folder from which the hosts run can be saved again. */
  showReplace() {
    find('system-replace-label').hidden = !this.names.includes(find('system-save-name').value);
  }

  create(name) {
    const components = partsOf(this.counts);
    if (components.length === 0) return this.tell(false, 'The new system has no component: enter a number beside each component that it should have.');
    return this.act({command: 'new', name, components}, `Create ${name}`);
  }

  async save(name) {
    const group = this.groups?.find(({label}) => label === find('system-save-hosts').value);
    if (!group) return this.tell(false, 'There is nothing to save: no host is running.');
    const replace = this.names.includes(name) && find('system-replace').checked;
    if (await this.act({command: 'save', name, hosts: group.pids, replace}, `Save ${name}`)) find('system-replace').checked = false;
  }

  command(command, name) {
    if (command === 'start') this.showLog(name);
    return this.act({command, name}, `${command === 'start' ? 'Start' : 'Stop'} ${name}`);
  }

  async act(request, text) {
    this.tell(null, `${text}: waiting for the answer ...`);
    const reply = await this.connection.ask({op: 'system', ...request}), lines = reply.text.trim();
    this.tell(reply.ok, `${text}: ${lines || (reply.ok ? 'done' : 'failed')}`);
    await this.read();
    return reply.ok;
  }

  tell(ok, text) {
    setClass(find('systems-answer'), ok === false ? 'bad' : '');
    setText(find('systems-answer'), `${ok === null ? '' : ok ? '✓ ' : '✕ '}${text}`);
    tellFailure('systems', ok === false, `✕ ${text}`);
  }

  showLog(name) {
    this.logged = name;
    this.askedAt = 0;
    find('system-log-part').hidden = false;
    setText(find('system-log-title'), `Log of ${name}`);
    setText(find('system-log'), '');
  }

  async readLog() {
    this.askedAt = performance.now();
    const name = this.logged, reply = await this.connection.ask({op: 'system', command: 'log', name}), pane = find('system-log');
    if (name !== this.logged) return;
    const atEnd = pane.scrollTop + pane.clientHeight >= pane.scrollHeight - 4;
    setText(pane, reply.ok ? reply.text || 'nothing yet' : `✕ ${reply.text}`);
    if (atEnd) pane.scrollTop = pane.scrollHeight;
  }
}
