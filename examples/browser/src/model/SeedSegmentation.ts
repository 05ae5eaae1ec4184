// SPDX-License-Identifier: MIT

import { batch, computed, signal } from '@preact/signals-core';
import type { EngineClient } from '../worker/EngineClient';
import { amend, beginHistory, record, redo, undo } from './History';
import {
  newAnnotation,
  withChangedLabel,
  withNewLabel,
  withoutLabelAndSeeds,
  type Annotation,
  type Label,
} from './labels';
import { latest } from './latest';
import { sameSeeds, withoutSeeds, withSeeds } from './seeds';

/** The user's labels and seeds, and the segments that the walk makes of them. */
export class SeedSegmentation {
  private readonly history = signal(beginHistory(newAnnotation));
  readonly annotation = computed(() => this.history.value.present);
  readonly labels = computed(() => this.annotation.value.labels);
  readonly canUndo = computed(() => this.history.value.past.length > 0);
  readonly canRedo = computed(() => this.history.value.future.length > 0);

  /** The label that new seeds get. */
  readonly currentLabel = signal(0);
  /** The segment of each face, null without seeds. */
  readonly segmentOfFace = signal<Uint32Array | null>(null);
  /** The labels whose seeds made those segments; components without seeds have others. */
  readonly seededLabels = signal<ReadonlySet<number>>(new Set());
  /** The label whose probability is looked at. */
  readonly probableLabel = signal<number | null>(null);
  readonly probabilities = signal<Float32Array | null>(null);
  /** How long the last answer took, from the edit on. */
  readonly milliseconds = signal<number | null>(null);

  private meshes = 0;

  constructor(
    private readonly engine: EngineClient,
    private readonly report: (error: unknown) => void,
  ) {}

  /** Begins anew on another mesh, with segments that are known already, if any are. */
  reset(annotation: Annotation = newAnnotation, segmentOfFace: Uint32Array | null = null): void {
    ++this.meshes;
    batch(() => {
      this.history.value = beginHistory(annotation);
      this.currentLabel.value = annotation.labels[0]?.id ?? 0;
      this.segmentOfFace.value = segmentOfFace;
      this.seededLabels.value = new Set(annotation.seeds.values());
      this.probableLabel.value = null;
      this.probabilities.value = null;
      this.milliseconds.value = null;
    });
  }

  /**
   * @param goesOn whether the edit is a part of the one before, as in a stroke
   * @returns whether that changes anything
   */
  place(faces: Iterable<number>, goesOn = false): boolean {
    const annotation = this.annotation.peek();
    return this.edit({ ...annotation, seeds: withSeeds(annotation.seeds, faces, this.currentLabel.peek()) }, goesOn);
  }

  /** As `place()`. */
  erase(faces: Iterable<number>, goesOn = false): boolean {
    const annotation = this.annotation.peek();
    return this.edit({ ...annotation, seeds: withoutSeeds(annotation.seeds, faces) }, goesOn);
  }

  eraseAll(): void {
    this.edit({ ...this.annotation.peek(), seeds: new Map() });
  }

  /** Takes labels and seeds from elsewhere, as one edit. */
  replace(annotation: Annotation): void {
    this.edit(annotation);
    this.currentLabel.value = annotation.labels[0]?.id ?? 0;
  }

  addLabel(): void {
    const before = new Set(this.annotation.peek().labels.map((label) => label.id));
    this.edit(withNewLabel(this.annotation.peek()));
    const added = this.annotation.peek().labels.find((label) => !before.has(label.id));
    if (added) this.currentLabel.value = added.id;
  }

  changeLabel(id: number, change: Partial<Omit<Label, 'id'>>): void {
    this.edit(withChangedLabel(this.annotation.peek(), id, change));
  }

  removeLabel(id: number): void {
    this.edit(withoutLabelAndSeeds(this.annotation.peek(), id));
  }

  undo(): void {
    this.moveTo(undo(this.history.peek()));
  }

  redo(): void {
    this.moveTo(redo(this.history.peek()));
  }

  /** Shows or, with null, leaves the probability of a label. */
  showProbability(label: number | null): void {
    this.probableLabel.value = label;
    if (label === null) this.probabilities.value = null;
    else void this.recompute();
  }

  /** Asks the engine for the segments of the seeds as they are. */
  readonly recompute = latest(async () => {
    const mesh = this.meshes;
    const { seeds } = this.annotation.peek();
    const label = this.probableLabel.peek();
    const start = performance.now();
    try {
      const segmentOfFace = await this.engine.segment(seeds);
      const probabilities = label === null || seeds.size === 0 ? null : await this.engine.probabilities(seeds, label);
      if (mesh !== this.meshes) return;
      batch(() => {
        this.segmentOfFace.value = segmentOfFace;
        this.seededLabels.value = new Set(seeds.values());
        this.probabilities.value = this.probableLabel.peek() === label ? probabilities : null;
        this.milliseconds.value = seeds.size === 0 ? null : performance.now() - start;
      });
    } catch (error) {
      if (mesh === this.meshes) this.report(error);
    }
  });

  private edit(next: Annotation, goesOn = false): boolean {
    const history = this.history.peek();
    const unchanged = next.labels === history.present.labels && sameSeeds(next.seeds, history.present.seeds);
    if (!unchanged) this.moveTo(goesOn ? amend(history, next) : record(history, next));
    return !unchanged;
  }

  private moveTo(history: ReturnType<typeof undo<Annotation>>): void {
    const before = this.annotation.peek();
    batch(() => {
      this.history.value = history;
      const { labels } = history.present;
      const has = (id: number | null) => labels.some((label) => label.id === id);
      if (!has(this.currentLabel.peek())) this.currentLabel.value = labels[0]?.id ?? 0;
      if (!has(this.probableLabel.peek())) this.showProbability(null);
    });
    if (!sameSeeds(before.seeds, history.present.seeds)) void this.recompute();
  }
}
