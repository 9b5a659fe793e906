// What is the same for every peer. The program that drives the browser calls window.peer.open() first.
//
// A peer's module exports open(canvas, setup), which loads the scene and resolves to an object with
//   version            of the renderer
//   gl                 its WebGL context
//   setShadows(on)     async; afterwards nothing is left to compile
//   draw()             one frame, to the canvas
//   drawLinear()       async; one frame in linear light without tone mapping: the red channel as a Float32Array of all
//                      pixels, bottom row first
// setup is the object that scene.mjs describes.

const SETTLING_FRAMES = 2; // drawn and not measured after each change

let canvas, renderer;

// Waits until everything drawn so far is finished: a pixel can be read only then.
function finish() {
  const { gl } = renderer;
  gl.bindFramebuffer(gl.READ_FRAMEBUFFER, null);
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
}

function drawToEnd() {
  renderer.draw();
  finish();
}

function driverOf(gl) {
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  return gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
}

function base64(array) {
  const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
  const pieces = [];
  for (let at = 0; at < bytes.length; at += 32768) {
    pieces.push(String.fromCharCode(...bytes.subarray(at, at + 32768)));
  }
  return btoa(pieces.join(''));
}

window.peer = {
  async open(name, setup) {
    canvas = document.createElement('canvas');
    canvas.width = setup.width;
    canvas.height = setup.height;
    document.body.append(canvas);
    renderer = await (await import(`./${name}.mjs`)).open(canvas, setup);
    await renderer.setShadows(true);
    drawToEnd();
    const { gl } = renderer;
    if (gl.drawingBufferWidth !== setup.width || gl.drawingBufferHeight !== setup.height) {
      throw new Error(`it draws ${gl.drawingBufferWidth}x${gl.drawingBufferHeight} pixels`);
    }
    return { version: renderer.version, driver: driverOf(gl) };
  },

  // The time of a frame, in milliseconds, measured `count` times: that of `inRow` frames that are finished together,
  // divided by their number. All are drawn in one task, so that the browser does nothing in between.
  async times(count, inRow, shadows) {
    await renderer.setShadows(shadows);
    for (let i = 0; i < SETTLING_FRAMES; ++i) drawToEnd();
    const times = [];
    for (let i = 0; i < count; ++i) {
      const begin = performance.now();
      for (let frame = 0; frame < inRow; ++frame) renderer.draw();
      finish();
      times.push((performance.now() - begin) / inRow);
    }
    return times;
  },

  // A PNG of the canvas, in base64.
  async picture() {
    await renderer.setShadows(true);
    renderer.draw();
    return canvas.toDataURL('image/png').split(',')[1];
  },

  // The light of each pixel with or without shadows, in base64.
  async light(shadows) {
    await renderer.setShadows(shadows);
    return base64(await renderer.drawLinear());
  },
};
