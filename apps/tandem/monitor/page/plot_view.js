// SPDX-License-Identifier: Apache-2.0
// One plot: curves over time, drawn by uPlot. Drag over a part to enlarge it, double-click to return; the values at the cursor
// are in the legend.
import {align, curveId, labelOf, pointsOf} from './curves.js';
import {KeyedList, make, number, setAttributes, setClass, setText} from './dom.js';

/** Thin lines cost a third: plots of many curves have them. */
const thick = 1.75, thin = 1, mostThick = 4; // pixels; curves
const legendPause = 200; // ms between two texts that people can read
const dashes = [[], [7, 3], [2, 3], [9, 3, 2, 3], [], [12, 4]], colours = dashes.length;
let loading = null;

/** Loads uPlot once. Throws an error with the remedy if it is missing. */
export function loadPlots() {
  loading ??= import('./lib/uPlot.esm.js').then((module) => module.default,
    () => { throw new Error('uPlot is missing; build Tandem where npm can install it'); });
  return loading;
}

/** Returns the time of day for the axis; `step`: between two marks, in s. */
function clockText(seconds, step) {
  const time = new Date(seconds * 1000), text = time.toLocaleTimeString('en-GB');
  return step < 1 ? `${text}.${String(time.getMilliseconds()).padStart(3, '0').slice(0, step < 0.1 ? 3 : 1)}` : text;
}

const colourOf = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

export class PlotView {
  /** `parent`: gets the plot and its legend. `plot`: curves, seconds, range (null: fits the values). `store`: SampleStore. */
  constructor(parent, plot, store) {
    Object.assign(this, {plot, store, uplot: null, key: '', hidden: new Set(), paused: false, shown: null, points: null, legendAt: -legendPause});
    this.element = make('div', 'plot');
    this.legendElement = make('div', 'legend');
    parent.append(this.element, this.legendElement);
    this.legend = new KeyedList(this.legendElement, (item) => this.createEntry(item), (entry, item) => this.updateEntry(entry, item));
    this.resize = new ResizeObserver(() => this.uplot?.setSize(this.size()));
    this.resize.observe(this.element);
  }

  size() { return {width: Math.max(220, this.element.clientWidth), height: this.element.clientHeight}; }

  /** Called by the legend's button; set by those who let people remove curves. */
  onremove = null;

  createEntry({curve, index}) {
    const entry = make('span', `entry entry${index % colours}`), show = make('button');
    show.type = 'button';
    show.append(make('span', 'line'), make('span', 'name'), ' ', make('b'));
    show.addEventListener('click', () => {
      const id = curveId(curve);
      if (!this.hidden.delete(id)) this.hidden.add(id);
      this.key = '';
    });
    entry.append(show);
    if (this.onremove) {
      const remove = make('button', 'remove', '×');
      remove.type = 'button';
      remove.addEventListener('click', () => this.onremove(curve));
      entry.append(remove);
    }
    return entry;
  }

  updateEntry(entry, {curve, index, label, value}) {
    const [show, remove] = entry.children, off = this.hidden.has(curveId(curve));
    setClass(entry, `entry entry${index % colours}`);
    setText(show.children[1], label);
    setText(show.children[2], number(value));
    setAttributes(show, {'aria-pressed': !off, title: off ? 'show' : 'hide'});
    if (remove) setAttributes(remove, {'aria-label': `remove ${label}`});
  }

  create(Plot) {
    this.uplot?.destroy();
    this.legendAt = -legendPause;
    const {plot} = this, axis = {stroke: colourOf('--faint'), grid: {stroke: colourOf('--line'), width: 1}, ticks: {stroke: colourOf('--line')}};
    const range = (_, low, high) => plot.range ?? (low === null ? [-1, 1] : low === high ? [low - 1, high + 1]
      : [low - 0.05 * (high - low), high + 0.05 * (high - low)]);
    const series = plot.curves.map((curve, i) => ({label: this.label(curve), stroke: colourOf(`--curve${i % colours}`),
      dash: dashes[i % colours], width: plot.curves.length > mostThick ? thin : thick, show: !this.hidden.has(curveId(curve)), points: {show: false}}));
    this.uplot = new Plot({...this.size(), legend: {show: false}, scales: {x: {time: true}, y: {range}},
      axes: [{...axis, space: 90, values: (_, marks, __, ___, step) => marks.map((mark) => clockText(mark, step))}, {...axis, size: 60}], series: [{}, ...series],
      cursor: {drag: {x: true, y: true, uni: 40, setScale: false}, focus: {prox: 24}},
      hooks: {setSelect: [(u) => this.enlarge(u)], setCursor: [() => this.drawLegend()]}}, align(plot.curves.map(() => null)), this.element);
    this.uplot.over.addEventListener('dblclick', () => this.live());
    setAttributes(this.element, {role: 'img', 'aria-label': `Plot of ${plot.curves.map((curve) => this.label(curve)).join(', ') || 'nothing'}`});
  }

  label(curve) { return labelOf(curve, new Set(this.plot.curves.map(({key}) => key)).size === 1); }

  /** Shows the selected part and stands still. */
  enlarge(uplot) {
    const {left, top, width: wide, height: high} = uplot.select;
    if (wide < 5 && high < 5) return;
    const at = (place, scale) => uplot.posToVal(place, scale), full = uplot.over;
    const part = {x: wide < 5 ? [0, full.clientWidth] : [left, left + wide], y: high < 5 ? null : [top + high, top]};
    this.pause([at(part.x[0], 'x') * 1000, at(part.x[1], 'x') * 1000], part.y && part.y.map((place) => at(place, 'y')));
    uplot.setSelect({left: 0, top: 0, width: 0, height: 0}, false);
  }

  /** Stands still at these times in ms, by default the shown ones; `zoom`: the values shown. */
  pause(times = this.shown, zoom = null) {
    Object.assign(this, {paused: true, shown: times});
    this.zoom = zoom;
    this.onpause?.(true);
  }

  live() {
    Object.assign(this, {paused: false, zoom: null});
    this.onpause?.(false);
  }

  /** Draws the newest samples, or what was shown when the plot was paused. */
  draw(Plot) {
    const {plot, store} = this, key = JSON.stringify([plot.curves, plot.range, [...this.hidden]]);
    if (this.key !== key) {
      this.create(Plot);
      this.key = key;
    }
    const now = store.now();
    if (!this.paused) this.shown = [now - 1000 * plot.seconds, now];
    const [from, to] = this.shown;
    this.uplot.batch(() => {
      if (!this.hasPoints(from, to)) this.uplot.setData(align(plot.curves.map((curve) => pointsOf(store, curve, from, to))), false);
      this.uplot.setScale('x', {min: from / 1000, max: to / 1000});
      if (this.zoom) this.uplot.setScale('y', {min: this.zoom[0], max: this.zoom[1]});
    });
    if (performance.now() - this.legendAt > legendPause) this.drawLegend();
  }

  /** Returns whether the points that were computed last show these times: no message has come, and the span is the same. */
  hasPoints(from, to) {
    const tracks = this.plot.curves.flatMap(({key, minus}) => minus ? [key, minus.key] : [key]).map((key) => this.store.tracks.get(key));
    const points = [this.uplot, to - from, ...tracks, ...tracks.map((track) => track?.version)], {points: last, from: begin} = this;
    const same = last?.length === points.length && from >= begin && points.every((each, i) => i === 1 ? Math.abs(each - last[i]) < 1 : each === last[i]);
    if (!same) Object.assign(this, {points, from});
    return same;
  }

  /** Shows the values at the cursor, or the newest ones. */
  drawLegend() {
    if (!this.uplot) return;
    this.legendAt = performance.now();
    const {idx} = this.uplot.cursor, data = this.uplot.data;
    this.legend.show(this.plot.curves.map((curve, index) => ({curve, index, label: this.label(curve),
      value: lastOf(data[index + 1], idx ?? data[0].length - 1)})), ({curve}) => curveId(curve));
  }

  remove() {
    this.resize.disconnect();
    this.uplot?.destroy();
    this.element.remove();
    this.legendElement.remove();
  }
}

/** Returns the last value at or before an index; other curves of the plot may have no sample there. */
function lastOf(column, index) {
  if (!column) return undefined; // of a curve that is not drawn yet
  let at = index;
  while (at > 0 && column[at] === undefined) --at;
  return column[at];
}
