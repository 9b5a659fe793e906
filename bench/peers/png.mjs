// Grey PNG files of 8 bits.
import fs from 'node:fs';
import zlib from 'node:zlib';

const CRCS = Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let bit = 0; bit < 8; ++bit) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c;
});

function chunk(kind, data) {
  const body = Buffer.concat([Buffer.from(kind, 'latin1'), data]), size = Buffer.alloc(4), check = Buffer.alloc(4);
  let crc = 0xffffffff;
  for (const byte of body) crc = CRCS[(crc ^ byte) & 255] ^ (crc >>> 8);
  size.writeUInt32BE(data.length);
  check.writeUInt32BE(~crc >>> 0);
  return Buffer.concat([size, body, check]);
}

// values: from 0 to 1, top row first; anything else is black
export function writeGrey(file, width, height, values) {
  const header = Buffer.alloc(13), lines = Buffer.alloc(height * (width + 1));
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header[8] = 8;
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      lines[y * (width + 1) + 1 + x] = Math.round(255 * Math.min(Math.max(values[y * width + x] || 0, 0), 1));
    }
  }
  fs.writeFileSync(file, Buffer.concat([Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), chunk('IHDR', header),
    chunk('IDAT', zlib.deflateSync(lines)), chunk('IEND', Buffer.alloc(0))]));
}
