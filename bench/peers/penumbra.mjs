// The program penumbra: every figure of its side comes from its own commands.
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { atEnd } from './cleanup.mjs';
import { Failure } from './failure.mjs';

export class Penumbra {
  constructor(program, seconds) {
    this.program = program;
    this.seconds = seconds;
    if (!fs.existsSync(program)) throw new Failure(`${program}: no such file; ./run.sh builds penumbra`);
  }

  // Runs a command and resolves to what it prints.
  run(...args) {
    return new Promise((resolve, reject) => {
      const child = spawn(this.program, args.map(String), { stdio: ['ignore', 'pipe', 'pipe'] });
      const end = atEnd(() => child.kill('SIGKILL'));
      const name = `penumbra ${args[0]}`;
      let out = '', errors = '', late = false;
      const timer = setTimeout(() => {
        late = true;
        child.kill('SIGKILL');
      }, this.seconds * 1000);
      for (const stream of [child.stdout, child.stderr]) stream.setEncoding('utf8');
      child.stdout.on('data', (data) => { out += data; });
      child.stderr.on('data', (data) => { errors += data; });
      child.on('error', (error) => {
        clearTimeout(timer);
        end();
        reject(new Failure(`${name}: ${error.message}`));
      });
      child.on('close', (code) => {
        clearTimeout(timer);
        end();
        if (late) return reject(new Failure(`${name} took longer than ${this.seconds} s`));
        const said = errors.split('\n').find((line) => line.startsWith('error: '))?.slice('error: '.length);
        return code === 0 ? resolve(out) : reject(new Failure(`${name}: ${said ?? `exit code ${code}`}`));
      });
    });
  }

  async paramNames() {
    return JSON.parse(await this.run('list', 'params', '--json')).rows.map((row) => row.name);
  }

  // What --stats writes of a picture without shadows: camera, sun, scene and device.
  async facts(scene, sceneArgs, folder) {
    const file = path.join(folder, 'stats.json');
    await this.run('render', scene, '-o', path.join(folder, 'facts.png'), ...sceneArgs, '--technique', 'none',
      '--stats', file, '--quiet');
    return JSON.parse(fs.readFileSync(file, 'utf8'));
  }

  // The errors of a picture's shadows over the receivers of the reference.
  async figures(picture, reference) {
    const layers = ['--layer', 'shadow', '--mask', 'receiver'];
    return JSON.parse(await this.run('diff', picture, reference, ...layers, '--json', '-')).figures;
  }
}
