// SPDX-License-Identifier: Apache-2.0
// Connects ports in the graph of a page with the token: by a drag from one to the other, or by the keyboard.
import {makeSvg, setText} from '../dom.js';
import {connectionsIn, whyNot} from '../system/system.js';
import {ConnectionDialog} from './connection_dialog.js';

const find = (id) => document.getElementById(id);
const hint = 'To connect two ports, drag from one to the other, or press C on one and Enter on the other. To end a connection, choose its line.';
const slack = 6; // px that a click may move
const shortOf = ({component, name}) => `${component}.${name.startsWith(`${component}.`) ? name.slice(component.length + 1) : name}`;

export class Connector {
  /** `system`: of system_view.js. `redraw`: called when other ports are marked. `pressed`: whether the pointer is down on a port. */
  constructor(drawing, system, redraw) {
    Object.assign(this, {drawing, system, redraw, from: null, pressed: false, dialog: new ConnectionDialog(system)});
    setText(find('graph-choice'), hint);
    drawing.mark = (port) => this.mark(port);
    drawing.svg.addEventListener('pointerdown', (event) => this.press(event));
    document.addEventListener('keydown', (event) => {
      if (event.key === 'Escape' && this.from) this.choose(null);
    });
  }

  /** Called with each state. */
  show() {
    this.drawing.control = this.system.connection.open;
    this.drawing.svg.classList.toggle('connects', this.drawing.control);
    find('graph-control').hidden = !this.drawing.control;
    if (!this.drawing.control && this.from) this.choose(null);
  }

  /** Returns the port of an RT-Component that a port of the graph is, or that stands for it in the RTM host; else undefined. */
  portOf({listed, twin}) {
    if (this.known !== this.system.components) {
      this.known = this.system.components;
      this.ports = new Map(this.known.flatMap(({ports}) => ports).map((port) => [`${port.component}.${port.short}`, port]));
    }
    for (const each of [listed, twin?.listed]) {
      const port = each && this.ports.get(shortOf(each));
      if (port) return port;
    }
    return undefined;
  }

  /** Returns the class that shows whether a port fits the chosen one. */
  mark(port) {
    if (!this.from || port.id === this.from.id) return '';
    const [a, b] = [this.portOf(this.from), this.portOf(port)];
    return a && b && whyNot(a, b) === '' ? ' fits' : ' unfit';
  }

  choose(port) {
    this.from = port;
    setText(find('graph-choice'), port ? `Connect ${port.listed ? shortOf(port.listed) : port.name}: choose the other port. Esc ends this.` : hint);
    find('graph-choice').classList.toggle('empty', !port);
    this.redraw();
  }

  /** Called when a port is chosen by a click or a key. Returns whether that was for a connection. */
  port(port, key) {
    if (!this.drawing.control) return false;
    if (this.from) {
      this.finish(port);
      return true;
    }
    if (key !== 'c' && (port.key || port.filter || port.fold)) return false;
    this.choose(port);
    return true;
  }

  finish(port) {
    const from = this.from;
    this.choose(null);
    if (from && port && port.id !== from.id) this.dialog.connect([from, port].map((each) => ({name: each.listed ? shortOf(each.listed) : each.name, find: () => this.portOf(each)})));
  }

  /** Shows a connection. That of a link is the one of its RTC with the component that stands for the other host. */
  edge({connection, from, to, title}) {
    this.dialog.show(title, () => {
      const ports = [from, to].filter(Boolean).map((port) => this.portOf(port)?.name), all = connectionsIn(this.system.components);
      return connection ? all.filter(({id}) => id === connection) : all.filter((each) => each.ports.some((name) => ports.includes(name)));
    });
  }

  /** Draws a line from a port to the pointer, and takes the port where it is released. */
  press(down) {
    const element = down.target.closest('.port');
    if (!this.drawing.control || !element || down.button !== 0) return;
    const {svg} = this.drawing, {x, y} = this.drawing.layout.places.get(element.item.id), line = makeSvg('path', {class: 'rubber'});
    const move = (event) => {
      if (!line.parentNode) {
        if (Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) < slack) return;
        svg.append(line);
        this.choose(element.item);
      }
      const to = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
      line.setAttribute('d', `M ${x} ${y} L ${to.x} ${to.y}`);
    };
    const end = (event) => {
      this.pressed = false;
      removeEventListener('pointermove', move);
      for (const type of ['pointerup', 'pointercancel']) removeEventListener(type, end);
      if (!line.parentNode) return; // a click
      line.remove();
      this.finish(event.type === 'pointerup' ? document.elementFromPoint(event.clientX, event.clientY)?.closest('.port')?.item : null);
      // The click that follows on the same port is part of the drag.
      addEventListener('click', (click) => click.stopPropagation(), {capture: true, once: true, signal: AbortSignal.timeout(0)});
    };
    this.pressed = true;
    addEventListener('pointermove', move);
    for (const type of ['pointerup', 'pointercancel']) addEventListener(type, end);
  }
}
