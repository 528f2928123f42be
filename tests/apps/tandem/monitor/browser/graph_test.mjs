// SPDX-License-Identifier: Apache-2.0
// The graph of a made-up system of 1,000 components: folding, searching, zooming and the SVG file.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { cleanUp, startBrowser, startMonitor } from "./robot.mjs";

const hosts = 4, each = 250, pictures = process.env.TANDEM_PICTURES;
let monitor, browser, page, tools, real, state;

/** Chains of ten components in each host; every tenth component is alone. */
function inventory(host) {
  const names = Array.from({ length: each }, (_, i) => `Comp${host}x${i}`), of = (i) => `${host}-${i}`;
  const port = (i, name, direction, connections) => ({ component: names[i], name: `${names[i]}.${name}`, kind: "data", direction, type: "IDL:RTC/TimedLong:1.0", connections });
  return { components: names.map((name) => ({ name, type: "Comp", execution: "", period_ns: 0, names: [] })),
    contexts: names.map((name) => ({ owner: name, kind: "periodic", period_ns: 1e7, running: true, components: [name] })),
    ports: names.flatMap((_, i) => [port(i, "in", "input", i % 10 > 1 ? [of(i - 1)] : []), port(i, "out", "output", i % 10 > 0 && i % 10 < 9 ? [of(i)] : [])]) };
}

function systemOf(count) {
  const pids = Array.from({ length: count }, (_, i) => 100 + i);
  return { ...real, links: [], verdict: { level: "well", text: "All is well", reason: "made up", findings: 0, worst: [] },
    hosts: pids.map((pid, i) => ({ pid, program: "rtm_host", links: [], stopped: false, cpu_percent: 1, resident_bytes: 2 ** 24, threads: 3, busiest_threads: [], inventory: inventory(i) })),
    components: pids.flatMap((pid, i) => Array.from({ length: each }, (_, k) => ({ name: `Comp${i}x${k}`, program: "rtm_host", pid, state: i === 2 && k === 77 ? "error" : "active", in_cycle_s: 0 }))),
    ticks: [], events: [], refused_connections: [] };
}

before(async () => {
  monitor = await startMonitor([`made-up-${process.pid}`]);
  real = await (await fetch(new URL("api/state", monitor.url))).json();
  state = systemOf(hosts);
  browser = await startBrowser([]);
  page = await browser.open();
  tools = await page.context().newCDPSession(page);
  await tools.send("Performance.enable", { timeDomain: "threadTicks" }); // which other programs do not stretch
  await page.routeWebSocket(/api\/live/, (socket) => {
    const timer = setInterval(() => socket.send(JSON.stringify({ ...state, time_ms: Date.now() })), 500).unref();
    socket.onClose(() => clearInterval(timer));
  });
  const began = performance.now();
  await page.goto(monitor.url);
  await page.waitForSelector("#graph .component");
  console.log(`the graph of ${hosts * each} components is drawn after ${(performance.now() - began).toFixed(0)} ms`);
});
after(async () => {
  await browser?.close();
  await cleanUp();
});

const names = () => page.locator("#graph .component .name").allTextContents();
const boxes = (count) => page.waitForFunction((wanted) => document.querySelectorAll("#graph .component").length === wanted, count);
/** Prints what the page's thread computes while something is done. A machine under load is slow, so times are not asserted. */
async function during(name, action) {
  const now = async () => Object.fromEntries((await tools.send("Performance.getMetrics")).metrics.map(({ name: of, value }) => [of, value * 1000]));
  const before = await now();
  await action();
  const after = await now();
  console.log(`${name}: ${["Task", "Script", "Layout"].map((of) => `${of} ${(after[`${of}Duration`] - before[`${of}Duration`]).toFixed(0)} ms`).join(", ")}`);
}

test("the hosts of 1,000 components are initially folded, and show what has failed", async () => {
  assert.deepEqual((await names()).sort(), ["249 more components", "250 components", "250 components", "250 components", "Comp2x77"]);
  assert.equal(await page.locator("#graph .component.failed").count(), 1);
  const places = await page.locator("#graph .host > rect:first-child").evaluateAll((boxes) => boxes.map((box) => box.getBoundingClientRect().toJSON()));
  const right = await page.locator("#graph").evaluate((part) => part.getBoundingClientRect().right);
  assert.ok(new Set(places.map(({ y }) => Math.round(y))).size < hosts && places.every((place) => place.right <= right), JSON.stringify(places)); // side by side
  assert.match(await page.locator("#graph-note").textContent(), /^4 of 4 hosts are folded; all hosts have 1000 components$/);
  await during("folded, 3 s at rest", () => page.waitForTimeout(3000));
  await page.screenshot({ path: join(pictures, "graph-folded.png") });
});

test("a found component of a folded host is marked and in view", async () => {
  await page.locator("body").press("/");
  await page.keyboard.type("comp3x12");
  await page.waitForFunction(() => /^1 of 11$/.test(document.querySelector("#graph-found").textContent));
  assert.equal(await page.locator("#graph .component.found").count(), 11);
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => /^2 of 11$/.test(document.querySelector("#graph-found").textContent));
  await page.waitForFunction(() => {
    const box = [...document.querySelectorAll("#graph .component.found")].find((each) => each.querySelector(".name").textContent === "Comp3x120");
    const is = box?.getBoundingClientRect(), part = document.querySelector("#graph").getBoundingClientRect();
    return is && is.top >= part.top && is.bottom <= part.bottom && is.left >= part.left && is.right <= part.right;
  });
  await page.locator("#graph-search").fill("nobody");
  await page.waitForFunction(() => document.querySelector("#graph-found").textContent === "nothing found");
  await page.locator("#graph-search").fill("");
  await boxes(5);
});

test("a host unfolds by the keyboard, and draws only what is in view", async () => {
  const fold = page.getByRole("button", { name: "Unfold RTM host rtm_host" }).first();
  await fold.focus();
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.querySelectorAll("#graph .component").length > 20);
  await page.locator("#graph-fold").click();
  await page.waitForFunction(() => document.querySelector("#graph-fold").textContent === "Fold all");
  await page.waitForFunction(() => document.querySelectorAll("#graph .host").length === 4 && document.querySelectorAll("#graph .component").length > 20);
  await during("unfolded, 3 s at rest", () => page.waitForTimeout(3000));
  const drawn = await page.locator("#graph .component").count();
  assert.ok(drawn < 300, `${drawn} components`);
  await page.locator("#graph").focus();
  await page.keyboard.press("0");
  await boxes(1000);
  assert.equal(await page.locator("#graph .port").count(), 0); // too small to read
  await page.screenshot({ path: join(pictures, "graph-whole.png") });
});

test("states do not move what is drawn, and the graph is saved with all components", async () => {
  const places = () => page.locator("#graph").evaluate((graph) => [...graph.querySelectorAll(".component rect")].map((box) => `${box.getAttribute("x")} ${box.getAttribute("y")}`).join());
  const before = await places();
  state = { ...state, components: state.components.map((each) => ({ ...each, state: each.name === "Comp2x77" ? "active" : each.name === "Comp1x5" ? "inactive" : each.state })) };
  await page.waitForSelector("#graph .component.inactive");
  assert.equal(await places(), before);
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#graph-save").click()]);
  assert.equal(download.suggestedFilename(), "tandem-graph.svg");
  const file = join(pictures, "graph.svg");
  await download.saveAs(file);
  const text = readFileSync(file, "utf8");
  assert.equal(text.match(/>Comp\dx\d+</g).length, 1000);
  assert.ok(!/ class=| style=|var\(|href/.test(text));
  assert.ok(/<text[^>]* fill="rgb\(\d+, \d+, \d+\)"[^>]*>Comp1x5</.test(text));
  await page.locator("#graph-fold").click();
  await boxes(4);
});

test("wheel, keys and buttons zoom, and the point below the pointer stays where it is", async () => {
  const box = () => page.locator("#graph .component").first().evaluate((each) => { const { x, y, width } = each.firstChild.getBoundingClientRect(); return { x, y, width }; });
  const before = await box();
  await page.mouse.move(before.x, before.y);
  await page.mouse.wheel(0, -200);
  await page.waitForFunction((width) => document.querySelector("#graph .component rect").getBoundingClientRect().width > 1.2 * width, before.width);
  const after = await box();
  assert.ok(Math.abs(after.x - before.x) < 3 || after.width > 1.2 * before.width, JSON.stringify([before, after]));
  await page.locator("#graph").focus();
  await page.keyboard.press("+");
  assert.ok((await box()).width > 1.2 * after.width);
  await page.keyboard.press("-");
  assert.ok(Math.abs((await box()).width - after.width) < 1);
  await page.getByRole("button", { name: "Zoom in" }).click();
  assert.ok((await box()).width > 1.2 * after.width);
  await page.locator("#graph").focus();
  for (let i = 0; i < 8; ++i) await page.keyboard.press("+");
  const left = await page.locator("#graph").evaluate((part) => part.scrollLeft);
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction((old) => document.querySelector("#graph").scrollLeft > old, left);
  assert.deepEqual(page.errors, []);
});
