// SPDX-License-Identifier: Apache-2.0
// Receives the state five times a second and shows it. docs/monitoring.md describes the JSON.
import {Chair} from './chair.js';
import {ControlPanel} from './control.js';
import {KeyedList, make, setClass, setText} from './dom.js';
import {Graph} from './graph.js';
import {requestState, socketAddress} from './server.js';
import {CallTable, PortTable} from './tables.js';
import {TickTable} from './ticks.js';
import {Values} from './values.js';

const find = (id) => document.getElementById(id);

// A sign for each level, in addition to colour and words.
const signs = {well: '✓', unseen: '?', setting: '≠', inactive: '○', missing: '○', unrecorded: '✕', failed: '✕', no_link: '○', mismatch: '≠', waiting: '…', late: '◷', dropping: '▼', overrun: '↻', unreadable: '?', stopped: '❚❚', gone: '✕', dead: '✕', hanging: '!'};

let newest = null;
const values = new Values(), control = new ControlPanel(), chair = new Chair(control.connection);

/** Selects a port. The page's address contains it, so that it survives a reload and works as a bookmark. */
function choose(key) {
  if (key !== decodeURIComponent(location.hash.slice(1))) history.replaceState(null, '', `#${encodeURIComponent(key)}`);
  graph.chosen = ports.chosen = key;
  values.choose(key);
  if (newest !== null) show(newest);
}
/** Shows a component's ports in the table. */
function filterPorts(text) {
  find('filter').value = text;
  ports.show(newest.links);
  find('links-section').scrollIntoView();
  find('filter').focus({preventScroll: true});
}
const graph = new Graph(find('graph'), find('graph-note'), choose, filterPorts);
const ports = new PortTable(choose);
const ticks = new TickTable(), calls = new CallTable();

const events = new KeyedList(find('events'), (event) => {
  const item = make('li', event.bad ? 'bad' : 'good');
  const time = make('time', '', new Date(event.time_ms).toLocaleTimeString([], {hour12: false}));
  time.dateTime = new Date(event.time_ms).toISOString();
  item.append(time, make('span', 'sign', event.bad ? '✕' : '•'), make('b', '', event.link), make('span', '', event.text));
  return item;
}, () => {});

let spoken = '';

function showVerdict(verdict) {
  const section = find('verdict');
  setClass(section, verdict.level);
  setText(section.querySelector('.sign'), signs[verdict.level] ?? '?');
  setText(section.querySelector('.text'), verdict.text);
  const more = verdict.findings > 1 ? `; ${verdict.findings - 1} more` : '';
  setText(section.querySelector('.reason'), verdict.reason + more);
  // Announced on a change of level, not on each change of a count in the reason.
  if (spoken !== verdict.level) setText(find('spoken'), `${verdict.text}: ${verdict.reason}`);
  spoken = verdict.level;
  const title = `${signs[verdict.level] ?? '?'} ${verdict.text} – Tandem monitor`;
  if (document.title !== title) document.title = title;
}

let isConnected = false;

function show(state) {
  newest = state;
  setText(find('cut'), state.cut);
  find('cut').hidden = state.cut === '';
  if (isConnected) showVerdict(state.verdict); // a port can be selected in the last state while disconnected
  graph.show(state.links, state.refused_connections);
  ports.show(state.links);
  calls.show(state.links);
  ticks.show(state.ticks);
  values.show(state);
  chair.show(state);
  control.show(state);
  events.show([...state.events].reverse(), (event) => `${event.number} ${event.time_ms}`);
  find('events-empty').hidden = state.events.length > 0;
}

/** Shows the connection's state. Marks the shown state as outdated if the connection is lost. */
function showConnection(connected, text) {
  setText(find('connection'), text);
  document.body.classList.toggle('disconnected', !connected);
  isConnected = connected;
  if (connected || newest === null) return;
  showVerdict({level: 'unreadable', text: 'Disconnected', findings: 0,
    reason: `the monitor does not answer; the page shows the state at ${new Date(newest.time_ms).toLocaleTimeString([], {hour12: false})}`});
}

let retry = 500; // ms, doubles up to 8 s

function connect() {
  // The token entitles to a place that other clients cannot take.
  const query = control.token ? `?token=${encodeURIComponent(control.token)}` : '';
  const socket = new WebSocket(socketAddress(`api/live${query}`));
  let silent, received = false;
  const watch = () => {
    clearTimeout(silent);
    silent = setTimeout(() => socket.close(), 5000); // an unreachable machine does not close the socket
  };
  watch();
  let waiting = null; // draws only the newest state, when the browser draws
  socket.onmessage = (message) => {
    received = true;
    watch();
    retry = 500;
    showConnection(true, 'Connected');
    if (waiting === null && !document.hidden) requestAnimationFrame(() => {
      const text = waiting;
      waiting = null;
      show(JSON.parse(text));
    });
    if (!document.hidden) waiting = message.data;
  };
  socket.onclose = async () => {
    clearTimeout(silent);
    const state = received ? null : await requestState();
    if (state !== null) {
      showConnection(true, 'Connected without WebSocket: new values once a second');
      show(state);
      setTimeout(connect, 1000);
      return;
    }
    showConnection(false, 'Disconnected: trying again');
    setTimeout(connect, retry);
    retry = Math.min(2 * retry, 8000);
  };
}

find('filter').addEventListener('input', () => {
  if (newest !== null) ports.show(newest.links);
});
const wanted = decodeURIComponent(location.hash.slice(1));
if (wanted.includes('/')) choose(wanted); // others are sections
connect();
