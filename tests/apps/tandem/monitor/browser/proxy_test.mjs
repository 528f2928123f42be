// SPDX-License-Identifier: Apache-2.0
// The page in a folder of a reverse proxy, as docs/monitoring.md describes it, and behind one that passes on no WebSocket.
import assert from "node:assert/strict";
import { once } from "node:events";
import { createServer, request } from "node:http";
import { connect } from "node:net";
import { after, before, test } from "node:test";
import { cleanUp, start, startBrowser, startMonitor } from "./robot.mjs";

const name = `proxy-${process.pid}`;
const servers = [];
let system, monitor, browser;

/** Returns the address of the page in the folder /robot/ of a proxy. */
async function startProxy(passesWebSockets) {
  const path = (url) => url.startsWith("/robot/") ? url.slice("/robot".length) : null;
  const server = createServer((asked, answer) => {
    if (path(asked.url) === null) return answer.writeHead(404).end();
    const passed = request({ port: monitor.port, path: path(asked.url), headers: asked.headers }, (got) => {
      answer.writeHead(got.statusCode, got.headers);
      got.pipe(answer);
    });
    asked.pipe(passed);
  });
  server.on("upgrade", (asked, socket) => {
    if (!passesWebSockets || path(asked.url) === null) return socket.end("HTTP/1.1 400 Bad Request\r\n\r\n");
    const passed = connect(monitor.port, "127.0.0.1", () => {
      const headers = Object.entries(asked.headers).map(([key, value]) => `${key}: ${value}\r\n`).join("");
      passed.write(`GET ${path(asked.url)} HTTP/1.1\r\n${headers}\r\n`);
      socket.pipe(passed).pipe(socket);
    });
    for (const each of [socket, passed]) each.on("error", () => { socket.destroy(); passed.destroy(); });
  });
  servers.push(server);
  await once(server.listen(0, "127.0.0.1"), "listening");
  return `http://localhost:${server.address().port}/robot/`;
}

before(async () => {
  system = start(process.env.TANDEM_MANY_PORTS, [name, "2", "6", "10", "refuse"], "pipe");
  await system.line(/^12 ports/);
  monitor = await startMonitor([`${name}-0`, `${name}-1`]);
  browser = await startBrowser([]);
});
after(async () => {
  await browser?.close();
  for (const server of servers) { server.closeAllConnections(); server.close(); }
  if (system) system.stdin.end();
  await cleanUp();
});

test("the page shows live values and the graph in a folder of a reverse proxy", async () => {
  const page = await browser.open(await startProxy(true));
  await page.waitForSelector("#graph .edge");
  assert.equal(await page.locator("#connection").textContent(), "Connected");
  assert.deepEqual(page.errors, []);
});

test("the page shows values also if a proxy passes on no WebSocket, and says so", async () => {
  const page = await browser.open(await startProxy(false));
  await page.waitForSelector("#graph .edge");
  assert.match(await page.locator("#connection").textContent(), /^Connected without WebSocket/);
  assert.equal(await page.locator("#verdict .text").textContent() === "Disconnected", false);
});
