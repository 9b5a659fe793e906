// three.js: a forward renderer with one shadow map. Its library has no percentage-closer soft shadows; as in its own
// example of them, they replace the look-up of the basic shadow map, here with a directional sun's cone and N blocker
// and N filter taps.
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { farDepth, shadowBox } from './fit.mjs';

// width of the cone in texture coordinates for each unit of depth in the map; bias: half a texel of depth.
function pcssSource({ blocker, filter }, cone, bias) {
  return `
    vec2 discPoint(int i, int count, float turn) {
      float radius = sqrt((float(i) + 0.5) / float(count)), angle = float(i) * 2.39996323 + turn;
      return radius * vec2(cos(angle), sin(angle));
    }
    float pcss(sampler2D map, vec3 at) {
      vec3 dx = dFdx(at), dy = dFdy(at);
      float area = dx.x * dy.y - dx.y * dy.x;
      vec2 slope = abs(area) < 1e-14 ? vec2(0.0) : vec2(dy.y * dx.z - dx.y * dy.z, dx.x * dy.z - dy.x * dx.z) / area;
      slope = clamp(slope, vec2(-4.0), vec2(4.0));
      float turn = 6.28318531 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
      float reach = ${cone} * at.z, sum = 0.0, count = 0.0;
      for (int i = 0; i < ${blocker}; i++) {
        vec2 offset = discPoint(i, ${blocker}, turn) * reach;
        float depth = texture2D(map, at.xy + offset).r;
        if (depth < at.z + dot(slope, offset) - ${bias}) { sum += depth; count += 1.0; }
      }
      if (count == 0.0) return 1.0;
      float radius = ${cone} * max(at.z - sum / count, 0.0), lit = 0.0;
      for (int i = 0; i < ${filter}; i++) {
        vec2 offset = discPoint(i, ${filter}, turn) * radius;
        lit += step(at.z + dot(slope, offset) - ${bias}, texture2D(map, at.xy + offset).r);
      }
      return lit / ${filter}.0;
    }
    `;
}

function usePcss(setup, box) {
  const chunk = THREE.ShaderChunk.shadowmap_pars_fragment;
  const lookUp = 'shadow = step( shadowCoord.z, depth );';
  const place = /#if defined\( SHADOWMAP_TYPE_PCF \)\s*float getShadow\(/;
  for (const text of [lookUp, place]) {
    if (chunk.split(text).length !== 2) throw new Error('its shader of shadow maps has changed');
  }
  const number = (value) => value.toExponential(8);
  const cone = number((box.depth * setup.tanHalfSun) / (2 * box.half));
  const bias = number(box.half / setup.mapSize / box.depth);
  THREE.ShaderChunk.shadowmap_pars_fragment = chunk
    .replace(place, (found) => pcssSource(setup.taps, cone, bias) + found)
    .replace(lookUp, 'shadow = pcss( shadowMap, shadowCoord.xyz );');
}

function whiteOf(material) {
  const masked = material.alphaTest > 0;
  return new THREE.MeshLambertMaterial({
    color: 0xffffff, side: material.side, alphaTest: material.alphaTest, map: masked ? material.map : null,
  });
}

function ground(setup) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(setup.ground.flat()), 3));
  geometry.setAttribute('normal', new THREE.BufferAttribute(new Float32Array([0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0]), 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  return new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({ color: 0xbcbcbc, metalness: 0, roughness: 1 }));
}

async function load(setup) {
  const { scene } = await new GLTFLoader().loadAsync(setup.url);
  if (setup.ground) scene.add(ground(setup));
  const removed = [];
  scene.traverse((object) => {
    if (object.isLight || object.isCamera) removed.push(object);
    if (!object.isMesh) return;
    object.castShadow = object.receiveShadow = true;
    if (setup.white) object.material = whiteOf(object.material);
    object.material.shadowSide = THREE.DoubleSide;
  });
  removed.forEach((object) => object.removeFromParent());
  return scene;
}

function sun(setup, box) {
  const light = new THREE.DirectionalLight(0xffffff, setup.white ? Math.PI : 0.8 * Math.PI);
  light.position.set(...box.center);
  light.target.position.set(...box.center.map((v, i) => v - setup.toLight[i]));
  light.shadow.mapSize.set(setup.mapSize, setup.mapSize);
  Object.assign(light.shadow.camera,
    { left: -box.half, right: box.half, top: box.half, bottom: -box.half, near: 0, far: box.depth });
  light.shadow.bias = 0;
  light.shadow.normalBias = (2 * box.half) / setup.mapSize;
  return light;
}

export async function open(canvas, setup) {
  const box = shadowBox(setup);
  usePcss(setup, box);
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: false });
  renderer.setPixelRatio(1);
  renderer.setSize(setup.width, setup.height, false);
  renderer.toneMapping = THREE.NoToneMapping;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = THREE.BasicShadowMap;

  const { eye, forward, up, fovY, near } = setup.camera;
  const camera = new THREE.PerspectiveCamera(fovY, setup.width / setup.height, near, farDepth(setup));
  camera.up.set(...up);
  camera.position.set(...eye);
  camera.lookAt(...eye.map((v, i) => v + forward[i]));

  const world = new THREE.Scene(), light = sun(setup, box);
  world.add(await load(setup), light, light.target);
  if (!setup.white) world.add(new THREE.HemisphereLight(0xffffff, 0x808080, 0.6));
  const draw = () => renderer.render(world, camera);

  return {
    version: THREE.REVISION,
    gl: renderer.getContext(),
    draw,
    async setShadows(on) {
      light.castShadow = on;
      renderer.shadowMap.autoUpdate = true;
      await renderer.compileAsync(world, camera);
      draw();
      renderer.shadowMap.autoUpdate = !setup.keepMaps;
    },
    async drawLinear() {
      const target = new THREE.WebGLRenderTarget(setup.width, setup.height, { type: THREE.FloatType });
      renderer.setRenderTarget(target);
      draw();
      const pixels = new Float32Array(setup.width * setup.height * 4);
      renderer.readRenderTargetPixels(target, 0, 0, setup.width, setup.height, pixels);
      renderer.setRenderTarget(null);
      target.dispose();
      return pixels.filter((_, i) => i % 4 === 0);
    },
  };
}
