// SPDX-License-Identifier: Apache-2.0
// "Did I set it up right?": what cannot be connected is said, in words, in red and with a sign.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { cleanUp, start, startBrowser, startMonitor } from "./robot.mjs";

const pictures = process.env.TANDEM_PICTURES;
const name = `refused-${process.pid}`;
let system, browser, page;

before(async () => {
  system = start(process.env.TANDEM_MANY_PORTS, [name, "2", "6", "10", "refuse"], "pipe");
  await system.line(/^12 ports/);
  const monitor = await startMonitor([`${name}-0`, `${name}-1`]);
  browser = await startBrowser([]);
  page = await browser.open(monitor.url);
  await page.waitForSelector("#graph .edge");
});
after(async () => {
  await browser?.close();
  if (system) system.stdin.end();
  await cleanUp();
});

test("a connection that a host refuses is in the verdict, in the graph and among the events", async () => {
  await page.waitForSelector("#verdict.mismatch");
  assert.match(await page.locator("#verdict").textContent(), /could not connect Plant0\.sensor0 with Logger0\.level: rtc\.conf:12: /);
  assert.equal(await page.locator("#findings summary").textContent(), "2 more");
  assert.equal(await page.locator("#findings li").count(), 2);
  // Both links have a sensor0, and the host that refused is in both of them.
  await page.waitForFunction(() => document.querySelectorAll("#graph .edge.refused").length === 2);
  assert.equal(await page.locator("#graph .edge.refused .rate").first().textContent(), "✕ refused");
  assert.match(await page.locator("#graph .edge.refused title").first().textContent(),
    /Plant0\.sensor0 and Logger0\.level are not connected: .*has signature '\{value\}d\{count\}u'.*has 'f'/);
  const marked = await page.locator("#graph .port.mismatch text").allTextContents();
  assert.deepEqual(marked.sort(), ["✕ camera", "✕ camera", "✕ sensor0", "✕ sensor0"]);
  assert.match(await page.locator("#graph .port.mismatch title").first().textContent(), /cannot cross the link|are not connected/);
  const { refused_connections: refused } = await (await fetch(new URL("/api/state", page.url()))).json();
  assert.deepEqual(refused.map(({ from, to }) => [from, to]), [["Plant0.sensor0", "Logger0.level"]]);
});

test("a host with several links says which link a component's ports are in", async () => {
  const names = await page.locator("#graph .component .name").allTextContents();
  assert.ok(names.includes(`Plant0, link ${name}-0`) && names.includes(`Plant0, mirrored, link ${name}-1`), names.join());
});

test("pictures of what cannot be connected, including as colour-blind people see it", async () => {
  await page.screenshot({ path: join(pictures, "refused.png") });
  await page.locator("#graph-section").screenshot({ path: join(pictures, "refused-graph.png") });
  const tools = await page.context().newCDPSession(page);
  await tools.send("Emulation.setEmulatedVisionDeficiency", { type: "deuteranopia" });
  await page.screenshot({ path: join(pictures, "refused-deuteranopia.png") });
  assert.deepEqual(page.errors, []);
});
