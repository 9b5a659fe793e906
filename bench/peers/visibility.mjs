// Shadows of a peer: the ratio of its frame with shadows to its frame without, in linear light, of white materials
// without ambient light. That is the visibility of the sun, whatever the renderer's shading is.
import path from 'node:path';
import { readExr, writeExr } from './exr.mjs';

// Where a white surface has less light than this share of what it has when it faces the sun, the ratio would be mostly
// rounding. Peers shade by interpolated normals, so there are such pixels among the receivers.
const LEAST_LIGHT = 0.02;

// Of two frames with their bottom rows first. visibility has its top row first; NaN: the ratio is not known.
export function visibilityOf(width, height, shadowed, unshadowed) {
  const visibility = new Float32Array(width * height);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const from = (height - 1 - y) * width + x, light = unshadowed[from];
      visibility[y * width + x] = light >= LEAST_LIGHT ? Math.min(Math.max(shadowed[from] / light, 0), 1) : NaN;
    }
  }
  return visibility;
}

// Writes the reference that every renderer is compared with: the truth, at those of its receivers where the ratio of
// each peer is known. Returns how many receivers the truth has, and how many of them are compared.
export function writeReference(file, truthFile, visibilities) {
  const { width, height, channels } = readExr(truthFile);
  const receiver = channels['receiver.V'].map((there, i) =>
    (there > 0 && visibilities.every((visibility) => !Number.isNaN(visibility[i])) ? 1 : 0));
  writeExr(file, width, height, { 'shadow.V': channels['shadow.V'], 'receiver.V': receiver });
  const count = (mask) => mask.reduce((sum, there) => sum + (there > 0 ? 1 : 0), 0);
  return { receivers: count(channels['receiver.V']), compared: count(receiver) };
}

// The errors of a visibility against a reference, by penumbra diff.
export async function figuresOf(penumbra, folder, width, height, visibility, reference) {
  const file = path.join(folder, 'visibility.exr');
  writeExr(file, width, height, { 'shadow.V': visibility.map((v) => (Number.isNaN(v) ? 0 : v)) });
  return penumbra.figures(file, reference);
}
