// SPDX-License-Identifier: MIT

import { batch, computed, effect, signal, type ReadonlySignal } from '@preact/signals-core';
import type { EngineClient } from '../worker/EngineClient';
import type { FoundSurfaces, Regularity, SurfaceType, Walls } from '../worker/EngineModule';
import { latest } from './latest';

/** Surfaces of segments, and what they were made regular by. */
interface Finding {
  segmentOfFace: Uint32Array;
  regularity: Regularity | null;
  found: FoundSurfaces;
}

/** The surfaces that the segments of a machine part lie on, which follow the segments, and what of them is looked at. */
export class Surfaces {
  /** Without it surfaces stay as they were fitted. */
  readonly regularity = signal<Regularity | null>(null);
  private readonly finding = signal<Finding | null>(null);
  /** The surface of each segment, null until it is known. */
  readonly found = computed(() => {
    const finding = this.finding.value;
    const isCurrent = finding !== null && finding.segmentOfFace === this.segmentOfFace.value;
    return isCurrent && isSame(finding.regularity, this.regularity.value) ? finding.found : null;
  });
  /** The types of the surfaces that are greyed. */
  readonly greyed = signal<ReadonlySet<SurfaceType>>(new Set());
  /** The label of the segment that stands out. */
  readonly chosen = signal<number | null>(null);
  readonly pointedFace = signal<number | null>(null);
  /** The label of the segment under the pointer. */
  readonly pointed = computed(() => {
    const face = this.pointedFace.value;
    return face === null ? null : (this.segmentOfFace.value?.[face] ?? null);
  });

  /** What came with the mesh. */
  private given: Finding | null = null;

  /** @param segmentOfFace of a machine part; null for what else is shown */
  constructor(
    private readonly engine: EngineClient,
    private readonly segmentOfFace: ReadonlySignal<Uint32Array | null>,
    private readonly walls: ReadonlySignal<Walls>,
    private readonly report: (error: unknown) => void,
  ) {
    effect(() => {
      const segmentOfFace = this.segmentOfFace.value;
      this.regularity.value;
      this.walls.value;
      this.chosen.value = null;
      if (segmentOfFace) void this.find();
    });
  }

  /** Forgets what is known: the mesh is another. */
  reset(): void {
    batch(() => {
      this.given = this.finding.value = null;
      this.regularity.value = null;
      this.chosen.value = this.pointedFace.value = null;
      this.greyed.value = new Set();
    });
  }

  /** Takes surfaces from elsewhere. */
  take(given: Finding): void {
    this.given = given;
    this.regularity.value = given.regularity;
  }

  toggleType(type: SurfaceType): void {
    const greyed = new Set(this.greyed.peek());
    if (!greyed.delete(type)) greyed.add(type);
    this.greyed.value = greyed;
  }

  /** Lets a segment stand out, or none if it does already. */
  choose(label: number): void {
    this.chosen.value = this.chosen.peek() === label ? null : label;
  }

  private readonly find = latest(async () => {
    const segmentOfFace = this.segmentOfFace.peek();
    const regularity = this.regularity.peek();
    if (!segmentOfFace) return;
    try {
      const found = this.givenFor(segmentOfFace, regularity) ?? (await this.compute(segmentOfFace, regularity));
      this.finding.value = { segmentOfFace, regularity, found };
    } catch (error) {
      this.report(error);
    }
  });

  private compute(segmentOfFace: Uint32Array, regularity: Regularity | null): Promise<FoundSurfaces> {
    return this.engine.surfaces(segmentOfFace, regularity, this.walls.peek());
  }

  private givenFor(segmentOfFace: Uint32Array, regularity: Regularity | null): FoundSurfaces | null {
    const { given } = this;
    if (!given || !isSame(given.regularity, regularity) || given.segmentOfFace.length !== segmentOfFace.length)
      return null;
    return given.segmentOfFace.every((label, face) => label === segmentOfFace[face]) ? given.found : null;
  }
}

function isSame(a: Regularity | null, b: Regularity | null): boolean {
  return a === b || (a !== null && b !== null && a.length === b.length && a.angle === b.angle);
}
