// SPDX-License-Identifier: Apache-2.0
// The controls of a page with the token: RT-Components, recording, and the stick. docs/monitoring.md describes the
// requests.
import {setText} from './dom.js';
import {socketAddress} from './server.js';
import {tellFailure} from './top.js';

const find = (id) => document.getElementById(id);

/** Longest wait for an answer, ms. The monitor ends a command after 15 s. */
const patience = 20000;

/** The connection for requests. It is open after the server has accepted the token. */
export class Connection {
  constructor() {
    this.open = false;
    this.waiting = new Map();
    this.next = 1;
    this.listeners = []; // called with `open`
    this.refused = false; // the server has not accepted the last token
    this.driveFailed = () => {}; // called with the reason why a stick position was not sent
  }

  connect(token) {
    if (this.socket && this.socket.readyState <= WebSocket.OPEN) return;
    const socket = this.socket = new WebSocket(socketAddress(`api/control?token=${encodeURIComponent(token)}`));
    this.refused = false;
    socket.onopen = () => socket.send(JSON.stringify({token}));
    socket.onmessage = (message) => {
      const reply = JSON.parse(message.data);
      if (reply.op === 'token') {
        this.refused = !reply.ok;
        if (reply.ok) this.change(true);
      }
      const done = this.waiting.get(reply.id);
      this.waiting.delete(reply.id);
      if (done) done(reply);
      else if (reply.op === 'drive') this.driveFailed(reply.text);
    };
    socket.onclose = () => {
      this.change(false);
      for (const done of this.waiting.values()) done({ok: false, text: 'no answer: the connection is lost'});
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

  /** Sends a request and returns its reply, which may be a refusal or say that there is none. */
  ask(request) {
    return new Promise((resolve) => {
      if (!this.open) return resolve({ok: false, text: 'not sent: there is no connection for control'});
      const id = this.next++;
      const late = setTimeout(() => {
        this.waiting.delete(id);
        resolve({ok: false, text: `no answer within ${patience / 1000} s`});
      }, patience);
      this.waiting.set(id, (reply) => {
        clearTimeout(late);
        resolve(reply);
      });
      this.send({...request, id});
    });
  }
}

/** What each command expects in the field; one without an entry expects nothing. */
const expected = {
  activate: 'an RT-Component, for example ConsoleIn0',
  deactivate: 'an RT-Component, for example ConsoleIn0',
  reset: 'an RT-Component, for example ConsoleIn0',
  connect: 'two ports, for example ConsoleIn0:out ConsoleOut0:in',
  disconnect: 'a port, for example ConsoleIn0:out',
  conf: 'an RT-Component, for example ConsoleIn0, or ConsoleIn0 NAME=VALUE',
};

export class ControlPanel {
  constructor(connection) {
    this.connection = connection;
    connection.listeners.push((open) => this.showConnection(open));
    // The token comes with the printed address. Removes it from the address bar and keeps it for this tab.
    this.token = location.hash.match(/^#token=(\w+)$/)?.[1] ?? sessionStorage.getItem('tandem-token') ?? '';
    if (location.hash.startsWith('#token=')) history.replaceState(null, '', location.pathname);
    find('token-form').addEventListener('submit', (event) => {
      event.preventDefault();
      this.token = find('token').value.trim();
      find('token').value = '';
      setText(find('token-answer'), this.token === '' ? '✕ enter the token first' : 'asking ...');
      if (this.token !== '') connection.connect(this.token);
    });
    find('command-form').addEventListener('submit', (event) => {
      event.preventDefault();
      this.run(event.submitter.value);
    });
    find('record').addEventListener('click', () => this.record());
  }

  showConnection(open) {
    find('control-form').hidden = !open;
    find('token-form').hidden = open || !this.allowed;
    if (open) sessionStorage.setItem('tandem-token', this.token);
    else if (this.connection.refused) {
      this.token = ''; // asking again would be useless: each start of the monitor has another token
      sessionStorage.removeItem('tandem-token');
    }
    const refused = !open && this.connection.refused;
    setText(find('token-answer'), refused ? '✕ the monitor does not accept this token; it prints a new one at each start' : '');
    tellFailure('token', refused, '✕ This page controls nothing, because the monitor does not accept its token. Enter the printed token in the view Control.');
  }

  /** Called with each state: connects, and shows the recording. */
  show(state) {
    this.state = state;
    this.allowed = state.control.allowed;
    if (!this.connection.open) find('token-form').hidden = !this.allowed;
    if (this.allowed && this.token && !this.connection.open && performance.now() > (this.retryAt ?? 0)) {
      this.retryAt = performance.now() + 3000;
      this.connection.connect(this.token);
    }
    const file = state.control.recording;
    setText(find('record'), file ? '■ Stop recording' : '● Record all links shown');
    find('record').setAttribute('aria-pressed', file !== '');
    setText(find('recording'), this.recorded ?? (file ? `recording to ${file.split('/').pop()} in the monitor's folder` : ''));
  }

  async run(command) {
    const words = find('control-arguments').value.trim().split(/\s+/).filter((word) => word !== '');
    const answer = (text) => setText(find('control-result'), text);
    if (words.length === 0 && expected[command]) return answer(`✕ ${command}: enter ${expected[command]}`);
    answer(`${command}: waiting for the answer ...`);
    const reply = await this.connection.ask({op: 'rtm', command, arguments: words});
    answer(`${reply.ok ? '✓' : '✕'} ${command}: ${reply.text.trim() || (reply.ok ? 'done' : 'failed')}`);
    tellFailure('command', !reply.ok, `✕ ${command} ${words.join(' ')}: ${reply.text.trim() || 'failed'}`);
  }

  async record() {
    const on = this.state.control.recording === '';
    this.recorded = on ? 'starting ...' : 'stopping ...';
    this.show(this.state);
    const reply = await this.connection.ask({op: 'record', on}); // all links that the monitor shows
    this.recorded = !reply.ok ? `✕ ${on ? 'Not recorded' : 'The recording was not stopped'}: ${reply.text}` : on ? null : `✓ recorded to ${reply.text}`;
    tellFailure('record', this.recorded?.startsWith('✕'), this.recorded);
    this.show(this.state);
  }
}
