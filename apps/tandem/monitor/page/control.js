// SPDX-License-Identifier: Apache-2.0
// The controls of a page with the token: RT-Components, recording, and the stick. docs/monitoring.md describes the
// requests.
import {setText} from './dom.js';
import {socketAddress} from './server.js';

const find = (id) => document.getElementById(id);

/** The connection for requests. It is open after the server has accepted the token. */
class Connection {
  constructor() {
    this.open = false;
    this.waiting = new Map();
    this.next = 1;
    this.listeners = [];
  }

  connect(token) {
    if (this.socket && this.socket.readyState <= WebSocket.OPEN) return;
    const socket = this.socket = new WebSocket(socketAddress(`api/control?token=${encodeURIComponent(token)}`));
    socket.onopen = () => socket.send(JSON.stringify({token}));
    socket.onmessage = (message) => {
      const reply = JSON.parse(message.data);
      if (reply.op === 'token') this.change(true);
      this.waiting.get(reply.id)?.(reply);
      this.waiting.delete(reply.id);
      if (reply.op === 'drive') this.driveFailed?.(reply.text);
    };
    socket.onclose = () => {
      this.change(false);
      for (const done of this.waiting.values()) done({ok: false, text: 'the connection is lost'});
      this.waiting.clear();
    };
  }

  change(open) {
    this.open = open;
    for (const listener of this.listeners) listener(open);
  }

  send(request) {
    if (this.open) this.socket.send(JSON.stringify(request));
  }

  /** Sends a request and returns its reply. */
  ask(request) {
    return new Promise((resolve) => {
      if (!this.open) return resolve({ok: false, text: 'there is no connection'});
      const id = this.next++;
      this.waiting.set(id, resolve);
      this.send({...request, id});
    });
  }
}

export class ControlPanel {
  constructor() {
    this.connection = new Connection();
    this.connection.listeners.push((open) => {
      find('control-form').hidden = !open;
      find('token-form').hidden = open || !this.allowed;
      if (open) sessionStorage.setItem('tandem-token', this.token);
    });
    // The token comes with the printed address. Removes it from the address bar and keeps it for this tab.
    this.token = location.hash.match(/^#token=(\w+)$/)?.[1] ?? sessionStorage.getItem('tandem-token') ?? '';
    if (location.hash.startsWith('#token=')) history.replaceState(null, '', location.pathname);
    find('token-form').addEventListener('submit', (event) => {
      event.preventDefault();
      this.token = find('token').value.trim();
      find('token').value = '';
      this.retryAt = 0;
      this.connection.connect(this.token);
    });
    find('control-form').addEventListener('submit', (event) => {
      event.preventDefault();
      this.run(event.submitter.value);
    });
    find('record').addEventListener('click', () => this.record());
  }

  /** Called with each state: connects, and shows the recording. */
  show(state) {
    this.state = state;
    this.allowed = state.control.allowed;
    find('control-section').hidden = find('control-anchor').hidden = !this.allowed;
    if (!this.connection.open) find('token-form').hidden = !this.allowed;
    if (this.allowed && this.token && !this.connection.open && performance.now() > (this.retryAt ?? 0)) {
      this.retryAt = performance.now() + 3000;
      this.connection.connect(this.token);
    }
    const file = state.control.recording;
    setText(find('record'), file ? '■ Stop recording' : '● Record all links shown');
    find('record').setAttribute('aria-pressed', file !== '');
    setText(find('recording'), file ? `recording to ${file}` : this.recorded ?? '');
  }

  async run(command) {
    const words = find('control-arguments').value.trim().split(/\s+/).filter((word) => word !== '');
    setText(find('control-result'), '...');
    const reply = await this.connection.ask({op: 'rtm', command, arguments: words});
    setText(find('control-result'), `${reply.ok ? '✓' : '✕'} ${command}: ${reply.text.trim() || (reply.ok ? 'done' : 'failed')}`);
  }

  async record() {
    const on = this.state.control.recording === '';
    const links = this.state.links.filter((link) => link.readable).map((link) => link.name);
    const reply = await this.connection.ask({op: 'record', on, links});
    this.recorded = reply.ok && !on ? `recorded to ${reply.text}` : reply.ok ? '' : `not recorded: ${reply.text}`;
  }
}
