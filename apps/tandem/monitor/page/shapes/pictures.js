// SPDX-License-Identifier: Apache-2.0
// Shows pictures of ports. docs/monitoring.md describes the frames and the formats.
import {make, setAttributes, setText} from '../dom.js';

/** Returns the header of a frame of /api/samples, with its `pixels`. */
export function pictureIn(buffer) {
  const size = new DataView(buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, size)));
  return {...head, pixels: new Uint8Array(buffer, 4 + size)};
}

const begins = (pixels, bytes) => bytes.every((byte, i) => pixels[i] === byte);

/** Returns the MIME type of a compressed picture, or null. */
export function compressionOf(pixels) {
  if (begins(pixels, [0xff, 0xd8, 0xff])) return 'image/jpeg';
  return begins(pixels, [0x89, 0x50, 0x4e, 0x47]) ? 'image/png' : null;
}

/** More pixels than this are not decoded: few bytes may say that they are many. 8192 x 8192 pixels need 256 MiB. */
const mostPixels = 2 ** 26;

/** Returns [width, height] as the header of a JPEG says: of the first frame (SOF) behind the other segments. */
function jpegSize(pixels, view) {
  for (let at = 2; at + 9 <= pixels.length && pixels[at] === 0xff;) {
    const marker = pixels[at + 1];
    if (marker === 0xff) ++at; // a byte that fills
    else if (marker >= 0xc0 && marker <= 0xcf && ![0xc4, 0xc8, 0xcc].includes(marker)) return [view.getUint16(at + 7), view.getUint16(at + 5)];
    else at += 2 + view.getUint16(at + 2);
  }
  return null;
}

/** Returns [width, height] as the header of a compressed picture says; null if it says none. */
export function sizeIn(pixels) {
  const view = new DataView(pixels.buffer, pixels.byteOffset, pixels.length);
  if (compressionOf(pixels) === 'image/jpeg') return jpegSize(pixels, view);
  return pixels.length >= 24 ? [view.getUint32(16), view.getUint32(20)] : null; // IHDR is the first chunk of a PNG
}

/**
 * Returns the places of red, green and blue within a pixel of so many bytes; the second byte of 16 bits is the more significant one.
 * CF_RGB is 1 in the IDL of OpenRTM-aist and 2 in that of hrpsys. The other number is CF_GRAY there, with one byte per pixel.
 */
function colourPlaces(bytes, format) {
  if (bytes === 1) return [0, 0, 0];
  if (bytes === 2) return [1, 1, 1];
  if (bytes !== 3 && bytes !== 4) return null;
  return /rgb|^format [12]$/i.test(format) ? [0, 1, 2] : [2, 1, 0];
}

/** Returns the colours as RGBA, or null if the bytes do not fit the sizes. */
export function coloursOf({width, height, format, pixels}) {
  const count = width * height, bytes = count > 0 ? Math.floor(pixels.length / count) : 0, places = colourPlaces(bytes, format);
  if (places === null || width < 0) return null;
  const [red, green, blue] = places, colours = new Uint8ClampedArray(4 * count);
  for (let to = 0, from = 0; to < colours.length; to += 4, from += bytes) {
    colours[to] = pixels[from + red];
    colours[to + 1] = pixels[from + green];
    colours[to + 2] = pixels[from + blue];
    colours[to + 3] = 255;
  }
  return colours;
}

export class PictureView {
  constructor() {
    this.element = make('figure', 'picture');
    this.canvas = make('canvas');
    this.caption = make('figcaption');
    this.decodes = false;
    this.element.append(this.canvas, this.caption);
  }

  /** `picture`: of pictureIn(). Draws each picture once, and decodes one at a time: those that come meanwhile are left out. */
  async show(picture) {
    if (picture === this.shown || this.decodes) return;
    this.shown = picture;
    const {pixels} = picture, type = compressionOf(pixels);
    if (!type) return this.draw(picture, this.imageOf(picture));
    const size = sizeIn(pixels);
    if (!size || size[0] * size[1] > mostPixels) return this.refuse(size ? `its header says ${size[0]} × ${size[1]} pixels: too many to be shown` : 'its header has no size');
    this.decodes = true;
    const image = await createImageBitmap(new Blob([pixels], {type})).catch(() => null);
    this.decodes = false;
    this.draw(picture, image);
    image?.close(); // frees its memory now
  }

  /** `image`: null if the picture cannot be shown. */
  draw(picture, image) {
    const {port, pixels, format} = picture, {width, height} = image ?? picture;
    if (image === null) return this.refuse(`${width} × ${height} pixels with ${pixels.length} bytes${format ? `, format ${format}` : ''}: cannot be shown`);
    this.canvas.hidden = false;
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, {width, height});
    const context = this.canvas.getContext('2d');
    if (image instanceof ImageData) context.putImageData(image, 0, 0);
    else context.drawImage(image, 0, 0);
    setAttributes(this.canvas, {role: 'img', 'aria-label': `Picture of ${port}`});
    setText(this.caption, `${width} × ${height} pixels${format ? `, ${format}` : ''}`);
  }

  refuse(why) {
    this.canvas.hidden = true;
    setText(this.caption, `✕ ${why}`);
  }

  imageOf(picture) {
    const colours = coloursOf(picture);
    return colours && new ImageData(colours, picture.width, picture.height);
  }
}
