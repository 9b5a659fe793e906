// An error whose message is one clear line for the user.
export class Failure extends Error {
  constructor(message, code = 1) {
    super(message);
    this.code = code;
  }
}

// The first line of any error's message.
export const lineOf = (error) => String(error?.message ?? error).split('\n')[0];

// Rejects with a Failure if the promise takes longer.
export function bounded(promise, seconds, what) {
  let timer;
  const late = new Promise((_, reject) => {
    timer = setTimeout(() => reject(new Failure(`${what} took longer than ${seconds} s`)), seconds * 1000);
  });
  return Promise.race([promise, late]).finally(() => clearTimeout(timer));
}
