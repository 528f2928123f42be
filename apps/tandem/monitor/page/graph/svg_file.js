// SPDX-License-Identifier: Apache-2.0
// Writes the graph as an SVG file that needs no other file.

/** What is written of the style, with the value that a file has without it. */
const kept = {fill: '', stroke: 'none', 'stroke-width': '1px', 'stroke-dasharray': 'none', 'stroke-linecap': 'butt'};
const ofTexts = {'font-size': '', 'font-weight': '400', 'text-anchor': 'start'};
const tools = '.fold-box, .hit, .rubber';

/** Returns the text of a file with the whole graph, as it looks now. `background`: its colour. */
export function svgFileOf(svg, background) {
  const copy = svg.cloneNode(true), originals = svg.querySelectorAll('*');
  copy.querySelectorAll('*').forEach((element, i) => {
    if (element.closest(tools) || element.matches('g, title')) return;
    const style = getComputedStyle(originals[i]);
    if (style.display === 'none') element.classList.add('hit');
    for (const [name, initial] of Object.entries(element.matches('text') ? {...kept, ...ofTexts} : kept)) {
      const value = style.getPropertyValue(name);
      if (value !== initial) element.setAttribute(name, value);
    }
  });
  for (const tool of copy.querySelectorAll(tools)) tool.remove();
  for (const element of [copy, ...copy.querySelectorAll('*')])
    for (const name of ['class', 'style', 'tabindex', 'role', 'aria-label', 'data-port']) element.removeAttribute(name);
  const [, , width, height] = svg.getAttribute('viewBox').split(' ');
  copy.setAttribute('width', width);
  copy.setAttribute('height', height);
  copy.setAttribute('font-family', 'sans-serif');
  const back = document.createElementNS(copy.namespaceURI, 'rect');
  for (const [name, value] of Object.entries({width: '100%', height: '100%', fill: background})) back.setAttribute(name, value);
  copy.prepend(back);
  return `<?xml version="1.0" encoding="UTF-8"?>\n${new XMLSerializer().serializeToString(copy)}\n`;
}
