// What has to be undone however the program ends: processes that it started, temporary folders.
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';

const actions = new Set();

// Runs the action, which must be synchronous, when the program ends. Returns a function that runs it at once instead.
export function atEnd(action) {
  actions.add(action);
  return () => {
    if (actions.delete(action)) action();
  };
}

function undoAll() {
  for (const action of [...actions].reverse()) {
    actions.delete(action);
    try {
      action();
    } catch {
      // The others still have to be undone.
    }
  }
}

export function undoAtEveryEnd() {
  process.on('exit', undoAll);
  for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP']) {
    process.on(signal, () => process.exit(128 + os.constants.signals[signal]));
  }
}

export function temporaryFolder() {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'penumbra-peers-'));
  atEnd(() => fs.rmSync(folder, { recursive: true, force: true, maxRetries: 5, retryDelay: 100 }));
  return folder;
}

// Ends a process and all that it started in its group.
export function killGroup(pid) {
  try {
    if (pid) process.kill(-pid, 'SIGKILL');
  } catch {
    // It has ended already.
  }
}
