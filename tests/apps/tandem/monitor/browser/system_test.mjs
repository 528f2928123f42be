// SPDX-License-Identifier: Apache-2.0
// A person with the token changes the system from the page: connects and disconnects ports, stops and starts components, sets
// parameters, undoes it, and reads the log.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { cleanUp, startBrowser, startMonitor, startWheelchair } from "./robot.mjs";

let chair, browser, page;

before(async () => {
  chair = await startWheelchair();
  const monitor = await startMonitor([chair.link, `${chair.link}-chair`], 0, ["--control"]);
  browser = await startBrowser([]);
  page = await browser.open(monitor.url);
  await page.waitForSelector("#control-form:not([hidden])", { state: "attached" });
  await page.locator("#control-anchor").click();
  await row("JoystickComp0").waitFor();
});
after(async () => {
  await browser?.close();
  await cleanUp();
});

const row = (name) => page.locator("#system-components tbody tr", { has: page.locator("th", { hasText: new RegExp(`^${name}$`) }) });
const answerIs = (pattern) => page.waitForFunction((text) => new RegExp(text).test(document.querySelector("#system-answer").textContent), pattern.source);
const stateIs = (name, pattern) => page.waitForFunction(([of, text]) => [...document.querySelectorAll("#system-components tbody tr")].some((each) =>
  each.cells[0].textContent === of && new RegExp(text).test(each.cells[2].textContent)), [name, pattern.source]);

test("the components of both models are listed with their states", async () => {
  await stateIs("JoystickComp0", /ACTIVE/);
  await stateIs("ControlComp", /ACTIVE/);
  await page.locator("#control-section").screenshot({ path: join(process.env.TANDEM_PICTURES, "system.png") });
});

test("a component is deactivated, and undo activates it", async () => {
  await page.getByRole("button", { name: "Deactivate JoystickComp0", exact: true }).click();
  await answerIs(/^✓ Deactivate JoystickComp0: done/);
  await stateIs("JoystickComp0", /^INACTIVE$/);
  await page.locator("#system-undo").click();
  await answerIs(/^✓ Undo: activate JoystickComp0: done/);
  await stateIs("JoystickComp0", /^✓ ACTIVE$/);
  assert.equal(await page.locator("#system-undo").isVisible(), false);
});

test("an OPRoS component is stopped and started", async () => {
  await page.getByRole("button", { name: "Stop ControlComp", exact: true }).click();
  await stateIs("ControlComp", /^(READY|INACTIVE)$/);
  await page.getByRole("button", { name: "Start ControlComp", exact: true }).click();
  await stateIs("ControlComp", /^✓ ACTIVE$/);
});

test("a connection is removed and made again, and two ports that do not fit say why", async () => {
  const connections = page.locator("#system-connections li"), before = await connections.count();
  assert.ok(before > 0);
  const ports = (await connections.first().locator("b").textContent()).split(" → ");
  await connections.first().getByRole("button").click();
  await answerIs(/^✓ Disconnect .*: done/);
  await page.waitForFunction((count) => document.querySelectorAll("#system-connections li").length === count, before - 1);
  await page.locator("#connect-from").selectOption(ports[0]);
  await page.locator("#connect-to").selectOption(ports[0]);
  assert.match(await page.locator("#connect-fit").textContent(), /^✕ They cannot be connected: this is the same port/);
  assert.ok(await page.locator("#connect-form button").isDisabled());
  await page.locator("#connect-to").selectOption(ports[1]);
  assert.equal(await page.locator("#connect-fit").textContent(), "✓ The ports fit.");
  await page.locator("#connect-form button").click();
  await answerIs(/^✓ Connect .*: done/);
  await page.waitForFunction((count) => document.querySelectorAll("#system-connections li").length === count, before);
});

test("the connections and active components are saved as lines of rtc.conf", async () => {
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#system-save").click()]);
  assert.equal(download.suggestedFilename(), "rtc.conf");
  const file = join(process.env.TANDEM_PICTURES, "saved-rtc.conf");
  await download.saveAs(file);
  const text = readFileSync(file, "utf8");
  assert.match(text, /^manager\.components\.preconnect: .*\w\.\w+\?port=\w+\.\w+/);
  assert.match(text, /\nmanager\.components\.preactivation: .*JoystickComp0/);
});

test("the failure of a part behind the answer of a command does not hide the answer", async () => {
  const found = await page.evaluate(async () => {
    const { jsonIn } = await import("./system/system.js");
    return ['[\n  {\n    "a": [1]\n  }\n]\ntandem: no answer from [::1]:2809\n', "[]\ntandem: none}\n", '{"a": 1}', "[\n  1,\n"].map(jsonIn);
  });
  assert.deepEqual(found, [[{ a: [1] }], [], { a: 1 }, null]);
});

test("names that rtc.conf would read as something else are left out of the saved lines", async () => {
  const text = await page.evaluate(async () => {
    const { rtcConfOf } = await import("./system/system.js");
    const port = (name, other, properties = {}) => ({ name, kind: "DataOutPort", connections: [{ id: name, with: [other], properties }] });
    const component = (name, ports = []) => ({ model: "RTM", name, state: "ACTIVE", ports });
    return rtcConfOf([component("A0", [port("A0.out", "B0.in", { "dataport.push_policy": "all" }), port("A0.more", "(unreachable)"), port("A0.wrong", "C0.in\nmanager.modules.preload: x.so")]),
      component("B0"), component("C0\nmanager.modules.preload: x.so")]);
  });
  assert.equal(text, "manager.components.preconnect: A0.out?port=B0.in&push_policy=all\nmanager.components.preactivation: A0, B0\n" +
    "# 3 connections or components are left out: rtc.conf cannot name them.\n");
});

test("a property is set, and undo sets the old value", async () => {
  await page.getByRole("button", { name: "Parameters of ControlComp", exact: true }).click();
  const gain = () => page.getByLabel("ratio_gain of property");
  await gain().fill("17");
  await gain().press("Enter");
  await answerIs(/^✓ Set ratio_gain of ControlComp to 17: done/);
  await page.waitForFunction(() => document.querySelector('#parameters input[aria-label="ratio_gain of property"]')?.value === "17");
  await page.locator("#system-undo").click();
  await answerIs(/^✓ Undo: /);
  await page.waitForFunction(() => document.querySelector('#parameters input[aria-label="ratio_gain of property"]')?.value === "16");
});

test("the recording is in view everywhere, and is downloaded", async () => {
  await page.locator("#record").click();
  await page.locator("#graph-anchor").click();
  await page.waitForFunction(() => /^● Recording, \d+ s$/.test(document.querySelector("#recording-now").textContent));
  await page.locator("#recording-now").click();
  await page.locator("#record").click();
  await page.waitForSelector("#recording-now", { state: "hidden" });
  await page.locator("summary", { hasText: "Recordings" }).click();
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#recordings a").first().click()]);
  assert.match(download.suggestedFilename(), /^tandem-\d{8}-\d{6}\.mcap$/);
  assert.equal(await download.failure(), null);
});

test("the log has the lines of the hosts, by level and text", async () => {
  await page.locator("#events-anchor").click();
  await page.waitForFunction(() => document.querySelectorAll("#log tbody tr").length > 0);
  const result = await page.evaluate(async () => {
    const { LogStore, lineIn } = await import("./system/logs.js");
    const store = new LogStore(), text = "[2026-01-02 03:04:06.000] [error] Arm: stuck\n[2026-01-02 03:04:05.000] [info] Leg: fine\nother words\n";
    store.take([{ id: "a", hosts: ["rtm_host 1"], text, next: 90 }]);
    return { line: lineIn("[2026-01-02 03:04:06.000] [warn] rtm_host: a: b"), offsets: store.offsets, all: store.select(0, "", 10).count,
      bad: store.select(3, "", 10).lines.map(({ text: of }) => of), found: store.select(0, "LEG", 10).lines.map(({ text: of }) => of) };
  });
  assert.deepEqual(result.line, { at: "2026-01-02 03:04:06.000", time: "03:04:06.000", level: "warn", rank: 2, program: "", component: "rtm_host", text: "a: b" });
  assert.deepEqual([result.offsets, result.all, result.bad, result.found], [{ a: 90 }, 3, ["stuck"], ["fine"]]);
  await page.locator("#events-section").screenshot({ path: join(process.env.TANDEM_PICTURES, "log.png") });
  assert.deepEqual(page.errors, []);
});

test("the page says how to write all lines of the hosts to a file", async () => {
  // tandem run prints the lines of the hosts to standard output, and its own to standard error.
  assert.deepEqual(await page.locator("#log-where code").allTextContents(), ["tandem run DIR &> run.log", "rtm_host 2> FILE"]);
});

test("the log of tandem run has the level and the host of each line", async () => {
  const result = await page.evaluate(async () => {
    const { LogStore } = await import("./system/logs.js");
    const store = new LogStore(), text = "rtm_host   | [2026-01-02 03:04:05.000] [error] Arm: stuck | bent\n" +
      "opros_host | [2026-01-02 03:04:06.000] [warn] Leg: late\nrtm_host   | ready\ntandem run: all hosts are ready\n";
    store.take([{ id: "a", hosts: ["opros_host 2", "rtm_host 1"], text, next: 170 }]);
    store.take([{ id: "b", hosts: ["opros_host 3"], text: "rtm_host   | [2026-01-02 03:04:07.000] [info] Arm: it has ended since\n", next: 70 }]);
    const texts = (rank, of = "") => store.select(rank, of, 10).lines.reverse().map(({ level, host, component, text: line }) => [level, host, component, line]);
    return { warnings: texts(2), all: texts(0), rtm: texts(2, "rtm_host") };
  });
  const stuck = ["error", "rtm_host 1", "Arm", "stuck | bent"], late = ["warn", "opros_host 2", "Leg", "late"];
  assert.deepEqual(result, { warnings: [stuck, late], rtm: [stuck], all: [stuck, late, ["", "rtm_host 1", "", "ready"],
    ["", "opros_host 2, rtm_host 1", "", "tandem run: all hosts are ready"], ["info", "rtm_host", "Arm", "it has ended since"]] });
});

test("parameters get the widgets that their component declares", async () => {
  const kinds = await page.evaluate(async () => {
    const { widgetFor, createWidget } = await import("./system/parameters.js");
    const slider = createWidget(widgetFor("slider.0.5", "0<=x<=10"), "3", "a", "a", () => {})[0];
    const radio = createWidget(widgetFor("radio", "(on,off)"), "off", "b", "b", () => {})[0];
    return { slider: [slider.type, slider.min, slider.max, slider.step, slider.value], radio: [...radio.querySelectorAll("input")].map(({ value, checked }) => [value, checked]),
      kinds: [widgetFor("text", "").kind, widgetFor("spin", "0<=x").kind, widgetFor("", "x<5").kind, widgetFor("", "(a,b)").kind, widgetFor("checkbox", "(a,b)").kind, widgetFor("slider", "").kind] };
  });
  assert.deepEqual(kinds, { slider: ["range", "0", "10", "0.5", "3"], radio: [["on", false], ["off", true]],
    kinds: ["text", "number", "number", "radio", "checkbox", "text"] });
});

test("ports say why they do not fit", async () => {
  const reasons = await page.evaluate(async () => {
    const { whyNot, commonProperties } = await import("./system/system.js");
    const port = (name, kind, type, properties = {}) => ({ name, component: "A", short: name, kind, type, properties, connections: [] });
    const out = port("out", "DataOutPort", "IDL:RTC/TimedLong:1.0", { "dataport.dataflow_type": "push,pull", "dataport.subscription_type": "flush,new,periodic" });
    const into = port("in", "DataInPort", "IDL:RTC/TimedLong:1.0", { "dataport.dataflow_type": "push", "dataport.subscription_type": "Any" });
    return { fits: whyNot(out, into), type: whyNot(out, port("x", "DataInPort", "IDL:RTC/TimedDouble:1.0")), kind: whyNot(out, port("y", "DataOutPort", "IDL:RTC/TimedLong:1.0")),
      service: whyNot(out, port("s", "CorbaPort", "provides A")), services: [whyNot(port("p", "CorbaPort", "provides IDL:A:1.0"), port("r", "CorbaPort", "requires IDL:A:1.0")),
        whyNot(port("p", "CorbaPort", "provides IDL:A:1.0"), port("r", "CorbaPort", "requires IDL:B:1.0"))], properties: commonProperties(out, into) };
  });
  assert.deepEqual(reasons, { fits: "", type: "A.out has type TimedLong, A.x has TimedDouble", kind: "both are OutPorts: one of them must receive",
    service: "a service port fits only a service port", services: ["", "neither provides a service that the other requires"],
    properties: [["dataflow_type", ["push"]], ["subscription_type", ["flush", "new", "periodic"]]] });
});

test("a token is kept when the connection is lost before the monitor has answered", async () => {
  const refused = await page.evaluate(async () => {
    const { Connection } = await import("./control.js");
    const original = window.WebSocket, results = [];
    for (const answer of [null, { op: "token", ok: false }]) {
      const connection = new Connection();
      let socket;
      window.WebSocket = class { constructor() { socket = this; } send() {} };
      connection.connect("0");
      window.WebSocket = original;
      socket.onopen();
      if (answer) socket.onmessage({ data: JSON.stringify(answer) });
      socket.onclose();
      results.push(connection.refused);
    }
    return results;
  });
  assert.deepEqual(refused, [false, true]);
});

test("the RTC that stands for an OPRoS component is told apart from it", async () => {
  const listed = await page.evaluate(async () => {
    const { componentsIn } = await import("./system/system.js"), rtc = (instance) => ({ instance, address: instance, state: "INACTIVE", ports: [] });
    return componentsIn([{ kind: "manager", components: [rtc("Arm"), rtc("Gripper0")] }], [{ pid: 1, components: [{ name: "Arm", state: "READY" }] }])
      .map(({ model, name, mirrored }) => `${model} ${name} ${Boolean(mirrored)}`);
  });
  assert.deepEqual(listed, ["RTM Arm true", "OPRoS Arm false", "RTM Gripper0 false"]);
});

test("one button activates all listed components, sixteen in a request, until one fails", async () => {
  const found = await page.evaluate(async () => {
    const { SystemView } = await import("./system/system_view.js"), sent = [];
    let refused = "";
    const view = new SystemView({ open: true, ask: async ({ op, command, arguments: names }) => {
      if (["activate", "start", "deactivate", "stop"].includes(command)) sent.push(`${op} ${command} ${names.length} ${names[0]}`);
      return { ok: command !== refused, text: "" };
    } });
    view.readOnce = async () => {};
    view.components = [...Array.from({ length: 18 }, (_, i) => ({ model: "RTM", name: `Rtc${i}`, id: `r${i}`, state: i < 17 ? "INACTIVE" : "ACTIVE", ports: [] })),
      { model: "OPRoS", name: "Arm", id: "1/Arm", state: "READY", ports: [] }];
    view.draw();
    const label = document.getElementById("system-activate").textContent;
    await view.activateAll();
    await view.undo();
    refused = "activate";
    await view.activateAll();
    return { label, sent, failure: document.getElementById("failure").textContent };
  });
  assert.equal(found.label, "Activate 18 components");
  assert.deepEqual(found.sent, ["rtm activate 16 r0", "rtm activate 1 r16", "opros start 1 1/Arm", "opros stop 1 1/Arm", "rtm activate 16 r0"]);
  assert.match(found.failure, /^✕ Activate Rtc0, Rtc1, .*: failed/);
});
