// SPDX-License-Identifier: MIT

import { batch, computed, effect, signal } from '@preact/signals-core';
import { unpacked } from '../files/unpacked';
import { defaultParameters, type LoadedMesh, type MeshSource, type WalkParameters } from '../worker/calls';
import { Cancelled, EngineClient } from '../worker/EngineClient';
import type { Curves, Walls } from '../worker/EngineModule';
import { Appearance } from './Appearance';
import { AutomaticSegmentation } from './AutomaticSegmentation';
import { colorOf, type Color } from './colorVision';
import { latest } from './latest';
import { palette } from './palette';
import { segmentColors } from './segmentColors';
import { neighboursOf, segmentsOf, type Segment } from './segments';
import { SeedSegmentation } from './SeedSegmentation';
import { Surfaces } from './Surfaces';

export type Mode = 'seeds' | 'automatic';
export type Tool = 'view' | 'seed' | 'paint' | 'erase';

/** A segment as it is shown. */
export interface ShownSegment extends Segment {
  name: string;
  color: Color;
}

/** What is said to the user. */
export interface Message {
  kind: 'error' | 'note';
  text: string;
}

/** A mesh that is being segmented, and everything the page knows of it. */
export class Session {
  /** Answers edits of seeds. */
  readonly engine = new EngineClient();
  /** Does what takes longer, so that edits need not wait for it. */
  readonly background = new EngineClient();
  readonly seeds = new SeedSegmentation(this.engine, (error) => this.report(error));
  readonly parameters = signal<WalkParameters>(defaultParameters);
  readonly walls = computed(() => this.parameters.value.walls);
  readonly automatic = new AutomaticSegmentation(this.background, this.walls, (error) => this.report(error));
  readonly appearance = new Appearance();

  readonly mesh = signal<LoadedMesh | null>(null);
  readonly name = signal('');
  /** What is being opened. */
  readonly opening = signal<string | null>(null);
  readonly message = signal<Message | null>(null);
  readonly mode = signal<Mode>('seeds');
  readonly tool = signal<Tool>('seed');
  /** Labels that came with an embedded result, until another segmentation takes their place. */
  readonly givenLabels = signal<Uint32Array | null>(null);
  readonly curves = signal<Curves | null>(null);
  /** The edges that are walls, a curve each. */
  readonly wallEdges = signal<Curves | null>(null);

  /** The segment of each face, null before there are segments. */
  readonly segmentOfFace = computed(() =>
    this.mode.value === 'seeds'
      ? this.seeds.segmentOfFace.value
      : (this.automatic.segmentOfFace.value ?? this.givenLabels.value),
  );

  /** The segment of each face of a machine part, which are surfaces; null for other segments. */
  readonly surfaceSegments = computed(() =>
    this.mode.value === 'automatic' && this.automatic.kind.value === 'engineering' ? this.segmentOfFace.value : null,
  );
  readonly surfaces = new Surfaces(this.background, this.surfaceSegments, this.walls, (error) => this.report(error));

  readonly segments = computed<ShownSegment[]>(() => {
    const segmentOfFace = this.segmentOfFace.value;
    const mesh = this.mesh.value;
    if (!segmentOfFace || segmentOfFace.length !== mesh?.faces) return [];
    const segments = segmentsOf(segmentOfFace, mesh.faceAreas);
    return this.mode.value === 'seeds'
      ? this.named(segments)
      : this.coloredApart(segments, neighboursOf(segments, segmentOfFace, mesh.adjacentFaces), segmentOfFace);
  });

  /** The colour, as an index into the palette, that faces had in the last automatic segmentation. */
  private paletteOfFace: Uint8Array | null = null;
  /** What the engine has made the walk for. */
  private preparedParameters = defaultParameters;
  /** How many meshes were to be opened, and whether the last one was. */
  private openings = 0;
  private lastOpening = Promise.resolve(false);

  constructor() {
    effect(() => {
      this.curves.value = null;
      this.walls.value;
      if (this.appearance.boundaries.value && this.segmentOfFace.value) void this.findCurves();
    });
    effect(() => {
      // Labels of one mode mean nothing in the other, where what is found in the background hides and shows nothing.
      if (this.mode.value === 'automatic') this.automatic.level.value;
      this.appearance.showAll();
    });
  }

  /**
   * Opens another mesh. The one before stays if that fails. Of those that are asked for while one is being opened, the last
   * is opened after it.
   *
   * @param walls the edges of that mesh that are walls; those of the one before mean nothing there
   * @returns whether it was opened
   */
  open(name: string, source: () => Promise<MeshSource> | MeshSource, walls: Walls['file'] = null): Promise<boolean> {
    const opening = ++this.openings;
    this.opening.value = name;
    const isLast = () => opening === this.openings;
    this.lastOpening = this.lastOpening.then(async () => {
      const isOpened = isLast() && (await this.exchange(name, source, walls));
      if (isLast()) this.endOpening();
      return isOpened;
    });
    return this.lastOpening;
  }

  /** Ends when no mesh is being opened. */
  async whenOpened(): Promise<void> {
    while (this.opening.peek() !== null) await this.lastOpening;
  }

  private async exchange(
    name: string,
    source: () => Promise<MeshSource> | MeshSource,
    walls: Walls['file'],
  ): Promise<boolean> {
    try {
      const content = await source();
      const parameters = this.parameters.peek();
      const nextParameters = { ...parameters, walls: { ...parameters.walls, file: walls } };
      const mesh = await this.engine.load(content, nextParameters);
      this.background.follow(content);
      batch(() => {
        this.paletteOfFace = null;
        this.givenLabels.value = null;
        this.curves.value = null;
        const asked = this.parameters.peek(); // which may have changed meanwhile
        this.preparedParameters = nextParameters;
        this.parameters.value =
          asked === parameters ? nextParameters : { ...asked, walls: { ...asked.walls, file: walls } };
        this.wallEdges.value = mesh.walls;
        this.appearance.reset();
        this.automatic.reset();
        this.surfaces.reset();
        this.seeds.reset();
        this.mesh.value = mesh;
        this.name.value = name;
        this.message.value = mesh.notes.length > 0 ? { kind: 'note', text: mesh.notes.join(' ') } : null;
      });
      return true;
    } catch (error) {
      this.report(error, `${name} was not opened. `);
      return false;
    }
  }

  private endOpening(): void {
    this.opening.value = null;
    if (this.mesh.peek() && this.parameters.peek() !== this.preparedParameters) void this.prepare();
  }

  openFile(file: File): Promise<boolean> {
    return this.open(file.name, async () => ({ fileName: file.name, bytes: await unpacked(file) }));
  }

  openModel(model: string): Promise<boolean> {
    return this.open(modelName(model), () => ({ model }));
  }

  setParameters(parameters: Partial<WalkParameters>): void {
    this.parameters.value = { ...this.parameters.peek(), ...parameters };
    if (this.mesh.peek() && this.opening.peek() === null) void this.prepare();
  }

  resetParameters(): void {
    this.setParameters({ ...defaultParameters, walls: this.walls.peek() });
  }

  setWalls(walls: Partial<Walls>): void {
    this.setParameters({ walls: { ...this.walls.peek(), ...walls } });
  }

  /** Tells the user of an error. */
  report(error: unknown, prefix = ''): void {
    if (error instanceof Cancelled) return;
    this.message.value = { kind: 'error', text: prefix + (error instanceof Error ? error.message : String(error)) };
  }

  private readonly prepare = latest(async () => {
    const parameters = this.parameters.peek();
    try {
      this.wallEdges.value = await this.engine.prepare(parameters);
      this.preparedParameters = parameters;
      await this.seeds.recompute();
    } catch (error) {
      if (parameters === this.parameters.peek()) this.parameters.value = this.preparedParameters;
      this.report(error);
    }
  });

  private readonly findCurves = latest(async () => {
    const segmentOfFace = this.segmentOfFace.peek();
    if (!segmentOfFace || !this.appearance.boundaries.peek()) return;
    try {
      const curves = await this.background.smoothBoundaries(segmentOfFace, this.walls.peek());
      if (segmentOfFace === this.segmentOfFace.peek()) this.curves.value = curves;
    } catch (error) {
      this.report(error);
    }
  });

  /** Segments with the names and colours of their labels. Components without seeds have neither. */
  private named(segments: Segment[]): ShownSegment[] {
    const seeded = this.seeds.seededLabels.value;
    const labels = new Map(
      this.seeds.labels.value.filter(({ id }) => seeded.has(id)).map((label) => [label.id, label]),
    );
    return segments.map((segment) => {
      const label = labels.get(segment.label);
      return {
        ...segment,
        name: label?.name ?? `Unseeded ${segment.label + 1}`,
        color: label ? colorOf(label.color) : palette[segment.label % palette.length],
      };
    });
  }

  /** Segments with colours unlike those of their neighbours, which faces keep from level to level where that suits. */
  private coloredApart(segments: Segment[], neighbours: number[][], segmentOfFace: Uint32Array): ShownSegment[] {
    const index = new Map(segments.map(({ label }, i) => [label, i]));
    const former: (number | undefined)[] = [];
    this.paletteOfFace?.forEach((color, face) => (former[index.get(segmentOfFace[face])!] ??= color));
    const colors = segmentColors(neighbours, former);
    this.paletteOfFace = Uint8Array.from(segmentOfFace, (label) => colors[index.get(label)!]);
    return segments.map((segment, i) => ({ ...segment, name: `Part ${segment.label + 1}`, color: palette[colors[i]] }));
  }
}

/** What a built-in model is called. */
export function modelName(model: string): string {
  return model[0].toUpperCase() + model.slice(1).replaceAll('_', ' ');
}
