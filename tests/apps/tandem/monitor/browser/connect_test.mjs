// SPDX-License-Identifier: Apache-2.0
// A person with the token connects ports in the graph, by the mouse and by the keyboard, and ends a connection.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { cleanUp, start, startBrowser, startMonitor } from "./robot.mjs";

const pictures = process.env.TANDEM_PICTURES;
const startChair = () => start(join(process.env.TANDEM_BIN, "wheelchair"), ["--config", "rtm", "--scenario", "s_curve", "--duration", "300"]).line(/rtm_host pid (\d+)/);
let monitor, browser, page;

before(async () => {
  await startChair();
  monitor = await startMonitor([], 0, ["--control"]);
  browser = await startBrowser([]);
  page = await browser.open(monitor.url);
  await page.waitForSelector("#graph-control:not([hidden])");
  await port("ControlComp0", "reference").waitFor();
});
after(async () => {
  await browser?.close();
  await cleanUp();
});

const port = (component, name) => page.locator(`#graph .port[data-port="${component}.${name}"]`);
const text = (id) => page.locator(id).textContent();
const fitIs = (pattern) => page.waitForFunction((wanted) => new RegExp(wanted).test(document.querySelector("#connection-fit").textContent), pattern.source);
const answerIs = (pattern) => page.waitForFunction((wanted) => new RegExp(wanted).test(document.querySelector("#graph-control .system-answer").textContent), pattern.source);
const edge = () => page.locator("#graph .edge", { has: page.locator("title", { hasText: /^reference → reference / }) });

async function drag(from, to) {
  await from.locator("circle").hover();
  await page.mouse.down();
  await to.locator("circle").hover();
  assert.equal(await page.locator("#graph .rubber").count(), 1);
  await page.mouse.up();
  assert.equal(await page.locator("#graph .rubber").count(), 0);
}

test("two ports that do not fit say why after a drag", async () => {
  await drag(port("JoystickComp0", "reference"), port("HWComp0", "wheelSpeed"));
  await fitIs(/^✕ They cannot be connected: both are OutPorts: one of them must receive\.$/);
  assert.equal(await page.locator("#connection-make").isVisible(), false);
  await page.keyboard.press("Escape");
  assert.equal(await page.locator("#connection-dialog").isVisible(), false);
});

test("a connection is chosen and ended, and the graph and the answer show it", async () => {
  await edge().focus();
  await page.keyboard.press("Enter");
  await page.getByRole("button", { name: /^Disconnect JoystickComp0.reference → ControlComp0.reference$/ }).click();
  await answerIs(/^✓ Disconnect JoystickComp0.reference → ControlComp0.reference: done$/);
  await page.waitForFunction(() => ![...document.querySelectorAll("#graph .edge title")].some(({ textContent }) => textContent.startsWith("reference → reference ")));
  assert.equal(await page.locator("#connection-dialog").isVisible(), false);
});

test("a drag from port to port offers what both support, and connects them", async () => {
  await drag(port("JoystickComp0", "reference"), port("ControlComp0", "reference"));
  await fitIs(/^✓ The ports fit\. Both support dataflow type push, pull; subscription type flush, new, periodic; interface type corba_cdr/);
  assert.match(await text("#connection-ports"), /fromJoystickComp0.reference  TimedDoubleSeqtoControlComp0.reference/);
  await page.screenshot({ path: join(pictures, "connect.png") });
  await page.locator("#connection-properties select[name=subscription_type]").selectOption("new");
  await page.locator("#connection-make").click();
  await answerIs(/^✓ Connect JoystickComp0.reference and ControlComp0.reference: done$/);
  await edge().waitFor();
  const isChosen = () => page.evaluate(() => /push.*new|new.*push/.test(document.querySelector("#connection-list").textContent));
  for (let i = 0; i < 30 && !await isChosen(); ++i) { // a new layout may move the line before the click
    const [x, y] = await edge().locator(".line").evaluate((line) => {
      const at = line.getPointAtLength(line.getTotalLength() / 2).matrixTransform(line.getScreenCTM());
      return [at.x, at.y];
    });
    await page.mouse.click(x, y);
    await page.waitForTimeout(1000);
  }
  assert.ok(await isChosen());
  await page.keyboard.press("Escape");
});

test("the keyboard connects, marks the ports that fit, and undo ends the connection", async () => {
  await page.locator("#graph-control .system-undo").click(); // of the connection before
  await answerIs(/^✓ Undo: disconnect JoystickComp0.reference and ControlComp0.reference: done$/);
  await port("JoystickComp0", "reference").focus();
  await page.keyboard.press("c");
  assert.match(await text("#graph-choice"), /^Connect JoystickComp0.reference: choose the other port/);
  await page.waitForSelector('#graph .port.fits[data-port="ControlComp0.reference"]');
  assert.equal(await page.locator('#graph .port.unfit[data-port="HWComp0.wheelSpeed"]').count(), 1);
  await page.keyboard.press("Escape");
  assert.match(await text("#graph-choice"), /^To connect two ports/);
  await page.keyboard.press("c");
  await port("ControlComp0", "reference").focus();
  await page.keyboard.press("Enter");
  await fitIs(/^✓ The ports fit/);
  await page.keyboard.press("Enter");
  await answerIs(/^✓ Connect JoystickComp0.reference and ControlComp0.reference: done$/);
  await edge().waitFor();
  assert.deepEqual(page.errors, []);
});

test("Esc ends a drag, and what is released then connects nothing", async () => {
  await port("JoystickComp0", "reference").locator("circle").hover();
  await page.mouse.down();
  await port("ControlComp0", "reference").locator("circle").hover();
  await page.keyboard.press("Escape");
  await page.mouse.up();
  assert.equal(await page.locator("#graph .rubber").count(), 0);
  assert.equal(await page.locator("#connection-dialog").isVisible(), false);
  assert.deepEqual(page.errors, []);
});

test("a change that a host refuses is told in the form", async () => {
  const host = page.locator("#connection-dialog .system-answer");
  await port("JoystickComp0", "reference").press("c");
  await port("ControlComp0", "reference").press("Enter");
  await fitIs(/^✕ They cannot be connected: they are connected\.$/);
  assert.equal(await host.textContent(), "");
  await page.keyboard.press("Escape");
});

test("the graph holds still as long as the pointer is down on a port", async () => {
  const hosts = page.locator("#graph .host"), shown = await hosts.count();
  await port("JoystickComp0", "reference").locator("circle").hover();
  await page.mouse.down();
  const [, pid] = await startChair();
  const isListed = async () => (await (await fetch(new URL("api/state", monitor.url))).json()).hosts.some((host) => host.pid === Number(pid));
  while (!await isListed()) await page.waitForTimeout(50);
  await page.waitForTimeout(1000); // several states
  assert.equal(await hosts.count(), shown);
  await page.mouse.up();
  await hosts.nth(shown).waitFor();
  assert.deepEqual(page.errors, []);
});
