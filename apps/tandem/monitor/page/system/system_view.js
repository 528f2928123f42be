// SPDX-License-Identifier: Apache-2.0
// Changes the system: activates components, connects ports, sets parameters, and undoes the last changes.
import {KeyedList, make, setAttributes, setClass, setText} from '../dom.js';
import {groupsOf} from '../graph/groups.js';
import {tellFailure} from '../top.js';
import {propertiesIn, showProperties} from './connection_properties.js';
import {ParametersView} from './parameters_view.js';
import {actionsFor, componentsIn, connectionsIn, jsonIn, portLabel, propertiesAgain, rtcConfOf, whyNot} from './system.js';

const find = (id) => document.getElementById(id);
const mostRows = 200, mostUndone = 50;
const mostAtOnce = 16; // components of one request
const stateSigns = {ACTIVE: '✓ ', ERROR: '✕ ', UNREACHABLE: '✕ '};

const canStart = (component) => !component.mirrored && ['activate', 'start'].includes(actionsFor(component)[0]?.[0]);

const button = (text, act) => {
  const element = make('button', 'raised', text);
  element.type = 'button';
  element.addEventListener('click', act);
  return element;
};

export class SystemView {
  /** `connection`: of control.js. */
  constructor(connection) {
    Object.assign(this, {connection, components: [], done: [], seen: '', reading: false});
    this.rows = new KeyedList(find('system-components').tBodies[0], (component) => this.createRow(component), (row, component) => this.updateRow(row, component));
    this.connected = new KeyedList(find('system-connections'), (each) => this.createConnection(each), () => {});
    this.parameters = new ParametersView(find('parameters'), (request, text, undo) => this.act(request, text, undo), (request) => connection.ask(request));
    for (const id of ['connect-from', 'connect-to']) find(id).addEventListener('change', () => this.showFit());
    find('connect-form').addEventListener('submit', (event) => {
      event.preventDefault();
      this.connect(...this.chosen(), propertiesIn(find('connect-properties')));
    });
    find('system-filter').addEventListener('input', () => this.draw());
    find('system-refresh').addEventListener('click', () => this.read());
    find('system-activate').addEventListener('click', () => this.activateAll());
    find('system-save').addEventListener('click', () => this.save());
    for (const undo of document.querySelectorAll('.system-undo')) undo.addEventListener('click', () => this.undo());
  }

  /** Called with each state while the view is shown. Reads the system again when the hosts have other components or states. */
  show(state) {
    const seen = state.components.map(({pid, name, state: of}) => `${pid} ${name} ${of}`).join('\n');
    if (!this.connection.open || seen === this.seen) return;
    this.seen = seen;
    this.read();
  }

  /** Asks for the system, once more if this is called meanwhile. */
  async read() {
    this.wanted = true;
    if (this.reading) return;
    this.reading = true;
    try {
      while (this.wanted) {
        this.wanted = false;
        await this.readOnce();
      }
    } finally {
      this.reading = false;
    }
  }

  async readOnce() {
    const [tree, opros] = await Promise.all([this.connection.ask({op: 'rtm', command: 'tree', json: true}),
      this.connection.ask({op: 'opros', command: 'list', json: true})]);
    const rtcs = jsonIn(tree.text), hosts = jsonIn(opros.text);
    this.components = componentsIn(rtcs, hosts);
    const none = this.components.length === 0, failed = [[tree, rtcs], [opros, hosts]].filter(([{ok}, json]) => json === null || (none && !ok));
    const reasons = failed.map(([{ok, text}]) => ok ? 'an answer cannot be read' : text.trim().split('\n').at(-1));
    setText(find('system-note'), [...none ? ['No component answers.'] : [], ...reasons].join(' '));
    this.draw();
  }

  draw() {
    const wanted = find('system-filter').value.toLowerCase();
    const listed = this.components.filter(({name, model}) => `${name} ${model}`.toLowerCase().includes(wanted));
    this.rows.show(listed.slice(0, mostRows), ({model, id}) => `${model} ${id}`);
    setText(find('system-count'), listed.length > mostRows ? `${listed.length - mostRows} more components are not listed: type a part of a name above.` : '');
    this.showActivate(listed.filter(canStart));
    const connections = connectionsIn(this.components);
    this.connected.show(connections, ({id}) => id);
    find('system-connections-empty').hidden = connections.length > 0;
    this.fillPorts();
  }

  /** `waiting`: the listed components that are not active. */
  showActivate(waiting) {
    this.waiting = waiting;
    find('system-activate').hidden = waiting.length < 2;
    setText(find('system-activate'), `Activate ${waiting.length} components`);
  }

  /** Activates the RT-Components and starts the OPRoS components that are listed, until one fails. */
  async activateAll() {
    for (const members of groupsOf(this.waiting, ({model}) => model).values()) {
      const [command, label, undo] = actionsFor(members[0])[0];
      for (let i = 0; i < members.length; i += mostAtOnce) {
        const part = members.slice(i, i + mostAtOnce), names = part.map(({name}) => name).join(', ');
        const request = (of) => ({...this.request(part[0], of), arguments: part.map(({id}) => id)});
        if (!await this.act(request(command), `${label} ${names}`, {text: `${undo} ${names}`, request: request(undo)})) return;
      }
    }
  }

  createRow() {
    const row = make('tr'), head = make('th');
    head.scope = 'row';
    row.append(head, make('td'), make('td'), make('td', 'actions'));
    ['model', 'state', ''].forEach((label, i) => { row.children[i + 1].dataset.label = label; });
    return row;
  }

  updateRow(row, component) {
    const {name, model, mirrored, state} = component, [head, of, now, actions] = row.children;
    setText(head, name);
    setText(of, mirrored ? `${model}, mirrored` : model);
    setText(now, `${stateSigns[state] ?? ''}${state}`);
    setClass(now, state === 'ERROR' || state === 'UNREACHABLE' ? 'bad' : '');
    if (row.state === state) return;
    row.state = state;
    actions.replaceChildren(...actionsFor(component).map(([command, text, undo]) => {
      const act = button(text, () => this.act(this.request(component, command), `${text} ${name}`,
        undo && {text: `${undo} ${name}`, request: this.request(component, undo)}));
      act.ariaLabel = `${text} ${name}`;
      return act;
    }), Object.assign(button('Parameters', () => this.parameters.open(component)), {ariaLabel: `Parameters of ${name}`}));
  }

  request({model, id}, command, more = {}) { return {op: model === 'RTM' ? 'rtm' : 'opros', command, arguments: [id], ...more}; }

  /** Fills the lists of ports. Ports that fit the first one come first. */
  fillPorts() {
    const ports = this.components.flatMap((component) => component.ports), [from, to] = [find('connect-from'), find('connect-to')];
    const fill = (select, groups) => {
      const key = JSON.stringify(groups.map(([label, list]) => [label, list.map(portLabel)])), chosen = select.value;
      if (select.key === key) return;
      select.key = key;
      select.replaceChildren(...groups.filter(([, list]) => list.length > 0).map(([label, list]) => {
        const group = make('optgroup');
        group.label = label;
        group.append(...list.map((port) => new Option(portLabel(port), port.name)));
        return group;
      }));
      if (ports.some(({name}) => name === chosen)) select.value = chosen;
    };
    fill(from, [['send, or serve', ports.filter(({kind}) => kind !== 'DataInPort')], ['receive', ports.filter(({kind}) => kind === 'DataInPort')]]);
    const first = ports.find(({name}) => name === from.value), fits = (port) => first && whyNot(first, port) === '';
    fill(to, [['fits', ports.filter(fits)], ['does not fit', ports.filter((port) => !fits(port))]]);
    this.ports = ports;
    this.showFit(false);
  }

  chosen() { return ['connect-from', 'connect-to'].map((id) => this.ports?.find(({name}) => name === find(id).value)); }

  showFit(fill = true) {
    if (fill) return this.fillPorts();
    const [a, b] = this.chosen(), why = a && b ? whyNot(a, b) : 'there are no two ports';
    setText(find('connect-fit'), why === '' ? '✓ The ports fit.' : `✕ They cannot be connected: ${why}.`);
    setClass(find('connect-fit'), why === '' ? '' : 'bad');
    find('connect-form').querySelector('button').disabled = why !== '';
    showProperties(find('connect-properties'), a, b);
  }

  /** `properties`: KEY=VALUE. Returns whether it was done. */
  connect(a, b, properties) {
    const ports = [a.name, b.name];
    return this.act({op: 'rtm', command: 'connect', arguments: ports, ...properties.length > 0 ? {properties} : {}}, `Connect ${ports.join(' and ')}`,
      {text: `disconnect ${ports.join(' and ')}`, request: {op: 'rtm', command: 'disconnect', arguments: ports}});
  }

  /** Ends a connection of connectionsIn(). Returns whether it was done. */
  disconnect({id, ports, properties}) {
    const again = propertiesAgain(properties), names = ports.join(' → ');
    return this.act({op: 'rtm', command: 'disconnect', arguments: ports.slice(0, 2), connection: id}, `Disconnect ${names}`,
      {text: `connect ${names}`, request: {op: 'rtm', command: 'connect', arguments: ports, ...again.length > 0 ? {properties: again} : {}}});
  }

  createConnection(connection) {
    const {ports, properties} = connection, item = make('li'), names = ports.join(' → ');
    const kind = ['dataport.dataflow_type', 'dataport.subscription_type'].map((key) => properties[key]).filter(Boolean).join(', ');
    const drop = button('Disconnect', () => this.disconnect(connection));
    drop.ariaLabel = `Disconnect ${names}`;
    item.append(make('b', '', names), make('span', 'empty', kind), drop);
    return item;
  }

  /** Shows what became of a change in each view that can make one. */
  tell(text, bad = false) {
    for (const answer of document.querySelectorAll('.system-answer')) {
      answer.classList.toggle('bad', bad);
      setText(answer, text);
    }
    tellFailure('system', bad, text);
  }

  /** Carries out a change, says what became of it, and keeps how to undo it: {text, request}. Returns whether it was done. */
  async act(request, text, undo = null) {
    this.tell(`${text}: waiting for the answer ...`);
    const reply = await this.connection.ask(request), lines = reply.text.trim();
    this.tell(reply.ok ? `✓ ${text}: done` : `✕ ${text}: ${lines || 'failed'}`, !reply.ok);
    if (reply.ok && undo) this.done = [...this.done, undo].slice(-mostUndone);
    this.showUndo();
    this.read();
    return reply.ok;
  }

  /** Downloads the connections and the active components. */
  save() {
    const link = make('a');
    Object.assign(link, {href: URL.createObjectURL(new Blob([rtcConfOf(this.components)], {type: 'text/plain'})), download: 'rtc.conf'});
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }

  async undo() {
    const last = this.done.pop();
    this.showUndo();
    if (await this.act(last.request, `Undo: ${last.text}`)) this.parameters.refresh();
    else this.done.push(last); // it may be possible later
    this.showUndo();
  }

  showUndo() {
    const last = this.done.at(-1);
    for (const button of document.querySelectorAll('.system-undo')) {
      button.hidden = !last;
      setText(button, last ? `↶ Undo: ${last.text}` : '');
      setAttributes(button, {title: `${this.done.length} changes can be undone`});
    }
  }
}
