// SPDX-License-Identifier: Apache-2.0
// The inside of hosts in Chromium: a wheelchair whose three components are RTCs of one host, without a link between models.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { cleanUp, start, startBrowser, startMonitor } from "./robot.mjs";

const names = ["ControlComp0", "HWComp0", "JoystickComp0"];
let monitor, browser, page, pid;

before(async () => {
  const chair = start(join(process.env.TANDEM_BIN, "wheelchair"), ["--config", "rtm", "--scenario", "s_curve", "--duration", "300"]);
  [, pid] = await chair.line(/rtm_host pid (\d+)/);
  monitor = await startMonitor([]);
  browser = await startBrowser([]);
  page = await browser.open(monitor.url);
});
after(async () => {
  await browser?.close();
  await cleanUp();
});

test("a host without a link shows its components, their ports and the connections between them", async () => {
  const host = page.locator("#graph .host", { hasText: `pid ${pid}` });
  await host.waitFor();
  assert.equal(await host.locator(".name").textContent(), "RTM host rtm_host");
  assert.match(await host.textContent(), /\d+ % CPU, \d+ MiB/);
  assert.match(await host.locator("title").textContent(), /\d+ threads; the busiest: /);
  for (const name of names) {
    const component = page.locator("#graph .component", { hasText: name }).first();
    await component.waitFor();
    assert.match(await component.locator("title").textContent(), new RegExp(`${name}, of type ${name.slice(0, -1)}`));
  }
  await page.waitForFunction(() => [...document.querySelectorAll("#graph .component .detail")].filter((text) => /^✓ active, 10 ms$/.test(text.textContent)).length >= 3);
  const { hosts } = await (await page.request.get(new URL("api/state", monitor.url).href)).json();
  const { inventory } = hosts.find((each) => each.pid === Number(pid));
  const ids = new Set(inventory.ports.flatMap(({ connections }) => connections));
  assert.ok(ids.size >= 2, `${ids.size} connections`);
  assert.ok(await page.locator("#graph .edge.inside").count() >= ids.size);
  assert.deepEqual(page.errors, []);
});

test("the graph of the inside stands still while components run", async () => {
  const places = () => page.locator("#graph").evaluate((graph) =>
    [...graph.querySelectorAll("rect:not(.back), .line")].map((part) => part.getAttribute("d") ?? [part.getAttribute("x"), part.getAttribute("y")].join()));
  const first = await places();
  await page.waitForTimeout(1000);
  assert.deepEqual(await places(), first);
});

test("of a host that lists all its ports with one connection, a bounded number of edges is made", async () => {
  const [few, many] = await page.evaluate(async () => {
    const { topologyOf } = await import(new URL("graph/topology.js", document.baseURI).href);
    const graphOf = (number) => {
      const port = (direction) => (_, i) => ({ component: "A", name: `${direction}${i}`, kind: "data", direction, connections: ["one"] });
      const ports = ["output", "input"].flatMap((direction) => Array.from({ length: number }, port(direction)));
      const { edges, notes } = topologyOf([], [], [], [{ pid: 1, program: "rtm_host", inventory: { components: [{ name: "A" }], contexts: [], ports } }]);
      return { edges: edges.length, notes };
    };
    return [graphOf(3), graphOf(1000)];
  });
  assert.deepEqual(few, { edges: 9, notes: [] });
  assert.deepEqual(many, { edges: 10000, notes: ["990000 more connections inside hosts are not drawn"] });
});
