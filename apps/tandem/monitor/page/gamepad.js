// SPDX-License-Identifier: Apache-2.0
// A gamepad at the browser's machine moves the stick of the page while the view of the wheelchair is shown.
const pause = 40; // ms between two looks; browsers have no events for its axes
const centre = 0.12; // of the way; a released stick rests somewhere in it

export class GamepadInput {
  /** `stick`: of stick.js. `isShown`: returns whether the view is shown. */
  constructor(stick, isShown) {
    Object.assign(this, {stick, isShown, holds: false, timer: null});
    addEventListener('gamepadconnected', () => { this.timer ??= setInterval(() => this.look(), pause); });
    addEventListener('gamepaddisconnected', () => this.look());
  }

  look() {
    const pads = navigator.getGamepads().filter((pad) => pad?.connected);
    if (pads.length === 0) {
      clearInterval(this.timer);
      this.timer = null;
    }
    const [x, y] = pads.map(({axes}) => axes).find(([right, down]) => Math.hypot(right, down) > centre) ?? [0, 0];
    const wanted = x !== 0 || y !== 0, drives = wanted && this.isShown() && document.hasFocus() && this.stick.drives;
    if (drives) this.stick.push(-x, -y);
    else if (this.holds) this.stick.release();
    this.holds = drives;
  }
}
