// What every renderer is told of a scene, all of it as penumbra chose it.
import path from 'node:path';
import { Failure } from './failure.mjs';

function boundsWithGround({ min, max }, ground) {
  const points = [min, max, ...(ground ?? [])];
  const along = (choose) => [0, 1, 2].map((i) => choose(...points.map((p) => p[i])));
  return { min: along(Math.min), max: along(Math.max) };
}

// The arguments by which every command of penumbra draws the same view of a scene under the same sun.
export function sceneArguments(options) {
  return ['--size', `${options.width}x${options.height}`, '--ground', options.ground, '--sun-angle', options.sunAngle,
    ...(options.camera === null ? [] : ['--camera', options.camera])];
}

// The setup of a peer's page, without the number of maps and the materials. url: the scene's address on the server.
export function setupOf(scene, facts, options) {
  const { camera, sun_to_light: toLight, ground, scene_facts: { bounds, animations }, params } = facts;
  if (camera.fov_y_degrees === undefined) {
    throw new Failure(`${scene}: the camera is orthographic; the peers are drawn with perspective cameras only`);
  }
  const lamps = facts.lights.filter((light) => light.kind !== 'sun').length;
  if (!toLight || lamps > 0) {
    throw new Failure(`${scene}: ${toLight ? `it has ${lamps} lamps` : 'it has no sun'}; the peers are drawn with one sun only`);
  }
  const length = Math.hypot(...toLight);
  return {
    url: `/scene/${encodeURIComponent(path.basename(scene))}`,
    width: options.width, height: options.height, mapSize: options.mapSize, taps: options.taps,
    keepMaps: options.keepMaps, split: params['cascades.split'],
    toLight: toLight.map((v) => v / length),
    tanHalfSun: Math.tan((options.sunAngle * Math.PI) / 360),
    camera: { eye: camera.eye, forward: camera.forward, up: camera.up, near: camera.near, fovY: camera.fov_y_degrees },
    bounds: boundsWithGround(bounds, ground), ground,
    animated: animations.length > 0,
  };
}
