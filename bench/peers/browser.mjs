// One headless Chromium for each peer, so that one that hangs can be ended without the others.
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { atEnd, killGroup, temporaryFolder } from './cleanup.mjs';
import { Failure, bounded, lineOf } from './failure.mjs';

function findChromium() {
  const names = ['chromium', 'chromium-browser', 'google-chrome'];
  const folders = (process.env.PATH ?? '').split(path.delimiter);
  const files = names.flatMap((name) => folders.map((folder) => path.join(folder, name)));
  const found = files.find((file) => fs.existsSync(file));
  if (!found) throw new Failure('there is no Chromium on the PATH; bench/peers/run.sh installs Debian\'s');
  return found;
}

// ANGLE draws with the machine's OpenGL ES by EGL: the driver that penumbra has, too. What a browser does besides
// drawing a page is switched off.
const FLAGS = ['--headless', '--remote-debugging-pipe', '--use-gl=angle', '--use-angle=gl-egl',
  '--ignore-gpu-blocklist', '--disable-gpu-watchdog', '--disable-background-networking', '--disable-component-update',
  '--disable-default-apps', '--disable-quic', '--disable-sync', '--force-device-scale-factor=1', '--no-first-run'];

// A software rasteriser is asked for by name where penumbra has one, as the browser might find another driver. The
// drivers of GPUs find their own platform.
const environment = (software) => ({ ...process.env,
  ...(software ? { EGL_PLATFORM: 'surfaceless', LIBGL_ALWAYS_SOFTWARE: '1' } : {}) });

// Messages of the DevTools protocol over two pipes: a zero byte ends each. The browser ends itself when they are
// closed.
function transportOver(child) {
  const [, , , toBrowser, fromBrowser] = child.stdio;
  const transport = { send: (message) => toBrowser.write(`${message}\0`), close: () => toBrowser.end() };
  let pending = [];
  fromBrowser.on('data', (data) => {
    let begin = 0;
    for (let end = data.indexOf(0); end >= 0; begin = end + 1, end = data.indexOf(0, begin)) {
      const message = Buffer.concat([...pending, data.subarray(begin, end)]).toString();
      pending = [];
      transport.onmessage?.(message);
    }
    pending.push(data.subarray(begin));
  });
  toBrowser.on('error', () => {});
  fromBrowser.on('close', () => transport.onclose?.());
  return transport;
}

function puppeteerIn(packages) {
  try {
    return createRequire(path.join(packages, 'package.json'))('puppeteer-core');
  } catch {
    throw new Failure(`puppeteer-core is not in ${packages}; bench/peers/run.sh installs it`);
  }
}

// Throws a Failure where something is missing that each peer needs.
export function checkBrowser(packages) {
  findChromium();
  puppeteerIn(packages);
}

// A peer in a browser of its own. Each step that takes longer than `seconds` ends the browser and throws a Failure.
export class Peer {
  constructor(name, label, seconds) {
    Object.assign(this, { name, label, seconds });
  }

  async start(packages, software) {
    const puppeteer = puppeteerIn(packages), root = process.getuid?.() === 0 ? ['--no-sandbox'] : [];
    const child = spawn(findChromium(), [...FLAGS, ...root, `--user-data-dir=${temporaryFolder()}`],
      { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'], detached: true, env: environment(software) });
    this.kill = atEnd(() => killGroup(child.pid));
    const ended = new Promise((_, reject) => {
      child.on('error', reject);
      child.on('exit', () => reject(new Failure('Chromium ended')));
    });
    const connected = puppeteer.connect({ transport: transportOver(child), defaultViewport: null, protocolTimeout: 0 });
    this.ended = ended;
    this.ended.catch(() => {}); // each step looks at it
    this.browser = await this.step('the start of Chromium', connected);
    this.chromium = await this.step('the start of Chromium', this.browser.version());
  }

  // Opens the page with a scene; an earlier page of this browser is closed first.
  async open(origin, setup) {
    if (this.page) await this.step('closing its page', this.page.close());
    this.page = await this.step('opening its page', this.browser.newPage());
    const failed = [];
    this.page.on('pageerror', (error) => failed.push(lineOf(error)));
    this.page.on('requestfailed', (request) => failed.push(`${request.url()} can't be loaded`));
    this.page.on('response', (response) => {
      if (response.status() >= 400) failed.push(`${response.url()} can't be loaded: status ${response.status()}`);
    });
    await this.step('opening its page', this.page.goto(`${origin}/page/index.html`, { waitUntil: 'load' }));
    await this.step('opening its page', this.page.waitForFunction('window.peer', { timeout: 0, polling: 50 }));
    Object.assign(this, await this.call('opening the scene', 'open', this.name, setup));
    if (failed.length > 0) throw new Failure(`${this.label}: ${failed[0]}`);
  }

  // Calls a function of window.peer.
  call(what, method, ...args) {
    return this.step(what, this.page.evaluate((name, values) => window.peer[name](...values), method, args));
  }

  times(count, inRow, shadows) {
    return this.call('drawing', 'times', count, inRow, shadows);
  }

  async picture() {
    return Buffer.from(await this.call('drawing', 'picture'), 'base64');
  }

  async light(shadows) {
    const bytes = Buffer.from(await this.call('drawing', 'light', shadows), 'base64');
    return new Float32Array(bytes.buffer, bytes.byteOffset, bytes.length / 4);
  }

  async step(what, promise) {
    try {
      return await bounded(Promise.race([promise, this.ended]), this.seconds, what);
    } catch (error) {
      this.close();
      throw new Failure(`${this.label}: ${lineOf(error)}`);
    }
  }

  close() {
    this.kill?.();
  }
}
