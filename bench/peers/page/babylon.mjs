// Babylon.js: a forward renderer with cascades, or one shadow map, and contact-hardening shadows of its own.
import { farDepth, shadowBox } from './fit.mjs';

// Its taps of blocker search and filter are fixed by these three qualities.
const QUALITIES = { '16/16': 'QUALITY_LOW', '16/32': 'QUALITY_MEDIUM', '32/64': 'QUALITY_HIGH' };

function loadScript(url) {
  return new Promise((resolve, reject) => {
    const script = document.createElement('script');
    Object.assign(script, { src: url, onload: resolve, onerror: () => reject(new Error(`${url} can't be loaded`)) });
    document.head.append(script);
  });
}

const vector = (array) => new BABYLON.Vector3(...array);

function makeCamera(scene, setup) {
  const { eye, forward, up, fovY, near } = setup.camera;
  const camera = new BABYLON.FreeCamera('camera', vector(eye), scene);
  camera.upVector = vector(up);
  camera.setTarget(vector(eye.map((v, i) => v + forward[i])));
  Object.assign(camera, { fov: (fovY * Math.PI) / 180, minZ: near, maxZ: farDepth(setup) });
  return camera;
}

function makeSun(scene, setup, box) {
  const light = new BABYLON.DirectionalLight('sun', vector(setup.toLight.map((v) => -v)), scene);
  light.position = vector(box.center);
  light.intensity = setup.white ? 1 : 2.5;
  if (setup.white) light.specular = BABYLON.Color3.Black();
  Object.assign(light, {
    autoUpdateExtends: false, autoCalcShadowZBounds: false, orthoLeft: -box.half, orthoRight: box.half,
    orthoTop: box.half, orthoBottom: -box.half, shadowMinZ: 0, shadowMaxZ: box.depth,
  });
  return light;
}

function makeShadows(light, camera, setup, box) {
  const quality = QUALITIES[`${setup.taps.blocker}/${setup.taps.filter}`];
  if (!quality) throw new Error(`it has only the taps ${Object.keys(QUALITIES).join(', ')}`);
  const cascaded = setup.maps > 1;
  const shadows = new BABYLON[cascaded ? 'CascadedShadowGenerator' : 'ShadowGenerator'](setup.mapSize, light);
  if (cascaded) {
    Object.assign(shadows, {
      numCascades: setup.maps, lambda: setup.split, stabilizeCascades: false, penumbraDarkness: 0,
      shadowMaxZ: camera.maxZ, cascadeBlendPercentage: 0.05,
    });
  }
  shadows.useContactHardeningShadow = true;
  shadows.filteringQuality = BABYLON.ShadowGenerator[quality];
  const size = { width: 2 * box.half, depth: box.depth };
  fitTo(shadows, setup, size, size);
  return shadows;
}

// The light's size is set in widths of the map or of the first cascade, the biases in lengths of the map and in metres.
// One pair of biases serves all cascades, which are known only after a frame.
function fitTo(shadows, setup, first, last) {
  const texel = Math.sqrt(first.width * last.width) / setup.mapSize;
  shadows.contactHardeningLightSizeUVRatio = (first.depth * setup.tanHalfSun) / first.width;
  shadows.normalBias = 0.5 * texel;
  shadows.bias = 0.8 / setup.mapSize;
}

function fitToCascades(shadows, setup) {
  const sizes = [0, setup.maps - 1].map((i) => {
    const min = shadows.getCascadeMinExtents(i), max = shadows.getCascadeMaxExtents(i);
    return { width: max.x - min.x, depth: max.z - min.z };
  });
  fitTo(shadows, setup, ...sizes);
}

function whiteOf(material, scene) {
  const white = new BABYLON.StandardMaterial('white', scene);
  white.specularColor = BABYLON.Color3.Black();
  white.backFaceCulling = material?.backFaceCulling ?? true;
  white.sideOrientation = material?.sideOrientation ?? white.sideOrientation;
  white.twoSidedLighting = material?.twoSidedLighting ?? false;
  if (material?.needAlphaTesting?.()) {
    white.diffuseTexture = material.albedoTexture;
    white.alphaCutOff = material.alphaCutOff;
    white.transparencyMode = BABYLON.Material.MATERIAL_ALPHATEST;
  }
  return white;
}

function addGround(scene, setup) {
  const mesh = new BABYLON.Mesh('ground', scene), data = new BABYLON.VertexData();
  Object.assign(data, { positions: setup.ground.flat(), normals: [0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0],
    indices: [0, 1, 2, 0, 2, 3] });
  data.applyToMesh(mesh);
  mesh.material = new BABYLON.PBRMaterial('ground', scene);
  Object.assign(mesh.material, { albedoColor: new BABYLON.Color3(0.5, 0.5, 0.5), metallic: 0, roughness: 1,
    sideOrientation: BABYLON.Material.CounterClockWiseSideOrientation });
}

async function load(scene, setup, shadows) {
  await BABYLON.ImportMeshAsync(setup.url, scene, {
    pluginOptions: { gltf: { animationStartMode: 0, extensionOptions: { KHR_lights_punctual: { enabled: false } } } },
  });
  for (const texture of scene.textures) texture.anisotropicFilteringLevel = 1; // 4 by default; the others have none
  if (setup.ground) addGround(scene, setup);
  const whites = new Map();
  for (const mesh of scene.meshes) {
    if (mesh.getTotalVertices() === 0) continue;
    if (setup.white && !whites.has(mesh.material)) whites.set(mesh.material, whiteOf(mesh.material, scene));
    if (setup.white) mesh.material = whites.get(mesh.material);
    mesh.receiveShadows = true;
    shadows.addShadowCaster(mesh, false);
  }
}

export async function open(canvas, setup) {
  await loadScript('/packages/babylonjs/babylon.js');
  await loadScript('/packages/babylonjs-loaders/babylonjs.loaders.min.js');
  const engine = new BABYLON.Engine(canvas, false, { antialias: false, stencil: false }, false);
  const scene = new BABYLON.Scene(engine), box = shadowBox(setup);
  scene.useRightHandedSystem = true;
  scene.clearColor = new BABYLON.Color4(0, 0, 0, 1);
  const camera = makeCamera(scene, setup), light = makeSun(scene, setup, box);
  const shadows = makeShadows(light, camera, setup, box);
  await load(scene, setup, shadows);
  scene.activeCamera = camera;
  if (!setup.white) new BABYLON.HemisphericLight('sky', BABYLON.Vector3.Up(), scene).intensity = 0.4;

  const draw = () => {
    engine.beginFrame();
    scene.render();
    engine.endFrame();
  };
  const once = BABYLON.RenderTargetTexture.REFRESHRATE_RENDER_ONCE;
  const always = BABYLON.RenderTargetTexture.REFRESHRATE_RENDER_ONEVERYFRAME;
  return {
    version: BABYLON.Engine.Version,
    gl: engine._gl,
    draw,
    async setShadows(on) {
      light.shadowEnabled = on;
      shadows.getShadowMap().refreshRate = always;
      for (let i = 0; i < 2; ++i) {
        await scene.whenReadyAsync();
        draw();
        if (setup.maps > 1) fitToCascades(shadows, setup);
      }
      draw();
      if (setup.keepMaps) shadows.getShadowMap().refreshRate = once;
    },
    async drawLinear() {
      const target = new BABYLON.RenderTargetTexture('linear', { width: setup.width, height: setup.height }, scene,
        { generateMipMaps: false, type: BABYLON.Constants.TEXTURETYPE_FLOAT });
      camera.outputRenderTarget = target;
      await scene.whenReadyAsync();
      draw();
      const pixels = await target.readPixels();
      camera.outputRenderTarget = null;
      target.dispose();
      return pixels.filter((_, i) => i % 4 === 0);
    },
  };
}
