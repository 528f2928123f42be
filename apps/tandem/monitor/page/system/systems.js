// SPDX-License-Identifier: Apache-2.0
// The systems in the monitor's folder, and which running hosts can be saved as one. Draws nothing.

/** Returns the hosts that links join, each once: [{pids, label}]. A host without a link is alone. */
export function hostGroups(hosts) {
  const groups = hosts.map((host) => ({links: new Set(host.links), hosts: [host]}));
  for (let i = 0; i < groups.length; ++i)
    for (let k = groups.length - 1; k > i; --k) {
      if (![...groups[k].links].some((link) => groups[i].links.has(link))) continue;
      for (const link of groups[k].links) groups[i].links.add(link);
      groups[i].hosts.push(...groups[k].hosts);
      groups.splice(k, 1);
      k = groups.length; // the links of the group are more now
    }
  return groups.map(({links, hosts: of}) => {
    const members = of.map(({program, pid}) => `${program} ${pid}`).sort(), names = [...links].sort();
    return {pids: of.map(({pid}) => pid), label: members.join(' and ') + (names.length > 0 ? ` (${names.join(', ')})` : '')};
  }).sort((a, b) => a.label.localeCompare(b.label));
}

/** Returns what became of the run of a system; an empty text if there was none. */
export function runText(run) {
  if (!run) return '';
  if (run.running) return `● runs since ${new Date(run.since_ms).toLocaleTimeString([], {hour12: false})}`;
  return run.end === 'exited with 0' ? 'has ended' : `✕ ${run.end}; the log says why`;
}

/** Returns the list of components for a new system from {name: count}. */
export const partsOf = (counts) => Object.entries(counts).flatMap(([name, count]) => Array(count).fill(name));
