// SPDX-License-Identifier: Apache-2.0
// Receives the state five times a second and shows it. docs/monitoring.md describes the JSON.
import {Chair, findChair} from './chair.js';
import {Connection, ControlPanel} from './control.js';
import {KeyedList, make, setClass, setText} from './dom.js';
import {Graph} from './graph/graph_view.js';
import {LogView} from './system/log_view.js';
import {PlotsPanel} from './plots.js';
import {RecordingsView} from './system/recordings_view.js';
import {SampleStore} from './samples.js';
import {requestState, socketAddress} from './server.js';
import {SystemView} from './system/system_view.js';
import {SystemsView} from './system/systems_view.js';
import {CallTable, PortTable} from './tables.js';
import {Tabs} from './tabs.js';
import {TickTable} from './ticks.js';
import {Values} from './values.js';

const find = (id) => document.getElementById(id);

// A sign for each level, in addition to colour and words.
const signs = {well: '✓', unseen: '?', setting: '≠', inactive: '○', missing: '○', unrecorded: '✕', failed: '✕', no_link: '○', mismatch: '≠', waiting: '…', late: '◷', dropping: '▼', overrun: '↻', unreadable: '?', stopped: '❚❚', gone: '✕', dead: '✕', hanging: '!'};

let newest = null;
const connection = new Connection(), control = new ControlPanel(connection), store = new SampleStore();
const log = new LogView(connection), recordings = new RecordingsView(control);
const system = new SystemView(connection), systems = new SystemsView(connection), values = new Values(), plots = new PlotsPanel(store), chair = new Chair(connection, store);

/** The address of the page contains the shown view or the chosen port, so that it survives a reload and works as a bookmark. */
function keptPlace() {
  try {
    return decodeURIComponent(location.hash.slice(1));
  } catch (error) {
    if (error instanceof URIError) return ''; // an address that a user has typed
    throw error;
  }
}

function keepPlace(place) {
  if (place !== keptPlace()) history.replaceState(null, '', `#${encodeURIComponent(place)}`);
}

/** Plots a port. */
function choose(key) {
  tabs.show('plots-section');
  keepPlace(key);
  graph.chosen = ports.chosen = key;
  values.choose(key);
  plots.openPort(key);
  if (newest !== null) show(newest);
}

/** Shows a component's ports in the table. */
function filterPorts(text) {
  find('filter').value = text;
  tabs.show('links-section');
  find('filter').focus({preventScroll: true});
}

const graph = new Graph(choose, filterPorts, system);
const ports = new PortTable(choose);
const ticks = new TickTable(), calls = new CallTable();

const events = new KeyedList(find('events'), (event) => {
  const item = make('li', event.bad ? 'bad' : 'good');
  const time = make('time', '', new Date(event.time_ms).toLocaleTimeString([], {hour12: false}));
  time.dateTime = new Date(event.time_ms).toISOString();
  item.append(time, make('span', 'sign', event.bad ? '✕' : '•'), make('b', '', event.link), make('span', '', event.text));
  return item;
}, () => {});

const findings = new KeyedList(find('findings').querySelector('ol'), () => make('li'), (item, {text, reason}) => {
  if (item.children.length === 0) item.append(make('b'), ' ', make('span'));
  setText(item.firstChild, text);
  setText(item.lastChild, reason);
});

let spoken = '';

function showVerdict(verdict) {
  const section = find('verdict');
  setClass(section, verdict.level);
  setText(section.querySelector('.sign'), signs[verdict.level] ?? '?');
  setText(section.querySelector('.text'), verdict.text);
  setText(section.querySelector('.reason'), verdict.reason);
  const more = verdict.findings - 1, listed = (verdict.worst ?? []).slice(1);
  find('findings').hidden = more < 1 || listed.length === 0;
  setText(find('findings').firstElementChild, `${more} more${more > listed.length ? `, of which the worst ${listed.length} are listed` : ''}`);
  findings.show(listed.map((finding, i) => ({...finding, i})), ({i}) => i);
  // Announced on a change of level, not on each change of a count in the reason.
  if (spoken !== verdict.level) setText(find('spoken'), `${verdict.text}: ${verdict.reason}`);
  spoken = verdict.level;
  const title = `${signs[verdict.level] ?? '?'} ${verdict.text} – Tandem monitor`;
  if (document.title !== title) document.title = title;
}

let isConnected = false;

/** What each view shows of the state. Views that are not shown cost nothing. */
const views = {
  'graph-section': (state) => { graph.show(state); system.show(state); },
  'plots-section': (state) => { plots.show(state); values.show(state); },
  'links-section': (state) => { ports.show(state.links); calls.show(state.links); },
  'ticks-section': (state) => ticks.show(state),
  'control-section': (state) => { system.show(state); systems.show(state); },
  'events-section': (state) => {
    events.show([...state.events].reverse(), (event) => `${event.number} ${event.time_ms}`);
    find('events-empty').hidden = state.events.length > 0;
    log.show(state);
  },
};
const tabs = new Tabs(find('views'), (id) => {
  keepPlace(id === 'plots-section' && values.key ? values.key : id);
  if (id !== 'plots-section') plots.hide();
  if (id !== 'chair-section') chair.hide();
  if (newest !== null) show(newest);
});

function show(state) {
  newest = state;
  setText(find('cut'), state.cut);
  find('cut').hidden = state.cut === '';
  if (isConnected) showVerdict(state.verdict); // a port can be selected in the last state while disconnected
  tabs.offer('chair-section', findChair(state) !== null || chair.link !== null);
  tabs.offer('control-section', state.control.allowed);
  const failures = state.events.filter((event) => event.bad).length;
  setText(find('events-count'), failures > 0 ? `✕ ${failures}` : '');
  chair.show(state);
  control.show(state);
  recordings.show(state);
  views[tabs.current]?.(state);
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
const longestSilence = 3000; // ms; the monitor sends five states a second

function connect() {
  // The token entitles to a place that other clients cannot take.
  const query = control.token ? `?token=${encodeURIComponent(control.token)}` : '';
  const socket = new WebSocket(socketAddress(`api/live${query}`));
  let silent, received = false;
  const watch = () => {
    clearTimeout(silent);
    silent = setTimeout(end, longestSilence);
  };
  // A monitor that is stopped, or on a machine out of reach, does not close the socket, and a browser waits long for that.
  const end = async () => {
    clearTimeout(silent);
    socket.onmessage = socket.onclose = null;
    socket.close();
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
  watch();
  let waiting = null; // draws only the newest state, when the browser draws
  let toldHidden = 0; // when the verdict of a hidden page, which is its title, was last shown
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
    else if (performance.now() - toldHidden >= 1000) {
      toldHidden = performance.now();
      showVerdict(JSON.parse(message.data).verdict);
    }
  };
  socket.onclose = end;
}

find('recording-now').addEventListener('click', (event) => {
  event.preventDefault();
  tabs.show('control-section');
});
find('filter').addEventListener('input', () => {
  if (newest !== null) ports.show(newest.links);
});
const wanted = keptPlace();
if (wanted.includes('/')) choose(wanted);
else tabs.show(wanted);
connect();
