// SPDX-License-Identifier: Apache-2.0
// The stick on the page for mouse, finger, arrow keys or gamepad.js. It sends its position while it is held. `wheelchair` treats
// 200 ms without a position as a released stick, so that a lost page does not drive.
const pause = 40; // ms between two positions
const maxCounts = 2000, countsByKey = 1000;

export class Stick {
  /** `svg` has a pad around `centre` of its viewBox. `reach`: full deflection there. `connection`: of control.js. */
  constructor(svg, centre, reach, connection) {
    Object.assign(this, {svg, centre, reach, connection, link: null, keys: new Set(), timer: null, position: null, pointer: null});
    svg.addEventListener('pointerdown', (event) => {
      if (!this.drives) return;
      svg.setPointerCapture(this.pointer = event.pointerId);
      this.follow(event);
    });
    svg.addEventListener('pointermove', (event) => svg.hasPointerCapture(event.pointerId) && this.follow(event));
    for (const end of ['pointerup', 'pointercancel', 'lostpointercapture']) svg.addEventListener(end, () => this.release());
    svg.addEventListener('keydown', (event) => this.key(event, true));
    svg.addEventListener('keyup', (event) => this.key(event, false));
    svg.addEventListener('blur', () => this.release());
    for (const type of ['blur', 'pagehide']) addEventListener(type, () => this.release());
    document.addEventListener('visibilitychange', () => document.hidden && this.release());
    connection.listeners.push(() => this.update());
  }

  /** `link`: of the wheelchair to drive; null: none. Releases the stick of the one before: who holds it must take it again. */
  offer(link) {
    if (this.link === link) return;
    this.release();
    this.link = link;
    this.update();
  }

  get drives() { return this.link !== null && this.connection.open; }

  update() {
    this.svg.classList.toggle('drives', this.drives);
    if (this.drives) this.svg.setAttribute('tabindex', '0');
    else this.svg.removeAttribute('tabindex');
    if (!this.drives) this.release();
    this.onchange?.(this.drives);
  }

  follow(event) {
    const place = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.svg.getScreenCTM().inverse());
    this.push((this.centre[0] - place.x) / this.reach, (this.centre[1] - place.y) / this.reach);
  }

  /** Moves it to the left and forward, in shares of its reach. */
  push(x, y) {
    const length = Math.max(1, Math.hypot(x, y));
    this.move(maxCounts * x / length, maxCounts * y / length);
  }

  key(event, down) {
    if (!event.key.startsWith('Arrow') || !this.drives) return;
    event.preventDefault();
    if (event.repeat && !this.keys.has(event.key)) return; // pressed before the stick was released
    if (down) this.keys.add(event.key);
    else this.keys.delete(event.key);
    const held = (name) => this.keys.has(name) ? countsByKey : 0;
    if (this.keys.size === 0) this.release();
    else this.move(held('ArrowLeft') - held('ArrowRight'), held('ArrowUp') - held('ArrowDown'));
  }

  move(x, y) {
    this.position = [Math.round(x), Math.round(y)];
    if (this.timer !== null) return;
    this.send();
    this.timer = setInterval(() => this.send(), pause);
  }

  send() {
    const [x, y] = this.position ?? [0, 0];
    this.connection.send({op: 'drive', link: this.link, x, y, stop: false});
  }

  release() {
    clearInterval(this.timer);
    this.keys.clear();
    if (this.pointer !== null && this.svg.hasPointerCapture(this.pointer)) this.svg.releasePointerCapture(this.pointer);
    if (this.timer === null) return;
    this.timer = this.position = null;
    if (this.drives) this.send();
  }
}
