// SPDX-License-Identifier: Apache-2.0
// Computes the points of curves from samples, as uPlot takes them: undefined where a curve has no sample, null in a gap.

/** More samples than this in view are reduced to the lowest and highest of each part. */
const mostPoints = 3000;

/** A curve: `key` of its port, `name` of the number, `form`: value, derivative, or difference to the curve `minus`. */
export const curveId = ({key, name, form = 'value', minus}) => `${form} ${key} ${name}${minus ? ` - ${minus.key} ${minus.name}` : ''}`;

/** Returns the label of a curve for people; `alone`: all curves of the plot are of one port. */
export function labelOf({key, name, form, minus}, alone) {
  const of = (port, number) => alone ? number : `${port.split('/').slice(2).join('/')}.${number}`;
  if (form === 'derivative') return `d/dt ${of(key, name)}`;
  return form === 'difference' ? `${of(key, name)} − ${of(minus.key, minus.name)}` : of(key, name);
}

/** Returns the derivative per second at each sample but the first of a run. */
function derivative(times, values) {
  return values.map((value, i) => i === 0 ? NaN : 1000 * (value - values[i - 1]) / (times[i] - times[i - 1]));
}

/** Returns the values less those of another track, of which the last sample before counts. */
function difference(times, values, track, name) {
  const other = track?.columns.get(name);
  if (!other) return values.map(() => NaN);
  let at = track.indexOf(times[0] ?? 0);
  return values.map((value, i) => {
    while (at < track.size && track.times[at] <= times[i]) ++at;
    return at === 0 ? NaN : value - other[at - 1];
  });
}

/** Keeps the lowest and the highest value of each part, in order, and each gap. */
function reduce(times, values) {
  if (times.length <= mostPoints) return {x: times, y: values};
  const part = Math.ceil(2 * times.length / mostPoints), kept = [];
  for (let begin = 0; begin < times.length; begin += part) {
    const end = Math.min(begin + part, times.length);
    let low = begin, high = begin, gap = -1;
    for (let i = begin; i < end; ++i) {
      if (Number.isNaN(values[i])) gap = i;
      if (!(values[low] <= values[i])) low = i;
      if (!(values[high] >= values[i])) high = i;
    }
    kept.push(...new Set([low, high, ...(gap >= 0 ? [gap] : [])].sort((a, b) => a - b)));
  }
  return {x: Float64Array.from(kept, (i) => times[i]), y: Float64Array.from(kept, (i) => values[i])};
}

/** Returns the points of a curve from `from` to `to` in ms, with one more on each side; null if there are none. */
export function pointsOf(store, curve, from, to) {
  const track = store.tracks.get(curve.key), column = track?.columns.get(curve.name);
  if (!column) return null;
  const first = Math.max(0, track.indexOf(from) - 2), last = Math.min(track.size, track.indexOf(to) + 1);
  const times = track.times.subarray(first, last), values = column.subarray(first, last);
  if (curve.form === 'derivative') return reduce(times, derivative(times, values));
  if (curve.form === 'difference') return reduce(times, difference(times, values, store.tracks.get(curve.minus.key), curve.minus.name));
  return reduce(times, values);
}

/** Returns the times of all curves, in order and each once. */
function unionOf(present) {
  const [first] = present;
  if (!first) return new Float64Array(0);
  if (present.every(({x}) => x.buffer === first.x.buffer && x.byteOffset === first.x.byteOffset && x.length === first.x.length)) return first.x;
  const all = new Float64Array(present.reduce((count, {x}) => count + x.length, 0));
  let at = 0;
  for (const {x} of present) {
    all.set(x, at);
    at += x.length;
  }
  all.sort();
  return all.filter((time, i) => i === 0 || time !== all[i - 1]);
}

/** Returns uPlot's data: the times of all curves in seconds, and for each curve its values at these times. */
export function align(points) {
  const times = unionOf(points.filter((each) => each !== null));
  const columns = points.map((each) => {
    const column = new Array(times.length).fill(undefined);
    if (each === null) return column;
    for (let i = 0, at = 0; i < each.x.length; ++i) {
      while (times[at] < each.x[i]) ++at;
      column[at] = Number.isFinite(each.y[i]) ? each.y[i] : null;
    }
    return column;
  });
  return [Array.from(times, (time) => time / 1000), ...columns];
}
