import type { Color } from './colorVision';
import { distinct, palette, paletteDistance } from './palette';

/**
 * A colour of the palette for each segment, such that neighbours never look alike, also to people with a colour-vision
 * deficiency.
 *
 * Segments keep the colour that they had where it suits. The others get, of the colours that are far enough from those
 * of the neighbours, the least used one. A segment with so many neighbours that none is far enough gets the farthest.
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
  const take = (segment: number, color: number) => {
    choice[segment] = color;
    ++uses[color];
  };
  const chooseBest = (segment: number) => {
    let best = 0;
    let bestDistance = -1;
    for (let candidate = 0; candidate < palette.length; ++candidate) {
      const distance = distanceToNeighbours(segment, candidate);
      if (distance > bestDistance || (distance === bestDistance && uses[candidate] < uses[best])) {
        best = candidate;
        bestDistance = distance;
      }
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

export function paletteColors(indices: readonly number[]): Color[] {
  return indices.map((i) => palette[i]);
}
