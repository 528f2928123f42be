// SPDX-License-Identifier: Apache-2.0
// Finds out what the messages of a port are about: distances around a sensor, or the pose of a robot. Draws nothing.

/** Returns the part of a message with distances and their angles, as in RTC::RangeData, or null. */
export function rangesIn(message) {
  if (message === null || typeof message !== 'object') return null;
  const {ranges, config} = message;
  if (Array.isArray(ranges) && Number.isFinite(config?.minAngle) && Number.isFinite(config?.angularRes)) return {ranges, config};
  for (const member of Object.values(message)) {
    const found = Array.isArray(member) ? null : rangesIn(member);
    if (found) return found;
  }
  return null;
}

/** Returns the points [x, y] in metres that a sensor at 0, 0 sees: x to the front, y to the left. */
export function pointsAround({ranges, config: {minAngle, angularRes, minRange = 0, maxRange = 0}}) {
  const points = [];
  ranges.forEach((range, i) => {
    if (typeof range !== 'number' || range < minRange || (maxRange > 0 && range >= maxRange)) return; // it sees nothing there
    const angle = minAngle + i * angularRes;
    points.push([range * Math.cos(angle), range * Math.sin(angle)]);
  });
  return points;
}

/** Returns the names of a pose's numbers {x, y, heading, degrees} in the names of a message's numbers, or null. */
export function poseIn(names) {
  const known = new Set(names);
  for (const name of names) {
    const before = name.match(/^(.*?)x$/)?.[1];
    if (before === undefined || (before !== '' && !before.endsWith('.')) || !known.has(`${before}y`)) continue;
    const outer = before.replace(/[^.]*\.$/, '');
    const heading = ['heading', 'theta', 'yaw', 'heading_deg', 'theta_deg', 'yaw_deg'].flatMap((each) => [before + each, outer + each])
      .concat(`${outer}orientation.y`).find((each) => known.has(each));
    if (heading || before.endsWith('position.')) return {x: `${before}x`, y: `${before}y`, heading, degrees: heading?.endsWith('_deg') ?? false};
  }
  return null;
}

/** A path has at most so many points. */
const mostPoints = 1500;

/** Returns the points of a pose from `from` to `to` in ms, the last one with its `heading` in degrees if it is known. */
export function pathOf(track, pose, from, to) {
  const [x, y, heading] = [pose.x, pose.y, pose.heading].map((name) => track.columns.get(name));
  if (!x || !y) return null;
  const first = track.indexOf(from), last = track.indexOf(to), step = Math.max(1, Math.ceil((last - first) / mostPoints)), points = [];
  for (let i = first; i < last; i += step) if (Number.isFinite(x[i]) && Number.isFinite(y[i])) points.push([x[i], y[i]]);
  let at = last - 1;
  while (at >= first && !(Number.isFinite(x[at]) && Number.isFinite(y[at]))) --at; // gaps
  if (at < first) return null;
  return {points, x: x[at], y: y[at], heading: heading ? heading[at] * (pose.degrees ? 1 : 180 / Math.PI) : undefined};
}
