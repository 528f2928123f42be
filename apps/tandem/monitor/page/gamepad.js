// SPDX-License-Identifier: Apache-2.0
// A gamepad at the browser's machine moves the stick of the page while the view of the wheelchair is shown.
const pause = 40; // ms between two looks; browsers have no events for its axes
const centre = 0.12; // of the way; a released stick rests somewhere in it

export class GamepadInput {
  /** `stick`: of stick.js. `isShown`: returns whether the view is shown. */
  constructor(stick, isShown) {
    Object.assign(this, {stick, isShown, holds: false, rested: false, timer: null});
    addEventListener('gamepadconnected', () => {
      this.timer ??= setInterval(() => this.look(), pause);
      this.look();
    });
    addEventListener('gamepaddisconnected', () => this.look());
  }

  /**
   * A gamepad that is held when it may begin to drive, or when something else has released the stick (the emergency stop, another
   * chair, a lost focus), drives only after it has rested in the centre.
   */
  look() {
    const pads = navigator.getGamepads().filter((pad) => pad?.connected);
    if (pads.length === 0) {
      clearInterval(this.timer);
      this.timer = null;
    }
    const [x, y] = pads.map(({axes}) => axes).find(([right, down]) => Math.hypot(right, down) > centre) ?? [0, 0];
    const wanted = x !== 0 || y !== 0, may = this.isShown() && document.hasFocus() && this.stick.drives;
    if (!wanted) this.rested = true;
    else if (!may || (this.holds && this.stick.position === null)) this.rested = false;
    const drives = wanted && may && this.rested;
    if (drives) this.stick.push(-x, -y);
    else if (this.holds) this.stick.release();
    this.holds = drives;
  }
}
