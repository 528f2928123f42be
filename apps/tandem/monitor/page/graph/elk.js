// SPDX-License-Identifier: Apache-2.0
// Loads elkjs with its layout in a worker. index.html begins with this module, because the worker takes longest to be ready.

/** elkjs defines the global `ELK`. */
async function loadElk() {
  try {
    await import('../lib/elk-api.js');
  } catch {
    throw new Error('elkjs is missing; build Tandem where npm can install it');
  }
  return new globalThis.ELK({workerUrl: new URL('../lib/elk-worker.min.js', import.meta.url).href});
}

export const loading = loadElk();
loading.catch(() => {}); // layOut() tells why
