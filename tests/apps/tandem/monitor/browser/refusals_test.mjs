// SPDX-License-Identifier: Apache-2.0
// What is refused, fails or gets no answer is told on the page, in words that name it.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { cleanUp, startBrowser, startMonitor } from "./robot.mjs";

let monitor, browser, page, samples;

before(async () => {
  monitor = await startMonitor([`made-up-${process.pid}`]);
  browser = await startBrowser([]);
  page = await browser.open();
  await page.routeWebSocket(/api\/samples/, (socket) => { samples = socket; });
  await page.goto(monitor.url);
  await page.waitForSelector("#verdict:not(.unknown)");
});
after(async () => {
  await browser?.close();
  await cleanUp();
});

const textIs = (selector, pattern) => page.waitForFunction(([of, text]) => new RegExp(text).test(document.querySelector(of).textContent), [selector, pattern.source], { timeout: 20_000 });

test("a replay that is not stopped, and a list of recordings that fails, are told", async () => {
  await page.evaluate(async () => {
    const { RecordingsView } = await import(new URL("system/recordings_view.js", document.baseURI).href);
    const view = new RecordingsView({ token: "", connection: { open: true, ask: async ({ op }) => ({ ok: false, text: `no ${op} today` }) } });
    await view.stop();
    await view.ask();
  });
  await textIs("#failure", /^✕ The replay was not stopped: no replay today/);
  await textIs("#recordings-empty", /^✕ The recordings cannot be listed: no recordings today/);
});

test("a range whose ends are exchanged is told", async () => {
  await page.locator("#plots-anchor").click();
  await page.locator("#new-plot").click();
  await page.getByLabel("values").selectOption("fixed");
  await page.getByLabel("lowest value").fill("1000");
  await page.getByLabel("lowest value").press("Enter");
  await textIs("#plots-note", /The lowest value must be below the highest, but 1000 is not below/);
  assert.notEqual(await page.getByLabel("lowest value").inputValue(), "1000");
  await page.getByLabel("lowest value").fill("-1000");
  await page.getByLabel("lowest value").press("Enter");
  await textIs("#plots-note", /^$/);
});

test("ports whose samples are left out are told, until they are read again", async () => {
  await page.evaluate(async () => {
    const { SampleStore } = await import(new URL("samples.js", document.baseURI).href);
    const store = new SampleStore();
    store.take({ left_out: [{ link: "made", owner: "first", port: "speed" }], most: 64 });
    const told = store.refusal;
    store.take({ time_ms: 1, ports: [] });
    window.tellings = [told, store.refusal, (store.take({ left_out: [], most: 64 }), store.refusal)];
  });
  const [first, kept, last] = await page.evaluate(() => window.tellings);
  assert.match(first, /^No samples of speed: all pages together can plot 64 ports/);
  assert.equal(kept, first);
  assert.equal(last, "");
});

test("plots whose samples do not come any more are told, until they come again", async () => {
  await page.evaluate(() => sessionStorage.setItem("tandem-plots", JSON.stringify([{ seconds: 10, range: null, own: true, curves: [{ key: "made/first/out", name: "data", form: "value" }] }])));
  await page.reload();
  await page.locator("#plots-anchor").click();
  await page.waitForSelector(".plot canvas");
  while (!samples) await page.waitForTimeout(50);
  await samples.close();
  await textIs("#plots-note", /^No new samples: .* Trying again/);
  await textIs("#plots-note", /^$/);
  assert.deepEqual(page.errors, []);
});
