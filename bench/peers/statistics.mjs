export function median(values) {
  const sorted = [...values].sort((a, b) => a - b), middle = sorted.length >> 1;
  return sorted.length % 2 === 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

// Of the medians of rounds: their median, and how far they are apart.
export const summary = (rounds) =>
  (rounds.length === 0 ? null : { median: median(rounds), min: Math.min(...rounds), max: Math.max(...rounds) });

// The cost of one renderer relative to another's, round by round, so that a machine that slows down slows both.
export const ratio = (rounds, otherRounds) => summary(rounds.map((value, i) => value / otherRounds[i]));
