// SPDX-License-Identifier: MIT

import { effect } from '@preact/signals-core';
import type { Session } from './model/Session';
import type { Stage } from './view/Stage';

/** What tests read of the page, as `window.segmentationPage`. It changes nothing. */
export interface SegmentationPage {
  /** The number of faces, 0 without a mesh. */
  faces(): number;
  /** The segment of each face as shown, null if there are none. */
  labels(): number[] | null;
  /** Face and label of each seed. */
  seeds(): [number, number][];
  /** Where the centre of a face is in the window, and whether it is what is seen there. */
  placeOf(face: number): { x: number; y: number; isVisible: boolean };
  /** The red, green and blue of a face. */
  colorOf(face: number): number[];
  /** How often the engine was called, by the names of the calls. */
  engineCalls(): Record<string, number>;
  /** The number of boundary curves shown. */
  curves(): number;
  /** The number of times that other segments were drawn. */
  answers(): number;
}

declare global {
  interface Window {
    segmentationPage: SegmentationPage;
  }
}

export function exposeForTests(session: Session, stage: Stage): void {
  const { viewer } = stage;
  let answers = 0;
  let drawnAnswers = 0;
  viewer.onDrawn(() => (drawnAnswers = answers));
  effect(() => {
    if (session.segmentOfFace.value) ++answers;
  });
  window.segmentationPage = {
    faces: () => session.mesh.peek()?.faces ?? 0,
    labels: () => (session.segments.peek().length > 0 ? [...session.segmentOfFace.peek()!] : null),
    seeds: () => [...session.seeds.annotation.peek().seeds],
    placeOf(face) {
      const mesh = stage.shown;
      const center = mesh?.center(face);
      if (!mesh || !center) return { x: NaN, y: NaN, isVisible: false };
      const place = viewer.projected(center);
      return { ...place, isVisible: mesh.hit(viewer.rayThrough(place.x, place.y))?.face === face };
    },
    colorOf: (face) => stage.shown?.colorOf(face) ?? [],
    engineCalls: () => ({ ...session.background.counts, ...session.engine.counts }),
    curves: () => (session.curves.peek()?.starts.length ?? 1) - 1,
    answers: () => drawnAnswers,
  };
}
