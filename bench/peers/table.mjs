// The results as text: on a terminal, or in Markdown.

const milliseconds = (value) => (value >= 100 ? value.toFixed(0) : value.toFixed(value >= 10 ? 1 : 2));

const times = (summary) => (summary === null ? '-'
  : `${milliseconds(summary.median)} (${milliseconds(summary.min)} to ${milliseconds(summary.max)})`);

// Penumbra's JSON writes infinity as a word.
const decibels = (value) => (typeof value === 'number' ? value.toFixed(1) : value ?? '-');

const HEAD = ['renderer', 'shadows', 'maps', 'with shadows, ms', 'without, ms', 'PSNR penumbra, dB', 'PSNR, dB'];

function cellsOf(row, mapSize) {
  const first = [`${row.renderer} ${row.version ?? ''}`.trim(), row.technique, `${row.maps} x ${mapSize}²`];
  if (row.failed) return [...first, 'failed', '-', '-', '-'];
  return [...first, times(row.shadowed_ms), times(row.unshadowed_ms), decibels(row.figures?.psnr_penumbra),
    decibels(row.figures?.psnr)];
}

function ratioLine({ technique, peer, maps, median, min, max }) {
  return `${technique} over ${peer}, ${maps === 1 ? 'one map' : `${maps} maps`}: ${median.toFixed(2)} ` +
    `(${min.toFixed(2)} to ${max.toFixed(2)})`;
}

function pixelsLine({ receivers, compared }) {
  return `PSNR over ${compared} pixels, ${((100 * compared) / receivers).toFixed(1)} % of the truth's receivers`;
}

// What stands below a table, line by line.
function notesOf(result) {
  return [...(result.pixels ? [pixelsLine(result.pixels)] : []), ...result.ratios.map(ratioLine),
    ...result.rows.filter((row) => row.failed).map((row) => `failed: ${row.failed}`),
    ...result.warnings.map((text) => `warning: ${text}`)];
}

export function textTable(result, mapSize) {
  const lines = [HEAD, ...result.rows.map((row) => cellsOf(row, mapSize))];
  const widths = HEAD.map((_, i) => Math.max(...lines.map((line) => line[i].length)));
  const table = lines.map((line) =>
    line.map((cell, i) => (i < 3 ? cell.padEnd(widths[i]) : cell.padStart(widths[i]))).join('  ').trimEnd());
  return [`${result.scene}, ${result.triangles} triangles`, ...table, ...notesOf(result)].join('\n');
}

export function conditions({ machine, settings, chromium, drivers }) {
  const taps = `${settings.taps.blocker} blocker and ${settings.taps.filter} filter taps`;
  return `${machine.cores} cores of ${machine.cpu}, Node.js ${machine.node}, ${chromium ?? 'no Chromium'}; drivers: ` +
    `${drivers.join('; ')}. ${settings.width} x ${settings.height} pixels, ${taps}, maps drawn ` +
    `${settings.keepMaps ? 'once and kept' : 'anew in each frame'}, ` +
    `${settings.white ? 'plain white' : 'the scene\'s own'} materials, a sun of ${settings.sunAngle}°. Times: the ` +
    `median of ${settings.rounds} rounds' medians of ${settings.frames} frames, in brackets the least and the ` +
    'greatest of these.';
}

export function markdown(report) {
  const line = (cells) => `| ${cells.join(' | ')} |`;
  const tables = report.scenes.map((result) => [`### ${result.scene}, ${result.triangles} triangles`, '', line(HEAD),
    line(HEAD.map(() => '---')), ...result.rows.map((row) => line(cellsOf(row, report.settings.mapSize))), '',
    ...notesOf(result).map((text) => `- ${text}`), ''].join('\n'));
  return `${conditions(report)}\n\n${tables.join('\n')}`;
}
