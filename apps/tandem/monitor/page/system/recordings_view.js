// SPDX-License-Identifier: Apache-2.0
// Shows on every view whether a recording runs, and lists the recordings for download.
import {KeyedList, make, setAttributes, setText} from '../dom.js';

const pause = 1000; // ms between two requests
const find = (id) => document.getElementById(id);
const name = (path) => path.split('/').pop();

export function sizeText(bytes) {
  const unit = bytes < 1e6 ? ['kB', 1e3] : bytes < 1e9 ? ['MB', 1e6] : ['GB', 1e9];
  return `${(bytes / unit[1]).toFixed(bytes < 1e6 ? 0 : 1)} ${unit[0]}`;
}

export class RecordingsView {
  /** `panel`: of control.js, with the connection and the token. */
  constructor(panel) {
    Object.assign(this, {panel, file: null});
    this.list = new KeyedList(find('recordings'), ({file}) => this.createItem(file), (item, recording) => this.updateItem(item, recording));
  }

  createItem(file) {
    const item = make('li'), link = make('a', '', file);
    link.download = file;
    item.append(link, ' ', make('span', 'empty'));
    return item;
  }

  updateItem(item, {file, bytes, time_ms: time}) {
    const runs = this.file !== '' && name(this.file) === file;
    setAttributes(item.firstChild, {href: `api/recordings/${file}?token=${encodeURIComponent(this.panel.token)}`}); // which may be a new one
    setText(item.lastChild, `${sizeText(bytes)}, ${runs ? '● being recorded' : new Date(time).toLocaleString([], {hour12: false})}`);
  }

  /** Called with each state. */
  show(state) {
    const file = state.control.recording;
    if (file !== this.file) this.changed(file, state.time_ms);
    find('recording-now').hidden = file === '';
    if (file) setText(find('recording-now'), `● Recording, ${Math.max(0, Math.round((state.time_ms - this.since) / 1000))} s`);
    if (this.panel.connection.open && !find('control-section').hidden && performance.now() - this.askedAt > pause) this.ask();
  }

  changed(file, time) {
    Object.assign(this, {file, since: time, askedAt: -pause});
    find('recording-now').title = file;
  }

  async ask() {
    this.askedAt = performance.now();
    const reply = await this.panel.connection.ask({op: 'recordings'});
    if (!reply.ok) return;
    this.list.show(reply.recordings, ({file}) => file);
    find('recordings-empty').hidden = reply.recordings.length > 0;
  }
}
