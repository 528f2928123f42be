// SPDX-License-Identifier: Apache-2.0
// node read_sample.mjs FILE indexed|stream: prints what @mcap/core finds in the file, by its index or from the front.
import { open, readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";

const require = createRequire(import.meta.url);
const zstd = require("@foxglove/wasm-zstd");
const lz4 = require("@foxglove/wasm-lz4");
await zstd.isLoaded;
await lz4.isLoaded;
const decompressHandlers = {
  zstd: (bytes, size) => zstd.decompress(bytes, Number(size)),
  lz4: (bytes, size) => lz4(bytes, Number(size)),
};
const text = (bytes) => Buffer.from(bytes).toString();
const [file, how] = process.argv.slice(2);
const lines = [];

function message(channel, record) {
  lines.push(`${channel.topic} ${record.sequence} ${record.logTime} ${record.publishTime} ${text(record.data)}`);
}
function metadata(record) {
  lines.push(`metadata ${record.name} ${[...record.metadata.values()].join(" ")}`);
}
function attachment(record) {
  lines.push(`attachment ${record.name} ${record.mediaType} ${text(record.data)}`);
}
function ends(schemas, channels, statistics) {
  for (const schema of schemas.values()) lines.push(`schema ${schema.name} ${schema.encoding} ${text(schema.data)}`);
  for (const channel of channels.values()) {
    const link = channel.metadata.get("link") ?? "-";
    lines.push(`channel ${channel.topic} ${schemas.get(channel.schemaId)?.name ?? "-"} ${channel.messageEncoding} ${link}`);
  }
  const { messageCount, schemaCount, channelCount, attachmentCount, metadataCount } = statistics;
  lines.push(`statistics ${messageCount} ${schemaCount} ${channelCount} ${attachmentCount} ${metadataCount}`);
}

if (how === "indexed") {
  const handle = await open(file);
  const readable = {
    size: async () => BigInt((await handle.stat()).size),
    read: async (offset, size) => {
      const bytes = new Uint8Array(Number(size));
      const { bytesRead } = await handle.read(bytes, 0, bytes.length, Number(offset));
      if (bytesRead !== bytes.length) throw new Error(`only ${bytesRead} of ${size} bytes at ${offset}`);
      return bytes;
    },
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  for await (const record of reader.readMessages({ validateCrcs: true }))
    message(reader.channelsById.get(record.channelId), record);
  for await (const record of reader.readMetadata()) metadata(record);
  for await (const record of reader.readAttachments({ validateCrcs: true })) attachment(record);
  ends(reader.schemasById, reader.channelsById, reader.statistics);
  await handle.close();
} else {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  reader.append(await readFile(file));
  const schemas = new Map(), channels = new Map(), later = [];
  let statistics;
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Schema") schemas.set(record.id, record);
    if (record.type === "Channel") channels.set(record.id, record);
    if (record.type === "Message") message(channels.get(record.channelId), record);
    if (record.type === "Metadata") later.unshift(() => metadata(record));
    if (record.type === "Attachment") later.push(() => attachment(record));
    if (record.type === "Statistics") statistics = record;
  }
  if (!reader.done()) throw new Error("the file does not end");
  for (const tell of later) tell();
  ends(schemas, channels, statistics);
}
console.log(lines.join("\n"));
