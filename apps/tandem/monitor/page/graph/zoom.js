// SPDX-License-Identifier: Apache-2.0
// Zooms and moves the graph within its scrolling part of the page: wheel, pinch, drag, keys and buttons.

const least = 0.1, most = 3, step = 1.25;
/** The smallest scale at which labels are easy to read, to which the graph shrinks by itself. */
const readable = 0.75;
/** A finger needs ports that are further apart. */
const touchable = 1;
/** A small graph grows by itself up to this scale. */
const largest = 1.4;

/** Returns the scale at which a graph of this size fits into a room. */
export const fittingScale = ({width, height}, room) => Math.min(largest, room.width / width, room.height / height);

export class Zoom {
  /** `scroller`: the element that scrolls, and contains the `svg`. `onmove`: called when another part of the graph is in view. */
  constructor(scroller, svg, onmove) {
    Object.assign(this, {scroller, svg, onmove, width: 1, height: 1, scale: 1, mode: 'readable', factor: 1});
    scroller.addEventListener('wheel', (event) => this.wheel(event), {passive: false});
    scroller.addEventListener('keydown', (event) => this.key(event));
    scroller.addEventListener('pointerdown', (event) => this.drag(event));
    for (const element of [scroller, window]) element.addEventListener('scroll', () => this.moved(), {passive: true});
    for (const type of ['touchstart', 'touchmove']) scroller.addEventListener(type, (event) => this.pinch(event), {passive: false});
  }

  /** Takes the size of a new layout. Keeps the scale that a person has chosen, or shows the whole graph if that was chosen. */
  resize(width, height) {
    Object.assign(this, {width, height});
    if (this.mode === 'whole') this.scale = this.whole;
    const {room} = this, fitting = Math.max(fittingScale(this, room), Math.min(1, room.width / width));
    if (this.mode === 'readable') this.scale = Math.max(matchMedia('(pointer: coarse)').matches ? touchable : readable, fitting);
    this.svg.setAttribute('viewBox', `0 0 ${Math.ceil(width)} ${Math.ceil(height)}`);
    this.apply();
  }

  apply() {
    this.svg.style.width = `${Math.floor(this.width * this.scale)}px`;
    this.svg.style.height = `${Math.floor(this.height * this.scale)}px`;
    this.moved();
  }

  /** Tells of several moves once for each picture of the browser. */
  moved() {
    if (!this.told) requestAnimationFrame(() => {
      this.told = false;
      this.onmove();
    });
    this.told = true;
  }

  /** Returns the part of the graph that is in view, and half as much around it. */
  get view() {
    const box = this.svg.getBoundingClientRect(), part = this.scroller.getBoundingClientRect();
    const [left, right] = [Math.max(0, part.left), Math.min(innerWidth, part.right)], [top, bottom] = [Math.max(0, part.top), Math.min(innerHeight, part.bottom)];
    const [aroundX, aroundY] = [(right - left) / 2, (bottom - top) / 2];
    return {left: (left - aroundX - box.left) / this.scale, right: (right + aroundX - box.left) / this.scale,
      top: (top - aroundY - box.top) / this.scale, bottom: (bottom + aroundY - box.top) / this.scale};
  }

  /** Brings a part of the graph to the middle. */
  center({x, y, width, height}) {
    const {scroller, scale} = this;
    scroller.scrollLeft = (x + width / 2) * scale - scroller.clientWidth / 2;
    scroller.scrollTop = (y + height / 2) * scale - scroller.clientHeight / 2;
    const middle = this.svg.getBoundingClientRect().top + (y + height / 2) * scale;
    if (middle < 0 || middle > innerHeight) scrollBy(0, middle - innerHeight / 2); // on a phone, the page scrolls
  }

  /** The room in which the graph may be drawn without scrolling. */
  get room() {
    const {scroller} = this, high = parseFloat(getComputedStyle(scroller).maxHeight) || innerHeight;
    return {width: scroller.clientWidth - 2, height: high - 2};
  }

  get whole() { return fittingScale(this, this.room); }

  /** Shows the whole graph. */
  fit() {
    this.mode = 'whole';
    this.scale = this.whole;
    this.apply();
  }

  /** Changes the scale. The point at these coordinates of the window, or the middle, stays where it is. */
  by(factor, x = null, y = null) {
    const part = this.scroller.getBoundingClientRect(), before = this.svg.getBoundingClientRect(), old = this.scale;
    const [atX, atY] = [x ?? part.left + part.width / 2, y ?? part.top + part.height / 2];
    this.scale = Math.max(Math.min(least, this.whole), Math.min(most, old * factor));
    if (this.scale === old) return;
    this.mode = 'chosen';
    this.apply();
    const after = this.svg.getBoundingClientRect(), grown = this.scale / old;
    this.scroller.scrollLeft += after.left + (atX - before.left) * grown - atX;
    this.scroller.scrollTop += after.top + (atY - before.top) * grown - atY;
  }

  /** Scales once for each picture of the browser, however many events come. A graph that is all in view lets the page scroll. */
  wheel(event) {
    if (event.shiftKey || (event.deltaY > 0 && this.scale <= Math.min(least, this.whole)) || event.deltaY === 0) return;
    event.preventDefault();
    const waits = this.factor !== 1, lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE;
    this.factor *= Math.exp(-Math.max(-300, Math.min(300, event.deltaY * (lines ? 30 : 1))) * (event.ctrlKey ? 0.01 : 0.0015));
    if (!waits) requestAnimationFrame(() => {
      this.by(this.factor, event.clientX, event.clientY);
      this.factor = 1;
    });
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const act = {'+': () => this.by(step), '=': () => this.by(step), '-': () => this.by(1 / step), 0: () => this.fit()}[event.key];
    if (!act) return; // arrow keys scroll, which the browser does
    event.preventDefault();
    act();
  }

  /** Moves the graph with the mouse. A finger scrolls it, which the browser does. */
  drag(down) {
    if (down.pointerType !== 'mouse' || down.button !== 0 || down.target.closest('[role=button]')) return;
    const {scroller} = this, from = {left: scroller.scrollLeft, top: scroller.scrollTop};
    const box = scroller.getBoundingClientRect();
    if (down.clientX > box.left + scroller.clientWidth || down.clientY > box.top + scroller.clientHeight) return; // the scroll bars
    const move = (event) => {
      scroller.scrollLeft = from.left + down.clientX - event.clientX;
      scroller.scrollTop = from.top + down.clientY - event.clientY;
    };
    const end = () => {
      removeEventListener('pointermove', move);
      for (const type of ['pointerup', 'pointercancel']) removeEventListener(type, end);
      scroller.classList.remove('moves');
    };
    scroller.classList.add('moves');
    addEventListener('pointermove', move);
    for (const type of ['pointerup', 'pointercancel']) addEventListener(type, end);
  }

  pinch(event) {
    if (event.touches.length !== 2) return;
    event.preventDefault();
    const [a, b] = event.touches, apart = Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
    if (event.type === 'touchmove' && this.apart > 0) this.by(apart / this.apart, (a.clientX + b.clientX) / 2, (a.clientY + b.clientY) / 2);
    this.apart = apart;
  }
}
