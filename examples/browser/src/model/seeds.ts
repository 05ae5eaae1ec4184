// SPDX-License-Identifier: MIT

/** The label of each seed face. */
export type Seeds = ReadonlyMap<number, number>;

/** The seeds with some faces more, or with another label for them. */
export function withSeeds(seeds: Seeds, faces: Iterable<number>, label: number): Seeds {
  const result = new Map(seeds);
  for (const face of faces) result.set(face, label);
  return result;
}

export function withoutSeeds(seeds: Seeds, faces: Iterable<number>): Seeds {
  const result = new Map(seeds);
  for (const face of faces) result.delete(face);
  return result;
}

export function withoutLabel(seeds: Seeds, label: number): Seeds {
  return new Map([...seeds].filter(([, seedLabel]) => seedLabel !== label));
}

export function sameSeeds(a: Seeds, b: Seeds): boolean {
  return a.size === b.size && [...a].every(([face, label]) => b.get(face) === label);
}

/** What has to be done to one set of seeds to get another. */
export interface SeedEdit {
  removed: number[];
  /** Face and label; faces that change their label among them. */
  added: [number, number][];
}

export function seedEdit(from: Seeds, to: Seeds): SeedEdit {
  return {
    removed: [...from.keys()].filter((face) => !to.has(face)),
    added: [...to].filter(([face, label]) => from.get(face) !== label),
  };
}
