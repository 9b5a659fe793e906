// Everything that is measured of one scene.
import path from 'node:path';
import { PeerContender, PenumbraContender } from './contenders.mjs';
import { PEERS } from './options.mjs';
import { busyWarning, idleShare } from './machine.mjs';
import { sceneArguments, setupOf } from './scene.mjs';
import { serve } from './server.mjs';
import { ratio, summary } from './statistics.mjs';
import { figuresOf, writeReference } from './visibility.mjs';

// Judges the shadows of all renderers at the same pixels; returns how many these are.
async function judge(context, scene, sceneArgs, peers, own, pictures) {
  const { options, folder, penumbra } = context;
  const reference = options.truth ? path.join(folder, 'reference.exr') : null;
  let pixels = null;
  if (reference) {
    const truth = path.join(folder, 'truth.exr'), seen = peers.filter(({ visibility }) => visibility);
    await penumbra.run('truth', scene, '-o', truth, ...sceneArgs, '--spp', options.spp, '--quiet');
    pixels = writeReference(reference, truth, seen.map(({ visibility }) => visibility));
    for (const { row, visibility } of seen) {
      row.figures = await figuresOf(penumbra, folder, options.width, options.height, visibility, reference);
    }
  }
  for (const each of own) await each.judge(sceneArgs, folder, reference, pictures);
  return pixels;
}

// Penumbra's rows over each peer's with as many maps.
function ratiosOf(peerRows, ownRows) {
  return ownRows.flatMap((row) => peerRows
    .filter((peer) => peer.maps === row.maps && !peer.failed)
    .map((peer) => ({ technique: row.technique, peer: peer.renderer, maps: row.maps,
      ...ratio(row.shadowed, peer.shadowed) })));
}

// The driver that each peer draws with has to be Penumbra's.
function driverWarnings(rows, renderer) {
  const name = renderer.split(/[,(]/)[0].trim();
  return rows.filter((row) => row.driver && !row.driver.includes(name))
    .map((row) => `${row.renderer} draws with ${row.driver}, Penumbra with ${renderer}: their times can't be compared`);
}

async function takeTurns(context, sceneArgs, peers, own, report) {
  const busy = [];
  for (let round = 1; round <= context.options.rounds; ++round) {
    report(`round ${round} of ${context.options.rounds}`);
    busy.push(await idleShare(context.options.waitIdle));
    for (const peer of peers) await peer.measure();
    for (const each of own) await each.measure(sceneArgs, context.folder);
  }
  return busy;
}

// A scene's file name, or its folder's for a file that is named just scene.
export function nameOf(scene) {
  const stem = path.basename(scene).replace(/\.(glb|gltf)$/, '');
  return stem === 'scene' ? path.basename(path.dirname(path.resolve(scene))) : stem;
}

// context: {options, penumbra, settings, packages, pages, folder}; report: called with what is being done.
export async function measureScene(context, scene, report) {
  const { options, penumbra, folder } = context, sceneArgs = sceneArguments(options);
  const name = nameOf(scene);
  const pictures = options.pictures ? path.join(options.pictures, name) : null;
  const facts = await penumbra.facts(scene, sceneArgs, folder), setup = setupOf(scene, facts, options);
  const peers = options.peers.flatMap((peer) => options.cascades.filter((maps) => PEERS[peer].maps.includes(maps))
    .map((maps) => new PeerContender(peer, maps, options)));
  const own = options.cascades.map((maps) => new PenumbraContender(penumbra, scene, maps, options, context.settings));
  const server = await serve({ page: context.pages, packages: path.join(context.packages, 'node_modules'),
    scene: path.dirname(path.resolve(scene)) });
  try {
    const place = { packages: context.packages, software: facts.device.software, origin: server.origin };
    for (const peer of peers) {
      report(`${peer.row.renderer}, ${peer.maps} x ${options.mapSize}`);
      await peer.prepare(place, setup, pictures);
    }
    report('shadows against the truth');
    const pixels = await judge(context, scene, sceneArgs, peers, own, pictures);
    const busy = await takeTurns(context, sceneArgs, peers, own, report);
    const peerRows = peers.map(({ row }) => row), ownRows = own.flatMap(({ rows }) => rows);
    const warnings = [busyWarning(busy), ...driverWarnings(peerRows, facts.device.renderer),
      setup.animated ? 'the scene is animated: the peers draw it as the file places it, Penumbra at time 0' : null];
    return { scene: name, triangles: facts.scene_facts.triangles, pixels, busy,
      rows: [...ownRows, ...peerRows].map((row) => ({ ...row, shadowed_ms: summary(row.shadowed),
        unshadowed_ms: summary(row.unshadowed) })),
      ratios: ratiosOf(peerRows, ownRows), warnings: warnings.filter(Boolean) };
  } finally {
    peers.forEach((peer) => peer.close());
    server.close();
  }
}
