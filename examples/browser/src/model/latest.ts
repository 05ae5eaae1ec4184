// SPDX-License-Identifier: MIT

/**
 * Runs a job now, or, while it runs, once more after its end, however often it is asked for: answers follow edits as
 * fast as they come, and the last edit is always answered.
 *
 * @returns asks for the job; the promise ends when no run is left
 */
export function latest(job: () => Promise<void>): () => Promise<void> {
  let running: Promise<void> | undefined;
  let again = false;
  const run = async () => {
    do {
      again = false;
      await job();
    } while (again);
  };
  return () => {
    again = true;
    running ??= run().finally(() => (running = undefined));
    return running;
  };
}
