// SPDX-License-Identifier: Apache-2.0
// A person with the token builds a system of ten components of both models, connects and configures it, saves it, runs it again,
// records it and replays the recording, all from the page.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { appendFileSync, cpSync, existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { cleanUp, start, startBrowser, startMonitor } from "./robot.mjs";

const link = `built-${process.pid}`, folder = mkdtempSync(join(tmpdir(), "tandem-systems-"));
const chain = [0, 1, 2, 3, 4].flatMap((i) => [`PartComp${i}`, `PartRtc${i}`]);
let browser, page;

before(async () => {
  for (const part of ["PartComp", "PartRtc"]) cpSync(join(process.env.TANDEM_PARTS, part), join(folder, part), { recursive: true });
  const monitor = await startMonitor([link], 0, ["--control", "--systems", folder]);
  browser = await startBrowser([]);
  page = await browser.open(monitor.url);
  await page.waitForSelector("#control-form:not([hidden])", { state: "attached" });
  await page.locator("#control-anchor").click();
});
after(async () => {
  await browser?.close();
  await cleanUp();
  rmSync(folder, { recursive: true, force: true });
});

const textIs = (selector, pattern) => page.waitForFunction(([of, text]) => new RegExp(text).test(document.querySelector(of)?.textContent), [selector, pattern.source]);
const row = (name, model) => page.locator("#system-components tbody tr", { has: page.locator("th", { hasText: new RegExp(`^${name}$`) }) }).filter({ has: page.locator("td", { hasText: model }) });
const system = (name) => page.locator("#systems li", { has: page.locator("b", { hasText: new RegExp(`^${name}$`) }) });
const click = (name) => page.getByRole("button", { name, exact: true }).click();

/** Waits until an element is there, and asks for the components again: the RTCs of OPRoS components appear after their link. */
async function untilAsked(locator) {
  while (await locator.count() === 0) {
    await click("Refresh");
    await page.waitForTimeout(1000); // the test has a time limit
  }
}

/** Starts a system and waits until each of its components is listed in its own model, and the OPRoS ones also as RTCs. */
async function run(name) {
  await click(`Start ${name}`);
  await system(name).locator("span", { hasText: /^● runs since/ }).waitFor();
  await page.locator("#system-filter").fill("part"); // not the components of other systems
  for (const each of chain) await untilAsked(row(each, "RTM"));
  for (const each of chain.filter((of) => of.startsWith("PartComp"))) await untilAsked(row(each, "OPRoS"));
}

async function stop(name) {
  await click(`Stop ${name}`);
  await system(name).locator("span", { hasText: /^has ended$/ }).waitFor();
}

test("a system is created of components in the monitor's folder, and started", async () => {
  await page.locator("summary", { hasText: "New system" }).click();
  for (const part of ["PartComp (OPRoS)", "PartRtc (RTM)"]) await page.getByLabel(part).fill("5");
  await page.locator("#system-new-name").fill(link);
  await click("Create");
  await textIs("#systems-answer", /^✓ Create /);
  await run(link);
});

test("the ten components are connected in a chain, activated and configured", async () => {
  for (let i = 1; i < chain.length; ++i) {
    const ports = [`${chain[i - 1]}.out`, `${chain[i]}.in`];
    await page.locator("#connect-from").selectOption(ports[0]);
    await page.locator("#connect-to").selectOption(ports[1]);
    await page.locator("#connect-form button").click();
    await textIs("#system-answer", new RegExp(`^✓ Connect ${ports[0]} and ${ports[1]}: done`));
  }
  await click("Activate PartRtc0");
  await textIs("#system-answer", /^✓ Activate PartRtc0: done/);
  await page.getByRole("button", { name: /^Activate \d+ components$/ }).click();
  for (let i = 0; i < 5; ++i) await row(`PartRtc${i}`, "RTM").locator("td", { hasText: "✓ ACTIVE" }).waitFor();
  for (const [of, model, label, value] of [["PartRtc0", "RTM", "gain of default", "2"], ["PartComp0", "OPRoS", "amplitude of property", "3"]]) {
    await row(of, model).getByRole("button", { name: `Parameters of ${of}` }).click();
    await page.getByLabel(label).fill(value);
    await page.getByLabel(label).press("Enter");
    await textIs("#system-answer", new RegExp(`^✓ Set .* of ${of} to ${value}: done`));
  }
});

test("a mistyped parameter is refused in words that name it, and the value that counts is shown", async () => {
  await row("PartRtc0", "RTM").getByRole("button", { name: "Parameters of PartRtc0" }).click();
  await page.getByLabel("gain of default").fill("much");
  await page.getByLabel("gain of default").press("Enter");
  await textIs("#system-answer", /^✕ Set gain of PartRtc0 to much: [\s\S]*gain/);
  await page.waitForFunction(() => document.querySelector('#parameters input[aria-label="gain of default"]')?.value === "2");
});

test("what was refused stays in view in every view, until it is closed", async () => {
  const failure = page.locator("#failure");
  assert.match(await failure.textContent(), /^✕ Set gain of PartRtc0 to much: /);
  for (const view of ["control", "graph", "ticks"]) {
    await page.locator(`#${view}-anchor`).click();
    await page.evaluate(() => scrollTo(0, document.documentElement.scrollHeight));
    const box = await failure.boundingBox();
    assert.ok(box.y >= 0 && box.y + box.height < 400, `${view}: ${JSON.stringify(box)}`);
  }
  await failure.getByRole("button").click();
  assert.equal(await failure.isVisible(), false);
  await page.locator("#control-anchor").click();
});

test("saving over a system needs consent, and the copy of a system is a folder for tandem run", async () => {
  await page.locator("#system-save-name").fill(link);
  await click("Save");
  await textIs("#systems-answer", /^✕ Save .*runs from/);
  await page.locator("#system-replace").check();
  await click("Save");
  await textIs("#systems-answer", /^✓ Save /);
  assert.ok(existsSync(join(folder, link, "rtm", "rtc.conf~")));
  await page.locator("#system-save-name").fill(`${link}-copy`);
  await click("Save");
  await textIs("#systems-answer", /^✓ Save .*-copy: saved /);
  for (const name of [link, `${link}-copy`]) {
    const conf = readFileSync(join(folder, name, "rtm", "rtc.conf"), "utf8");
    assert.match(conf, /PartRtc0\.out\?port=rtcloc:\/\/unix:self\/PartComp1\.in/);
    assert.match(conf, /\.PartRtc0\.conf\.default\.gain: 2\n/);
  }
  await stop(link);
});

test("the saved system runs again as it was, its misspelt setting is named at the top, and it is recorded", async () => {
  appendFileSync(join(folder, `${link}-copy`, "rtm", "rtc.conf"), "manager.componets.precreate: PartRtc\n");
  await run(`${link}-copy`);
  for (let i = 1; i < chain.length; ++i)
    await untilAsked(page.locator("#system-connections b", { hasText: `${chain[i - 1]}.out → ${chain[i]}.in` }));
  await row("PartRtc4", "RTM").locator("td", { hasText: "✓ ACTIVE" }).waitFor();
  for (const [of, model, label, value] of [["PartRtc0", "RTM", "gain of default", "2"], ["PartComp0", "OPRoS", "amplitude of property", "3"]]) {
    await row(of, model).getByRole("button", { name: `Parameters of ${of}` }).click();
    await page.waitForFunction(([name, wanted]) => document.querySelector(`#parameters input[aria-label="${name}"]`)?.value === wanted, [label, value]);
  }
  await textIs("#verdict", /manager\.componets\.precreate/);
  await page.locator("#record").click();
  await textIs("#recording-now", /^● Recording, [2-9] s$/);
  await page.reload();
  await textIs("#recording-now", /^● Recording, ([2-9]|\d\d) s$/);
  await page.locator("#control-anchor").click();
  await page.waitForSelector("#control-form:not([hidden])");
  await page.screenshot({ path: join(process.env.TANDEM_PICTURES, "systems.png"), fullPage: true });
  await page.locator("#record").click();
  await textIs("#recording", /^✓ recorded to .*mcap$/);
  await stop(`${link}-copy`);
});

test("the recording is replayed in place of the host that does not run", async () => {
  const host = start(join(process.env.TANDEM_BIN, "rtm_host"), ["-f", join(folder, `${link}-copy`, "rtm", "rtc.conf")]);
  await host.line(/ready/);
  await page.locator("summary", { hasText: "Recordings" }).click();
  await page.locator("#recordings li").first().getByRole("button", { name: /^Replay / }).click();
  await textIs("#recording-now", /^▶ Replay, \d+ s$/);
  await page.waitForSelector("#replay-now:not([hidden])");
  await textIs("#replay-end", /^The replay of tandem-.*\.mcap has ended\. [\s\S]*messages/);
  const file = (await page.locator("#recordings a").first().textContent()).trim();
  assert.match(execFileSync(join(process.env.TANDEM_BIN, "tandem"), ["bag", "info", file], { encoding: "utf8" }), /PartComp0/);
  assert.deepEqual(page.errors, []);
});
