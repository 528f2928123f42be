// SPDX-License-Identifier: Apache-2.0
// The emergency stop of the wheelchair: sends it, and says whether the chair has confirmed it, and what to do next.
import {setClass, setText} from './dom.js';
import {tellFailure} from './top.js';

const patience = 1000; // ms for the chair to confirm; it takes some ticks, and the monitor looks five times a second
const otherWay = 'Stop the chair by its own switch, or press Ctrl-C where wheelchair runs.';
const inEffect = '■ Emergency stop. It lasts until the run ends. To drive again: press Ctrl-C where wheelchair runs, and start it again.';

export class EmergencyStop {
  /** `answer`: the element for the outcome. `connection`: of control.js. */
  constructor(button, answer, connection) {
    Object.assign(this, {answer, connection, link: null, pressed: false, waits: false});
    button.addEventListener('click', () => this.stop());
  }

  tell(bad, text) {
    setClass(this.answer, bad ? 'bad' : '');
    setText(this.answer, text);
    tellFailure('emergency stop', bad, text);
  }

  async stop() {
    this.onstop?.();
    this.tell(false, 'Emergency stop: sending ...');
    this.waits = !this.pressed;
    clearTimeout(this.late); // of a press before
    this.late = setTimeout(() => {
      if (this.waits) this.tell(true, `✕ The chair has not confirmed the emergency stop. ${otherWay}`);
      this.waits = false;
    }, patience);
    const reply = await this.connection.ask({op: 'drive', link: this.link, x: 0, y: 0, stop: true});
    if (this.pressed) return this.tell(true, inEffect); // also before this press
    if (!reply.ok) {
      this.waits = false;
      return this.tell(true, `✕ Emergency stop failed: ${reply.text}. ${otherWay}`);
    }
    if (this.waits) this.tell(false, 'Emergency stop: sent, the chair has not confirmed it yet ...');
  }

  /** Called with each message of the chair. */
  show(link, chair) {
    const pressed = chair.emergency_stop === 1;
    if (pressed === this.pressed && link === this.link) return;
    Object.assign(this, {link, pressed, waits: this.waits && !pressed});
    this.tell(pressed, pressed ? inEffect : '');
  }
}
