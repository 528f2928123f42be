// SPDX-License-Identifier: Apache-2.0
// The part of the page that stays in view: the verdict, and below it the newest change that was refused, has failed, or got no answer.
import {setText} from './dom.js';

const find = (id) => document.getElementById(id);
let shown = null; // whose failure the line tells

/** Tells a failure in every view, until what has failed succeeds or a person closes it. `from`: a word for what changes. */
export function tellFailure(from, failed, text) {
  if (!failed && from !== shown) return;
  shown = failed ? from : null;
  setText(find('failure').firstElementChild, failed ? text : '');
  find('failure').hidden = !failed;
}

find('failure').lastElementChild.addEventListener('click', () => tellFailure(shown, false, ''));
// Elements that the keyboard reaches must not be hidden behind it.
new ResizeObserver(([{target}]) => document.documentElement.style.setProperty('--top', `${target.offsetHeight}px`)).observe(find('top'));
