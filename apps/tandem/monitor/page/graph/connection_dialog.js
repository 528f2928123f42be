// SPDX-License-Identifier: Apache-2.0
// The form for a new connection between two ports of the graph, and for the end of one.
import {KeyedList, make, setClass, setText} from '../dom.js';
import {propertiesIn, showProperties} from '../system/connection_properties.js';
import {commonProperties, portLabel, whyNot} from '../system/system.js';

const find = (id) => document.getElementById(id);
const unknown = (name) => `${name} is not a port of an RT-Component, and no port of one stands for it. The profile of an OPRoS application has the connections ` +
  'between its components; AdaptorComp shares a port with the RTM host.';

export class ConnectionDialog {
  /** `system`: of system_view.js. */
  constructor(system) {
    Object.assign(this, {system, element: find('connection-dialog'), ports: [], asked: 0});
    this.connections = new KeyedList(find('connection-list'), (connection) => this.createConnection(connection), () => {});
    find('connection-make').addEventListener('click', () => this.make());
  }

  /** Opens it, and shows something once the system has been asked for its ports. */
  async open(title, draw) {
    const asked = ++this.asked;
    setText(find('connection-title'), title);
    find('connection-ports').replaceChildren();
    find('connection-properties').replaceChildren();
    find('connection-properties').offered = '';
    this.connections.show([], () => '');
    find('connection-make').hidden = true;
    this.system.tell('');
    this.tell('asking the hosts ...');
    if (!this.element.open) this.element.showModal();
    await this.system.read();
    if (asked === this.asked) draw();
  }

  tell(text, bad = false) {
    setText(find('connection-fit'), text);
    setClass(find('connection-fit'), bad ? 'bad' : '');
  }

  /** Offers to connect two ports: {name, find}. */
  connect(ends) {
    return this.open(`Connect ${ends.map(({name}) => name).join(' and ')}`, () => {
      this.ports = ends.map((end) => end.find());
      const [a, b] = this.ports, missing = ends.find((end, i) => !this.ports[i]);
      const why = missing ? unknown(missing.name) : whyNot(a, b), offered = why === '' ? commonProperties(a, b) : [];
      find('connection-ports').replaceChildren(...this.ports.flatMap((port, i) => port ? [make('dt', '', ['from', 'to'][i]), make('dd', '', portLabel(port))] : []));
      this.tell(why === '' ? `✓ The ports fit.${offered.length > 0 ? ` Both support ${offered.map(([name, values]) => `${name.replace('_', ' ')} ${values.join(', ')}`).join('; ')}.` : ''}`
        : `✕ They cannot be connected: ${why}${why.endsWith('.') ? '' : '.'}`, why !== '');
      if (why === '') showProperties(find('connection-properties'), a, b);
      find('connection-make').hidden = why !== '';
      if (why === '') find('connection-make').focus();
    });
  }

  async make() {
    find('connection-make').hidden = true;
    if (await this.system.connect(...this.ports, propertiesIn(find('connection-properties')))) this.element.close();
    else find('connection-make').hidden = false;
  }

  /** Shows connections, which can be ended. `listed`: returns them. */
  show(title, listed) {
    return this.open(title, () => {
      const connections = listed();
      this.tell(connections.length > 0 ? '' : 'No RT-Component has this connection, so that it cannot be ended here. The profile of an OPRoS application has the connections between its components.');
      this.connections.show(connections, ({id}) => id);
    });
  }

  createConnection(connection) {
    const item = make('li'), names = connection.ports.join(' → '), end = make('button', 'raised', 'Disconnect');
    end.type = 'button';
    end.ariaLabel = `Disconnect ${names}`;
    end.addEventListener('click', async () => {
      end.disabled = true;
      if (await this.system.disconnect(connection)) this.element.close();
      end.disabled = false;
    });
    item.append(make('b', '', names), make('span', 'empty', Object.entries(connection.properties).filter(([key]) => /^dataport\.\w+_type$/.test(key)).map(([, value]) => value).join(', ')), end);
    return item;
  }
}
