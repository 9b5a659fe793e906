// OpenEXR files with scan lines of 32-bit floats: what penumbra writes (not compressed, or by ZIP) is read, and single
// channels are written without compression. Format: openexr.com, "OpenEXR File Layout".
import fs from 'node:fs';
import zlib from 'node:zlib';
import { Failure } from './failure.mjs';

const MAGIC = 20000630, FLOAT = 2;
const LINES = { 0: 1, 2: 1, 3: 16 }; // lines of a block, by compression: none, ZIPS, ZIP

function readHeader(data) {
  let at = 8;
  const text = () => {
    const begin = at;
    while (data[at] !== 0) ++at;
    return data.toString('latin1', begin, at++);
  };
  const attributes = {};
  for (let name = text(); name !== ''; name = text()) {
    const type = text(), size = data.readUInt32LE(at);
    attributes[name] = { type, data: data.subarray(at + 4, at + 4 + size) };
    at += 4 + size;
  }
  return { attributes, end: at };
}

function readChannels(list) {
  const channels = [];
  for (let at = 0; list[at] !== 0; at += 16) {
    const end = list.indexOf(0, at);
    channels.push({ name: list.toString('latin1', at, end), type: list.readInt32LE(end + 1) });
    at = end + 1;
  }
  return channels;
}

// Reverses the two steps that precede ZIP: differences of neighbouring bytes, and low and high halves kept apart.
function unpack(packed, size) {
  if (packed.length === size) return packed;
  const bytes = zlib.inflateSync(packed), out = Buffer.alloc(size), half = (size + 1) >> 1;
  for (let i = 1; i < size; ++i) bytes[i] = (bytes[i - 1] + bytes[i] - 128) & 255;
  for (let i = 0; i < size; ++i) out[i] = bytes[i % 2 === 0 ? i >> 1 : half + (i >> 1)];
  return out;
}

// {width, height, channels: {name: Float32Array, top row first}}
export function readExr(file) {
  const data = fs.readFileSync(file);
  if (data.length < 8 || data.readUInt32LE(0) !== MAGIC) throw new Failure(`${file} is no OpenEXR file`);
  const { attributes, end } = readHeader(data);
  const window = [0, 4, 8, 12].map((at) => attributes.dataWindow.data.readInt32LE(at));
  const width = window[2] - window[0] + 1, height = window[3] - window[1] + 1;
  const list = readChannels(attributes.channels.data), lines = LINES[attributes.compression.data[0]];
  if (!lines || list.some(({ type }) => type !== FLOAT)) {
    throw new Failure(`${file}: only files with channels of 32-bit floats, not compressed or by ZIP, can be read`);
  }
  const channels = Object.fromEntries(list.map(({ name }) => [name, new Float32Array(width * height)]));
  const rowBytes = 4 * width * list.length;
  for (let block = 0; block * lines < height; ++block) {
    const at = Number(data.readBigUInt64LE(end + 8 * block));
    const first = data.readInt32LE(at) - window[1], count = Math.min(lines, height - first);
    const bytes = unpack(data.subarray(at + 8, at + 8 + data.readUInt32LE(at + 4)), count * rowBytes);
    let read = 0;
    for (let y = first; y < first + count; ++y) {
      for (const { name } of list) {
        for (let x = 0; x < width; ++x, read += 4) channels[name][y * width + x] = bytes.readFloatLE(read);
      }
    }
  }
  return { width, height, channels };
}

function attribute(name, type, ...values) {
  const data = Buffer.concat(values), head = Buffer.from(`${name}\0${type}\0`, 'latin1'), size = Buffer.alloc(4);
  size.writeUInt32LE(data.length);
  return Buffer.concat([head, size, data]);
}

const int = (...values) => Buffer.from(Int32Array.from(values).buffer);
const float = (...values) => Buffer.from(Float32Array.from(values).buffer);

// channels: {name: Float32Array, top row first}
export function writeExr(file, width, height, channels) {
  const names = Object.keys(channels).sort();
  const list = names.map((name) => Buffer.concat([Buffer.from(`${name}\0`, 'latin1'), int(FLOAT, 0, 1, 1)]));
  const window = int(0, 0, width - 1, height - 1);
  const header = Buffer.concat([int(MAGIC, 2), attribute('channels', 'chlist', ...list, Buffer.alloc(1)),
    attribute('compression', 'compression', Buffer.alloc(1)), attribute('dataWindow', 'box2i', window),
    attribute('displayWindow', 'box2i', window), attribute('lineOrder', 'lineOrder', Buffer.alloc(1)),
    attribute('pixelAspectRatio', 'float', float(1)), attribute('screenWindowCenter', 'v2f', float(0, 0)),
    attribute('screenWindowWidth', 'float', float(1)), Buffer.alloc(1)]);
  const rowBytes = 4 * width * names.length, offsets = Buffer.alloc(8 * height), rows = [];
  for (let y = 0; y < height; ++y) {
    offsets.writeBigUInt64LE(BigInt(header.length + offsets.length + y * (8 + rowBytes)), 8 * y);
    const parts = names.map((name) => float(...channels[name].subarray(y * width, (y + 1) * width)));
    rows.push(int(y, rowBytes), ...parts);
  }
  fs.writeFileSync(file, Buffer.concat([header, offsets, ...rows]));
}
