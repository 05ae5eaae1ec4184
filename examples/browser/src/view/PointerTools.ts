// SPDX-License-Identifier: MIT

import { effect } from '@preact/signals-core';
import { MOUSE, TOUCH } from 'three';
import type { Annotation } from '../model/labels';
import type { Session } from '../model/Session';
import type { Hit } from './SegmentedMesh';
import type { Stage } from './Stage';

/** How far a pointer may move, in pixels, for a click. */
const clickTolerance = 5;

/**
 * What mouse, pen and fingers do on the canvas.
 *
 * The seed tool places a seed with a click and leaves dragging to the camera. Paint and erase take a drag that begins on
 * the mesh; beside the mesh, and with two fingers, a drag moves the camera.
 */
export class PointerTools {
  /** Radius of the brush in pixels. */
  brush = 16;

  private pointers = 0;
  private clickAt: { x: number; y: number } | null = null;
  /** Whether a stroke is painted, and whether it has changed anything yet. */
  private stroke: 'none' | 'begins' | 'goes on' = 'none';
  /** What the stroke has made. Once it was undone, or another mesh was opened, what follows is an edit of its own. */
  private painted: Annotation | null = null;

  constructor(
    private readonly session: Session,
    private readonly stage: Stage,
    private readonly cursor: HTMLElement,
  ) {
    const { canvas } = stage.viewer;
    const first = { capture: true }; // before the camera's own listeners
    canvas.addEventListener('pointerdown', (event) => this.down(event), first);
    canvas.addEventListener('pointermove', (event) => this.move(event));
    canvas.addEventListener('pointerup', (event) => this.up(event));
    canvas.addEventListener('pointercancel', () => this.cancel());
    canvas.addEventListener('pointerleave', () => {
      this.cursor.hidden = true;
      session.surfaces.pointedFace.value = null;
    });
    effect(() => {
      canvas.dataset.tool = session.tool.value;
      stage.viewer.controls.touches.TWO = this.paints() ? TOUCH.DOLLY_ROTATE : TOUCH.DOLLY_PAN;
    });
  }

  /** Uses the tool once at a place of the window. */
  useAt(x: number, y: number): void {
    if (this.session.mode.peek() === 'automatic') return this.pointAt(x, y);
    const faces = this.facesAt(x, y);
    if (faces) this.edit(faces, false);
  }

  /** Tells the surface of the face at a place of the window. */
  private pointAt(x: number, y: number): void {
    this.session.surfaces.pointedFace.value = this.hitAt(x, y)?.face ?? null;
  }

  private down(event: PointerEvent): void {
    if (++this.pointers > 1) return this.endStroke(true);
    this.clickAt = event.button === 0 ? { x: event.clientX, y: event.clientY } : null;
    const hits = event.button === 0 && this.paints() && this.hitAt(event.clientX, event.clientY) !== null;
    const { controls } = this.stage.viewer;
    controls.mouseButtons.LEFT = hits ? null : MOUSE.ROTATE;
    controls.touches.ONE = hits ? null : TOUCH.ROTATE;
    if (!hits) return;
    this.stroke = 'begins';
    if (event.pointerType === 'mouse') this.strokeTo(event); // a finger may be the first of two
  }

  private move(event: PointerEvent): void {
    this.showCursor(event);
    if (event.buttons === 0 && this.session.surfaceSegments.peek()) this.pointAt(event.clientX, event.clientY);
    if (this.stroke !== 'none') for (const step of event.getCoalescedEvents?.() ?? [event]) this.strokeTo(step);
  }

  private up(event: PointerEvent): void {
    this.pointers = Math.max(0, this.pointers - 1);
    if (this.stroke === 'begins') this.strokeTo(event);
    const start = this.clickAt;
    const isClick = start && Math.hypot(event.clientX - start.x, event.clientY - start.y) <= clickTolerance;
    if (isClick && this.session.tool.peek() === 'seed') this.useAt(event.clientX, event.clientY);
    this.endStroke(false);
  }

  private cancel(): void {
    this.pointers = Math.max(0, this.pointers - 1);
    this.endStroke(false);
  }

  private strokeTo({ clientX, clientY }: PointerEvent): void {
    const faces = this.facesAt(clientX, clientY);
    if (!faces || !this.edit(faces, this.isLastEdit())) return;
    this.stroke = 'goes on';
    this.painted = this.session.seeds.annotation.peek();
  }

  /** Whether nothing else was edited since the stroke. */
  private isLastEdit(): boolean {
    return this.stroke === 'goes on' && this.session.seeds.annotation.peek() === this.painted;
  }

  /** @param takeBack whether it turned out that it was meant for the camera */
  private endStroke(takeBack: boolean): void {
    if (takeBack && this.isLastEdit()) this.session.seeds.undo();
    this.stroke = 'none';
    this.painted = null;
    this.clickAt = null;
  }

  private paints(): boolean {
    const tool = this.session.tool.value;
    return this.session.mode.value === 'seeds' && (tool === 'paint' || tool === 'erase');
  }

  private hitAt(x: number, y: number): Hit | null {
    return this.stage.shown?.hit(this.stage.viewer.rayThrough(x, y)) ?? null;
  }

  /** The faces that the tool works on at a place of the window. */
  private facesAt(x: number, y: number): number[] | null {
    const hit = this.hitAt(x, y);
    if (!hit || !this.stage.shown) return null;
    if (this.session.tool.peek() === 'seed') return [hit.face];
    const radius = this.brush * this.stage.viewer.pixelSize(hit.point);
    return this.stage.shown.facesAround(hit, radius, this.stage.viewer.rayThrough(x, y));
  }

  private edit(faces: number[], goesOn: boolean): boolean {
    const { seeds, tool, mode, opening } = this.session;
    if (mode.peek() !== 'seeds' || opening.peek() !== null || tool.peek() === 'view') return false;
    return tool.peek() === 'erase' ? seeds.erase(faces, goesOn) : seeds.place(faces, goesOn);
  }

  private showCursor(event: PointerEvent): void {
    this.cursor.hidden = !this.paints() || event.pointerType === 'touch';
    this.cursor.style.width = this.cursor.style.height = `${2 * this.brush}px`;
    this.cursor.style.left = `${event.clientX}px`;
    this.cursor.style.top = `${event.clientY}px`;
  }
}
