// SPDX-License-Identifier: Apache-2.0
// Plots as a control engineer uses them: a port's signals at its own rate, single numbers of several ports, a pause, an enlarged
// part, a fixed range, derived curves, and gaps.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { cleanUp, startBrowser, startMonitor, startWheelchair } from "./robot.mjs";

const pictures = process.env.TANDEM_PICTURES;
let chair, monitor, browser, page;
const samples = new Map(); // by port: numbers of the messages

before(async () => {
  chair = await startWheelchair();
  monitor = await startMonitor([chair.link, `${chair.link}-chair`]);
  browser = await startBrowser([]);
  page = await browser.open(undefined, { viewport: { width: 1280, height: 800 } });
  page.on("websocket", (socket) => socket.url().includes("/api/samples") && socket.on("framereceived", ({ payload }) => {
    for (const { port, samples: rows } of JSON.parse(payload).ports ?? []) samples.set(port, [...samples.get(port) ?? [], ...rows.map((row) => row[0])]);
  }));
  await page.goto(monitor.url);
  await page.waitForSelector("#graph .edge");
});
after(async () => {
  await browser?.close();
  await cleanUp();
});

const curves = (card = 0) => page.locator(".plot-card").nth(card).locator(".entry .name").allTextContents();
const curvesAre = (names, card = 0) => page.waitForFunction(([wanted, at]) =>
  JSON.stringify([...document.querySelectorAll(".plot-card")[at]?.querySelectorAll(".entry .name") ?? []].map((name) => name.textContent)) === wanted,
[JSON.stringify(names), card]);
const bar = (text) => page.locator(".plot-card").first().locator(".plot-bar").getByRole("button", { name: text });
const isDrawn = (card = 0) => page.waitForFunction((at) => {
  const canvas = document.querySelectorAll(".plot-card")[at]?.querySelector(".plot canvas");
  return canvas && canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.some((byte) => byte !== 0);
}, card);

test("a click on a port opens its plot in view: its signals, without time stamp and sequence number", async () => {
  await page.locator("#graph .port[role=button]", { hasText: "reference" }).first().click();
  await curvesAre(["data[2]", "data[3]"]);
  await isDrawn();
  const box = await page.locator(".plot-card .plot").boundingBox();
  assert.ok(box.y >= 0 && box.y + box.height <= 800, JSON.stringify(box));
  assert.match(await page.locator("#values-title").textContent(), /^Newest message of reference/);
  await page.waitForFunction((kinds) => [...document.querySelectorAll("#member-tree [aria-pressed]")].map((member) => member.textContent).join() === kinds,
    ["tm.sec time stamp", "tm.nsec time stamp", "data[0] time stamp", "data[1] sequence number", "data[2]", "data[3]"].join());
});

test("every message of the port is plotted", async () => {
  samples.clear();
  while ((samples.get("reference")?.length ?? 0) < 100) await page.waitForTimeout(100); // the test has a time limit
  const numbers = samples.get("reference");
  numbers.forEach((number, i) => assert.ok(i === 0 || number === numbers[i - 1] + 1, `${number} after ${numbers[i - 1]}`));
});

test("numbers of another port are added by name or by dragging, and removed", async () => {
  await page.locator("#member-filter").fill("joystickPos");
  await page.getByRole("button", { name: "numbers of joystickPos" }).click();
  const member = (name) => page.locator("#member-tree ul button", { hasText: name });
  await member("data[2]").click();
  await curvesAre(["reference.data[2]", "reference.data[3]", "joystickPos.data[2]"]);
  await member("data[3]").dragTo(page.locator(".plot-card .plot").first());
  await curvesAre(["reference.data[2]", "reference.data[3]", "joystickPos.data[2]", "joystickPos.data[3]"]);
  await page.waitForFunction(() => document.querySelectorAll('#member-tree ul [aria-pressed="true"]').length === 2);
  await page.locator(".plot-card .remove").nth(3).click();
  await page.waitForFunction(() => document.querySelectorAll(".plot-card .entry").length === 3);
  await page.locator("#plots-section").screenshot({ path: join(pictures, "plots.png") });
});

test("a port chosen next gets a separate plot, and all survive a reload", async () => {
  await page.locator("#member-filter").fill("chair");
  await page.locator("#member-tree .port-name").first().click();
  await page.waitForFunction(() => document.querySelectorAll(".plot-card").length === 2 && document.querySelector(".plot-card .entry"));
  assert.ok((await curves()).length >= 2);
  assert.equal((await curves(1)).length, 3);
  await page.reload();
  await page.waitForFunction(() => document.querySelectorAll(".plot-card")[1]?.querySelectorAll(".entry").length === 3);
  await bar("Remove").click();
  await page.waitForFunction(() => document.querySelectorAll(".plot-card").length === 1);
});

test("a plot pauses, shows an enlarged part and the values at the cursor, and goes on", async () => {
  const plot = page.locator(".plot-card .u-over").first(), value = page.locator(".plot-card .entry b").first();
  await page.waitForTimeout(2000);
  await plot.hover({ position: { x: 400, y: 100 } });
  const box = await plot.boundingBox();
  await page.mouse.move(box.x + 300, box.y + 40);
  await page.mouse.down();
  await page.mouse.move(box.x + 500, box.y + 160, { steps: 4 });
  await page.mouse.up();
  await bar("Live").waitFor();
  const still = await value.textContent();
  await page.waitForTimeout(500);
  assert.equal(await value.textContent(), still);
  await bar("Live").click();
  await bar("Pause").waitFor();
  await bar("Pause").click();
  await bar("Live").waitFor();
  await bar("Live").click();
});

test("the range of values is fixed, and derived curves are added", async () => {
  const card = page.locator(".plot-card").first();
  await card.getByLabel("values").selectOption("fixed");
  await card.getByLabel("lowest value").fill("-5");
  await card.getByLabel("highest value").fill("5");
  await card.getByLabel("highest value").press("Enter");
  await card.getByLabel("add").selectOption({ label: "d/dt reference.data[2]" });
  await card.getByLabel("add").selectOption({ label: "reference.data[3] − reference.data[2]" });
  await page.waitForFunction(() => [...document.querySelectorAll(".plot-card .entry .name")].slice(-2).map((name) => name.textContent).join() ===
    "d/dt reference.data[2],reference.data[3] − reference.data[2]");
  assert.deepEqual(page.errors, []);
});

test("missing messages and silence are gaps; derivative and difference are computed at the samples", async () => {
  const result = await page.evaluate(async () => {
    const { Track, kindByValues } = await import("./samples.js");
    const { align, curveId, pointsOf } = await import("./curves.js");
    const a = new Track("l/first/a"), b = new Track("l/first/b");
    for (const [sequence, time, value] of [[1, 1000, 0], [2, 1010, 1], [5, 1040, 4], [6, 1050, 5], [7, 5000, 6]]) a.append(sequence, time, ["x"], [value]);
    for (const [sequence, time] of [[1, 1005], [2, 1015]]) b.append(sequence, time, ["x"], [10 * sequence]);
    const store = { tracks: new Map([["l/first/a", a], ["l/first/b", b]]) };
    const curve = (more) => ({ key: "l/first/a", name: "x", form: "value", ...more });
    const points = (curve) => pointsOf(store, curve, 0, 9000);
    const less = (key) => curveId(curve({ form: "difference", minus: { key, name: "x" } }));
    const range = (count, of) => Float64Array.from({ length: count }, (_, i) => of(i));
    const ramp = range(60, (i) => 10 * i), numbers = range(60, (i) => i + 1);
    return {
      values: align([points(curve())]),
      both: align([points(curve()), points(curve({ key: "l/first/b" }))]),
      slope: [...points(curve({ form: "derivative" })).y],
      less: [...points(curve({ form: "difference", minus: { key: "l/first/b", name: "x" } })).y],
      apart: less("l/first/b") !== less("l/first/c"),
      kinds: [kindByValues(ramp, ramp.map((time) => time / 1000), numbers), kindByValues(ramp, numbers.map((number) => number + 7), numbers),
        kindByValues(ramp, ramp.map(Math.sin), numbers), kindByValues(ramp.slice(0, 3), ramp, numbers)],
    };
  });
  assert.deepEqual(result.values, [[1, 1.01, 1.025, 1.04, 1.05, 3.025, 5], [0, 1, null, 4, 5, null, 6]]);
  assert.deepEqual(result.both[2].map((value) => value ?? null), [null, 10, null, 20, null, null, null, null, null]);
  assert.deepEqual(result.slope.map((value) => Number.isNaN(value) ? null : Math.round(value)), [null, 100, null, null, 100, null, null]);
  assert.deepEqual(result.less.map((value) => Number.isNaN(value) ? null : value), [null, -9, null, -16, -15, null, -14]);
  assert.ok(result.apart);
  assert.deepEqual(result.kinds, ["time", "sequence", "signal", null]);
});

test("the plots of a long run keep their memory", async () => {
  const sizes = await page.evaluate(async () => {
    const { Track } = await import("./samples.js");
    const track = new Track("l/first/a");
    for (let i = 1; i <= 200_000; ++i) track.append(i, i, ["x"], [i]);
    return [track.size <= 72_000, track.times.length, track.columns.get("x")[track.size - 1], track.times[track.indexOf(199_000)]];
  });
  assert.deepEqual(sizes, [true, 72_000, 200_000, 199_000]);
});

test("the numbers of a port that come and go do not take more and more memory", async () => {
  const [columns, kept, newest] = await page.evaluate(async () => {
    const { Track } = await import("./samples.js");
    const track = new Track("l/first/a");
    for (let i = 1; i <= 3000; ++i) track.append(i, i, ["x", `list[${i}]`], [i, -i]);
    return [track.columns.size, track.columns.get("x")[0], track.columns.get("list[3000]")[track.size - 1]];
  });
  assert.ok(columns <= 128, `${columns} columns`);
  assert.deepEqual([kept, newest], [1, -3000]);
});

test("the steering angle is plotted at 100 Hz, two clicks after the page was opened", async () => {
  const opened = await browser.open();
  const times = [];
  opened.on("websocket", (socket) => socket.url().includes("/api/samples") && socket.on("framereceived", ({ payload }) => {
    for (const { port, samples: rows } of JSON.parse(payload).ports ?? []) if (port === "chair") times.push(...rows.map((row) => row[1]));
  }));
  await opened.goto(monitor.url);
  await opened.locator("#chair-anchor").click();
  await opened.waitForFunction(() => document.querySelector("#steering .name")?.textContent === "steering_deg");
  while (times.length < 100) await opened.waitForTimeout(100); // the test has a time limit
  const periods = times.slice(1).map((time, i) => time - times[i]).sort((a, b) => a - b);
  assert.ok(periods[50] > 9 && periods[50] < 11, `a period of ${periods[50]} ms`);
  await opened.close();
});
