// The renderers of one scene: pages of peers, and Penumbra's techniques. A row is what is reported of one of them:
//   renderer, version, technique, maps, driver
//   shadowed, unshadowed   median milliseconds of a frame, by round
//   figures                errors of its shadows, if they were wanted
//   failed                 why there is nothing else
import fs from 'node:fs';
import path from 'node:path';
import { Peer } from './browser.mjs';
import { lineOf } from './failure.mjs';
import { PEERS, isPresetFile, labelOf } from './options.mjs';
import { writeGrey } from './png.mjs';
import { median } from './statistics.mjs';
import { visibilityOf } from './visibility.mjs';

const newRow = (renderer, technique, maps) => ({ renderer, version: null, technique, maps, driver: null, shadowed: [],
  unshadowed: [], figures: null, failed: null });

// On a GPU, waiting for a single frame takes as long as drawing it. A software rasteriser may hold back work where
// frames follow each other, so each is finished there.
const FRAMES_IN_ROW = 16;

// One peer with a number of maps.
export class PeerContender {
  constructor(name, maps, options) {
    const { blocker, filter } = options.taps;
    this.options = options;
    this.maps = maps;
    this.peer = new Peer(name, PEERS[name].label, options.timeout);
    this.row = newRow(PEERS[name].label, `PCSS ${blocker}/${filter}`, maps);
    this.stem = `${name}_${maps}`;
  }

  // Runs a step; where it fails, the row says so and nothing more is done.
  async attempt(step) {
    if (this.row.failed) return;
    try {
      await step();
    } catch (error) {
      this.row.failed = lineOf(error);
      this.peer.close();
    }
  }

  // Starts the browser, and finds the visibility if it is wanted.
  prepare(context, setup, pictures) {
    return this.attempt(async () => {
      const { width, height, truth, white, keepMaps } = this.options;
      const own = { ...setup, maps: this.maps };
      this.inRow = context.software ? 1 : FRAMES_IN_ROW;
      await this.peer.start(context.packages, context.software);
      this.row.chromium = this.peer.chromium;
      if (truth) {
        await this.peer.open(context.origin, { ...own, white: true, keepMaps: false });
        this.visibility = visibilityOf(width, height, await this.peer.light(true), await this.peer.light(false));
        if (pictures) writeGrey(`${pictures}_${this.stem}_shadow.png`, width, height, this.visibility);
      }
      const same = truth && white && !keepMaps; // as the page is by now
      if (!same) await this.peer.open(context.origin, { ...own, white });
      Object.assign(this.row, { version: this.peer.version, driver: this.peer.driver });
      if (pictures) fs.writeFileSync(`${pictures}_${this.stem}.png`, await this.peer.picture());
    });
  }

  measure() {
    return this.attempt(async () => {
      const { peer, row, inRow, options: { frames } } = this;
      row.shadowed.push(median(await peer.times(frames, inRow, true)));
      row.unshadowed.push(median(await peer.times(frames, inRow, false)));
    });
  }

  close() {
    this.peer.close();
  }
}

// Penumbra's techniques with a number of maps, all in one run of penumbra bench.
export class PenumbraContender {
  constructor(penumbra, scene, maps, options, settings) {
    const { blocker, filter } = options.taps;
    Object.assign(this, { penumbra, scene, maps, options, settings });
    this.rows = options.techniques.map((name) =>
      newRow('Penumbra', name === 'pcss' ? `pcss ${blocker}/${filter}` : labelOf(name), maps));
  }

  // A preset file: the taps are those of pcss alone, not those of presets that are built on it. A peer's blocker tap
  // reads one texel.
  technique(name, folder) {
    if (name !== 'pcss') return name;
    const { blocker, filter } = this.options.taps, file = path.join(folder, 'pcss.toml');
    fs.writeFileSync(file, `technique = "pcss"\n[pcss]\nblocker_taps = ${blocker}\n` +
      `blocker_reads = "texel"\nfilter_taps = ${filter}\n`);
    return file;
  }

  parameters() {
    return [`cascades.count=${this.maps}`, `cascades.size=${this.options.mapSize}`, ...this.settings]
      .flatMap((setting) => ['--set', setting]);
  }

  // Draws each technique's shadows and compares them with the reference.
  async judge(sceneArgs, folder, reference, pictures) {
    for (const [i, name] of this.options.techniques.entries()) {
      const file = path.join(folder, `shadow_${this.maps}.exr`), technique = this.technique(name, folder);
      const chosen = [isPresetFile(technique) ? '--preset' : '--technique', technique];
      const draw = (output, ...more) => this.penumbra.run('render', this.scene, '-o', output, ...sceneArgs, ...chosen,
        ...this.parameters(), ...more, '--quiet');
      if (reference) {
        await draw(file, '--aov', 'shadow');
        this.rows[i].figures = await this.penumbra.figures(file, reference);
      }
      if (pictures) await draw(`${pictures}_penumbra_${labelOf(name)}_${this.maps}.png`, '--aov', 'color,shadow');
    }
  }

  async measure(sceneArgs, folder) {
    const file = path.join(folder, 'bench.json');
    const techniques = this.options.techniques.map((name) => this.technique(name, folder));
    await this.penumbra.run('bench', this.scene, ...sceneArgs, '--technique', ['none', ...techniques].join(','),
      ...this.parameters(), '--whole-frames', '--frames', this.options.frames, '--warmup', 2, '-o', file, '--quiet');
    const { version, commit, device, points } = JSON.parse(fs.readFileSync(file, 'utf8'));
    const [none, ...costs] = points[0].costs.map((cost) => cost.frame.median_ms);
    this.rows.forEach((row, i) => {
      Object.assign(row, { version: version.replace(/^Penumbra /, ''), commit, driver: device.renderer });
      row.shadowed.push(costs[i]);
      row.unshadowed.push(none);
    });
  }
}
