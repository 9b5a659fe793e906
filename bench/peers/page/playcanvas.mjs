// PlayCanvas: a forward renderer with one to four cascades, which share one texture, and percentage-closer soft shadows
// of its own.
import * as pc from 'playcanvas';
import { farDepth } from './fit.mjs';

function makeCamera(app, setup) {
  const { eye, forward, up, fovY, near } = setup.camera;
  const camera = new pc.Entity('camera');
  camera.addComponent('camera', {
    clearColor: new pc.Color(0, 0, 0), fov: fovY, nearClip: near, farClip: farDepth(setup),
    gammaCorrection: setup.white ? pc.GAMMA_NONE : pc.GAMMA_SRGB, toneMapping: pc.TONEMAP_LINEAR,
  });
  camera.setPosition(...eye);
  camera.lookAt(new pc.Vec3(eye.map((v, i) => v + forward[i])), new pc.Vec3(up));
  app.root.addChild(camera);
  return camera;
}

function makeSun(app, setup) {
  const sun = new pc.Entity('sun');
  sun.addComponent('light', {
    type: 'directional', intensity: setup.white ? 1 : 1.5, castShadows: true, shadowType: pc.SHADOW_PCSS_32F,
    // Two to four cascades have a quarter of the texture each.
    shadowResolution: setup.maps > 1 ? 2 * setup.mapSize : setup.mapSize,
    numCascades: setup.maps, cascadeDistribution: setup.split, shadowDistance: farDepth(setup),
    shadowBlockerSamples: setup.taps.blocker, shadowSamples: setup.taps.filter,
    penumbraSize: setup.tanHalfSun, penumbraFalloff: 1, shadowBias: 0.2,
  });
  sun.setRotation(new pc.Quat().setFromDirections(pc.Vec3.UP, new pc.Vec3(setup.toLight)));
  app.root.addChild(sun);
  return sun.light;
}

// One normal offset, in metres, serves all cascades: a texel of the widest, whose size is known only after a frame. The
// light itself takes it, as its component takes no more than a metre.
function fitBias(light, camera, setup) {
  const { shadowCamera } = light.light.getRenderData(camera.camera.camera, setup.maps - 1);
  light.light.normalOffsetBias = (2 * shadowCamera.orthoHeight) / setup.mapSize;
}

function whiteOf(material) {
  const white = new pc.StandardMaterial();
  Object.assign(white, { useMetalness: false, gloss: 0, useFog: false, useSkybox: false, cull: material.cull,
    twoSidedLighting: material.twoSidedLighting, alphaTest: material.alphaTest });
  white.specular.set(0, 0, 0);
  if (material.alphaTest > 0) {
    white.opacityMap = material.opacityMap;
    white.opacityMapChannel = material.opacityMapChannel;
  }
  white.update();
  return white;
}

function addGround(app, setup) {
  const mesh = new pc.Mesh(app.graphicsDevice), material = new pc.StandardMaterial();
  mesh.setPositions(setup.ground.flat());
  mesh.setNormals([0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0]);
  mesh.setIndices([0, 1, 2, 0, 2, 3]);
  mesh.update();
  material.diffuse.set(0.73, 0.73, 0.73);
  material.update();
  const entity = new pc.Entity('ground');
  entity.addComponent('render', { meshInstances: [new pc.MeshInstance(mesh, material)], castShadows: true,
    receiveShadows: true });
  app.root.addChild(entity);
}

function loadContainer(app, url) {
  return new Promise((resolve, reject) => {
    const asset = new pc.Asset('scene', 'container', { url });
    asset.once('load', () => resolve(asset.resource));
    asset.once('error', (message) => reject(new Error(message)));
    app.assets.add(asset);
    app.assets.load(asset);
  });
}

async function load(app, setup) {
  const container = await loadContainer(app, setup.url);
  const root = container.instantiateRenderEntity({ castShadows: true, receiveShadows: true });
  for (const kind of ['light', 'camera']) root.findComponents(kind).forEach(({ entity }) => entity.destroy());
  app.root.addChild(root);
  if (setup.ground) addGround(app, setup);
  if (!setup.white) return;
  const whites = new Map();
  for (const instance of app.root.findComponents('render').flatMap((render) => render.meshInstances)) {
    if (!whites.has(instance.material)) whites.set(instance.material, whiteOf(instance.material));
    instance.material = whites.get(instance.material);
  }
}

export async function open(canvas, setup) {
  const app = new pc.Application(canvas, { graphicsDeviceOptions: { antialias: false, alpha: false } });
  const device = app.graphicsDevice;
  device.maxPixelRatio = 1;
  app.setCanvasFillMode(pc.FILLMODE_NONE, setup.width, setup.height);
  app.setCanvasResolution(pc.RESOLUTION_FIXED, setup.width, setup.height);
  app.autoRender = false;
  const ambient = setup.white ? 0 : 0.25;
  app.scene.ambientLight = new pc.Color(ambient, ambient, ambient);
  const camera = makeCamera(app, setup), light = makeSun(app, setup);
  await load(app, setup);
  app.start();
  cancelAnimationFrame(app.frameRequestId); // frames are drawn when they are asked for

  const draw = () => {
    app.update(1 / 60);
    app.render();
  };
  return {
    version: pc.version,
    gl: device.gl,
    draw,
    async setShadows(on) {
      light.castShadows = on;
      light.shadowUpdateMode = pc.SHADOWUPDATE_REALTIME;
      for (let i = 0; i < 2; ++i) {
        draw();
        if (on) fitBias(light, camera, setup);
        await new Promise((resolve) => { setTimeout(resolve, 0); });
      }
      if (setup.keepMaps) light.shadowUpdateMode = pc.SHADOWUPDATE_NONE;
    },
    async drawLinear() {
      const { width, height } = setup;
      const colorBuffer = new pc.Texture(device, { width, height, format: pc.PIXELFORMAT_RGBA32F, mipmaps: false,
        minFilter: pc.FILTER_NEAREST, magFilter: pc.FILTER_NEAREST });
      const renderTarget = new pc.RenderTarget({ colorBuffer, depth: true });
      camera.camera.renderTarget = renderTarget;
      for (let i = 0; i < 2; ++i) draw();
      const pixels = await colorBuffer.read(0, 0, width, height, { renderTarget, immediate: true });
      camera.camera.renderTarget = null;
      renderTarget.destroy();
      colorBuffer.destroy();
      return new Float32Array(pixels).filter((_, i) => i % 4 === 0);
    },
  };
}
