// SPDX-License-Identifier: Apache-2.0
// Shows the configuration sets of an RT-Component, or the properties of an OPRoS component, with a widget for each value.
import {make, setText} from '../dom.js';
import {createWidget, widgetFor} from './parameters.js';
import {jsonIn} from './system.js';

export class ParametersView {
  /** `act(request, text, undo)`: carries out a change and returns whether it was done. `ask(request)`: returns a reply. */
  constructor(element, act, ask) {
    Object.assign(this, {element, act, ask, component: null});
  }

  async open(component) {
    this.component = component;
    this.element.hidden = false;
    this.element.replaceChildren(make('h3', '', `Parameters of ${component.name}`), make('p', 'empty', 'asking ...'));
    this.element.scrollIntoView({block: 'nearest'});
    await this.refresh();
  }

  async refresh() {
    const {component} = this;
    if (!component) return;
    const rtm = component.model === 'RTM', request = (command) => ({op: rtm ? 'rtm' : 'opros', command, arguments: [component.id], json: true});
    const [conf, info] = await Promise.all([this.ask(request('conf')), rtm ? this.ask(request('info')) : null]);
    if (component !== this.component) return;
    const values = conf.ok ? jsonIn(conf.text) : null, declared = info?.ok ? jsonIn(info.text)?.properties ?? {} : {};
    if (values === null) this.draw([make('p', 'bad', `✕ ${conf.text.trim()}`)]);
    else if (rtm) this.draw(values.map((set) => this.createSet(set, values, declared)));
    else this.draw([this.createValues(values.properties, 'property', () => [], {})]);
  }

  draw(parts) {
    this.element.replaceChildren(make('h3', '', `Parameters of ${this.component.name}`), ...parts);
    if (parts.length === 0) this.element.append(make('p', 'empty', 'It has no parameters.'));
  }

  /** A configuration set: whether it is active, and its values. */
  createSet({set, active, values}, all, declared) {
    const part = make('fieldset'), legend = make('legend'), label = make('label'), choice = make('input');
    Object.assign(choice, {type: 'radio', name: 'active-set', checked: active});
    const before = all.find((each) => each.active)?.set;
    choice.addEventListener('change', () => this.change({activate: set}, [], `Activate the set ${set} of ${this.component.name}`,
      before && {activate: before}, []));
    label.append(choice, ` ${set}${active ? ' (active)' : ''}`);
    legend.append(label);
    part.append(legend, this.createValues(values, set, (name) => [declared[`conf.__widget__.${name}`], declared[`conf.__constraints__.${name}`]], {set}));
    return part;
  }

  createValues(values, group, descriptionOf, more) {
    const list = make('dl', 'parameters');
    for (const [name, value] of Object.entries(values)) {
      const [widget, constraint] = [...descriptionOf(name) ?? []], title = make('dt', '', name), entry = make('dd');
      entry.append(...createWidget(widgetFor(widget, constraint), value, `${name} of ${group}`, `${group} ${name}`, (changed) =>
        this.change(more, [`${name}=${changed}`], `Set ${name} of ${this.component.name} to ${changed}`, more, [`${name}=${value}`])));
      if (constraint) entry.append(make('span', 'empty', constraint));
      list.append(title, entry);
    }
    if (list.children.length === 0) setText(list, 'no parameters');
    return list;
  }

  async change(more, values, text, undoMore, undoValues) {
    const {component} = this, of = (options, assignments) => ({op: component.model === 'RTM' ? 'rtm' : 'opros', command: 'conf',
      arguments: [component.id, ...assignments], ...options});
    await this.act(of(more, values), text, undoMore && {text: undoValues[0] ?? `the set of ${component.name}`, request: of(undoMore, undoValues)});
    await this.refresh(); // a refused value shows the one that counts
  }
}
