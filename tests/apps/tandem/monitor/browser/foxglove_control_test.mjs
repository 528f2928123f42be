// SPDX-License-Identifier: Apache-2.0
// A client with the token publishes, sets parameters and calls services, by the libraries of Foxglove's makers.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { after, before, test } from "node:test";
import WebSocket from "ws";
import { cleanUp, startMonitor, startWheelchair } from "./robot.mjs";

const require = createRequire(import.meta.url);
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const { parseIDL } = require("@foxglove/omgidl-parser");
const { MessageReader, MessageWriter } = require("@foxglove/omgidl-serialization");

let chair, monitor, client, events;

async function until(holds, what) {
  for (let i = 0; i < 600; ++i) {
    const found = holds();
    if (found) return found;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  assert.fail(`never: ${what}; statuses: ${JSON.stringify(events?.status)}`);
}
const status = (pattern) => until(() => events.status.find(({ message }) => pattern.test(message)), `a status ${pattern}`);
const channel = (name) => events.advertise.flat().find(({ topic }) => topic.endsWith(`/${name}`));
const service = (name) => events.advertiseServices.flat().find((one) => one.name === `/${chair.link}/${name}`);
const token = () => new URL(monitor.url).hash.slice("#token=".length);
const address = (query) => `ws://127.0.0.1:${monitor.port}/${query}`;

function connect(query) {
  const of = { serverInfo: [], advertise: [], advertiseServices: [], message: [], status: [], parameterValues: [], serviceCallResponse: [], serviceCallFailure: [] };
  const connected = new FoxgloveClient({ ws: new WebSocket(address(query), [FoxgloveClient.SUPPORTED_SUBPROTOCOL]) });
  for (const [name, list] of Object.entries(of)) connected.on(name, (event) => list.push(event));
  return [connected, of];
}

/** Messages of a channel, decoded, as they come. */
function subscribe(name) {
  const { id, schema, schemaName } = channel(name);
  const reader = new MessageReader(schemaName, parseIDL(schema)), subscription = client.subscribe(id), messages = [];
  client.on("message", ({ subscriptionId, data }) => subscriptionId === subscription && messages.push(reader.readMessage(data)));
  return messages;
}

const json = (value) => new TextEncoder().encode(JSON.stringify(value));
const view = (bytes) => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
let calls = 0;
async function call(name, encoding, bytes) {
  const callId = ++calls;
  client.sendServiceCallRequest({ serviceId: service(name).id, callId, encoding, data: view(bytes) });
  return until(() => [...events.serviceCallResponse, ...events.serviceCallFailure].find((one) => one.callId === callId), `an answer of ${name}`);
}

before(async () => {
  chair = await startWheelchair(["--drive"]);
  monitor = await startMonitor([chair.link, `${chair.link}-chair`], 0, ["--control"]);
  [client, events] = connect(`?token=${token()}`);
  await until(() => events.serverInfo[0] && channel("reference") && channel("joystickPos") && channel("chair"), "channels");
  await until(() => service("joystick/dead_zone"), "services");
});
after(async () => {
  client.close();
  await cleanUp();
});

test("control is offered to who has the token, and to nobody else", async () => {
  assert.deepEqual(events.serverInfo[0].capabilities, ["connectionGraph", "clientPublish", "parameters", "parametersSubscribe", "services"]);
  assert.deepEqual(events.serverInfo[0].supportedEncodings, ["cdr", "json"]);
  const [watcher, seen] = connect("");
  await until(() => seen.serverInfo[0], "a server");
  assert.deepEqual(seen.serverInfo[0].capabilities, ["connectionGraph"]);
  const id = watcher.advertise({ topic: channel("reference").topic, encoding: "json", schemaName: "" });
  watcher.sendMessage(id, json({ data: [1, 2, 3, 4] }));
  watcher.setParameters([{ name: "a", value: 1 }]);
  await until(() => seen.status.length >= 3, "three refusals");
  for (const { message } of seen.status) assert.match(message, /is read-only/);
  assert.equal(seen.advertiseServices.length, 0);
  watcher.close();
  const refused = new WebSocket(address(`?token=${"0".repeat(32)}`), [FoxgloveClient.SUPPORTED_SUBPROTOCOL]);
  const [, response] = await new Promise((resolve) => { refused.on("unexpected-response", (...all) => resolve(all)); refused.on("error", () => {}); });
  assert.equal(response.statusCode, 403);
});

test("JSON that is published to the topic of an RTC's InPort reaches the RTC", async () => {
  const references = subscribe("reference");
  const id = client.advertise({ topic: channel("joystickPos").topic, encoding: "json", schemaName: channel("joystickPos").schemaName });
  let sequence = 0;
  const push = setInterval(() => client.sendMessage(id, json({ data: [Number(process.hrtime.bigint()) / 1e9, ++sequence, 0, 1500, 0] })), 10);
  await until(() => references.find(({ data }) => data[3] > 0.02), "a reference to the front");
  clearInterval(push);
  client.unadvertise(id);
});

test("CDR that is published to the topic of an RTC's OutPort goes through the ring to the OPRoS side", async () => {
  const { topic, schema, schemaName } = channel("reference");
  const references = subscribe("reference");
  const id = client.advertise({ topic, encoding: "cdr", schemaName, schema, schemaEncoding: "omgidl" });
  const writer = new MessageWriter(schemaName, parseIDL(schema));
  const bytes = writer.writeMessage({ tm: { sec: 7, nsec: 8 }, data: [1, 424242, 0, 0] });
  client.sendMessage(id, bytes);
  const mine = await until(() => references.find(({ data }) => data[1] === 424242), "the message in the ring");
  assert.deepEqual({ ...mine.tm }, { sec: 7, nsec: 8 });
  client.unadvertise(id);
});

test("what does not fit the port is refused with a reason, and nothing is sent", async () => {
  const references = subscribe("reference");
  const { topic, schema, schemaName } = channel("reference");
  client.advertise({ topic: "/no/such", encoding: "json", schemaName: "" });
  await status(/^\/no\/such: unknown topic/);
  client.advertise({ topic, encoding: "cdr", schemaName: "RTC::TimedLong" });
  await status(/the type of the port is RTC::TimedDoubleSeq, not RTC::TimedLong/);
  client.advertise({ topic, encoding: "cdr", schemaName, schemaEncoding: "omgidl", schema: schema.replace("double", "float") });
  await status(/the schema of RTC::TimedDoubleSeq differs/);
  client.advertise({ topic, encoding: "protobuf", schemaName });
  await status(/expected encoding cdr or json, not protobuf/);
  client.advertise({ topic: channel("chair").topic, encoding: "json", schemaName: "" });
  await status(/\/chair: the RTM host that forwards messages is not running/);
  const text = client.advertise({ topic, encoding: "json", schemaName: "" });
  client.sendMessage(text, json({ data: [1, 535353, "fast", 0] }));
  await status(/data\[2\]: expected a number of type 'd'/);
  client.sendMessage(text, json({ date: [1, 535353, 0, 0] }));
  await status(/date: expected one of the members tm, data/);
  client.sendMessage(text, new TextEncoder().encode("{"));
  await status(/expected JSON: .*parse error/);
  const cdr = client.advertise({ topic, encoding: "cdr", schemaName });
  client.sendMessage(cdr, new Uint8Array([1, 2, 3]));
  await status(/little-endian CDR/);
  client.sendMessage(cdr, new Uint8Array([0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 200, 0, 0, 0, 1, 2, 3, 4]));
  await status(/the message of 16 bytes is not a valid/);
  client.sendMessage(4711, json({}));
  await status(/channel 4711, which is not advertised/);
  client.sendMessage(text, json({ data: [1, 646464, 0, 0] }));
  await until(() => references.find(({ data }) => data[1] === 646464), "the next message");
  assert.equal(references.some(({ data }) => data[1] === 535353), false);
  client.unadvertise(text);
  client.unadvertise(cdr);
});

test("operations of services are called with JSON and with CDR, of RTCs and of OPRoS components", async () => {
  const answer = await call("joystick/dead_zone", "json", json({}));
  assert.equal(typeof JSON.parse(new TextDecoder().decode(answer.data)).result, "number", JSON.stringify(answer));
  const { response } = service("chair/limits");
  const limits = await call("chair/limits", "cdr", new Uint8Array([0, 1, 0, 0]));
  assert.equal(limits.message, undefined);
  const { result } = new MessageReader(response.schemaName, parseIDL(response.schema)).readMessage(limits.data);
  assert.equal(result.length, 4);
  assert.ok(result.every((limit) => limit > 0));
  assert.match((await call("chair/limits", "json", json({ fast: 1 }))).message, /one of the members/);
  assert.match((await call("chair/limits", "xml", json({}))).message, /cdr or json/);
  client.sendServiceCallRequest({ serviceId: 999999, callId: ++calls, encoding: "json", data: view(json({})) });
  await until(() => events.serviceCallFailure.find((one) => one.callId === calls && /unknown service/.test(one.message)), "a refusal");
});

test("parameters are read, set, refused, and told when they change", async () => {
  client.getParameters([], "all");
  const all = await until(() => events.parameterValues.find(({ id }) => id === "all"), "all parameters");
  const name = `/${chair.link}/JoystickComp0/scenario`;
  const scenario = all.parameters.find((one) => one.name === name);
  assert.ok(scenario, JSON.stringify(all.parameters));
  client.subscribeParameterUpdates([name]);
  await until(() => events.parameterValues.find(({ id, parameters }) => id === undefined && parameters[0].name === name), "the value");
  client.setParameters([{ name, value: "doorway" }], "set");
  const now = await until(() => events.parameterValues.find(({ id }) => id === "set"), "the new value");
  assert.deepEqual(now.parameters, [{ name, value: "doorway" }]);
  await until(() => events.parameterValues.find(({ id, parameters }) => id === undefined && parameters.some((one) => one.value === "doorway")), "an update");
  client.setParameters([{ name: `/${chair.link}/JoystickComp0/scenery`, value: 1 }]);
  await status(/no parameter scenery/);
  client.setParameters([{ name: "/x/y/z", value: 1 }]);
  await status(/\/x\/y\/z: unknown component of a link/);
  client.setParameters([{ name, value: { deep: 1 } }]);
  await status(/a string, a number, a boolean/);
});

test("a client that leaves takes its connections down", async () => {
  const [other, seen] = connect(`?token=${token()}`);
  await until(() => seen.advertise.length, "channels");
  const references = subscribe("reference");
  const id = other.advertise({ topic: channel("reference").topic, encoding: "json", schemaName: "" });
  other.sendMessage(id, json({ data: [1, 757575, 0, 0] }));
  await until(() => references.find(({ data }) => data[1] === 757575), "its message");
  other.close();
  // The connections of the port are those of the other side of the test: a new client publishes as before.
  const [third, of] = connect(`?token=${token()}`);
  await until(() => of.advertise.length, "channels");
  const next = third.advertise({ topic: channel("reference").topic, encoding: "json", schemaName: "" });
  third.sendMessage(next, json({ data: [1, 868686, 0, 0] }));
  await until(() => references.find(({ data }) => data[1] === 868686), "a message of the next client");
  third.close();
});

test("a host that has gone fails calls and messages, and the monitor stays", async () => {
  const id = client.advertise({ topic: channel("reference").topic, encoding: "json", schemaName: "" });
  process.kill(chair.rtm, "SIGKILL");
  for (let i = 0; i < 20; ++i) client.sendMessage(id, json({ data: [1, 979797, 0, 0] }));
  await status(/\/reference: /);
  assert.equal((await fetch(`http://127.0.0.1:${monitor.port}/api/state`)).status, 200);
});
