// SPDX-License-Identifier: Apache-2.0
// Shows what a chosen port is about, above its curves: a picture, distances around a sensor, or the path of a pose.
import {make, makeSvg, number, setAttributes, setText} from '../dom.js';
import {MapView, headingText} from './map_view.js';
import {PictureView} from './pictures.js';
import {pathOf, pointsAround, poseIn, rangesIn} from './shapes.js';

const arrow = 'M -0.5 -0.4 L 0.6 0 L -0.5 0.4 L -0.25 0 z', dot = 'M -0.3 0 a 0.3 0.3 0 1 0 0.6 0 a 0.3 0.3 0 1 0 -0.6 0';

export class ShapeView {
  /** `parent`: gets the view. */
  constructor(parent, store) {
    Object.assign(this, {store, kind: null, picture: new PictureView(), marker: makeSvg('path', {class: 'marker'})});
    this.element = make('div', 'shape');
    this.figure = make('figure');
    this.svg = makeSvg('svg', {role: 'img', class: 'map'});
    this.caption = make('figcaption');
    this.map = new MapView(this.svg, this.marker);
    this.figure.append(this.svg, this.caption);
    this.element.append(this.picture.element, this.figure);
    parent.append(this.element);
    this.show(null);
  }

  /** Forgets the port that was shown. */
  reset() {
    this.names = this.pose = undefined;
    this.show(null);
  }

  show(kind) {
    this.kind = kind;
    this.element.hidden = kind === null;
    this.picture.element.hidden = kind !== 'picture';
    this.figure.hidden = kind !== 'polar' && kind !== 'path';
  }

  /** Draws the newest data of the port, or those that a paused plot shows. `value`: its newest message in the state. Sets `kind`. */
  draw(key, value, [from, to], paused) {
    const picture = this.store.pictures.get(key), ranges = rangesIn(this.store.messages.get(key) ?? value ?? null);
    const name = key.split('/').slice(2).join('/');
    if (picture) {
      this.show('picture');
      return paused ? undefined : this.picture.show(picture);
    }
    if (ranges) {
      this.show('polar');
      return paused ? undefined : this.drawRanges(name, ranges);
    }
    const track = this.store.tracks.get(key);
    if (track && track.names !== this.names) Object.assign(this, {names: track.names, pose: poseIn(track.names)});
    const path = track && this.pose ? pathOf(track, this.pose, from, to) : null;
    this.show(path ? 'path' : null);
    if (path) this.drawPath(name, path);
  }

  drawRanges(name, ranges) {
    const points = pointsAround(ranges);
    this.map.fit([...points, [0, 0]], 1);
    this.map.drawDots(points);
    this.map.drawTrace([]);
    this.drawMarker(0, 0, 0);
    const nearest = points.reduce((least, [x, y]) => Math.min(least, Math.hypot(x, y)), Infinity);
    this.describe(`Distances around ${name}`, `${ranges.ranges.length} distances${points.length > 0 ? `, nearest ${number(nearest)} m` : ', nothing in reach'}`);
  }

  drawPath(name, {points, x, y, heading}) {
    this.map.fit([...points, [x, y]], 1);
    this.map.drawDots([]);
    this.map.drawTrace([...points, [x, y]]);
    this.drawMarker(x, y, heading);
    this.describe(`Path of ${name}`, `x ${number(x)}, y ${number(y)}${Number.isFinite(heading) ? `, heading ${headingText(heading)}` : ''}`);
  }

  drawMarker(x, y, heading) {
    setAttributes(this.marker, {d: heading === undefined ? dot : arrow});
    this.map.place(x, y, heading, this.map.box.side / 20);
  }

  describe(label, text) {
    setAttributes(this.svg, {'aria-label': label});
    setText(this.caption, `${label}: ${text}; a square is ${this.map.step} m`);
  }
}
