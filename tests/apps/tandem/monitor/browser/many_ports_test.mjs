// SPDX-License-Identifier: Apache-2.0
// The page with 1,000 ports: what it changes for each state, and that it never holds a person up. A machine under load makes
// every task longer, so that work is counted and times are only printed.
import assert from "node:assert/strict";
import { readdirSync, rmSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { cleanUp, end, start, startBrowser, startMonitor } from "./robot.mjs";

const pictures = process.env.TANDEM_PICTURES;
const links = 10, ports = 100;
const name = `many-${process.pid}`;
let system, monitor, browser, page, tools;

before(async () => {
  system = start(process.env.TANDEM_MANY_PORTS, [name, String(links), String(ports), "10"], "pipe");
  await system.line(/^1000 ports/);
  monitor = await startMonitor(Array.from({ length: links }, (_, i) => `${name}-${i}`));
  browser = await startBrowser([]);
  page = await browser.open();
  tools = await page.context().newCDPSession(page);
  await tools.send("Performance.enable", { timeDomain: "threadTicks" });
  // Counts states, changes of the document and tasks that hold the page up.
  await page.addInitScript(() => {
    const counts = (window.counts = { states: 0, nodes: 0, long: [] });
    const Native = window.WebSocket;
    window.WebSocket = class extends Native {
      constructor(...all) {
        super(...all);
        this.addEventListener("message", () => ++counts.states);
      }
    };
    new PerformanceObserver((list) => counts.long.push(...list.getEntries().map((entry) => entry.duration))).observe({ type: "longtask" });
    document.addEventListener("DOMContentLoaded", () => new MutationObserver((changes) => (counts.nodes += changes.length))
      .observe(document.body, { subtree: true, childList: true, attributes: true, characterData: true }));
  });
  await page.goto(monitor.url);
  await page.waitForSelector("#graph .edge");
});
after(async () => {
  await browser?.close();
  await cleanUp();
  for (const file of readdirSync("/dev/shm").filter((each) => each.startsWith(`tandem.${name}-`))) rmSync(join("/dev/shm", file)); // of the killed system
});

/** What happens meanwhile; `cpu`: ms of the page's thread for each state, by its own clock, which other programs do not stretch. */
async function during(action) {
  const cpuNow = async () => (await tools.send("Performance.getMetrics")).metrics.find((metric) => metric.name === "TaskDuration").value * 1000;
  await page.evaluate(() => Object.assign(window.counts, { states: 0, nodes: 0, long: [] }));
  const before = await cpuNow();
  await action();
  const counts = await page.evaluate(() => window.counts);
  counts.cpu = (await cpuNow() - before) / counts.states;
  console.log(`${counts.states} states; for each ${(counts.nodes / counts.states).toFixed(0)} changes and ${counts.cpu.toFixed(0)} ms of a processor; ` +
    `tasks over 50 ms: ${counts.long.map(Math.round).join(" ") || "none"}`);
  return counts;
}
const states = (count) => page.waitForFunction((wanted) => window.counts.states >= wanted, count);

test("1,000 ports are shown, with the rows of those in view and a line for each component", async () => {
  assert.equal(await page.locator("#graph .edge").count(), 1); // between two folded hosts
  assert.match(await page.locator("#graph-note").textContent(), /2 of 2 hosts are folded; all hosts have 100 components/);
  await page.locator("#graph-fold").click();
  await page.waitForFunction((count) => document.querySelectorAll("#graph .edge").length === count, 5 * links);
  assert.match(await page.locator("#graph .port text").first().textContent(), /20 ports out/);
  assert.match(await page.locator("#graph-note").textContent(), /Of a folded component, one line stands for all ports of a kind/);
  await page.waitForFunction(() => /[12]\d\d\/s/.test(document.querySelector("#graph .edge.live .rate").textContent));
  await page.screenshot({ path: join(pictures, "many-ports.png"), fullPage: true });
  await page.locator("#links-anchor").click();
  await page.waitForFunction(() => document.querySelector("#ports-count").textContent === "1000 ports");
  const rows = await page.locator("#ports tbody:not(.space) tr").count();
  assert.ok(rows > 10 && rows < 100, `${rows} rows`);
  assert.equal(await page.locator("#ports").getAttribute("aria-rowcount"), "1001");
  const nodes = await page.evaluate(() => document.querySelectorAll("*").length);
  assert.ok(nodes < 5000, `${nodes} elements`);
});

// How long tasks take is printed, not asserted: other programs have the processors, too.
test("a state changes few parts of the page", async () => {
  await states(5);
  const counts = await during(() => states(40));
  assert.ok(counts.nodes / counts.states < 1000, `${counts.nodes / counts.states} changes for each state`);
  assert.deepEqual(page.errors, []);
});

test("scrolling to any port and filtering show what they should", async () => {
  await during(async () => {
    for (const share of [0.25, 0.5, 0.75, 1]) {
      await page.locator("#ports").evaluate((table, to) => { table.parentElement.scrollTop = to * table.parentElement.scrollHeight; }, share);
      await page.waitForTimeout(300);
    }
  });
  const last = page.getByRole("button", { name: "sensor99", exact: true }).last();
  await last.waitFor();
  assert.match(await last.locator("xpath=ancestor::tr").textContent(), new RegExp(`${name}-9`));
  await page.locator("#links-section").screenshot({ path: join(pictures, "many-ports-end.png") });
  await page.locator("#filter").fill("sensor42");
  await page.waitForFunction(() => document.querySelector("#ports-count").textContent === "10 of 1000 ports");
  assert.equal(await page.locator("#ports tbody tr").count(), 10);
  await page.locator("#filter").fill("");
  await page.locator("#graph-anchor").click();
  await page.locator("#graph .port[role=button]").first().press("Enter");
  await page.waitForFunction(() => document.querySelector("#ports-count").textContent === "200 of 1000 ports");
  assert.match(await page.locator("#filter").inputValue(), /^Plant\d$/);
});

test("a component of many ports is unfolded, and its ports fold again", async () => {
  await page.locator("#graph-anchor").click();
  const ports = await page.locator("#graph .port").count(), fold = page.getByRole("button", { name: /^Unfold Plant/ }).first();
  await fold.focus();
  await page.keyboard.press("Enter");
  await page.waitForFunction((before) => document.querySelectorAll("#graph .port").length > before + 15, ports);
  await page.getByRole("button", { name: /^Fold Plant/ }).first().click();
  await page.waitForFunction((before) => document.querySelectorAll("#graph .port").length === before, ports);
  await page.locator("#links-anchor").click();
});

test("a port of a thousand is chosen and plotted, and the death of the system is told", async () => {
  await page.locator("#filter").fill("sensor7");
  await page.getByRole("button", { name: "sensor77", exact: true }).first().click();
  await page.waitForFunction(() => document.querySelectorAll(".plot-card .entry").length > 0);
  await end(system, "SIGKILL");
  await page.waitForSelector("#verdict:is(.dead, .gone)");
});
