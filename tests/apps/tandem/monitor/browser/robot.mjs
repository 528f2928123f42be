// SPDX-License-Identifier: Apache-2.0
// A wheelchair that drives, a monitor that watches it, and a browser, as child processes that end with the test.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { once } from "node:events";
import { tmpdir } from "node:os";
import { join } from "node:path";

const bin = process.env.TANDEM_BIN;
const children = new Set();
const folder = mkdtempSync(join(tmpdir(), "tandem-monitor-test-"));

/** Starts a program. `line(pattern)` waits for a line of its output, of standard error, too. */
export function start(program, args, input = "ignore") {
  const child = spawn(program, args, { stdio: [input, "pipe", "pipe"] });
  children.add(child);
  child.on("exit", () => children.delete(child));
  let text = "";
  const waiting = new Set();
  const look = () => {
    for (const wait of waiting) {
      const match = text.match(wait.pattern);
      if (match) { waiting.delete(wait); wait.resolve(match); }
    }
  };
  for (const stream of [child.stdout, child.stderr])
    stream.on("data", (data) => { text += data; look(); });
  child.line = (pattern) => new Promise((resolve, reject) => {
    waiting.add({ pattern, resolve });
    const late = setTimeout(() => reject(new Error(`${program}: no line ${pattern}; it wrote: ${text}`)), 60_000);
    late.unref();
    look();
  });
  return child;
}

export async function end(child, signal = "SIGTERM") {
  if (child.exitCode !== null || child.signalCode !== null) return;
  child.kill(signal);
  await once(child, "exit");
}

/** Drives on and on: a curve of 8 s, then 2 s of rest, in which a chair that was stopped for a late reference recovers. */
export async function startWheelchair(more = []) {
  const recorded = more.includes("--drive") ? [] : ["--joystick", recordedStick()];
  const child = start(join(bin, "wheelchair"), [...recorded, "--host-wait", "60", ...more]);
  const [, opros, rtm] = await child.line(/opros_host pid (\d+), rtm_host pid (\d+)/);
  return { child, opros: Number(opros), rtm: Number(rtm), link: `wheelchair-${child.pid}` };
}

function recordedStick() {
  const stick = join(folder, "stick.csv");
  const lines = ["t,jx,jy,estop"];
  for (let i = 0; i < 60; ++i) lines.push(`${10 * i + 1},0,700,0`, `${10 * i + 4},${i % 3 === 2 ? -900 : 900},800,0`, `${10 * i + 8.5},0,0,0`);
  writeFileSync(stick, lines.join("\n") + "\n");
  return stick;
}

/** `links`: what it shows, so that other links of the machine do not matter. */
export async function startMonitor(links, port = 0, more = []) {
  const child = start(join(bin, "tandem"), ["monitor", "--port", String(port), ...links, ...more]);
  const [, url] = await child.line(/(http:\S+)/);
  return { child, url, port: Number(new URL(url).port) };
}

/** `requests` gets the address of each request of any page. */
export async function startBrowser(requests) {
  const { chromium } = await import("playwright-core");
  const server = await chromium.launchServer({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox", "--disable-gpu",
    "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"] });
  const browser = await chromium.connect(server.wsEndpoint());
  const open = async (url, options = {}) => {
    const page = await browser.newPage({ viewport: { width: 1280, height: 900 }, ...options });
    page.setDefaultTimeout(60_000);
    page.errors = [];
    page.on("request", (request) => requests.push(request.url()));
    page.on("websocket", (socket) => requests.push(socket.url()));
    page.on("pageerror", (error) => page.errors.push(error.message));
    page.on("console", (message) => message.type() === "error" && page.errors.push(message.text()));
    if (url) await page.goto(url);
    return page;
  };
  /** As if the machine with the browser were switched off: the connection is not closed. */
  const kill = () => server.kill();
  return { open, kill, close: () => server.close() };
}

/** Ends all that was started. */
export async function cleanUp() {
  for (const child of [...children]) await end(child, "SIGTERM");
  rmSync(folder, { recursive: true, force: true });
}
