// SPDX-License-Identifier: Apache-2.0
// The page as a person sees it, of a wheelchair that drives. Times are printed, and not checked.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { cleanUp, end, start, startBrowser, startMonitor, startWheelchair } from "./robot.mjs";

const pictures = process.env.TANDEM_PICTURES;
const requests = [];
let chair, monitor, browser, page;

/** The wheelchair asks for real-time priorities, which not every machine grants. */
const verdictIsFine = () => page.waitForSelector("#verdict:is(.well, .setting)");
const text = (selector) => page.locator(selector).textContent();
const view = (name, of = page) => of.locator(`#${name}-anchor`).click();
const picture = (name, selector, of = page) => of.locator(selector).screenshot({ path: join(pictures, `${name}.png`) });

before(async () => {
  chair = await startWheelchair();
  monitor = await startMonitor([chair.link, `${chair.link}-chair`]);
  browser = await startBrowser(requests);
  const began = performance.now();
  page = await browser.open(monitor.url);
  const loaded = performance.now() - began;
  await page.waitForSelector("#graph .edge");
  console.log(`page loaded in ${loaded.toFixed(0)} ms, graph drawn after ${(performance.now() - began).toFixed(0)} ms`);
});
after(async () => {
  await browser?.close();
  await cleanUp();
});

test("a running wheelchair is shown: verdict, graph, links and events", async () => {
  await verdictIsFine();
  assert.match(await text("#verdict .reason"), /2 links: both hosts alive|without SCHED_FIFO priority/);
  const titles = await page.locator("#graph .host .name").allTextContents();
  assert.deepEqual(titles.sort(), ["OPRoS host opros_host", "RTM host rtm_host", "wheelchair"]);
  const components = await page.locator("#graph .component .name").allTextContents();
  assert.deepEqual(components.sort(), ["Adaptor", "ControlComp", "HWComp", "InterceptorComp0", "JoystickComp0", "JoystickComp0, mirrored", "wheelchair"]);
  const states = await page.locator("#graph .component", { hasText: "ControlComp" }).locator(".detail").textContent();
  assert.match(states, /^✓ active, 10 ms$/);
  const ports = await page.locator("#graph .port:not(.inside) text").allTextContents();
  assert.deepEqual(ports.map((name) => name.replace(/^[◉◡] /, "").replace(/ .*/, "")).sort(),
    ["chair", "chair", "chair", "joystick", "joystick", "joystickPos", "joystickPos", "reference", "reference"]);
  assert.equal(await page.locator("#graph .edge.live").count(), 2);
  assert.equal(await page.locator("#graph .edge.service:not(.inside)").count(), 2);
  assert.ok(await page.locator("#graph .edge.inside").count() >= 2); // from and to the mirror, and between ControlComp and HWComp
  await page.waitForFunction(() => /[1-9]\d*(\.\d+)?\/s/.test(document.querySelector("#graph .edge.live .rate").textContent));
  await view("links");
  assert.equal(await page.locator("#ports tbody tr").count(), 3);
  await page.waitForFunction(() => document.querySelectorAll("#ports .histogram .bars[d^=M]").length === 3);
  assert.equal(await page.locator("#calls tbody tr").count(), 2);
  await view("ticks");
  await page.waitForFunction(() => [...document.querySelectorAll("#ticks tbody tr")].filter((row) => /✓ active.*10 ms/.test(row.textContent)).length === 3);
  const ticks = await page.locator("#ticks tbody td:first-child").allTextContents();
  assert.deepEqual(ticks.filter((name) => /Comp/.test(name)).sort(), ["ControlComp", "HWComp", "InterceptorComp0", "JoystickComp0"]);
  await view("events");
  assert.match(await text("#events"), /the link exists/);
});

test("the graph stands still while rates change, and fills the width of the page", async () => {
  await view("graph");
  await page.waitForSelector("#graph .edge");
  const places = () => page.locator("#graph").evaluate((graph) =>
    [...graph.querySelectorAll("rect:not(.back), .line")].map((part) => part.getAttribute("d") ?? [part.getAttribute("x"), part.getAttribute("y")].join()));
  const first = await places();
  const age = await page.evaluate(() => document.querySelector("#chair-state").textContent);
  await page.waitForFunction((old) => document.querySelector("#chair-state").textContent !== old, age);
  assert.deepEqual(await places(), first);
  const widths = await page.evaluate(() => [document.querySelector("#graph svg").clientWidth, document.querySelector("#graph").clientWidth]);
  assert.ok(widths[0] > 0.85 * widths[1], widths.join());
});

test("a port is chosen with the keyboard, and its values are plotted and survive a reload", async () => {
  const plotted = (count) => page.waitForFunction((wanted) => document.querySelectorAll(".plot-card .entry").length === wanted, count);
  await page.getByRole("button", { name: "reference", exact: true }).first().focus();
  await page.keyboard.press("Enter");
  await plotted(2);
  assert.match(await text("#values-title"), /Newest message of reference, link wheelchair/);
  assert.match(await text("#value"), /"data": \[/);
  await page.locator(".plot-card .entry button").first().click();
  await page.waitForSelector('.plot-card .entry button[aria-pressed="false"]');
  await page.reload();
  await plotted(2);
  await page.waitForFunction(() => /Newest message of reference/.test(document.querySelector("#values-title").textContent));
});

test("the views are tabs that the arrow keys reach, and tables sort", async () => {
  await view("graph");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("ArrowDown");
  assert.equal(await page.getByRole("tab", { selected: true }).textContent(), "Ports and calls");
  const names = () => page.locator("#ports tbody th").allTextContents();
  const heading = page.locator("#ports thead").getByRole("button", { name: "port", exact: true });
  await heading.click();
  assert.deepEqual(await names(), ["chair", "joystickPos", "reference"]);
  await heading.click();
  assert.deepEqual(await names(), ["reference", "joystickPos", "chair"]);
  assert.equal(await page.locator("#ports th[aria-sort]").getAttribute("aria-sort"), "descending");
});

test("the wheelchair is seen from above and moves", async () => {
  const place = () => page.locator(".chair").getAttribute("transform");
  await view("chair");
  const first = await place();
  await page.waitForFunction((old) => document.querySelector(".chair").getAttribute("transform") !== old, first);
  await page.waitForFunction(() => document.querySelector("#chair-map .trace").getAttribute("points").split(" ").length > 20);
  assert.match(await text("#chair-state"), /m\/s, brake (open|closed)/);
  assert.deepEqual(await page.locator("#steering .entry .name").allTextContents(), ["steering_deg", "reference_deg"]);
  await page.waitForFunction(() => [...document.querySelectorAll("#steering .entry b")].every((value) => /\d/.test(value.textContent)));
  assert.match(await text("#chair-stick"), /stick/);
});

test("pictures of every view, including in dark mode and on a phone", async () => {
  await verdictIsFine();
  await page.waitForFunction(() => / (0\.[4-9]|1\.)\d* m\/s/.test(document.querySelector("#chair-state").textContent)); // it drives
  const views = ["graph", "links", "ticks", "plots", "chair", "events"];
  for (const name of views) {
    await view(name);
    await page.waitForTimeout(500);
    await picture(name, `#${name}-section`);
  }
  await picture("verdict", "#verdict");
  const dark = await browser.open(page.url(), { colorScheme: "dark", viewport: { width: 1920, height: 1080 }, reducedMotion: "reduce" });
  const phone = await browser.open(page.url(), { viewport: { width: 390, height: 844 } });
  for (const [name, other] of [["dark", dark], ["phone", phone]]) {
    await other.waitForSelector("#chair-anchor:not([hidden])");
    for (const each of views) {
      await view(each, other);
      if (each === "graph") await other.waitForSelector("#graph .edge");
      await other.waitForTimeout(300);
      await other.screenshot({ path: join(pictures, `${name}-${each}.png`), fullPage: true });
      // Nothing is wider than the page: what is too wide scrolls within its section.
      assert.equal(await other.evaluate(() => document.documentElement.scrollWidth <= innerWidth), true, `${name} ${each}`);
    }
    assert.deepEqual(other.errors, []);
    await other.close();
  }
});

test("a killed host turns the verdict red, and its restart turns it back", async () => {
  await verdictIsFine();
  const restart = chair.child.line(/to restart it: (.*)/);
  await view("graph");
  const places = () => page.locator("#graph").evaluate((graph) => [...graph.querySelectorAll(".component")].map((component) =>
    [component.querySelector(".name").textContent, component.querySelector("rect").getAttribute("x"), component.querySelector("rect").getAttribute("y")].join()));
  const placed = await places();
  const killed = performance.now();
  process.kill(chair.rtm, "SIGKILL");
  await page.waitForSelector("#verdict:is(.dead, .gone)");
  await view("graph");
  console.log(`red ${(performance.now() - killed).toFixed(0)} ms after the kill`);
  assert.match(await text("#verdict .reason"), new RegExp(`the RTM host rtm_host \\(pid ${chair.rtm}\\) has died`));
  await page.waitForSelector("#graph .host:is(.dead, .gone)");
  assert.equal(await page.locator("#graph .edge.dead").count(), 4);
  assert.deepEqual(await places(), placed);
  await picture("dead", "#verdict");
  await picture("dead-graph", "#graph-section");
  const [, command] = await restart;
  start("/bin/sh", ["-c", `exec ${command}`]);
  await verdictIsFine();
  await page.waitForFunction(() => document.querySelectorAll("#graph .edge.live").length === 2);
  assert.deepEqual(await places(), placed);
  await view("events");
  await page.waitForFunction(() => document.querySelector("#events").textContent.includes("has started again"));
  assert.match(await text("#events"), /rtm_host \(pid \d+\) has died/);
  assert.match(await text("#events"), /rtm_host \(pid \d+\) has started again/);
});

test("a monitor that is stopped is said not to answer, and the page shows its states again when it continues", async () => {
  monitor.child.kill("SIGSTOP");
  try {
    await page.waitForSelector("#verdict.unreadable");
    assert.match(await text("#verdict .text"), /Disconnected/);
    assert.match(await text("#connection"), /^Disconnected/);
  } finally {
    monitor.child.kill("SIGCONT");
  }
  await page.waitForSelector("body:not(.disconnected)");
  await verdictIsFine();
});

test("the title of a page in the background follows the verdict", async () => {
  const fine = await page.title();
  await page.evaluate(() => Object.defineProperty(document, "hidden", { get: () => true, configurable: true }));
  process.kill(chair.opros, "SIGSTOP");
  try {
    await page.waitForFunction((before) => document.title !== before && !/All is well/.test(document.title), fine);
  } finally {
    process.kill(chair.opros, "SIGCONT");
  }
  await page.evaluate(() => delete document.hidden);
  await page.waitForSelector("#verdict");
});

test("a monitor that ends is said to be gone, and the page finds the next one by itself", async () => {
  await end(monitor.child);
  await page.waitForSelector(".disconnected");
  assert.match(await text("#verdict .text"), /Disconnected/);
  await view("graph");
  await page.locator("#graph .port[role=button]").first().press("Enter"); // what was seen last is drawn again
  assert.match(await text("#verdict .text"), /Disconnected/);
  monitor = await startMonitor([chair.link, `${chair.link}-chair`], monitor.port);
  await page.waitForSelector("body:not(.disconnected)");
  await verdictIsFine();
});

test("no request has left this machine", () => {
  assert.ok(requests.length > 10);
  for (const url of requests) assert.match(url, new RegExp(`^(http|ws)://127.0.0.1:${monitor.port}/|^data:|^blob:http://127.0.0.1`), url);
});
