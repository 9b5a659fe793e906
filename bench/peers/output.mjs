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

// options: {scenes, json, markdown, pictures}
export function checkOutputs({ scenes, json, markdown, pictures }) {
  const taken = new Map(scenes.map((scene) => [fs.realpathSync(scene), 'the scene']));
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
