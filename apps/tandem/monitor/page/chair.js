// SPDX-License-Identifier: Apache-2.0
// Draws the wheelchair from above, from the port `chair` of the program `wheelchair`. docs/wheelchair.md describes the
// geometry: metres and degrees, x to the right, y up, angles to the left.
import {fixed, makeSvg, number, setAttributes, setClass, setText} from './dom.js';
import {EmergencyStop} from './emergency.js';
import {GamepadInput} from './gamepad.js';
import {MapView, headingText} from './shapes/map_view.js';
import {PlotView, loadPlots} from './plot_view.js';
import {Stick} from './stick.js';
import {keyOfPort} from './tables.js';

const find = (id) => document.getElementById(id);
const track = 0.57, wheelbase = 0.5, radius = 0.17; // of drive wheels and casters, m
const mostPoints = 3000;
const fastest = 12; // rad/s of a wheel at the end of its bar: 2 m/s
const surroundings = 8; // m that the map shows around the chair
const slowest = 0.01; // m/s; below, the chair stands
const states = [null, 'stopped, since a reference was late: release the stick', 'emergency stop',
  'fault: press Ctrl-C where wheelchair runs, and start it again'];

/** Describes for people what the chair does. */
function describe(chair) {
  const speed = radius * (chair.wheel_left + chair.wheel_right) / 2;
  const turns = radius * Math.max(Math.abs(chair.wheel_left), Math.abs(chair.wheel_right)) > slowest;
  const what = chair.state === 0 ? turns ? 'drives' : 'stands' : states[chair.state] ?? `state ${number(chair.state)}`;
  return `${fixed(chair.t, 1)} s: ${what}, ${turns ? `${fixed(speed, 2)} m/s, ` : ''}brake ${chair.brake ? 'closed' : 'open'}, ` +
    `${fixed(chair.volts_left, 1)} V left, ${fixed(chair.volts_right, 1)} V right`;
}

/** Returns the newest values of all ports `chair` with their link's name. */
const chairsIn = (state) => state.links.flatMap((link) => link.ports
  .filter((port) => port.name === 'chair' && port.type === 'Wheelchair::Chair' && port.value)
  .map((port) => ({link: link.name, port, ...port.value})));

/** Returns the chair of a link, or else the first one; null if there is none. */
export function findChair(state, link) {
  const chairs = chairsIn(state);
  return chairs.find((chair) => chair.link === link) ?? chairs[0] ?? null;
}

/** Returns the chair from above, looking to the right. */
function createBody() {
  const body = makeSvg('g', {class: 'chair'});
  const wheel = (x, y, size) => makeSvg('rect', {x: x - size, y: y - 0.04, width: 2 * size, height: 0.08, rx: 0.03, class: 'wheel'});
  body.append(
    makeSvg('rect', {x: -0.25, y: -0.22, width: 0.95, height: 0.44, rx: 0.08, class: 'seat'}),
    wheel(0, track / 2, radius), wheel(0, -track / 2, radius), wheel(wheelbase, 0.24, 0.09), wheel(wheelbase, -0.24, 0.09),
    makeSvg('path', {d: 'M 0.2 -0.12 L 0.55 0 L 0.2 0.12 z', class: 'nose'}));
  return body;
}

export class Chair {
  /** `connection`: of control.js; the stick uses it. `store`: of samples.js, for the steering angle. */
  constructor(connection, store) {
    Object.assign(this, {link: null, path: [], store});
    this.steering = new PlotView(find('steering'), {curves: [], seconds: 30, range: null}, store);
    this.map = new MapView(find('chair-map'), createBody());
    this.whole = false; // shows the whole path, else the surroundings of the chair
    find('chair-choice').addEventListener('change', () => setText(find('chair-ended'), ''));
    find('chair-whole').addEventListener('click', () => {
      this.whole = !this.whole;
      setAttributes(find('chair-whole'), {'aria-pressed': this.whole});
      if (this.newest) this.drawMap(this.newest);
    });
    this.createStick();
    this.stick = new Stick(find('chair-stick'), [90, 92], 66, connection);
    this.gamepad = new GamepadInput(this.stick, () => !find('chair-section').hidden);
    this.stick.onchange = (drives) => setText(find('drive-hint'), drives
      ? 'Drag the stick, use the arrow keys while it has the focus, or use a gamepad at this browser.' : 'To drive, enter the token under Control.');
    this.emergency = new EmergencyStop(find('emergency'), find('drive-answer'), connection);
    this.emergency.onstop = () => this.stick.release();
    connection.driveFailed = (reason) => this.emergency.tell(true, `✕ The stick is not sent: ${reason}`);
  }

  createStick() {
    const svg = find('chair-stick');
    setAttributes(svg, {viewBox: '0 0 300 200'});
    this.knob = makeSvg('circle', {r: 13, class: 'knob'});
    this.bars = [0, 1].map((i) => makeSvg('rect', {x: 215 + 40 * i, width: 24, class: 'speed'})); // left, right
    this.texts = [90, 227, 267].map((x) => makeSvg('text', {x, y: 194, 'text-anchor': 'middle', class: 'axis'}));
    this.texts.push(makeSvg('text', {x: 247, y: 8, 'text-anchor': 'middle', class: 'axis'}, 'wheels, rad/s'));
    svg.append(makeSvg('circle', {cx: 90, cy: 92, r: 80, class: 'pad'}),
      makeSvg('path', {d: 'M 90 12 V 172 M 10 92 H 170', class: 'grid'}), this.knob,
      makeSvg('path', {d: 'M 205 92 H 290', class: 'grid'}), ...this.bars, ...this.texts);
  }

  show(state) {
    const links = chairsIn(state).map((each) => each.link);
    this.offerChairs(links);
    const chair = findChair(state, find('chair-choice').value);
    if (chair && this.link !== null && !links.includes(this.link)) this.tellEnded(this.link, chair.link);
    this.stick.offer(chair !== null && chair.drive ? chair.link : null);
    if (chair === null) {
      if (this.link !== null) setText(find('chair-state'), 'The wheelchair has ended.');
      return;
    }
    if (chair.link !== this.link || (this.time ?? 0) > chair.t) this.path = []; // another run
    Object.assign(this, {link: chair.link, time: chair.t, newest: chair});
    find('drive-bar').hidden = !chair.drive || !state.control.allowed;
    this.emergency.show(chair.link, chair);
    setText(find('chair-state'), describe(chair));
    setClass(find('chair-state'), chair.state > 0 ? 'bar bad' : 'bar');
    this.drawMap(chair);
    this.drawStick(chair);
    if (!find('chair-section').hidden) this.drawSteering(keyOfPort({name: chair.link}, chair.port));
  }

  /** Another chair in place of the chosen one must not go unnoticed. */
  tellEnded(ended, shown) {
    setText(find('chair-ended'), `✕ The wheelchair ${ended} has ended. This is ${shown}.`);
  }

  /** Lets the person choose if there are several. */
  offerChairs(links) {
    const select = find('chair-choice'), key = links.join(' ');
    find('chair-choices').hidden = links.length < 2;
    if (select.key === key) return;
    const chosen = select.value;
    select.key = key;
    select.replaceChildren(...links.map((link) => new Option(link, link)));
    if (links.includes(chosen)) select.value = chosen;
  }

  /** Called when another view is shown. */
  hide() {
    this.store.follow(this, []);
  }

  async drawSteering(key) {
    this.steering.plot.curves = ['steering_deg', 'reference_deg'].map((name) => ({key, name, form: 'value'}));
    this.store.follow(this, [key]);
    try {
      this.steering.draw(await loadPlots());
    } catch (failure) {
      setText(find('steering-note'), failure.message);
    }
  }

  drawMap({x, y, heading_deg: heading}) {
    if (!Number.isFinite(x) || !Number.isFinite(y)) return setText(find('chair-place'), '✕ The chair does not know its place.'); // NaN is null in JSON
    const last = this.path.at(-1);
    if (!last || Math.hypot(x - last[0], y - last[1]) > 0.01) this.path.push([x, y]);
    if (this.path.length > mostPoints) this.path.shift();
    this.map.drawTrace(this.path);
    this.map.place(x, y, heading);
    if (this.whole) this.map.fit(this.path);
    else this.map.follow(x, y, surroundings);
    setText(find('chair-place'), `x ${fixed(x, 2)} m, y ${fixed(y, 2)} m, heading ${headingText(heading)}; a square is ${this.map.step} m`);
  }

  drawStick(chair) {
    // The stick's x points to the left, as on the page. 2000 counts are full deflection.
    const [x, y, left, right] = [chair.stick_x, chair.stick_y, chair.wheel_left, chair.wheel_right].map((value) => value ?? 0);
    setAttributes(this.knob, {cx: 90 - x / 2000 * 66, cy: 92 - y / 2000 * 66});
    [left, right].forEach((wheel, i) => {
      const size = Math.min(80, Math.abs(wheel) / fastest * 80);
      setAttributes(this.bars[i], {y: wheel > 0 ? 92 - size : 92, height: Math.max(1, size)});
    });
    const texts = [`stick ${number(chair.stick_x)}, ${number(chair.stick_y)}`, fixed(chair.wheel_left, 1), fixed(chair.wheel_right, 1)];
    texts.forEach((text, i) => setText(this.texts[i], text));
  }
}
