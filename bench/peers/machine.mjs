// What the figures were measured on, and whether it was idle.
import fs from 'node:fs';
import os from 'node:os';

const MOST_BUSY = 0.1; // share of all cores' time

export function machine() {
  const cores = os.cpus();
  return { cpu: cores[0]?.model ?? 'unknown', cores: cores.length, node: process.version };
}

function ticks() {
  const values = fs.readFileSync('/proc/stat', 'utf8').split('\n')[0].trim().split(/\s+/).slice(1, 9).map(Number);
  return { all: values.reduce((a, b) => a + b, 0), idle: values[3] + values[4] };
}

// The share of the cores' time that other work takes, from half a second in which the renderers rest.
async function busyShare() {
  const before = ticks();
  await new Promise((resolve) => { setTimeout(resolve, 500); });
  const after = ticks(), all = after.all - before.all;
  return all > 0 ? Math.max(0, 1 - (after.idle - before.idle) / all) : 0;
}

// Waits for at most `seconds` until hardly any other work runs. Returns the share that it takes by then.
export async function idleShare(seconds) {
  const end = Date.now() + 1000 * seconds;
  let share = await busyShare();
  while (share > MOST_BUSY && Date.now() < end) share = await busyShare();
  return share;
}

// A warning about the rounds that other work disturbed, or null.
export function busyWarning(shares) {
  const disturbed = shares.filter((share) => share > MOST_BUSY);
  if (disturbed.length === 0) return null;
  return `before ${disturbed.length} of ${shares.length} rounds other work took up to ` +
    `${Math.round(100 * Math.max(...disturbed))} % of the cores: measure again when the machine is idle`;
}
