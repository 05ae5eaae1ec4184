// SPDX-License-Identifier: MIT

import { computed, signal, type ReadonlySignal } from '@preact/signals-core';
import { defaultPolicies } from '../worker/calls';
import { Cancelled, type EngineClient } from '../worker/EngineClient';
import type { AutomaticMethod, Hierarchy, HierarchyKind, Policies, Walls } from '../worker/EngineModule';
import { segmentsAtLevel } from './mergeTree';

/** A hierarchy, and the number of parts that is looked at. */
interface Level {
  hierarchy: Hierarchy;
  parts: number;
  /** How long it took, if it was made here. */
  milliseconds?: number;
  /** Segments that came with the hierarchy, whose faces may have been cut along smooth boundaries since it was made. */
  given?: { parts: number; segmentOfFace: Uint32Array };
}

function segmentsOf({ hierarchy, parts, given }: Level): Uint32Array {
  return given?.parts === parts ? given.segmentOfFace : segmentsAtLevel(hierarchy, parts);
}

/** The same for methods and walls that give the same hierarchy. */
function nameOf({ kind, difference, radius, seeding, mergeCost }: AutomaticMethod, walls: Walls): string {
  const ofCurvatures = difference === 'curvature' ? radius : null;
  const policies = kind === 'engineering' ? null : [difference, ofCurvatures, seeding, mergeCost];
  return JSON.stringify([kind, policies, walls]);
}

/** Segments without seeds. The walk makes a hierarchy once for each method and walls; all numbers of parts are read off it. */
export class AutomaticSegmentation {
  readonly kind = signal<HierarchyKind>('graphical');
  readonly policies = signal<Policies>(defaultPolicies);
  private readonly method = computed<AutomaticMethod>(() => ({ kind: this.kind.value, ...this.policies.value }));
  /** The part done of a running computation. */
  readonly progress = signal<number | null>(null);
  private readonly levels = signal<Partial<Record<string, Level>>>({});

  readonly level = computed(() => this.levels.value[nameOf(this.method.value, this.walls.value)] ?? null);
  readonly segmentOfFace = computed(() => (this.level.value ? segmentsOf(this.level.value) : null));

  private meshes = 0;

  constructor(
    private readonly engine: EngineClient,
    private readonly walls: ReadonlySignal<Walls>,
    private readonly report: (error: unknown) => void,
  ) {}

  /** Forgets the hierarchies: the mesh or the parameters are others. */
  reset(): void {
    ++this.meshes;
    this.levels.value = {};
  }

  /** Takes a hierarchy, which is shown while its method and walls are chosen. */
  keep(method: AutomaticMethod, walls: Walls, level: Level): void {
    this.levels.value = { ...this.levels.peek(), [nameOf(method, walls)]: level };
  }

  setPolicies(policies: Partial<Policies>): void {
    this.policies.value = { ...this.policies.peek(), ...policies };
  }

  async compute(): Promise<void> {
    if (this.progress.peek() !== null) return;
    const method = this.method.peek();
    const walls = this.walls.peek();
    const mesh = this.meshes;
    this.progress.value = 0;
    try {
      const hierarchy = await this.engine.hierarchy(method, walls, (fraction) => (this.progress.value = fraction));
      if (mesh === this.meshes) {
        // The user may have chosen another method meanwhile, which stays chosen.
        this.keep(method, walls, { hierarchy, parts: hierarchy.suggested, milliseconds: hierarchy.milliseconds });
      }
    } catch (error) {
      if (!(error instanceof Cancelled)) this.report(error);
    } finally {
      this.progress.value = null;
    }
  }

  cancel(): void {
    if (this.progress.peek() !== null) this.engine.cancel();
  }

  setParts(parts: number): void {
    const level = this.level.peek();
    if (level) this.keep(this.method.peek(), this.walls.peek(), { ...level, parts });
  }
}
