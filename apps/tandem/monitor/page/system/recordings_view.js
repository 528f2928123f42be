// SPDX-License-Identifier: Apache-2.0
// Shows on every view whether a recording or a replay runs, and lists the recordings for download and replay.
import {KeyedList, make, setAttributes, setText} from '../dom.js';
import {tellFailure} from '../top.js';

const pause = 1000; // ms between two requests
const find = (id) => document.getElementById(id);
const name = (path) => path.split('/').pop();

function sizeText(bytes) {
  const unit = bytes < 1e6 ? ['kB', 1e3] : bytes < 1e9 ? ['MB', 1e6] : ['GB', 1e9];
  return `${(bytes / unit[1]).toFixed(bytes < 1e6 ? 0 : 1)} ${unit[0]}`;
}

export class RecordingsView {
  /** `panel`: of control.js, with the connection and the token. */
  constructor(panel) {
    Object.assign(this, {panel, file: null, replay: null});
    find('replay-stop').addEventListener('click', () => this.stop());
    this.list = new KeyedList(find('recordings'), ({file}) => this.createItem(file), (item, recording) => this.updateItem(item, recording));
  }

  createItem(file) {
    const item = make('li'), link = make('a', '', file), play = make('button', 'raised', '▶ Replay');
    link.download = file;
    Object.assign(play, {type: 'button', ariaLabel: `Replay ${file}`});
    play.addEventListener('click', () => this.play(file));
    item.append(link, ' ', make('span', 'empty'), ' ', play);
    return item;
  }

  updateItem(item, {file, bytes, time_ms: time}) {
    const runs = this.file !== '' && name(this.file) === file;
    setAttributes(item.firstChild, {href: `api/recordings/${file}?token=${encodeURIComponent(this.panel.token)}`}); // which may be a new one
    item.lastChild.hidden = runs || Boolean(this.replay?.running);
    setText(item.children[1], `${sizeText(bytes)}, ${runs ? '● being recorded' : new Date(time).toLocaleString([], {hour12: false})}`);
  }

  /** Called with each state. */
  show(state) {
    const {recording: file, recording_since_ms: since, replay = null} = state.control;
    if (file !== this.file) this.changed(file);
    const seconds = (from) => Math.max(0, Math.round((state.time_ms - from) / 1000));
    this.replay = replay;
    const texts = [...file ? [`● Recording, ${seconds(since)} s`] : [], ...replay?.running ? [`▶ Replay, ${seconds(replay.since_ms)} s`] : []];
    find('recording-now').hidden = texts.length === 0;
    setText(find('recording-now'), texts.join('; '));
    this.showReplay();
    if (this.panel.connection.open && !find('control-section').hidden && performance.now() - this.askedAt > pause) this.ask();
  }

  changed(file) {
    Object.assign(this, {file, askedAt: -pause});
    find('recording-now').title = file;
  }

  showReplay() {
    const {replay} = this;
    find('replay-now').hidden = !replay?.running;
    if (replay?.running) setText(find('replay-text'), `▶ Replays ${replay.file} in place of the host that does not run`);
    const text = this.refused ?? (replay && !replay.running ? `The replay of ${replay.file} has ended. ${replay.end.trim()}` : '');
    setText(find('replay-end'), text);
  }

  async play(file) {
    this.refused = null;
    const reply = await this.panel.connection.ask({op: 'replay', on: true, file});
    this.refused = reply.ok ? null : `✕ ${file} is not replayed: ${reply.text}`;
    tellFailure('replay', !reply.ok, this.refused);
    this.showReplay();
  }

  async stop() {
    const reply = await this.panel.connection.ask({op: 'replay', on: false});
    tellFailure('replay', !reply.ok, `✕ The replay was not stopped: ${reply.text}`);
  }

  async ask() {
    this.askedAt = performance.now();
    const reply = await this.panel.connection.ask({op: 'recordings'});
    setText(find('recordings-empty'), reply.ok ? 'There is no recording.' : `✕ The recordings cannot be listed: ${reply.text}`);
    if (!reply.ok) return find('recordings-empty').hidden = false;
    this.list.show(reply.recordings, ({file}) => file);
    find('recordings-empty').hidden = reply.recordings.length > 0;
  }
}
