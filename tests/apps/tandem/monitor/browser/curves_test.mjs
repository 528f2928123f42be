// SPDX-License-Identifier: Apache-2.0
// 20 curves of messages at 100 Hz, of a made-up system: each plot is drawn once in each frame, and computed once for new messages.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { cleanUp, startBrowser, startMonitor } from "./robot.mjs";

const ports = 4, numbers = 5, rate = 100, look = 40; // Hz; ms between two answers, as of the monitor
const seconds = Number(process.env.TANDEM_CURVES_SECONDS ?? 0); // how long memory is watched
let monitor, browser, page, real;

const names = Array.from({ length: numbers }, (_, i) => `data[${i}]`);
const nameOf = (i) => `port${i}`;

function state() {
  const idle = { readable: true, reason: "", damage: "", memory_bytes: 1, generation: 1, call_queues: [], shared_ports: [] };
  const side = { pid: 1, state: "joined", model: "OPRoS" };
  const list = Array.from({ length: ports }, (_, i) => ({ name: nameOf(i), owner: "first", writer: "first", type: "{dS}", value: { data: names.map(() => 0) },
    sent_per_s: rate, sent: 1, received: 1, waiting: 0, silent_s: 0, age: null, recently: {}, lost: {}, component: "Made" }));
  return { ...real, time_ms: Date.now(), links: [{ name: "made", ...idle, sides: { first: side, second: side }, ports: list }] };
}

/** Sends samples as the monitor does: `begun` at the first request, all that are due each time. */
function feed(socket) {
  const begun = Date.now();
  let sent = 0;
  const timer = setInterval(() => {
    const due = Math.floor((Date.now() - begun) * rate / 1000), rows = [];
    for (; sent < due; ++sent)
      rows.push([sent + 1, begun + sent * 1000 / rate, ...names.map((_, i) => Math.sin((sent + 10 * i) / 50) * (i + 1))]);
    socket.send(JSON.stringify({ time_ms: Date.now(), ports: Array.from({ length: ports }, (_, i) => ({ link: "made", owner: "first", port: nameOf(i), names, samples: rows })) }));
  }, look).unref();
  socket.onClose(() => clearInterval(timer));
}

before(async () => {
  monitor = await startMonitor([`made-up-${process.pid}`]);
  real = await (await fetch(new URL("api/state", monitor.url))).json();
  browser = await startBrowser([]);
  page = await browser.open(undefined, { viewport: { width: 1280, height: 1400 } });
  await page.routeWebSocket(/api\/live/, (socket) => {
    const timer = setInterval(() => socket.send(JSON.stringify(state())), 200).unref();
    socket.onClose(() => clearInterval(timer));
  });
  await page.routeWebSocket(/api\/samples/, feed);
  await page.addInitScript((plots) => sessionStorage.setItem("tandem-plots", JSON.stringify(plots)),
    Array.from({ length: ports }, (_, i) => ({ seconds: 10, range: null, own: true, curves: names.map((name) => ({ key: `made/first/${nameOf(i)}`, name, form: "value" })) })));
  await page.goto(monitor.url);
  await page.locator("#plots-anchor").click();
  await page.waitForFunction((count) => document.querySelectorAll(".plot canvas").length === count, ports);
  await page.waitForTimeout(2000);
});
after(async () => {
  await browser?.close();
  await cleanUp();
});

/** Counts frames, and what each draws and computes, for so many frames. */
const count = (frames) => page.evaluate((wanted) => new Promise((resolve) => {
  const found = { frames: 0, draws: 0, most: 0, sorts: 0 }, context = CanvasRenderingContext2D.prototype, clear = context.clearRect;
  let inFrame = 0;
  context.clearRect = function (...of) {
    ++inFrame;
    ++found.draws;
    return clear.apply(this, of);
  };
  const began = performance.now();
  const frame = () => {
    found.most = Math.max(found.most, inFrame);
    inFrame = 0;
    if (++found.frames <= wanted) return requestAnimationFrame(frame);
    context.clearRect = clear;
    resolve({ ...found, perSecond: 1000 * found.frames / (performance.now() - began) });
  };
  requestAnimationFrame(frame);
}), frames);

// A machine under load has fewer frames, so their rate is printed and not asserted.
test("each plot is drawn once in each frame", async () => {
  const client = await page.context().newCDPSession(page);
  await client.send("Performance.enable", { timeDomain: "threadTicks" }); // processor time, not that of the clock
  const metrics = async () => Object.fromEntries((await client.send("Performance.getMetrics")).metrics.map(({ name, value }) => [name, value]));
  const before = await metrics(), found = await count(120), after = await metrics();
  const each = (name) => (1000 * (after[name] - before[name]) / found.frames).toFixed(2);
  console.log(`${found.perSecond.toFixed(1)} frames per second; for each ${each("TaskDuration")} ms of a core in the page, of which ${each("ScriptDuration")} ms in scripts`);
  assert.ok(found.most <= ports, `${found.most} draws in one frame`);
  assert.ok(found.draws >= 0.9 * ports * found.frames, `${found.draws} draws in ${found.frames} frames`);
  assert.deepEqual(page.errors, []);
});

test("memory does not grow with the time that curves run", { skip: seconds === 0 && "set TANDEM_CURVES_SECONDS" }, async () => {
  const client = await page.context().newCDPSession(page), used = [];
  for (let at = 0; at <= seconds; at += 30) {
    await client.send("HeapProfiler.collectGarbage");
    used.push((await client.send("Runtime.getHeapUsage")).usedSize / 1e6);
    console.log(`${at} s: ${used.at(-1).toFixed(2)} MB`);
    await page.waitForTimeout(30_000);
  }
});
