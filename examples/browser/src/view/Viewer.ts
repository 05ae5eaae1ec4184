// SPDX-License-Identifier: MIT

import {
  ColorManagement,
  DirectionalLight,
  Group,
  HemisphereLight,
  LinearSRGBColorSpace,
  PerspectiveCamera,
  type Ray,
  Raycaster,
  Scene,
  Sphere,
  Spherical,
  Vector2,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

ColorManagement.enabled = false; // labels have the same colours on the mesh as in the lists

/** The cosine under which a part is seen well enough. */
const facing = 0.25;

/** Camera, light and canvas. Draws when something has changed. */
export class Viewer {
  /** What is looked at. Points and rays below are in its coordinates. */
  readonly content = new Group();
  readonly controls: OrbitControls;
  private readonly camera = new PerspectiveCamera(35, 1, 0.01, 100);
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly raycaster = new Raycaster();
  private readonly bounds = new Sphere(new Vector3(), 1);
  private isScheduled = false;
  private patience: ReturnType<typeof setTimeout> | undefined;
  private readonly listeners: (() => void)[] = [];

  constructor(readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: hasGraphicsCard(), alpha: true });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;

    const headlight = new DirectionalLight(0xffffff, 1.4);
    headlight.position.set(0.4, 0.8, 1);
    this.camera.add(headlight, headlight.target);
    this.scene.add(this.camera, this.content, new HemisphereLight(0xffffff, 0xd4d8e0, 1.95));

    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.draw());
    canvas.addEventListener('webglcontextrestored', () => this.draw());
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.followPixelRatio();
  }

  /** Tells the listener after each picture. */
  onDrawn(listener: () => void): void {
    this.listeners.push(listener);
  }

  /** Draws when something else is drawn, or after a while: for what is most often followed by more to draw. */
  drawSoon(): void {
    this.patience ??= setTimeout(() => this.draw(), 100);
  }

  /** Draws with the next frame of the screen. */
  draw(): void {
    clearTimeout(this.patience);
    this.patience = undefined;
    if (this.isScheduled) return;
    this.isScheduled = true;
    requestAnimationFrame(() => {
      this.isScheduled = false;
      this.drawNow();
      for (const listener of this.listeners) listener();
    });
  }

  /** Moves the camera until all of a sphere is seen, without turning it. */
  fit(sphere: Sphere): void {
    this.content.updateMatrixWorld();
    this.bounds.copy(sphere).applyMatrix4(this.content.matrixWorld);
    if (!(this.bounds.radius > 0)) this.bounds.radius = 1;
    const narrow = Math.min(1, this.camera.aspect);
    const distance = (1.02 * this.bounds.radius) / (Math.sin((this.camera.fov * Math.PI) / 360) * narrow);
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    this.controls.target.copy(this.bounds.center);
    this.camera.position.copy(this.bounds.center).addScaledVector(direction, distance);
    this.controls.minDistance = this.bounds.radius * 0.02;
    this.controls.maxDistance = this.bounds.radius * 50;
    this.controls.update();
    this.draw();
  }

  /**
   * Moves the camera towards a part of what it sees.
   *
   * @param normal of the part; where that faces away, the camera turns to see it
   */
  approach(part: Sphere, normal: Vector3): void {
    this.content.updateMatrixWorld();
    const sphere = part.clone().applyMatrix4(this.content.matrixWorld);
    const outward = normal.clone().transformDirection(this.content.matrixWorld);
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    if (normal.lengthSq() > 0 && direction.dot(outward) < facing)
      direction
        .copy(outward)
        .add(new Vector3(0.2, 0.2, 0.2))
        .normalize();
    const context = Math.max(3 * sphere.radius, 0.4 * this.bounds.radius); // so that one sees where it is
    const narrow = Math.min(1, this.camera.aspect);
    const distance = context / (Math.sin((this.camera.fov * Math.PI) / 360) * narrow);
    this.controls.target.copy(sphere.center);
    this.camera.position.copy(sphere.center).addScaledVector(direction, distance);
    this.controls.update();
    this.draw();
  }

  /** As `fit()`, from the front, a little from the right and from above. */
  fitFromFront(sphere: Sphere): void {
    this.camera.position.copy(this.controls.target).add(new Vector3(0.45, 0.3, 1));
    this.fit(sphere);
  }

  /** Turns what is up from y to z and back. */
  turnUp(): void {
    this.content.rotation.x = this.content.rotation.x === 0 ? -Math.PI / 2 : 0;
  }

  /** Turns the camera about its target, by angles in radians. */
  orbit(right: number, up: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const place = new Spherical().setFromVector3(offset);
    place.theta += right;
    place.phi -= up;
    this.camera.position.setFromSpherical(place.makeSafe()).add(this.controls.target);
    this.controls.update();
  }

  /** Moves the camera towards its target (< 1) or away from it (> 1). */
  zoom(factor: number): void {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
  }

  /** The ray through a place of the window. */
  rayThrough(clientX: number, clientY: number): Ray {
    const box = this.canvas.getBoundingClientRect();
    const place = new Vector2(((clientX - box.left) / box.width) * 2 - 1, 1 - ((clientY - box.top) / box.height) * 2);
    this.camera.updateMatrixWorld();
    this.raycaster.setFromCamera(place, this.camera);
    return this.raycaster.ray.applyMatrix4(this.content.matrixWorld.clone().invert());
  }

  /** The place of a point in the window. */
  projected(point: Vector3): { x: number; y: number } {
    this.camera.updateMatrixWorld();
    const box = this.canvas.getBoundingClientRect();
    const place = this.content.localToWorld(point.clone()).project(this.camera);
    return { x: box.left + ((place.x + 1) / 2) * box.width, y: box.top + ((1 - place.y) / 2) * box.height };
  }

  /** The length of a pixel at a point. */
  pixelSize(point: Vector3): number {
    const depth = this.content.localToWorld(point.clone()).distanceTo(this.camera.position);
    return (2 * depth * Math.tan((this.camera.fov * Math.PI) / 360)) / this.canvas.clientHeight;
  }

  /** What is seen, as a PNG file. */
  picture(): Promise<Blob> {
    this.drawNow();
    return new Promise((resolve, reject) => {
      this.canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('The browser gives no picture.'))));
    });
  }

  private drawNow(): void {
    const distance = this.camera.position.distanceTo(this.bounds.center);
    this.camera.near = Math.max(distance - 3 * this.bounds.radius, distance / 1000);
    this.camera.far = distance + 3 * this.bounds.radius;
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.scene, this.camera);
  }

  /** Another screen has another ratio, and so has a page that is zoomed. */
  private followPixelRatio(): void {
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.draw();
    const isSame = matchMedia(`(resolution: ${window.devicePixelRatio}dppx)`);
    isSame.addEventListener('change', () => this.followPixelRatio(), { once: true });
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.drawNow();
  }
}

/** Whether pictures are made by a graphics card. Where the processor makes them, smooth edges take too long. */
function hasGraphicsCard(): boolean {
  const context = document.createElement('canvas').getContext('webgl2');
  const info = context?.getExtension('WEBGL_debug_renderer_info');
  const renderer = info ? String(context?.getParameter(info.UNMASKED_RENDERER_WEBGL)) : '';
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return !/swiftshader|llvmpipe|software|basic render/i.test(renderer);
}
