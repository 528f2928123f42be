// SPDX-License-Identifier: Apache-2.0
// The parameters of a component with the widgets and constraints that it declares, as RTCBuilder writes them: conf.__widget__.NAME
// and conf.__constraints__.NAME.
import {make} from '../dom.js';

const numberText = '([-+]?[\\d.]+(?:e[-+]?\\d+)?)';

/** Returns what a constraint says: {low, high} of a number, and the `values` of a list. */
function constraintIn(text = '') {
  const list = text.match(/^\s*[({](.*)[)}]\s*$/)?.[1];
  const low = text.match(new RegExp(`${numberText}\\s*<=?\\s*x`))?.[1] ?? text.match(new RegExp(`x\\s*>=?\\s*${numberText}`))?.[1];
  const high = text.match(new RegExp(`x\\s*<=?\\s*${numberText}`))?.[1];
  return {values: list === undefined ? [] : list.split(',').map((each) => each.trim().replace(/^"|"$/g, '')).filter((each) => each !== ''), low, high};
}

/** Returns the widget for a parameter: {kind, values, low, high, step}; kind is slider, number, radio, checkbox or text. */
export function widgetFor(widget = '', constraint = '') {
  const {values, low, high} = constraintIn(constraint), [name, step] = [widget.split('.')[0], widget.slice(widget.indexOf('.') + 1)];
  const ends = low !== undefined && high !== undefined;
  if ((name === 'radio' || name === 'checkbox') && values.length > 0) return {kind: name, values};
  if (name === 'slider' && ends) return {kind: 'slider', low, high, step: widget.includes('.') && Number(step) > 0 ? step : (high - low) / 100};
  if (name === 'spin' || ((low ?? high) !== undefined && name !== 'text')) return {kind: 'number', low, high, step: 'any'};
  return values.length > 0 && name !== 'text' ? {kind: 'radio', values} : {kind: 'text'};
}

function createNumber({kind, low, high, step}, value, label, changed) {
  const input = make('input'), shown = make('output');
  Object.assign(input, {type: kind === 'slider' ? 'range' : 'number', min: low ?? '', max: high ?? '', step, ariaLabel: label});
  input.value = value;
  shown.textContent = kind === 'slider' ? value : '';
  input.addEventListener('input', () => { if (kind === 'slider') shown.textContent = input.value; });
  input.addEventListener('change', () => changed(input.value));
  return [input, shown];
}

/** `value` of a checkbox is a list with commas. */
function createChoices({kind, values}, value, label, name, changed) {
  const chosen = value.split(',').map((each) => each.trim());
  const inputs = values.map((each) => {
    const input = make('input');
    Object.assign(input, {type: kind, name, value: each, checked: chosen.includes(each)});
    input.addEventListener('change', () => changed(inputs.filter(({checked}) => checked).map((one) => one.value).join(',')));
    return input;
  });
  const group = make('span', 'choices');
  group.setAttribute('role', kind === 'radio' ? 'radiogroup' : 'group');
  group.ariaLabel = label;
  group.append(...inputs.map((input) => {
    const one = make('label');
    one.append(input, ` ${input.value}`);
    return one;
  }));
  return [group];
}

/** Returns the elements of a parameter's widget. `changed`: called with the new value. `group`: unlike those of other parameters. */
export function createWidget(widget, value, label, group, changed) {
  if (widget.kind === 'radio' || widget.kind === 'checkbox') return createChoices(widget, value, label, group, changed);
  if (widget.kind !== 'text') return createNumber(widget, value, label, changed);
  const input = make('input');
  Object.assign(input, {type: 'text', value, ariaLabel: label, spellcheck: false});
  input.addEventListener('change', () => changed(input.value));
  return [input];
}
