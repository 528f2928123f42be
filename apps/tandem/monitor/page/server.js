// SPDX-License-Identifier: Apache-2.0
// The addresses of the monitor. They are relative to the page, which a reverse proxy may show in a folder and by https.

/** Returns the address of a WebSocket. */
export function socketAddress(path) {
  const address = new URL(path, document.baseURI);
  address.protocol = address.protocol === 'https:' ? 'wss:' : 'ws:';
  return address.href;
}

/** Returns the state by one request, or null. A proxy or a firewall may pass on requests, but no WebSocket. */
export async function requestState() {
  try {
    const answer = await fetch('api/state', {cache: 'no-store', signal: AbortSignal.timeout(4000)});
    return answer.ok ? await answer.json() : null;
  } catch {
    return null;
  }
}
