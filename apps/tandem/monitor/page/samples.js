// SPDX-License-Identifier: Apache-2.0
// Keeps the messages of followed ports as columns of numbers, and their newest pictures and long messages. Tells the monitor which ports to follow. Draws nothing.
import {pictureIn} from './shapes/pictures.js';
import {socketAddress} from './server.js';

/** Samples kept of a port: 6 minutes at 100 Hz. */
const mostSamples = 36000;
/** Numbers kept of a port. A message has at most 64, but lists of other lengths bring other names. */
const mostColumns = 128;
/** Ports that the monitor lets a page follow: the last ones, which the shown view needs, count. */
const mostPorts = 16;
/** Times that go back by more than this, in ms, mean that the clock was set. */
const setBack = 50;
/** A port that is silent for longer than this, and than several of its periods, has a gap in its curves. */
const silentGap = 1000, silentPeriods = 5;

/** A robot that turns by 1 rad/s has a heading that runs as a clock does. */
const isOfPose = (name) => /(^|\.)(x|y|z|r|p|va|heading|theta|yaw|pitch|roll)(_deg|_rad)?$/i.test(name);

/** Returns the kind of a number by its name: `time`, `sequence`, or `signal`. */
export function kindByName(name) {
  if (/(^|\.)(tm|stamp|timestamp|time)(\.|$)/i.test(name)) return 'time';
  return /(^|[._])(seq|seqno|sequence|sequence_number)$/i.test(name) ? 'sequence' : 'signal';
}

/** Returns the kind of a number by its last values: `time` if it runs as a clock does, `sequence` if it counts messages. */
export function kindByValues(times, values, sequences) {
  const last = times.length - 1;
  if (last < 5 || times[last] - times[0] < 400) return null; // not known yet
  let counts = true, rises = true;
  for (let i = 1; i <= last; ++i) {
    if (!(values[i] > values[i - 1])) rises = false;
    if (values[i] - values[i - 1] !== sequences[i] - sequences[i - 1]) counts = false;
  }
  if (counts) return 'sequence';
  if (!rises) return 'signal';
  const slope = (values[last] - values[0]) / (times[last] - times[0]); // units in a millisecond
  return [1e-3, 1, 1e3, 1e6].some((unit) => Math.abs(slope / unit - 1) < 0.05) ? 'time' : 'signal';
}

/** The samples of one port: `times` in ms, and a column of numbers for each name. NaN stands for a gap. */
export class Track {
  constructor(key) {
    Object.assign(this, {key, size: 0, sequence: 0, period: 0, names: [], kinds: new Map(), columns: new Map(), version: 0});
    this.times = new Float64Array(1024);
    this.sequences = new Float64Array(1024);
  }

  column(name) {
    if (!this.columns.has(name)) this.columns.set(name, new Float64Array(this.times.length).fill(NaN));
    return this.columns.get(name);
  }

  append(sequence, time, names, values) {
    const last = this.size > 0 ? this.times[this.size - 1] : -Infinity, pause = time - last;
    if (pause < -setBack) this.forgetAll();
    else if (!(pause > 0)) return;
    const missing = this.sequence !== 0 && sequence !== this.sequence + 1;
    const silent = pause > silentGap && pause > silentPeriods * this.period;
    if (this.size > 0 && (missing || silent)) this.push(sequence - 0.5, (last + time) / 2, [], []);
    else if (this.size > 0) this.period += (pause - this.period) / 16;
    this.push(sequence, time, names, values);
    this.sequence = sequence;
    this.names = names;
  }

  push(sequence, time, names, values) {
    if (this.size === 2 * mostSamples) this.forgetHalf();
    else if (this.size === this.times.length) this.grow();
    this.times[this.size] = time;
    this.sequences[this.size] = sequence;
    for (const column of this.columns.values()) column[this.size] = NaN;
    names.forEach((name, i) => { this.column(name)[this.size] = values[i] ?? NaN; });
    if (this.columns.size > mostColumns) this.forgetNames(new Set(names));
    ++this.size;
    ++this.version;
  }

  grow() {
    const larger = (column) => {
      const copy = new Float64Array(Math.min(2 * column.length, 2 * mostSamples)).fill(NaN, column.length);
      copy.set(column);
      return copy;
    };
    this.times = larger(this.times);
    this.sequences = larger(this.sequences);
    for (const [name, column] of this.columns) this.columns.set(name, larger(column));
  }

  /** Forgets the numbers that the newest message does not have. */
  forgetNames(newest) {
    for (const name of this.columns.keys())
      if (!newest.has(name)) {
        this.columns.delete(name);
        this.kinds.delete(name);
      }
  }

  forgetHalf() {
    for (const column of [this.times, this.sequences, ...this.columns.values()]) column.copyWithin(0, mostSamples);
    this.size = mostSamples;
  }

  /** Messages that came before the clock was set back are in the future now. */
  forgetAll() {
    Object.assign(this, {size: 0, sequence: 0});
    this.kinds.clear();
  }

  /** Returns the index of the first sample at or after a time. */
  indexOf(time) {
    let low = 0, high = this.size;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.times[middle] < time) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** Returns `time`, `sequence` or `signal`; null if the values have not shown it yet. */
  kindOf(name) {
    const named = kindByName(name);
    if (named !== 'signal' || isOfPose(name)) return named;
    if (this.kinds.has(name)) return this.kinds.get(name);
    const from = Math.max(0, this.size - 60), part = (all) => all.subarray(from, this.size);
    const values = this.columns.get(name), kind = values ? kindByValues(part(this.times), part(values), part(this.sequences)) : null;
    if (kind) this.kinds.set(name, kind);
    return kind;
  }
}

/** Returns the port of a key from keyOfPort(): link and owner contain no slash. */
function portOfKey(key) {
  const [link, owner, ...name] = key.split('/');
  return {link, owner, port: name.join('/')};
}

export class SampleStore {
  constructor() {
    Object.assign(this, {tracks: new Map(), pictures: new Map(), messages: new Map(), users: new Map(), socket: null, retry: 500, skew: 0, refusal: '', leftOut: ''});
  }

  /** Sets the ports whose samples `user` needs. The store forgets those that nobody needs. */
  follow(user, keys) {
    const set = new Set(keys), before = this.users.get(user) ?? new Set();
    if (set.size === before.size && [...set].every((key) => before.has(key))) return;
    this.users.set(user, set);
    const needed = new Set([...this.users.values()].flatMap((wanted) => [...wanted]));
    for (const kept of [this.tracks, this.pictures, this.messages])
      for (const key of kept.keys()) if (!needed.has(key)) kept.delete(key);
    for (const key of needed) if (!this.tracks.has(key)) this.tracks.set(key, new Track(key));
    if (this.socket?.readyState === WebSocket.OPEN) this.request();
    else if (needed.size > 0) this.connect();
  }

  request() {
    this.socket.send(JSON.stringify({follow: [...this.tracks.keys()].slice(-mostPorts).map(portOfKey)}));
  }

  connect() {
    if (this.socket && this.socket.readyState <= WebSocket.OPEN) return;
    const token = sessionStorage.getItem('tandem-token');
    this.socket = new WebSocket(socketAddress(`api/samples${token ? `?token=${encodeURIComponent(token)}` : ''}`));
    this.socket.binaryType = 'arraybuffer';
    this.socket.onopen = () => {
      Object.assign(this, {retry: 500, refusal: '', leftOut: ''});
      this.request();
    };
    this.socket.onmessage = ({data}) => typeof data === 'string' ? this.take(JSON.parse(data)) : this.takePicture(pictureIn(data));
    this.socket.onclose = () => {
      if (this.tracks.size > 0) this.refusal = 'No new samples: the monitor has closed their connection, or something between it and this page has. Trying again.';
      setTimeout(() => this.tracks.size > 0 && this.connect(), this.retry);
      this.retry = Math.min(2 * this.retry, 8000);
    };
  }

  take({time_ms: time, ports, error, left_out: leftOut, most}) {
    if (leftOut) this.leftOut = leftOut.length === 0 ? '' : `No samples of ${leftOut.map(({port}) => port).join(', ')}: all pages together can plot ${most} ports. Close other pages, or remove their plots.`;
    this.refusal = error || this.leftOut;
    if (!ports) return;
    this.skew = time - performance.now();
    for (const {link, owner, port, names, samples, message} of ports) {
      const key = `${link}/${owner}/${port}`, track = this.tracks.get(key);
      if (!track) continue;
      if (message !== undefined) this.messages.set(key, message);
      else for (const [sequence, at, ...values] of samples) track.append(sequence, at, names, values);
    }
  }

  takePicture(picture) {
    const key = `${picture.link}/${picture.owner}/${picture.port}`;
    if (this.tracks.has(key)) this.pictures.set(key, picture);
  }

  /** Returns the monitor's time in ms, which continues between messages. */
  now() {
    return this.skew ? performance.now() + this.skew : Date.now();
  }
}
