// SPDX-License-Identifier: Apache-2.0
// The page for everyone: contrast, names for screen readers, the keyboard, little motion, and 1,000 components, of a made-up state.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { cleanUp, startBrowser, startMonitor } from "./robot.mjs";

const components = 1000, views = ["graph", "plots", "links", "ticks", "events", "control"];
let monitor, browser, page, shown, real;

/** As the monitor has it, with other components. */
function state() {
  const all = Array.from({ length: components }, (_, i) => ({ name: `Comp${i}`, program: "rtm_host", pid: 7, state: i === 3 ? "error" : "active", in_cycle_s: 0 }));
  return { ...real, time_ms: Date.now(), verdict: { level: "failed", text: "A component has failed", reason: "Comp3 of rtm_host (pid 7) is in ERROR", findings: 1, worst: [] },
    control: { allowed: true, recording: "/home/a/tandem-20260102-030405.mcap", recording_since_ms: Date.now() - 5000 }, components: all,
    ticks: all.map(({ name, pid }, slot) => ({ name, slot, program: "rtm_host", pid, period_ns: 1e7, ticks_per_s: 100, ticks: 5, overruns: 0, overruns_recently: 0, skipped: 0, latest_ns: 1e3, hang: null, lateness: null, execution: null, longest_ns: 1e3 })),
    events: [{ number: 1, time_ms: Date.now(), bad: true, link: "a", text: "Comp3 has failed" }] };
}

async function open(options) {
  const opened = await browser.open(undefined, options);
  await opened.routeWebSocket(/api\/live/, (socket) => {
    const timer = setInterval(() => socket.send(JSON.stringify(state())), 200).unref(); // the end does not wait for it
    socket.onClose(() => clearInterval(timer));
  });
  const began = performance.now();
  await opened.goto(monitor.url);
  await opened.waitForSelector("#verdict.failed");
  shown = performance.now() - began;
  await opened.waitForSelector("#control-form:not([hidden])", { state: "attached" });
  return opened;
}

before(async () => {
  monitor = await startMonitor([`made-up-${process.pid}`], 0, ["--control"]);
  real = await (await fetch(new URL("api/state", monitor.url))).json();
  browser = await startBrowser([]);
  page = await open();
});
after(async () => {
  await browser?.close();
  await cleanUp();
});

// A machine under load is slow, so the time is printed and not asserted.
test("1,000 components are shown, and the verdict names the one that has failed", async () => {
  console.log(`the verdict on ${components} components is shown after ${shown.toFixed(0)} ms`);
  await page.locator("#ticks-anchor").click();
  await page.waitForFunction(() => document.querySelector("#ticks").getAttribute("aria-rowcount") === "1001");
  const rows = await page.locator("#ticks tbody:not(.space) tr").count();
  assert.ok(rows > 10 && rows < 100, `${rows} rows`);
  assert.match(await page.locator("#verdict .reason").textContent(), /Comp3/);
  assert.match(await page.locator("#recording-now").textContent(), /^● Recording, \d+ s$/);
  assert.deepEqual(page.errors, []);
});

test("texts have the contrast of WCAG AA, and curves that of graphics, by day and in the dark", async () => {
  const low = [];
  for (const colorScheme of ["light", "dark"]) {
    await page.emulateMedia({ colorScheme });
    low.push(...await page.evaluate((scheme) => {
      const style = getComputedStyle(document.documentElement);
      const light = (name) => {
        const [red, green, blue] = style.getPropertyValue(`--${name}`).trim().match(/\w\w/g).map((digits) => parseInt(digits, 16) / 255)
          .map((part) => part <= 0.03928 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4);
        return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
      };
      const contrast = (a, b) => (Math.max(light(a), light(b)) + 0.05) / (Math.min(light(a), light(b)) + 0.05);
      const texts = { text: ["page", "panel", "good-panel", "warn-panel", "bad-panel"], faint: ["page", "panel"], good: ["panel", "good-panel"],
        warn: ["page", "panel", "warn-panel"], bad: ["page", "panel", "bad-panel"], accent: ["page", "panel"], panel: ["accent"], "bad-panel": ["bad"] };
      const found = Object.entries(texts).flatMap(([of, on]) => on.map((each) => [of, each, contrast(of, each), 4.5]));
      for (let i = 0; i < 6; ++i) for (const on of ["page", "panel"]) found.push([`curve${i}`, on, contrast(`curve${i}`, on), 3]);
      return found.filter(([, , is, least]) => is < least).map(([of, on, is]) => `${scheme}: ${of} on ${on} ${is.toFixed(2)}`);
    }, colorScheme));
  }
  assert.deepEqual(low, []);
});

test("every control and picture has a name for screen readers", async () => {
  for (const name of views) {
    await page.locator(`#${name}-anchor`).click();
    await page.waitForTimeout(300);
    const unnamed = await page.evaluate(() => [...document.querySelectorAll("button, input, select, a, [role=img], [role=region], [tabindex='0']")]
      .filter((each) => each.offsetParent !== null && !each.matches("h1, #main") && !(each.textContent.trim() && !each.matches("select, [role=img], [role=region]")) &&
        !each.ariaLabel && !each.querySelector(":scope > title") && !each.getAttribute("aria-labelledby") && !(each.labels?.length > 0)).map((each) => each.outerHTML.slice(0, 120)).slice(0, 5));
    assert.deepEqual(unnamed, [], name);
  }
});

test("the keyboard alone reaches the views, the recording and the commands", async () => {
  await page.locator("#graph-anchor").click();
  await page.locator("body").press("Tab");
  await page.locator("#graph-anchor").focus();
  await page.keyboard.press("End");
  assert.equal(await page.evaluate(() => document.activeElement.id), "control-anchor");
  const reached = [];
  for (let i = 0; i < 12; ++i) {
    await page.keyboard.press("Tab");
    reached.push(await page.evaluate(() => `${document.activeElement.id} ${getComputedStyle(document.activeElement).outlineStyle}`));
  }
  for (const id of ["record", "system-filter", "system-refresh"]) assert.ok(reached.includes(`${id} solid`), `${id} in ${reached}`);
});

test("who wants little motion gets none from buttons", async () => {
  const calm = await open({ reducedMotion: "reduce" });
  assert.equal(await calm.locator("#record").evaluate((button) => getComputedStyle(button).transitionDuration), "0s");
  await calm.close();
});
