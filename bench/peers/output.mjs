// The files of results: checked before minutes are spent on what they would hold, and written whole or not at all.
import fs from 'node:fs';
import path from 'node:path';
import { atEnd } from './cleanup.mjs';
import { Failure } from './failure.mjs';

// The path without links, also of a file that is not there yet.
function realPath(file) {
  if (fs.existsSync(file)) return fs.realpathSync(file);
  return path.join(fs.realpathSync(path.dirname(path.resolve(file))), path.basename(file));
}

function checkWritable(file) {
  try {
    fs.mkdirSync(path.dirname(path.resolve(file)), { recursive: true });
    const real = realPath(file), there = fs.existsSync(real);
    if (there) fs.accessSync(real, fs.constants.W_OK);
    if (!there || fs.statSync(real).isFile()) fs.accessSync(path.dirname(real), fs.constants.W_OK);
    if (there && fs.statSync(real).isDirectory()) throw Object.assign(new Error(), { code: 'EISDIR' });
  } catch (error) {
    throw new Failure(`${file}: can't be written: ${error.code}`);
  }
}

// The text of the glTF document of a .gltf or .glb file.
function documentText(scene) {
  const file = fs.openSync(scene), { size } = fs.fstatSync(file), header = Buffer.alloc(20);
  fs.readSync(file, header, 0, 20, 0);
  const binary = header.toString('latin1', 0, 4) === 'glTF';
  const text = Buffer.alloc(Math.min(size, binary ? header.readUInt32LE(12) : size));
  fs.readSync(file, text, 0, text.length, binary ? 20 : 0);
  fs.closeSync(file);
  return text.toString();
}

// The files of buffers and images that a scene refers to; none if it can't be read, which penumbra then reports.
function filesOf(scene) {
  try {
    const { buffers = [], images = [] } = JSON.parse(documentText(scene));
    const names = [...buffers, ...images].map(({ uri }) => uri).filter((uri) => uri && !uri.startsWith('data:'));
    return names.map((uri) => path.join(path.dirname(scene), decodeURIComponent(uri))).filter(fs.existsSync);
  } catch {
    return [];
  }
}

// options: {scenes, json, markdown, pictures}
export function checkOutputs({ scenes, json, markdown, pictures }) {
  const taken = new Map(scenes.flatMap(filesOf).map((file) => [fs.realpathSync(file), 'a file of the scene']));
  for (const scene of scenes) taken.set(fs.realpathSync(scene), 'the scene');
  for (const [name, file] of [['--json', json], ['--markdown', markdown]]) {
    if (!file) continue;
    checkWritable(file);
    const real = realPath(file), by = taken.get(real);
    if (by) throw new Failure(`${name} ${file}: this would overwrite ${by}`);
    taken.set(real, `the file of ${name}`);
  }
  if (pictures) fs.mkdirSync(pictures, { recursive: true });
}

// Replaces a file by one that is complete; what is not a regular file, such as a pipe, is written as it is.
export function writeWhole(file, text) {
  const real = realPath(file);
  if (fs.existsSync(real) && !fs.statSync(real).isFile()) return fs.writeFileSync(real, text);
  const beside = `${real}.${process.pid}.tmp`, remove = atEnd(() => fs.rmSync(beside, { force: true }));
  fs.writeFileSync(beside, text);
  fs.renameSync(beside, real);
  return remove();
}
