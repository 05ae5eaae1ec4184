// SPDX-License-Identifier: MIT

import { distinct, palette, paletteDistance } from './palette';

/**
 * A colour of the palette for each segment, such that neighbours never look alike, also to people with a colour-vision
 * deficiency.
 *
 * Segments keep the colour that they had where it suits. The others get, of the colours that are far enough from those
 * of the neighbours, the least used one, if possible one that looks like no other in use. A segment with so many neighbours that none is far enough gets the farthest.
 *
 * @param neighbours the neighbours of each segment
 * @param former the colour that a segment had, as an index into the palette
 * @returns indices into the palette
 */
export function segmentColors(neighbours: readonly number[][], former: readonly (number | undefined)[] = []): number[] {
  const choice: (number | undefined)[] = neighbours.map(() => undefined);
  const uses = palette.map(() => 0);

  const distanceToNeighbours = (segment: number, candidate: number): number => {
    let smallest = distinct;
    for (const neighbour of neighbours[segment]) {
      const taken = choice[neighbour];
      if (taken !== undefined) smallest = Math.min(smallest, paletteDistance[candidate][taken]);
    }
    return smallest;
  };
  /** How unlike all colours in use each colour is. */
  const rarity = palette.map(() => distinct);
  const take = (segment: number, color: number) => {
    choice[segment] = color;
    ++uses[color];
    paletteDistance[color].forEach((distance, other) => (rarity[other] = Math.min(rarity[other], distance)));
  };
  const chooseBest = (segment: number) => {
    const loss = (candidate: number) => [
      -distanceToNeighbours(segment, candidate),
      uses[candidate],
      -rarity[candidate],
    ];
    let best = 0;
    let leastLoss = loss(0);
    for (let candidate = 1; candidate < palette.length; ++candidate) {
      const candidateLoss = loss(candidate);
      if (isLess(candidateLoss, leastLoss)) [best, leastLoss] = [candidate, candidateLoss];
    }
    take(segment, best);
  };

  // Those with the most neighbours choose first (Welsh and Powell 1967).
  const order = neighbours.map((_, segment) => segment);
  order.sort((a, b) => neighbours[b].length - neighbours[a].length);
  for (const segment of order) {
    const color = former[segment];
    if (color !== undefined && uses[color] === 0 && distanceToNeighbours(segment, color) >= distinct)
      take(segment, color);
  }
  for (const segment of order) if (choice[segment] === undefined) chooseBest(segment);
  return choice as number[];
}

/** The lexicographic order. */
function isLess(a: readonly number[], b: readonly number[]): boolean {
  const first = a.findIndex((value, i) => value !== b[i]);
  return first >= 0 && a[first] < b[first];
}
