// SPDX-License-Identifier: MIT

import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Points, ShaderMaterial, Vector3 } from 'three';
import type { Color } from '../model/colorVision';

/** A seed as it is drawn. */
export interface Marker {
  place: Vector3;
  color: Color;
}

/** Round dots of a fixed size on the screen, in the colours of the seeds' labels. */
export class SeedMarkers {
  readonly object = new Points(new BufferGeometry(), dots());

  constructor() {
    this.object.onBeforeRender = (renderer) => {
      this.object.material.uniforms.diameter.value = 14 * renderer.getPixelRatio();
    };
    this.object.frustumCulled = false;
    this.resize(64);
  }

  show(markers: readonly Marker[]): void {
    if (markers.length > this.object.geometry.getAttribute('position').count) this.resize(2 * markers.length);
    const places = this.object.geometry.getAttribute('position') as BufferAttribute;
    const colors = this.object.geometry.getAttribute('color') as BufferAttribute;
    markers.forEach(({ place, color }, i) => {
      places.setXYZ(i, place.x, place.y, place.z);
      (colors.array as Uint8Array).set(color, 4 * i);
    });
    places.needsUpdate = colors.needsUpdate = true;
    this.object.geometry.setDrawRange(0, markers.length);
  }

  private resize(capacity: number): void {
    this.object.geometry.dispose();
    const geometry = new BufferGeometry();
    geometry.setAttribute(
      'position',
      new BufferAttribute(new Float32Array(3 * capacity), 3).setUsage(DynamicDrawUsage),
    );
    geometry.setAttribute(
      'color',
      new BufferAttribute(new Uint8Array(4 * capacity), 4, true).setUsage(DynamicDrawUsage),
    );
    geometry.setDrawRange(0, 0);
    this.object.geometry = geometry;
  }
}

/** A dot with a light ring inside a dark one, seen on every colour, and a little nearer than the face it lies on. */
function dots(): ShaderMaterial {
  return new ShaderMaterial({
    uniforms: { diameter: { value: 14 } },
    vertexShader: `
      attribute vec4 color;
      varying vec3 fill;
      uniform float diameter;
      void main() {
        fill = color.rgb;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
        gl_Position.z -= 0.006 * gl_Position.w;
        gl_PointSize = diameter;
      }`,
    fragmentShader: `
      varying vec3 fill;
      void main() {
        float radius = length(2.0 * gl_PointCoord - 1.0);
        if (radius > 1.0) discard;
        vec3 color = radius > 0.86 ? vec3(0.1) : radius > 0.58 ? vec3(1.0) : fill;
        gl_FragColor = vec4(color, 1.0);
      }`,
  });
}
