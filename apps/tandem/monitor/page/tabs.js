// SPDX-License-Identifier: Apache-2.0
// The views of the page as tabs (WAI-ARIA: arrow keys move between them, one of them has a place in the tab order).

export class Tabs {
  /** `list`: the element with role tablist. `onchange`: called with the id of the panel that is shown. */
  constructor(list, onchange) {
    this.tabs = [...list.querySelectorAll('[role=tab]')];
    for (const tab of this.tabs) tab.addEventListener('click', () => this.show(tab.getAttribute('aria-controls')));
    list.addEventListener('keydown', (event) => this.key(event));
    this.show(this.tabs[0].getAttribute('aria-controls'));
    this.onchange = onchange;
  }

  key(event) {
    const open = this.tabs.filter((tab) => !tab.hidden), at = open.indexOf(document.activeElement);
    const to = {ArrowDown: at + 1, ArrowRight: at + 1, ArrowUp: at - 1, ArrowLeft: at - 1, Home: 0, End: open.length - 1}[event.key];
    if (to === undefined || at < 0) return;
    event.preventDefault();
    const tab = open[(to + open.length) % open.length];
    tab.focus();
    this.show(tab.getAttribute('aria-controls'));
  }

  /** Shows the panel with this id, as soon as it is offered. */
  show(id) {
    const wanted = this.tabs.find((tab) => tab.getAttribute('aria-controls') === id);
    this.later = wanted?.hidden ? id : null;
    if (!wanted || wanted.hidden) return;
    this.current = id;
    for (const tab of this.tabs) {
      const of = tab.getAttribute('aria-controls'), selected = of === id;
      tab.setAttribute('aria-selected', selected);
      tab.tabIndex = selected ? 0 : -1;
      document.getElementById(of).hidden = !selected;
    }
    this.onchange?.(id);
  }

  /** Shows or hides a tab. If the current tab is hidden, selects the first. */
  offer(id, offered) {
    const tab = this.tabs.find((each) => each.getAttribute('aria-controls') === id);
    if (tab.hidden === !offered) return;
    tab.hidden = !offered;
    if (offered && this.later === id) this.show(id);
    if (!offered && this.current === id) this.show(this.tabs[0].getAttribute('aria-controls'));
  }
}
