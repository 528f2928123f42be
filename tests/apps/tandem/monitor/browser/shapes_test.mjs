// SPDX-License-Identifier: Apache-2.0
// A click on a port shows what it is about: a picture, distances around a sensor, the path of a pose.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { cleanUp, start, startBrowser, startMonitor } from "./robot.mjs";

const name = `tandem-sensors-${process.pid}`;
let sensors, browser, page;

before(async () => {
  sensors = start(process.env.TANDEM_SENSORS, [name], "pipe");
  await sensors.line(/running/);
  const monitor = await startMonitor([name]);
  browser = await startBrowser([]);
  page = await browser.open(monitor.url);
});
after(async () => {
  await browser?.close();
  sensors.stdin.end();
  await cleanUp();
});

async function open(port) {
  await page.locator("#plots-anchor").click();
  await page.locator("#member-tree .port-name", { hasText: port }).click();
}
const picture = (of) => page.locator(".plot-card").first().screenshot({ path: join(process.env.TANDEM_PICTURES, `${of}.png`) });

test("a port with pictures shows the newest one in its colours", async () => {
  await open("camera");
  await page.waitForFunction(() => /^160 × 120 pixels, RGB$/.test(document.querySelector(".picture figcaption").textContent));
  const colours = await page.locator(".picture canvas").evaluate((canvas) => [20, 140].map((x) => [...canvas.getContext("2d").getImageData(x, 60, 1, 1).data]));
  assert.deepEqual(colours, [[200, 0, 0, 255], [0, 0, 200, 255]]);
  assert.equal(await page.locator(".picture canvas").getAttribute("aria-label"), "Picture of camera");
  assert.equal(await page.locator(".plot-card .plot").first().isVisible(), false);
  await picture("picture");
});

test("a port with distances shows them around the sensor", async () => {
  await open("laser");
  await page.waitForFunction(() => document.querySelector(".map .dots")?.getAttribute("d")?.split("M").length === 182);
  assert.match(await page.locator(".shape figure:not(.picture) figcaption").textContent(), /^Distances around laser: 181 distances, nearest 1\.5 m; a square is 0?\.\d m$/);
  assert.equal(await page.locator(".plot-card .plot").first().isVisible(), false);
  await picture("polar");
});

test("a port with a pose shows its path and its numbers", async () => {
  await open("pose");
  await page.waitForFunction(() => document.querySelector(".map .trace")?.getAttribute("points")?.split(" ").length > 40);
  assert.match(await page.locator(".shape figure:not(.picture) figcaption").textContent(), /^Path of pose: x .*, y .*, heading -?\d+°; a square is /);
  await page.waitForFunction(() => document.querySelectorAll(".plot-card .entry").length === 3);
  assert.equal(await page.locator(".plot-card .plot").first().isVisible(), true);
  await picture("path");
  const viewed = await page.locator(".shape svg").evaluate((svg) => svg.getBoundingClientRect().width <= innerWidth);
  assert.ok(viewed);
  assert.deepEqual(page.errors, []);
});

test("poses, distances and pictures are recognized by their members", async () => {
  const result = await page.evaluate(async () => {
    const { poseIn, rangesIn, pointsAround } = await import("./shapes/shapes.js");
    const { PictureView, coloursOf, compressionOf, sizeIn } = await import("./shapes/pictures.js");
    const large = new Uint8Array(33), view = new PictureView(); // a PNG of 65,535 x 65,535 pixels
    large.set([0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10, 0, 0, 0, 13, 73, 72, 68, 82, 0, 0, 0xff, 0xff, 0, 0, 0xff, 0xff]);
    await view.show({ port: "camera", width: 1, height: 1, format: "PNG", pixels: large });
    const jpeg = Uint8Array.of(0xff, 0xd8, 0xff, 0xe0, 0, 4, 0, 0, 0xff, 0xc0, 0, 17, 8, 0, 240, 1, 64, 3);
    const grey = coloursOf({ width: 2, height: 1, format: "", pixels: Uint8Array.of(7, 9) });
    return {
      poses: [["data.position.x", "data.position.y", "data.heading"], ["t", "x", "y", "heading_deg"], ["data.position.x", "data.position.y", "data.position.z",
        "data.orientation.r", "data.orientation.p", "data.orientation.y"], ["data.x", "data.y"], ["data.vx", "data.vy", "data.va"]].map((names) => poseIn(names)?.heading ?? null),
      ranges: [rangesIn({ ranges: [1], config: { minAngle: 0, angularRes: 1 } }) !== null, rangesIn({ ranges: [1] }), rangesIn("x")],
      points: pointsAround({ ranges: [1, 20, "nan", 2], config: { minAngle: 0, angularRes: 0, minRange: 0.1, maxRange: 10 } }),
      bgr: [...coloursOf({ width: 1, height: 1, format: "bitmap", pixels: Uint8Array.of(1, 2, 3) })],
      // CF_RGB is 1 in the IDL of OpenRTM-aist and 2 in that of hrpsys; 5 is a Windows bitmap in the former.
      numbered: [1, 2, 5, 12].map((number) => coloursOf({ width: 1, height: 1, format: `format ${number}`, pixels: Uint8Array.of(1, 2, 3) })[0]),
      numberedGrey: [1, 2].map((number) => [...coloursOf({ width: 1, height: 1, format: `format ${number}`, pixels: Uint8Array.of(7) })]),
      grey: [...grey],
      short: coloursOf({ width: 100, height: 100, format: "", pixels: Uint8Array.of(1) }),
      sizes: [sizeIn(jpeg), sizeIn(jpeg.subarray(0, 12)), sizeIn(large.subarray(0, 20))], large: [view.canvas.hidden, view.caption.textContent],
      compressed: [compressionOf(Uint8Array.of(0xff, 0xd8, 0xff, 0xe0)), compressionOf(Uint8Array.of(1, 2))],
    };
  });
  assert.deepEqual(result, { poses: ["data.heading", "heading_deg", "data.orientation.y", null, null], ranges: [true, null, null], points: [[1, 0], [2, 0]],
    bgr: [3, 2, 1, 255], numbered: [1, 1, 3, 3], numberedGrey: [[7, 7, 7, 255], [7, 7, 7, 255]], grey: [7, 7, 7, 255, 9, 9, 9, 255], short: null, compressed: ["image/jpeg", null],
    sizes: [[320, 240], null, null], large: [true, "✕ its header says 65535 × 65535 pixels: too many to be shown"] });
});

test("a map has at most 21 lines in each direction, whatever numbers a message has", async () => {
  const lines = await page.evaluate(async () => {
    const { MapView } = await import("./shapes/map_view.js"), { makeSvg } = await import("./dom.js");
    const map = new MapView(makeSvg("svg"), makeSvg("path"));
    return [[[0, 0], [4, 3]], [[0, 0], [1e6, 0]], [[1e17, 0]], [[-1e300, 1e300]], [[-1e308, 0], [1e308, 0]]].map((points) => {
      map.fit(points);
      return map.grid.getAttribute("d").split("M").length - 1;
    });
  });
  assert.ok(lines[0] > 8 && lines[1] > 20, lines.join());
  for (const count of lines) assert.ok(count <= 42, lines.join());
});

test("a clock that was set back begins the curve again", async () => {
  const [size, last] = await page.evaluate(async () => {
    const { Track } = await import("./samples.js");
    const track = new Track("l/first/a");
    for (let i = 1; i <= 100; ++i) track.append(i, 5_000_000 + 10 * i, ["x"], [i]);
    for (let i = 101; i <= 110; ++i) track.append(i, 10 * i, ["x"], [i]);
    return [track.size, track.times[track.size - 1]];
  });
  assert.deepEqual([size, last], [10, 1100]);
});
