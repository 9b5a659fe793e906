// The command line.
import fs from 'node:fs';
import path from 'node:path';
import { parseArgs } from 'node:util';
import { Failure } from './failure.mjs';

export const PEERS = {
  three: { label: 'three.js', maps: [1] },
  babylon: { label: 'Babylon.js', maps: [1, 2, 3, 4] },
  playcanvas: { label: 'PlayCanvas', maps: [1, 2, 3, 4] },
};

export const HELP = `Draws scenes with Penumbra and with other renderers, in turn and on the same driver, and prints
what frames cost and how far their shadows are from the truth.

usage: bench/peers/run.sh SCENE... [OPTIONS]

  --size WxH          Pixels (1280x720)
  --frames N          Frames that are measured of each renderer in each round (5)
  --rounds N          Rounds; in each, all renderers take their turn (3)
  --peers NAME,...    three, babylon, playcanvas (all)
  --techniques T,...  Penumbra's techniques, presets or preset files, .toml (pcss)
  --cascades N,...    Numbers of shadow maps, 1 to 4, each measured with every renderer that has it (4,1)
  --map-size N        Width of a map in texels (2048)
  --taps B/F          Blocker taps of one texel each, and filter taps (16/16)
  --sun-angle DEG     Full angle of the sun's disc (0.53)
  --camera NAME       A camera of the scene, as in penumbra render
  --ground HOW        auto, on or off, as in penumbra render
  --materials WHICH   own: those of the scene; white: plain white ones without ambient light (own)
  --maps WHEN         anew: drawn in each frame; kept: drawn once, as nothing moves (anew)
  --spp N             Rays of each pixel of the truth (256)
  --no-truth          Measure times alone
  --json FILE         Write all figures as JSON
  --markdown FILE     Write the tables as Markdown
  --pictures FOLDER   Write each renderer's picture, and its shadows alone, as PNG
  --wait-idle S       Longest wait before each round until other programs rest, seconds (0)
  --timeout S         Longest time for one step of a browser, and for one command of penumbra, which gets at least
                      120, seconds (300)
  --program FILE      The program penumbra (build/release/penumbra)
  --help              This text
`;

const STRINGS = { size: '1280x720', frames: '5', rounds: '3', peers: 'three,babylon,playcanvas', techniques: 'pcss',
  cascades: '4,1', 'map-size': '2048', taps: '16/16', 'sun-angle': '0.53', camera: undefined, ground: 'auto',
  materials: 'own', maps: 'anew', spp: '256', json: undefined, markdown: undefined, pictures: undefined,
  'wait-idle': '0', timeout: '300', program: undefined };

const wrong = (message) => new Failure(message, 2);

function whole(name, text, least, most) {
  const value = Number(text);
  if (!/^\d+$/.test(text) || value < least || value > most) {
    throw wrong(`--${name}: '${text}' is no whole number from ${least} to ${most}`);
  }
  return value;
}

function chosen(name, text, choices) {
  if (!choices.includes(text)) throw wrong(`--${name}: '${text}' is none of ${choices.join(', ')}`);
  return text;
}

function pair(name, text, pattern, most) {
  const found = pattern.exec(text);
  if (!found) throw wrong(`--${name}: '${text}' is not of the form ${STRINGS[name]}`);
  return [1, 2].map((i) => whole(name, found[i], 1, most));
}

function number(name, text, least, most) {
  const value = Number(text);
  if (text.trim() === '' || !(value >= least && value <= most)) {
    throw wrong(`--${name}: '${text}' is no number from ${least} to ${most}`);
  }
  return value;
}

const unique = (list) => [...new Set(list)];

export const isPresetFile = (technique) => path.extname(technique) === '.toml';

// What a technique is called in tables and names of files.
export const labelOf = (technique) => (isPresetFile(technique) ? path.basename(technique, '.toml') : technique);

function techniques(text) {
  const names = unique(text.split(',').filter(Boolean)), labels = names.map(labelOf);
  const twice = labels.find((label, i) => labels.indexOf(label) < i);
  if (twice) throw wrong(`--techniques has '${twice}' twice`);
  if (labels.includes('none')) throw wrong("--techniques: 'none' is measured beside all others");
  const missing = names.find((name) => isPresetFile(name) && !fs.existsSync(name));
  if (missing) throw new Failure(`${missing}: no such file`);
  return names;
}

export function parse(args) {
  const options = Object.fromEntries(Object.entries(STRINGS).map(([name, value]) =>
    [name, { type: 'string', ...(value === undefined ? {} : { default: value }) }]));
  let values, positionals;
  try {
    ({ values, positionals } = parseArgs({ args, allowPositionals: true,
      options: { ...options, help: { type: 'boolean' }, 'no-truth': { type: 'boolean' } } }));
  } catch (error) {
    throw wrong(error.message.split('. ')[0]);
  }
  if (values.help) return { help: true };
  if (positionals.length === 0) throw wrong('name a scene; --help lists the options');
  for (const scene of positionals) {
    if (!fs.existsSync(scene)) throw new Failure(`${scene}: no such file`);
  }
  const [width, height] = pair('size', values.size, /^(\d+)x(\d+)$/, 16384);
  const [blocker, filter] = pair('taps', values.taps, /^(\d+)\/(\d+)$/, 256);
  return {
    scenes: positionals, width, height,
    frames: whole('frames', values.frames, 1, 10000),
    rounds: whole('rounds', values.rounds, 1, 1000),
    peers: unique(values.peers.split(',').filter(Boolean).map((name) => chosen('peers', name, Object.keys(PEERS)))),
    techniques: techniques(values.techniques),
    cascades: unique(values.cascades.split(',').map((text) => whole('cascades', text, 1, 4))),
    mapSize: whole('map-size', values['map-size'], 16, 8192),
    taps: { blocker, filter },
    sunAngle: number('sun-angle', values['sun-angle'], 0.01, 60),
    camera: values.camera ?? null,
    ground: chosen('ground', values.ground, ['auto', 'on', 'off']),
    white: chosen('materials', values.materials, ['own', 'white']) === 'white',
    keepMaps: chosen('maps', values.maps, ['anew', 'kept']) === 'kept',
    spp: whole('spp', values.spp, 1, 65536),
    truth: !values['no-truth'],
    json: values.json, markdown: values.markdown, pictures: values.pictures,
    waitIdle: number('wait-idle', values['wait-idle'], 0, 86400),
    timeout: number('timeout', values.timeout, 1, 86400),
    program: values.program,
  };
}
