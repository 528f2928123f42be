// SPDX-License-Identifier: Apache-2.0
// Foxglove's own client library connects, lists channels, receives and decodes.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { after, before, test } from "node:test";
import WebSocket from "ws";
import { cleanUp, startMonitor, startWheelchair } from "./robot.mjs";

const require = createRequire(import.meta.url);
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const { parseIDL } = require("@foxglove/omgidl-parser");
const { MessageReader } = require("@foxglove/omgidl-serialization");

let chair, monitor, client;
const events = { serverInfo: [], advertise: [], unadvertise: [], message: [], status: [], connectionGraphUpdate: [] };

async function until(holds, what) {
  for (let i = 0; i < 600; ++i) {
    const found = holds();
    if (found) return found;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  assert.fail(`never: ${what}`);
}
const address = () => monitor.url.replace("http", "ws");
const channel = (name) => events.advertise.flat().find(({ topic }) => topic.endsWith(`/${name}`));

before(async () => {
  chair = await startWheelchair();
  monitor = await startMonitor([chair.link, `${chair.link}-chair`]);
  client = new FoxgloveClient({ ws: new WebSocket(address(), [FoxgloveClient.SUPPORTED_SUBPROTOCOL]) });
  for (const [name, list] of Object.entries(events)) client.on(name, (event) => list.push(event));
});
after(async () => {
  client.close();
  await cleanUp();
});

test("the server says what it can do, and lists each data port once with its type as IDL", async () => {
  await until(() => events.serverInfo[0] && channel("chair") && channel("reference"), "channels");
  assert.deepEqual(events.serverInfo[0].capabilities, ["connectionGraph"]);
  const channels = events.advertise.flat();
  assert.deepEqual(channels.map(({ topic }) => topic).sort(),
    [`/${chair.link}-chair/chair`, `/${chair.link}/joystickPos`, `/${chair.link}/reference`]);
  assert.equal(new Set(channels.map(({ id }) => id)).size, 3);
  for (const { encoding, schemaEncoding } of channels) assert.deepEqual([encoding, schemaEncoding], ["cdr", "omgidl"]);
  assert.equal(channel("reference").schemaName, "RTC::TimedDoubleSeq");
});

test("messages of a channel come in order, and are decoded by its schema", async () => {
  const { id, schema, schemaName } = channel("reference");
  const subscription = client.subscribe(id);
  await until(() => events.message.length >= 100, "100 references");
  client.unsubscribe(subscription);
  const reader = new MessageReader(schemaName, parseIDL(schema));
  const messages = events.message.map(({ subscriptionId, timestamp, data }) => {
    assert.equal(subscriptionId, subscription);
    assert.ok(Math.abs(Number(timestamp / 1_000_000n) - Date.now()) < 120_000);
    return reader.readMessage(data).data;
  });
  for (const [i, data] of messages.entries()) {
    assert.equal(data.length, 4); // stamp, sequence number, direction, speed
    if (i > 0) assert.ok(data[1] > messages[i - 1][1]);
  }
  const seen = events.message.length;
  const other = new MessageReader(channel("chair").schemaName, parseIDL(channel("chair").schema));
  const second = client.subscribe(channel("chair").id);
  const message = await until(() => events.message.slice(seen).find((one) => one.subscriptionId === second), "a message of the chair");
  const value = other.readMessage(message.data);
  assert.equal(typeof value.heading_deg, "number");
  assert.ok(value.t > 0);
  client.unsubscribe(second);
});

test("the connection graph names hosts and services", async () => {
  client.subscribeConnectionGraph();
  const graph = await until(() => events.connectionGraphUpdate[0], "a connection graph");
  const topic = graph.publishedTopics.find(({ name }) => name === `/${chair.link}/reference`);
  assert.deepEqual(topic.publisherIds, [`${chair.link} RTM rtm_host`]);
  assert.deepEqual(graph.subscribedTopics.find(({ name }) => name === topic.name).subscriberIds, [`${chair.link} OPRoS opros_host`]);
  assert.ok(graph.advertisedServices.some(({ name }) => name === `/${chair.link}/joystick`));
});

test("what would change something is refused with a status", async () => {
  const id = client.advertise({ topic: "/x", encoding: "cdr", schemaName: "x" });
  client.sendMessage(id, new Uint8Array([1, 2, 3]));
  client.setParameters([{ name: "a", value: 1 }]);
  await until(() => events.status.length >= 3, "three refusals");
  for (const { message } of events.status) assert.match(message, /is read-only/);
});

test("channels of a host that is gone are taken back", async () => {
  const before = channel("reference").id;
  process.kill(chair.rtm, "SIGKILL");
  await until(() => events.unadvertise.flat().includes(before), "channels taken back");
});

test("pages of other sites are refused, programs are not", async () => {
  const status = (origin) => new Promise((resolve) => {
    const socket = new WebSocket(address(), [FoxgloveClient.SUPPORTED_SUBPROTOCOL], origin ? { origin } : {});
    socket.on("unexpected-response", (_, response) => { resolve(response.statusCode); socket.terminate(); });
    socket.on("open", () => { resolve(101); socket.close(); });
    socket.on("error", () => {});
  });
  assert.equal(await status("https://example.org"), 403);
  assert.equal(await status("null"), 403);
  assert.equal(await status(new URL(monitor.url).origin), 101);
  assert.equal(await status(), 101);
});
