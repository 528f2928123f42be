// SPDX-License-Identifier: Apache-2.0
// The top of the page names what is wrong with a host: a misspelt setting, then a component that hangs.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { cleanUp, start, startBrowser, startMonitor } from "./robot.mjs";

const folder = mkdtempSync(join(tmpdir(), "tandem-failures-"));
let monitor, browser, page;

const hang = join(folder, "hang");

/** Components of 10 ms; the second one never returns from a cycle once the file `hang` exists. */
function startHost() {
  const conf = join(folder, "rtc.conf");
  writeFileSync(conf, `naming.enable: NO
manager.modules.load_path: ${process.env.TANDEM_TANKS}
manager.modules.preload: TankRtc.so
manager.components.precreate: TankRtc, TankRtc
manager.components.preactivation: TankRtc0, TankRtc1
test.TankRtc1.conf.default.fault: hang when there is the file ${hang}
exec_cxt.periodic.rate: 100
exec_cxt.periodic.rat: 100
`);
  return start(join(process.env.TANDEM_BIN, "rtm_host"), ["-f", conf]);
}

before(async () => {
  monitor = await startMonitor([]);
  browser = await startBrowser([]);
  page = await browser.open(monitor.url);
  await page.waitForSelector("#verdict:not(.unknown)");
  await page.evaluate(() => {
    window.shown = [];
    const verdict = document.querySelector("#verdict");
    new MutationObserver(() => window.shown.push({ level: verdict.className, text: verdict.textContent, at: Date.now() }))
      .observe(verdict, { attributes: true, subtree: true, childList: true, characterData: true });
  });
});
after(async () => {
  await browser?.close();
  await cleanUp();
  rmSync(folder, { recursive: true, force: true });
});

test("a misspelt setting is named at the top, and then the component that hangs, with its callback", async () => {
  const host = startHost();
  // On a loaded machine, a late cycle is worse and comes first.
  await page.waitForFunction(() => document.querySelector("#top").textContent.includes("exec_cxt.periodic.rat"));
  writeFileSync(hang, "");
  await page.waitForSelector("#verdict.hanging");
  const reason = await page.locator("#verdict .reason").textContent();
  assert.match(reason, new RegExp(`TankRtc1 in rtm_host \\(pid ${host.pid}\\): onExecute has not returned since`));
  const shown = await page.evaluate(() => window.shown), hung = shown.find(({ level }) => level === "hanging");
  const { ticks } = await (await fetch(new URL("api/state", monitor.url))).json();
  console.log(`named ${hung.at - ticks.find(({ hang }) => hang).hang.since_ms} ms after its last cycle began`);
  await page.locator("#findings summary").click();
  assert.match(await page.locator("#findings").textContent(), /exec_cxt\.periodic\.rat/);
  await page.waitForSelector("#graph .component.failed");
  await page.locator("#verdict").screenshot({ path: join(process.env.TANDEM_PICTURES, "hanging.png") });
  assert.deepEqual(page.errors, []);
});
