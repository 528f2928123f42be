// SPDX-License-Identifier: Apache-2.0
// A person at the page drives the wheelchair, records, and goes away.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { mkdtempSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { cleanUp, end, startBrowser, startMonitor, startWheelchair } from "./robot.mjs";

let chair, monitor, browser, page, address;
const folder = mkdtempSync(join(tmpdir(), "tandem-recording-"));

before(async () => {
  chair = await startWheelchair(["--drive"]);
  process.chdir(folder);
  monitor = await startMonitor([chair.link, `${chair.link}-chair`], 0, ["--control"]);
  address = new URL(monitor.url).origin;
  browser = await startBrowser([]);
  page = await browser.open(monitor.url);
  await page.locator("#chair-anchor").click();
});
after(async () => {
  await browser?.close();
  await cleanUp();
  rmSync(folder, { recursive: true, force: true });
});

/** The newest message of the chair, as the monitor's JSON has it. */
async function chairNow() {
  const state = await (await fetch(`${address}/api/state`)).json();
  return state.links.flatMap((link) => link.ports).find((port) => port.name === "chair")?.value;
}

async function chairUntil(holds, what) {
  for (let i = 0; i < 600; ++i) {
    const chair = await chairNow();
    if (chair && holds(chair)) return chair;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  assert.fail(`the chair never had ${what}; it has ${JSON.stringify(await chairNow())}`);
}

/** Presses at a place of the stick, in shares of its reach, and holds. */
async function hold(of, right, up) {
  await of.locator("#chair-stick").scrollIntoViewIfNeeded(); // the mouse reaches only what is in the window
  const box = await of.locator("#chair-stick .pad").boundingBox();
  await of.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await of.mouse.down();
  await of.mouse.move(box.x + box.width / 2 * (1 + right), box.y + box.height / 2 * (1 - up));
}

test("the address that is printed has the token, and it leaves the address bar", async () => {
  assert.match(monitor.url, /#token=[0-9a-f]{32}$/);
  await page.waitForSelector("#control-form:not([hidden])", { state: "attached" });
  assert.doesNotMatch(page.url(), /token/);
  assert.doesNotMatch(await (await fetch(`${address}/api/state`)).text(), new RegExp(monitor.url.split("=")[1]));
});

test("wheelchair says where to drive", () => chair.child.line(/drive with a gamepad, or run tandem monitor --control and open the view Wheelchair/));

test("the stick on the page drives the chair, and a released one stops it", async () => {
  await page.waitForSelector("#chair-stick.drives");
  await hold(page, 0, 0.6);
  await chairUntil((now) => now.stick_y > 1000 && now.stick_x === 0 && now.wheel_left > 1, "a stick to the front and turning wheels");
  await page.mouse.up();
  await chairUntil((now) => now.stick_y === 0 && now.wheel_left === 0 && now.brake === 1, "a released stick, and stood still");
  await page.waitForFunction(() => /: stands, brake closed/.test(document.querySelector("#chair-state").textContent));
});

test("arrow keys drive while they are held", async () => {
  await page.locator("#chair-stick").focus();
  await page.keyboard.down("ArrowUp");
  await page.keyboard.down("ArrowLeft");
  await chairUntil((now) => now.stick_y === 1000 && now.stick_x === 1000, "a stick to the front and left");
  await page.keyboard.up("ArrowUp");
  await page.keyboard.up("ArrowLeft");
  await chairUntil((now) => now.stick_y === 0 && now.stick_x === 0, "a released stick");
});

test("a finger drives while it is down", async () => {
  const touch = await page.context().newCDPSession(page), box = await page.locator("#chair-stick .pad").boundingBox();
  const at = (up) => [{ x: box.x + box.width / 2, y: box.y + box.height / 2 * (1 - up) }];
  await touch.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: at(0) });
  await touch.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: at(0.6) });
  await chairUntil((now) => now.stick_y > 1000, "a stick to the front");
  await touch.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  await chairUntil((now) => now.stick_y === 0 && now.stick_x === 0, "a released stick");
});

test("a gamepad at the browser drives while its stick is away from the centre, and the view is shown", async () => {
  const move = (axes) => page.evaluate((to) => {
    window.pads = to ? [null, { connected: true, axes: to }] : [];
    navigator.getGamepads = () => window.pads;
    dispatchEvent(new Event(to ? "gamepadconnected" : "gamepaddisconnected"));
  }, axes);
  await page.bringToFront();
  await move([0.03, -0.05]);
  await move([-0.5, -0.8]);
  await chairUntil((now) => now.stick_y === 1600 && now.stick_x === 1000, "a stick to the front and left");
  await page.locator("#graph-anchor").click();
  await chairUntil((now) => now.stick_y === 0 && now.stick_x === 0, "a released stick");
  await page.locator("#chair-anchor").click();
  await page.waitForTimeout(500); // a gamepad that is still held does not drive again
  assert.equal((await chairNow()).stick_y, 0);
  await move([0, 0]);
  await move([0, -0.8]);
  await chairUntil((now) => now.stick_y === 1600, "a stick to the front");
  await move(null);
  await chairUntil((now) => now.stick_y === 0 && now.stick_x === 0, "a released stick");
});

test("another chair in place of the one that has ended is not shown silently", async () => {
  const two = await browser.open(), real = await (await fetch(`${address}/api/state`)).json();
  const chairs = real.links.find((link) => link.ports.some(({ name }) => name === "chair"));
  let links = [...real.links, { ...chairs, name: "other-chair" }];
  await two.routeWebSocket(/api\/live/, (socket) => {
    const timer = setInterval(() => socket.send(JSON.stringify({ ...real, links })), 200).unref();
    socket.onClose(() => clearInterval(timer));
  });
  await two.goto(`${address}/`);
  await two.locator("#chair-anchor").click();
  await two.locator("#chair-choice").selectOption("other-chair");
  await two.waitForTimeout(500);
  assert.equal(await two.locator("#chair-ended").textContent(), "");
  links = real.links;
  await two.waitForFunction((now) => document.querySelector("#chair-ended").textContent === `✕ The wheelchair other-chair has ended. This is ${now}.`, chairs.name);
  await two.close();
});

test("the emergency stop stays in view on a phone while the page is scrolled", async () => {
  const phone = await browser.open(monitor.url, { viewport: { width: 390, height: 844 } });
  await phone.locator("#chair-anchor").click();
  await phone.waitForSelector("#drive-bar:not([hidden])");
  await phone.evaluate(() => scrollTo(0, document.documentElement.scrollHeight));
  const { y, height } = await phone.locator("#emergency").boundingBox();
  assert.ok(y >= 0 && y + height < 844, `from ${y} to ${y + height}`);
  await phone.close();
});

test("a browser that is lost while it drives stops the chair", async () => {
  const other = await startBrowser([]);
  const driver = await other.open(monitor.url);
  await driver.locator("#chair-anchor").click();
  await driver.waitForSelector("#chair-stick.drives");
  await hold(driver, -0.5, 0.8);
  await chairUntil((now) => now.stick_y > 1000 && now.wheel_left > 0.5, "a stick to the front");
  await other.kill();
  const stopped = await chairUntil((now) => now.stick_y === 0 && now.wheel_left === 0 && now.wheel_right === 0, "stood still");
  assert.equal(stopped.brake, 1);
});

test("a page without the token sees everything and drives nothing", async () => {
  const watcher = await browser.open(`${address}/`);
  await watcher.locator("#control-anchor").click();
  await watcher.waitForSelector("#token-form:not([hidden])");
  await watcher.locator("#token").fill("0".repeat(32));
  await watcher.locator("#token-form button").click();
  await watcher.waitForFunction(() => /^✕ the monitor does not accept this token/.test(document.querySelector("#token-answer").textContent));
  await watcher.locator("#chair-anchor").click();
  await hold(watcher, 0, 0.9);
  assert.equal(await watcher.locator("#chair-stick.drives").count(), 0);
  await watcher.mouse.up();
  assert.equal(await watcher.locator("#control-form:not([hidden])").count(), 0);
  assert.equal((await chairNow()).stick_y, 0);
  await watcher.close();
});

test("a command without what it needs says so, and sends nothing", async () => {
  await page.locator("#control-anchor").click();
  await page.locator("summary", { hasText: "Other commands" }).click();
  await page.locator("#control-arguments").fill(" ");
  for (const command of ["activate", "connect", "conf"]) {
    await page.locator(`#control-form button[value="${command}"]`).click();
    await page.waitForFunction((name) => document.querySelector("#control-result").textContent.startsWith(`✕ ${name}: enter `), command);
  }
});

test("the page records, and tells an RT-Component's command what it answered", async () => {
  await page.locator("#control-anchor").click();
  await page.locator("#record").click();
  await page.waitForSelector('#record[aria-pressed="true"]');
  await page.waitForTimeout(500);
  await page.locator("#control-section").screenshot({ path: join(process.env.TANDEM_PICTURES, "control.png") });
  await page.locator("#record").click();
  await page.waitForSelector('#record[aria-pressed="false"]');
  assert.equal(readdirSync(folder).filter((name) => /^tandem-.*\.mcap$/.test(name)).length, 1);
  await page.locator("#control-arguments").fill("NoSuchComponent0");
  await page.locator('#control-form button[value="activate"]').click();
  await page.waitForFunction(() => document.querySelector("#control-result").textContent.startsWith("✕ activate"));
});

test("an emergency stop without a connection is not swallowed", async () => {
  const watcher = await browser.open(`${address}/`);
  await watcher.locator("#chair-anchor").click();
  await watcher.waitForSelector("#drive-bar:not([hidden])");
  await watcher.locator("#emergency").click();
  await watcher.waitForFunction(() => /^✕ Emergency stop failed: not sent/.test(document.querySelector("#drive-answer").textContent));
  await watcher.locator("#events-anchor").click();
  assert.match(await watcher.locator("#failure:not([hidden])").textContent(), /^✕ Emergency stop failed: not sent/);
  await watcher.close();
});

test("the emergency stop stays", async () => {
  await page.locator("#chair-anchor").click();
  await page.locator("#emergency").click();
  await chairUntil((now) => now.emergency_stop === 1 && now.state === 2, "an emergency stop");
  await hold(page, 0, 0.8);
  await page.waitForTimeout(500);
  await page.mouse.up();
  assert.equal((await chairNow()).brake, 1);
  const answer = await page.locator("#drive-answer").textContent();
  assert.match(answer, /^■ Emergency stop\. It lasts until the run ends\. To drive again: press Ctrl-C where wheelchair runs/);
  await page.locator("#emergency").click();
  await page.waitForFunction(() => document.querySelector("#drive-answer").textContent.startsWith("■"));
});

test("an emergency stop that nobody answers is told before the answer is given up", async () => {
  const text = await page.evaluate(async () => {
    const { EmergencyStop } = await import("./emergency.js");
    const answer = document.createElement("p");
    new EmergencyStop(document.createElement("button"), answer, { ask: () => new Promise(() => {}) }).stop();
    while (!answer.textContent.startsWith("✕")) await new Promise((resolve) => setTimeout(resolve, 50));
    return answer.textContent;
  });
  assert.match(text, /^✕ The chair has not confirmed the emergency stop/);
});

test("an emergency stop that does not reach the chair says so", async () => {
  const other = await startWheelchair(["--drive"]);
  const watching = await startMonitor([`${other.link}-chair`], 0, ["--control"]);
  const driver = await browser.open(watching.url);
  await driver.locator("#chair-anchor").click();
  await driver.waitForSelector("#chair-stick.drives");
  await end(other.child, "SIGKILL");
  await driver.locator("#emergency").click();
  await driver.waitForFunction(() => /^✕ Emergency stop failed: .*Stop the chair by its own switch/.test(document.querySelector("#drive-answer").textContent));
  await driver.close();
});

test("one of several wheelchairs is chosen, and the map follows it", async () => {
  const shown = await page.evaluate(async () => {
    const { Chair } = await import("./chair.js"), { SampleStore } = await import("./samples.js");
    const chair = new Chair({ listeners: [], open: false }, new SampleStore()), find = (id) => document.getElementById(id);
    const value = (x) => ({ t: x, x, y: 0, heading_deg: 0, wheel_left: 1, wheel_right: 1, state: 0, brake: 0, volts_left: 1, volts_right: 1, stick_x: 0, stick_y: 0, drive: "", emergency_stop: 0 });
    const of = (link, x) => ({ name: link, ports: [{ name: "chair", owner: "first", type: "Wheelchair::Chair", value: value(x) }] });
    const show = (x) => chair.show({ control: { allowed: false }, links: [of("a-chair", 0), of("b-chair", x)] });
    find("chair-section").hidden = true;
    show(20);
    const first = find("chair-place").textContent;
    find("chair-choice").value = "b-chair";
    for (let x = 20; x < 60; x += 0.5) show(x);
    return [first, find("chair-place").textContent, find("chair-map").getAttribute("viewBox").split(" ").map(Number)];
  });
  assert.match(shown[0], /^x 0\.00 m/);
  assert.match(shown[1], /^x 59\.50 m/);
  assert.ok(shown[2][0] < 59.5 && 59.5 < shown[2][0] + shown[2][2] && shown[2][2] === 8, shown[2].join());
});

test("a held stick does not drive another wheelchair when the chosen one ends", async () => {
  const sent = await page.evaluate(async () => {
    const { Stick } = await import("./stick.js"), { makeSvg } = await import("./dom.js"), sent = [];
    const stick = new Stick(makeSvg("svg"), [0, 0], 1, { listeners: [], open: true, send: ({ link, y }) => sent.push(`${link} ${y}`) });
    const press = (repeat) => stick.svg.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowUp", repeat }));
    stick.offer("a");
    press(false);
    press(true);
    stick.offer("b");
    press(true); // as the browser repeats it while the key is held
    stick.release();
    return sent;
  });
  assert.deepEqual(sent, ["a 1000", "a 0"]);
});
