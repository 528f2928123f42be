// SPDX-License-Identifier: Apache-2.0
// The view with the plots: their list, their controls, and the tree beside them. The list is kept for this tab of the browser.
import {curveId, labelOf} from './curves.js';
import {make, setText} from './dom.js';
import {MemberTree} from './member_tree.js';
import {PlotView, loadPlots} from './plot_view.js';
import {ShapeView} from './shapes/shape_view.js';
import {keyOfPort} from './tables.js';

const find = (id) => document.getElementById(id);
const mostCurves = 20, mostPlots = 12, firstCurves = 6, mostPorts = 16;
const spans = [2, 5, 10, 30, 60, 300]; // s
const storage = 'tandem-plots';

const option = (value, text) => {
  const element = make('option', '', text);
  element.value = value;
  return element;
};
const button = (text, act, className = '') => {
  const element = make('button', className, text);
  element.type = 'button';
  element.addEventListener('click', act);
  return element;
};

/** One plot with its controls. */
class PlotCard {
  constructor(panel, plot) {
    Object.assign(this, {panel, plot, element: make('article', 'plot-card')});
    this.title = make('h3');
    this.pause = button('❚❚ Pause', () => this.view.paused ? this.view.live() : this.view.pause());
    const bar = make('div', 'plot-bar');
    bar.append(this.title, this.pause, this.spanControl(), this.rangeControl(), this.formControl(),
      button('Remove', () => panel.removePlot(this)));
    this.element.append(bar);
    this.shape = new ShapeView(this.element, panel.store);
    this.view = new PlotView(this.element, plot, panel.store);
    this.view.onremove = (curve) => panel.change(this, plot.curves.filter((each) => curveId(each) !== curveId(curve)));
    this.view.onpause = (paused) => setText(this.pause, paused ? '▶ Live' : '❚❚ Pause');
    this.element.addEventListener('focusin', () => panel.activate(this));
    this.element.addEventListener('pointerdown', () => panel.activate(this));
    this.element.addEventListener('dragover', (event) => event.preventDefault());
    this.element.addEventListener('drop', (event) => {
      const text = event.dataTransfer.getData('application/x-tandem-curve');
      if (text) panel.addCurve(this, JSON.parse(text));
    });
  }

  spanControl() {
    const label = make('label', '', 'last '), select = make('select');
    select.append(...spans.map((seconds) => option(seconds, seconds < 60 ? `${seconds} s` : `${seconds / 60} min`)));
    select.value = this.plot.seconds;
    select.addEventListener('change', () => {
      this.plot.seconds = Number(select.value);
      this.view.live();
      this.panel.keep();
    });
    label.append(select);
    return label;
  }

  rangeControl() {
    const label = make('label', '', 'values '), select = make('select'), ends = [make('input'), make('input')];
    select.append(option('', 'fit'), option('fixed', 'fixed'));
    select.value = this.plot.range ? 'fixed' : '';
    const show = () => ends.forEach((end, i) => {
      end.hidden = !this.plot.range;
      if (this.plot.range) end.value = this.plot.range[i];
    });
    ends.forEach((end, i) => {
      Object.assign(end, {type: 'number', step: 'any', className: 'end', ariaLabel: i === 0 ? 'lowest value' : 'highest value'});
      end.addEventListener('change', () => {
        const range = ends.map((each) => Number(each.value));
        const isRange = range[0] < range[1];
        if (isRange) this.plot.range = range;
        show();
        this.panel.keep();
        if (!isRange) this.panel.note = `The lowest value must be below the highest, but ${range[0]} is not below ${range[1]}: the plot keeps its range.`;
      });
    });
    select.addEventListener('change', () => {
      const {min, max} = this.view.uplot?.scales.y ?? {min: -1, max: 1};
      this.plot.range = select.value ? [Number(min.toPrecision(3)), Number(max.toPrecision(3))] : null;
      show();
      this.panel.keep();
    });
    show();
    label.append(select, ' ', ...ends);
    return label;
  }

  get values() { return this.plot.curves.filter(({form}) => form === 'value'); }

  /** Adds a curve computed from those of the plot. */
  formControl() {
    const label = make('label', '', 'add ');
    this.forms = make('select');
    this.forms.addEventListener('change', () => {
      const [i, j] = JSON.parse(this.forms.value), {key, name} = this.values[i];
      this.panel.addCurve(this, j === undefined ? {key, name, form: 'derivative'} : {key, name, form: 'difference', minus: this.values[j]});
    });
    label.append(this.forms);
    return label;
  }

  /** Draws the newest data. A port with a picture or distances has no curves at first. */
  draw(Plot, values) {
    const {plot, view, shape} = this;
    view.draw(Plot);
    if (plot.key) shape.draw(plot.key, values.get(plot.key), view.shown, view.paused);
    view.element.hidden = view.legendElement.hidden = shape.kind !== null && plot.curves.length === 0;
  }

  /** Shows the ports of the curves, and offers the curves that can be computed from them. */
  update() {
    const {values, plot} = this, derived = values.flatMap(({key, name}, i) => [[[i], {key, name, form: 'derivative'}],
      ...values.map((minus, j) => [[i, j], {key, name, form: 'difference', minus}]).filter((_, j) => j !== i)]);
    setText(this.title, [...new Set([...plot.curves, ...plot.key ? [plot] : []].map(({key}) => key.split('/').slice(2).join('/')))].join(', ') || 'empty plot');
    this.forms.replaceChildren(option('', 'derived curve ...'), ...derived.map(([of, curve]) => option(JSON.stringify(of), labelOf(curve, false))));
  }
}

/** Returns the newest messages of the state by port. */
const valuesIn = (state) => new Map(state.links.flatMap((link) => link.ports.map((port) => [keyOfPort(link, port), port.value])));

export class PlotsPanel {
  constructor(store) {
    Object.assign(this, {store, cards: [], active: null, pending: null, note: ''});
    this.tree = new MemberTree(find('member-tree'), find('member-filter'), find('member-note'), store, {
      toggle: (curve) => this.toggle(curve), has: (curve) => this.hasCurve(curve), open: (key) => this.openPort(key)});
    find('new-plot').addEventListener('click', () => this.addPlot({curves: [], seconds: 10, range: null, own: true}));
    for (const plot of this.kept().reverse()) this.addPlot(plot); // each is put first
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
      for (const {view} of this.cards) view.key = ''; // the canvas has the old colours
    });
  }

  kept() {
    try {
      return JSON.parse(sessionStorage.getItem(storage)) ?? [];
    } catch {
      return [];
    }
  }

  keep() {
    sessionStorage.setItem(storage, JSON.stringify(this.cards.map(({plot}) => plot)));
    const keys = new Set(this.cards.flatMap(({plot}) => [...plot.key ? [plot.key] : [], ...plot.curves.flatMap(({key, minus}) => minus ? [key, minus.key] : [key])]));
    if (this.pending) keys.add(this.pending);
    this.store.follow(this, [...keys].slice(0, mostPorts));
    this.note = keys.size > mostPorts ? `The plots can show ${mostPorts} ports at once, and have curves of ${keys.size}: remove the curves of a port.` : '';
    find('plots-hint').hidden = this.cards.length > 0;
    for (const card of this.cards) card.update();
  }

  /** Returns the card, or null if there are too many. */
  addPlot(plot) {
    if (this.cards.length >= mostPlots) {
      this.note = `The page can show ${mostPlots} plots: remove one, then add another.`;
      return null;
    }
    const card = new PlotCard(this, plot);
    this.cards.unshift(card);
    find('plots').prepend(card.element);
    this.activate(card);
    this.keep();
    return card;
  }

  removePlot(card) {
    card.view.remove();
    card.element.remove();
    this.cards = this.cards.filter((each) => each !== card);
    this.activate(this.cards[0] ?? null);
    this.keep();
  }

  activate(card) {
    this.active = card;
    for (const each of this.cards) each.element.classList.toggle('active', each === card);
    if (this.state) this.tree.show(this.state);
  }

  /** Sets the curves of a plot, which then belongs to the person and no longer to a chosen port. */
  change(card, curves) {
    Object.assign(card.plot, {curves, own: true});
    this.keep();
    this.activate(card);
  }

  addCurve(card, curve) {
    const known = card.plot.curves.some((each) => curveId(each) === curveId(curve));
    if (known) return;
    if (card.plot.curves.length < mostCurves) this.change(card, [...card.plot.curves, curve]);
    else this.note = `A plot can have ${mostCurves} curves: remove one, or use another plot.`;
  }

  hasCurve(curve) { return this.active?.plot.curves.some((each) => curveId(each) === curveId(curve)) ?? false; }

  toggle(curve) {
    const card = this.active ?? this.addPlot({curves: [], seconds: 10, range: null, own: true});
    if (!this.hasCurve(curve)) return this.addCurve(card, curve);
    this.change(card, card.plot.curves.filter((each) => curveId(each) !== curveId(curve)));
  }

  /** Plots the signals of a port: in the plot of the port chosen before, unless a person has changed it. */
  openPort(key) {
    const known = this.cards.find(({plot}) => !plot.own && plot.key === key);
    const card = known ?? this.cards.find(({plot}) => !plot.own) ?? this.addPlot({curves: [], seconds: 10, range: null, own: false});
    if (!card) return;
    if (!known) {
      Object.assign(card.plot, {curves: [], key, own: false});
      card.shape.reset();
    }
    this.tree.expanded.add(key);
    this.pending = card.plot.curves.length > 0 ? null : key; // a second click finds it empty
    this.firstSeen = undefined;
    this.keep();
    this.activate(card);
    card.element.scrollIntoView({block: 'nearest'});
  }

  /** The first curves of a chosen port: its signals, as soon as its values have shown which numbers these are. */
  fillPending() {
    const track = this.store.tracks.get(this.pending), shown = this.cards.find(({plot}) => !plot.own && plot.key === this.pending)?.shape.kind;
    if (shown === 'picture' || shown === 'polar') return this.finishPending([]);
    if (!track || track.names.length === 0) return;
    const kinds = track.names.map((name) => track.kindOf(name));
    if (kinds.includes(null)) {
      this.firstSeen ??= this.store.now(); // of a slow port, no kind is known for long
      if (this.store.now() - this.firstSeen < 1500) return;
    }
    this.firstSeen = undefined;
    const signals = track.names.filter((_, i) => (kinds[i] ?? 'signal') === 'signal');
    this.finishPending((signals.length > 0 ? signals : track.names).slice(0, firstCurves));
  }

  finishPending(names) {
    const key = this.pending, card = this.cards.find(({plot}) => !plot.own && plot.key === key);
    this.pending = null;
    if (card) card.plot.curves = names.map((name) => ({key, name, form: 'value'}));
    this.keep();
  }

  /** Called with each state while the view is shown. Starts to draw. */
  show(state) {
    this.state = state;
    this.values = valuesIn(state);
    this.tree.show(state);
    if (this.loop === undefined) this.start();
  }

  hide() {
    this.loop = undefined;
  }

  async start() {
    const loop = this.loop = Symbol('of this time that the view is shown');
    try {
      this.run(await loadPlots(), loop);
    } catch (failure) {
      setText(find('plots-note'), failure.message);
    }
  }

  /** Draws all plots in each frame of the browser, or once a second if the person wants little motion. */
  run(Plot, loop) {
    const pause = matchMedia('(prefers-reduced-motion: reduce)').matches ? 1000 : 0;
    let drawn = 0;
    const frame = (now) => {
      if (this.loop !== loop) return;
      requestAnimationFrame(frame);
      if (now - drawn < pause) return;
      drawn = now;
      if (this.pending) this.fillPending();
      setText(find('plots-note'), this.note || this.store.refusal);
      for (const card of this.cards) card.draw(Plot, this.values);
    };
    requestAnimationFrame(frame);
  }
}
