import { batch, computed, signal } from '@preact/signals-core';
import { Cancelled, type EngineClient } from '../worker/EngineClient';
import type { Hierarchy, HierarchyKind } from '../worker/EngineModule';
import { segmentsAtLevel } from './mergeTree';

/** A hierarchy, and the number of parts that is looked at. */
interface Level {
  hierarchy: Hierarchy;
  parts: number;
  /** How long it took, if it was made here. */
  milliseconds?: number;
}

/** Segments without seeds. The walk makes a hierarchy once; all numbers of parts are read off it. */
export class AutomaticSegmentation {
  readonly kind = signal<HierarchyKind>('graphical');
  /** The part done of a running computation. */
  readonly progress = signal<number | null>(null);
  private readonly levels = signal<Partial<Record<HierarchyKind, Level>>>({});

  readonly level = computed(() => this.levels.value[this.kind.value] ?? null);
  readonly segmentOfFace = computed(() =>
    this.level.value ? segmentsAtLevel(this.level.value.hierarchy, this.level.value.parts) : null,
  );

  private meshes = 0;

  constructor(
    private readonly engine: EngineClient,
    private readonly report: (error: unknown) => void,
  ) {}

  /** Forgets the hierarchies: the mesh or the parameters are others. */
  reset(): void {
    ++this.meshes;
    this.levels.value = {};
  }

  /** Takes a hierarchy from elsewhere. */
  take(kind: HierarchyKind, level: Level): void {
    batch(() => {
      this.kind.value = kind;
      this.levels.value = { ...this.levels.peek(), [kind]: level };
    });
  }

  async compute(): Promise<void> {
    if (this.progress.peek() !== null) return;
    const kind = this.kind.peek();
    const mesh = this.meshes;
    this.progress.value = 0;
    try {
      const hierarchy = await this.engine.hierarchy(kind, (fraction) => (this.progress.value = fraction));
      if (mesh === this.meshes) {
        this.take(kind, { hierarchy, parts: hierarchy.suggested, milliseconds: hierarchy.milliseconds });
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
    if (level) this.take(this.kind.peek(), { ...level, parts });
  }
}
