// SPDX-License-Identifier: Apache-2.0
// The page with a made-up state that has no numbers yet, as after a first reading, and with one in which they are not known (null).
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { cleanUp, startBrowser, startMonitor } from "./robot.mjs";

const views = ["graph", "plots", "links", "ticks", "chair", "events", "control"];
let monitor, browser, real;

const times = { samples: 5, p50_ns: 1e3, p99_ns: 2e3, max_ns: 3e3, octaves: [[1024, 5]] };
const chair = { t: 1, x: 0, y: 0, heading_deg: 0, state: 0, wheel_left: 0, wheel_right: 0, brake: 1, volts_left: 0, volts_right: 0, stick_x: 0, stick_y: 0, emergency_stop: 0 };
const port = (name, more = {}) => ({ name, owner: "first", writer: "first", component: "Arm", type: "IDL:RTC/TimedLong:1.0", sent_per_s: 9, bytes_per_s: 9, age: times,
  sent: 9, received: 9, waiting: 1, dropped: { refused: 0, overwritten: 0, skipped: 0 }, lost: 1, recently: { lost: 1, undecodable: 0, missed_deadlines: 1 }, silent_s: 0, value: null, value_note: "", ...more });
const queue = { name: "calls", owner: "first", callers: "first", calls_per_s: 1, answered_per_s: 1, round_trip: times, open_calls: 0, calls: 1, timeouts: 1, overloads: 0, cancels: 0, recently: { failed: 1 } };
const inventory = { components: [{ name: "Arm", type: "Arm", execution: "periodic", period_ns: 1e7, names: [] }], ports: [], contexts: [{ owner: "Arm", kind: "periodic", period_ns: 1e7, running: true, components: ["Arm"] }] };
const tick = (name, more = {}) => ({ name, program: "opros_host", pid: 7, period_ns: 1e7, ticks_per_s: 100, ticks: 5, overruns: 1, overruns_recently: 1, skipped: 0, latest_ns: 1e3,
  hang: null, lateness: times, longest_ns: 1e3, execution: times, ...more });

function state() {
  const side = (pid, model) => ({ pid, pid_in_other_namespace: 0, state: "alive", model, program: "host", ended_in_order: false });
  return { ...real, links: [{ name: "made", generation: 1, readable: true, reason: "", damage: "", memory_bytes: 1, sides: { first: side(7, "OPRoS"), second: side(8, "RTM") },
    ports: [port("out"), port("chair", { type: "Wheelchair::Chair", value: chair }), { name: "bad", owner: "first", damage: "of a test" }],
    call_queues: [queue, { name: "bad", owner: "first", damage: "of a test" }], shared_ports: [] }],
    hosts: [7, 8].map((pid) => ({ pid, program: "host", links: ["made"], stopped: false, cpu_percent: 1, resident_bytes: 2 ** 24, threads: 3, busiest_threads: [{ tid: pid, name: "a", cpu_percent: 1 }], inventory })),
    components: [{ name: "Arm", program: "opros_host", pid: 7, state: "active", in_cycle_s: 0 }],
    ticks: [tick("Arm"), tick("Leg", { hang: { component: "Leg", callback: "onExecute", since_ms: 1, seconds: 9 } })],
    events: [], control: { allowed: true, recording: "" } };
}

const kept = new Set(["time_ms", "pid", "tid", "since_ms", "number"]); // they tell apart, and come first
/** Returns a copy in which all numbers are what `missing` gives for them: undefined leaves them out. */
function without(value, missing) {
  if (Array.isArray(value)) return value.map((each) => typeof each === "object" ? without(each, missing) : each);
  if (value === null || typeof value !== "object") return value;
  return Object.fromEntries(Object.entries(value).map(([name, each]) => [name, typeof each === "number" && !kept.has(name) ? missing : without(each, missing)]));
}
/** Returns a copy without the parts that hold measured values. */
const withoutParts = (value) => JSON.parse(JSON.stringify(value, (name, each) => ["age", "recently", "round_trip", "lateness", "execution", "busiest_threads"].includes(name) ? undefined : each));

before(async () => {
  monitor = await startMonitor([`made-up-${process.pid}`], 0, ["--control"]);
  real = await (await fetch(new URL("api/state", monitor.url))).json();
  browser = await startBrowser([]);
});
after(async () => {
  await browser?.close();
  await cleanUp();
});

for (const [name, change] of [["all numbers", (all) => all], ["no numbers yet", (all) => without(all, undefined)], ["numbers that are not known", (all) => without(all, null)],
  ["no measured parts yet", withoutParts]])
  test(`a state with ${name} is shown in every view`, async () => {
    const page = await browser.open();
    let sent = 0;
    await page.routeWebSocket(/api\/live/, (socket) => {
      const send = () => (++sent, socket.send(JSON.stringify({ ...change(state()), time_ms: Date.now() }))), timer = setInterval(send, 100).unref();
      socket.onClose(() => clearInterval(timer));
    });
    await page.goto(monitor.url);
    await page.waitForSelector("#graph .component", { timeout: 20_000 }).catch((late) => assert.fail(page.errors[0] ?? late.message));
    for (const view of views) {
      await page.locator(`#${view}-anchor`).click();
      const before = sent;
      while (sent < before + 4) await page.waitForTimeout(50); // it has drawn some of them
      assert.ok(await page.locator(`#${view}-section`).isVisible(), view);
      assert.doesNotMatch(await page.locator("main").innerText(), /NaN|undefined|null/, view);
      assert.deepEqual(page.errors, [], view);
    }
    await page.close();
  });
