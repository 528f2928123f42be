// SPDX-License-Identifier: Apache-2.0
// Draws a place from above: metres, x to the right, y up, angles in degrees to the left. A grid shows the scale.
import {fixed, makeSvg, setAttributes} from '../dom.js';

const margin = 0.7, smallest = 3; // m
const steps = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500];

/** The distance between two lines for at most 20 of them. */
const stepFor = (side) => steps.find((each) => side / each <= 20) ?? 10 ** Math.ceil(Math.log10(side / 20));

/** Returns the multiples of a step from a place on. Messages may have any numbers: counting on from 1e17 would never end. */
function multiples(from, side, step) {
  const first = Math.ceil(from / step), count = Math.floor((from + side) / step) - first + 1;
  return Array.from({length: Math.min(Math.max(count, 0), 21)}, (_, i) => (first + i) * step);
}

/** Returns an angle in degrees as people say it: from -180° to 180°, however often the robot has turned. */
export const headingText = (degrees) => `${fixed(degrees - 360 * Math.round(degrees / 360), 0)}°`;

export class MapView {
  /** `svg`: gets the map. `marker`: an element that is drawn at the pose, looking to the right. */
  constructor(svg, marker) {
    Object.assign(this, {svg, marker, box: null});
    this.grid = makeSvg('path', {class: 'grid'});
    this.trace = makeSvg('polyline', {class: 'trace'});
    this.dots = makeSvg('path', {class: 'dots'});
    const world = makeSvg('g', {transform: 'scale(1,-1)'}); // y points up
    world.append(this.grid, this.trace, this.dots, marker);
    svg.append(world);
  }

  /** Shows the whole of these points: whole metres, so that the picture stands still while nothing leaves it. */
  fit(points, least = smallest) {
    const xs = points.map((point) => point[0]), ys = points.map((point) => point[1]);
    const lowest = (values) => Math.floor(values.reduce((a, b) => Math.min(a, b)) - margin);
    const highest = (values) => Math.ceil(values.reduce((a, b) => Math.max(a, b)) + margin);
    const [left, right, low, high] = [lowest(xs), highest(xs), lowest(ys), highest(ys)], side = Math.max(right - left, high - low, least);
    this.setBox((left + right) / 2, (low + high) / 2, side);
  }

  /** Shows `side` metres around a place. The picture moves when the place leaves the middle of it. */
  follow(x, y, side) {
    const old = this.box?.side === side ? this.box : {x, y}, reach = side / 5;
    const near = (at, centre) => Math.min(Math.max(centre, at - reach), at + reach);
    this.setBox(near(x, old.x), near(y, old.y), side);
  }

  setBox(x, y, side) {
    this.box = {x, y, side};
    const left = x - side / 2, low = y - side / 2;
    setAttributes(this.svg, {viewBox: [left, -low - side, side, side].map((value) => value.toFixed(3)).join(' ')});
    this.step = stepFor(side);
    const lines = [...multiples(left, side, this.step).map((at) => `M ${at} ${low} V ${low + side}`),
      ...multiples(low, side, this.step).map((at) => `M ${left} ${at} H ${left + side}`)];
    setAttributes(this.grid, {d: lines.join(' ')});
  }

  drawTrace(points) {
    setAttributes(this.trace, {points: points.map(([x, y]) => `${x.toFixed(3)},${y.toFixed(3)}`).join(' ')});
  }

  drawDots(points) {
    setAttributes(this.dots, {d: points.map(([x, y]) => `M ${x.toFixed(3)} ${y.toFixed(3)} h 0`).join(' ')});
  }

  /** `heading`: undefined if it is not known. `size`: a factor for the marker. */
  place(x, y, heading, size = 1) {
    setAttributes(this.marker, {transform: `translate(${x.toFixed(3)},${y.toFixed(3)}) rotate(${(heading || 0).toFixed(2)}) scale(${size.toFixed(3)})`});
  }
}
