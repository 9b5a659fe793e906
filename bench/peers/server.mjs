// An HTTP server on 127.0.0.1 for the pages, the packages that they use, and the folder of one scene.
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { pipeline } from 'node:stream';

const TYPES = { '.html': 'text/html', '.mjs': 'text/javascript', '.js': 'text/javascript', '.json': 'application/json',
  '.wasm': 'application/wasm', '.glb': 'model/gltf-binary', '.gltf': 'model/gltf+json', '.png': 'image/png',
  '.jpg': 'image/jpeg', '.jpeg': 'image/jpeg' };

// With these, a page's clock counts in steps of 5 instead of 100 microseconds.
const ISOLATION = { 'cross-origin-opener-policy': 'same-origin', 'cross-origin-embedder-policy': 'require-corp' };

// The file that an address names in one of the folders, or null.
function fileOf(address, folders) {
  const [, first, ...rest] = decodeURIComponent(new URL(address, 'http://localhost').pathname).split('/');
  if (!Object.hasOwn(folders, first)) return null;
  const folder = fs.realpathSync(folders[first]), file = path.join(folder, ...rest);
  return file.startsWith(folder + path.sep) ? file : null;
}

// folders: from the first part of an address to a folder. Resolves to {origin, close}.
export async function serve(folders) {
  const server = http.createServer((request, response) => {
    let file = null;
    try {
      file = fileOf(request.url, folders);
    } catch {
      // An address that can't be decoded names no file.
    }
    const stream = file && fs.existsSync(file) && fs.statSync(file).isFile() ? fs.createReadStream(file) : null;
    if (!stream) return response.writeHead(404, ISOLATION).end();
    response.writeHead(200, { ...ISOLATION, 'content-type': TYPES[path.extname(file)] ?? 'application/octet-stream' });
    pipeline(stream, response, () => {}); // it closes both where one fails; the page reports what it lacks
  });
  await new Promise((resolve, reject) => {
    server.once('error', reject);
    server.listen(0, '127.0.0.1', resolve);
  });
  const close = () => {
    server.closeAllConnections();
    server.close();
  };
  return { origin: `http://127.0.0.1:${server.address().port}`, close };
}
