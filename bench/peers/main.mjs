// Measures Penumbra beside other renderers; run.sh installs what this needs and starts it.
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { checkBrowser } from './browser.mjs';
import { temporaryFolder, undoAtEveryEnd } from './cleanup.mjs';
import { Failure, lineOf } from './failure.mjs';
import { machine } from './machine.mjs';
import { measureScene, nameOf } from './measure.mjs';
import { HELP, parse } from './options.mjs';
import { checkOutputs, writeWhole } from './output.mjs';
import { Penumbra } from './penumbra.mjs';
import { conditions, markdown, textTable } from './table.mjs';

// A short limit is meant for browsers that hang; a command of penumbra may have to render a reference.
const LEAST_COMMAND_SECONDS = 120;

const here = path.dirname(fileURLToPath(import.meta.url)), root = path.dirname(path.dirname(here));

const unique = (list) => [...new Set(list.filter(Boolean))];

// Whether maps are kept from frame to frame, for a program that knows the parameter; another always draws them anew.
async function mapSettings(penumbra, options) {
  if ((await penumbra.paramNames()).includes('maps.keep')) return [`maps.keep=${options.keepMaps}`];
  if (options.keepMaps) throw new Failure('--maps kept: this penumbra has no parameter maps.keep');
  return [];
}

function tellError(error) {
  process.stderr.write(`error: ${lineOf(error)}\n`);
  process.exitCode = error.code === 2 ? 2 : 1;
}

async function run(args) {
  const options = parse(args);
  if (options.help) return process.stdout.write(HELP);
  checkOutputs(options);
  const program = options.program ?? process.env.PENUMBRA_PROGRAM ?? path.join(root, 'build/release/penumbra');
  const packages = process.env.PENUMBRA_PEERS ?? path.join(root, 'build/peers');
  if (options.peers.length > 0) checkBrowser(packages);
  const penumbra = new Penumbra(program, Math.max(options.timeout, LEAST_COMMAND_SECONDS));
  const context = { options, penumbra, settings: await mapSettings(penumbra, options), folder: temporaryFolder(),
    packages, pages: path.join(here, 'page') };
  const { scenes: _scenes, json, markdown: markdownFile, pictures, program: _program, ...settings } = options;
  const report = { format: 'penumbra.peers/1', machine: machine(), settings, scenes: [] };
  for (const scene of options.scenes) {
    const tell = (text) => process.stderr.write(`${nameOf(scene)}: ${text}\n`);
    try {
      const result = await measureScene(context, scene, tell);
      report.scenes.push(result);
      process.stdout.write(`${textTable(result, options.mapSize)}\n\n`);
    } catch (error) { // the other scenes are measured all the same
      tellError(error);
    }
  }
  if (report.scenes.length === 0) return undefined;
  const rows = report.scenes.flatMap((result) => result.rows);
  report.chromium = unique(rows.map((row) => row.chromium))[0] ?? null;
  report.drivers = unique(rows.map((row) => row.driver));
  process.stdout.write(`${conditions(report)}\n`);
  if (json) writeWhole(json, `${JSON.stringify(report, null, 2)}\n`);
  if (markdownFile) writeWhole(markdownFile, markdown(report));
  if (rows.some((row) => row.failed)) process.exitCode = 1;
  return undefined;
}

undoAtEveryEnd();
try {
  await run(process.argv.slice(2));
} catch (error) {
  tellError(error);
}
process.exit();
