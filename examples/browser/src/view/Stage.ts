// SPDX-License-Identifier: MIT

import { effect, untracked } from '@preact/signals-core';
import { Vector3 } from 'three';
import { colorOf, type Color } from '../model/colorVision';
import { heat } from '../model/heatMap';
import type { Session, ShownSegment } from '../model/Session';
import type { LoadedMesh } from '../worker/calls';
import { SeedMarkers, type Marker } from './SeedMarkers';
import { packed, SegmentedMesh, type Placement } from './SegmentedMesh';
import { SurfaceCurves } from './SurfaceCurves';
import { Viewer } from './Viewer';

const grey: Color = [196, 202, 210];
const unsegmented = packed(grey);
/** How much of their colour segments keep beside one that stands out. */
const faded = 0.3;
const boundaryColor = 0x14181f;
const wallColor = 0xd0021b;

/** Shows the mesh of a session as the session says, and follows its changes. */
export class Stage {
  readonly viewer: Viewer;
  shown: SegmentedMesh | null = null;
  private readonly markers = new SeedMarkers();
  private readonly curves = new SurfaceCurves(boundaryColor);
  private readonly walls = new SurfaceCurves(wallColor);

  constructor(
    private readonly session: Session,
    canvas: HTMLCanvasElement,
  ) {
    this.viewer = new Viewer(canvas);
    this.viewer.content.add(this.markers.object, this.walls.object, this.curves.object);
    effect(() => this.exchangeMesh());
    effect(() => this.paint());
    effect(() => this.place());
    effect(() => this.showSeeds());
    effect(() => this.showCurves());
    effect(() => this.approachChosen());
  }

  /** Shows all of the mesh. */
  fit(): void {
    if (this.shown) this.viewer.fit(this.shown.bounds());
  }

  /** Turns another axis of the mesh up. */
  turnUp(): void {
    this.viewer.turnUp();
    if (this.shown) this.viewer.fitFromFront(this.shown.bounds());
  }

  private exchangeMesh(): void {
    const mesh = this.session.mesh.value;
    if (this.shown) {
      this.viewer.content.remove(this.shown.object);
      this.shown.dispose();
    }
    this.shown = mesh && new SegmentedMesh(mesh);
    if (!this.shown) return;
    this.viewer.content.add(this.shown.object);
    this.viewer.fitFromFront(this.shown.bounds());
  }

  private paint(): void {
    const { session, shown } = this;
    if (!session.mesh.value || !shown) return;
    const probabilities = session.mode.value === 'seeds' ? session.seeds.probabilities.value : null;
    const segmentOfFace = session.segmentOfFace.value;
    if (probabilities) {
      const colors = Array.from({ length: 256 }, (_, i) => packed(heat(i / 255)));
      shown.paint((face) => colors[Math.round(255 * probabilities[face])]);
    } else if (segmentOfFace) {
      const colors: number[] = [];
      for (const segment of session.segments.value) colors[segment.label] = packed(this.colorOf(segment));
      shown.paint((face) => colors[segmentOfFace[face]]);
    } else {
      shown.paint(() => unsegmented);
    }
    this.viewer.draw();
  }

  /** The colour of a segment: greyed if its surface is of no interest, and faded beside one that stands out. */
  private colorOf({ label, color }: ShownSegment): Color {
    const { found, greyed, chosen } = this.session.surfaces;
    const surface = found.value?.surfaces[label];
    if (!surface || chosen.value === label) return color;
    if (greyed.value.has(surface.type)) return grey;
    const mixed = (i: number) => Math.round(faded * color[i] + (1 - faded) * grey[i]);
    return chosen.value === null ? color : [mixed(0), mixed(1), mixed(2)];
  }

  private approachChosen(): void {
    const label = this.session.surfaces.chosen.value;
    const segmentOfFace = this.session.segmentOfFace.peek();
    if (label === null || !segmentOfFace || !this.shown) return;
    const { sphere, normal } = this.shown.boundsOf((face) => segmentOfFace[face] === label);
    this.viewer.approach(sphere, normal);
  }

  private place(): void {
    const { session, shown } = this;
    const mesh = session.mesh.value;
    const explosion = session.appearance.explosion.value;
    const hidden = session.appearance.hidden.value;
    const isPlain = explosion === 0 && hidden.size === 0;
    if (!mesh || !shown || (isPlain && shown.isPlain)) return;
    const segmentOfFace = isPlain ? null : session.segmentOfFace.value;
    const placements: Placement[] = segmentOfFace ? this.placements(mesh, segmentOfFace, session.segments.value) : [];
    const inPlace = new Vector3();
    shown.place((face) => (segmentOfFace && placements[segmentOfFace[face]]) || inPlace);
    shown.isPlain = isPlain;
    untracked(() => this.showSeeds());
  }

  /** Where each segment goes: away from the centre of the mesh by a part of its distance, or out of sight. */
  private placements(mesh: LoadedMesh, segmentOfFace: Uint32Array, segments: readonly ShownSegment[]): Placement[] {
    const { hidden, explosion } = this.session.appearance;
    const centers: Vector3[] = [];
    const whole = new Vector3();
    const corner = new Vector3();
    const corners: number[] = [];
    mesh.triangles.forEach((vertex, i) => {
      const label = segmentOfFace[mesh.faceOfTriangle[Math.floor(i / 3)]];
      corner.fromArray(mesh.positions, 3 * vertex);
      (centers[label] ??= new Vector3()).add(corner);
      corners[label] = (corners[label] ?? 0) + 1;
      whole.add(corner);
    });
    whole.divideScalar(Math.max(mesh.triangles.length, 1));
    const placements: Placement[] = [];
    for (const { label } of segments) {
      const center = centers[label].divideScalar(corners[label]);
      placements[label] = hidden.value.has(label) ? 'hidden' : center.sub(whole).multiplyScalar(explosion.value);
    }
    return placements;
  }

  private showSeeds(): void {
    const { session, shown } = this;
    const mesh = session.mesh.value;
    const { labels, seeds } = session.seeds.annotation.value;
    if (!shown || !mesh || session.mode.value !== 'seeds') {
      this.markers.show([]);
    } else {
      const colors = new Map(labels.map((label) => [label.id, colorOf(label.color)]));
      const markers: Marker[] = [];
      for (const [face, label] of seeds) {
        const place = face < mesh.faces ? shown.center(face) : null;
        if (place) markers.push({ place, color: colors.get(label) ?? [255, 255, 255] });
      }
      this.markers.show(markers);
    }
    this.viewer.drawSoon();
  }

  /** Curves stay where the mesh is, so that they are shown only while all of it is in place. */
  private showCurves(): void {
    const { hidden, explosion } = this.session.appearance;
    const isWhole = hidden.value.size === 0 && explosion.value === 0;
    this.curves.show(isWhole ? this.session.curves.value : null);
    this.walls.show(isWhole ? this.session.wallEdges.value : null);
    this.viewer.draw();
  }
}
