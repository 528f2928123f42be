// SPDX-License-Identifier: Apache-2.0
// The fields for the properties of a new connection.
import {make} from '../dom.js';
import {commonProperties, whyNot} from './system.js';

/** Shows a field for each property that both ports support. Keeps the fields if the ports offer the same as before. */
export function showProperties(element, a, b) {
  const offered = a && b && whyNot(a, b) === '' ? commonProperties(a, b) : [], key = JSON.stringify(offered);
  if (element.offered === key) return;
  element.offered = key;
  element.replaceChildren(...offered.map(([name, values]) => {
    const label = make('label', '', `${name.replace('_', ' ')} `), select = make('select');
    select.name = name;
    select.append(new Option('default', ''), ...values.map((value) => new Option(value, value)));
    label.append(select);
    return label;
  }));
}

/** Returns the chosen properties, KEY=VALUE. */
export const propertiesIn = (element) => [...element.querySelectorAll('select')].filter(({value}) => value !== '').map(({name, value}) => `${name}=${value}`);
