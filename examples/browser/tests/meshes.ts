// SPDX-License-Identifier: MIT

/** The text of an OFF file. */
export function offFile(points: number[][], faces: number[][]): string {
  const rows = [...points.map((point) => point.join(' ')), ...faces.map((face) => [face.length, ...face].join(' '))];
  return `OFF\n${points.length} ${faces.length} 0\n${rows.join('\n')}\n`;
}

/** A cube whose sides have n x n squares. Faces s n^2 .. (s + 1) n^2 - 1 are side s; the sides are x, y, z = 0, then 1. */
export function cube(n: number): { points: number[][]; faces: number[][] } {
  const points: number[][] = [];
  const numbers = new Map<string, number>();
  const vertex = (point: number[]): number => {
    const key = point.join(' ');
    if (!numbers.has(key)) {
      numbers.set(key, points.length);
      points.push(point.map((coordinate) => coordinate / n));
    }
    return numbers.get(key)!;
  };
  const faces: number[][] = [];
  for (const end of [0, n])
    for (let axis = 0; axis < 3; ++axis)
      for (let i = 0; i < n; ++i)
        for (let j = 0; j < n; ++j) {
          const corner = (u: number, v: number) => {
            const point = [end, end, end];
            point[(axis + 1) % 3] = i + u;
            point[(axis + 2) % 3] = j + v;
            return vertex(point);
          };
          const face = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
          faces.push(end === 0 ? face.reverse() : face);
        }
  return { points, faces };
}

/** A sphere with bumps, of 4 n (n - 1) triangles. */
export function bumpySphere(n: number): { points: number[][]; faces: number[][] } {
  const ring = 2 * n;
  const points: number[][] = [[0, 0, 1]];
  for (let i = 1; i < n; ++i)
    for (let j = 0; j < ring; ++j) {
      const [a, b] = [(Math.PI * i) / n, (2 * Math.PI * j) / ring];
      const radius = 1 + 0.35 * Math.sin(3 * a) * Math.cos(4 * b) * Math.sin(a);
      points.push([radius * Math.sin(a) * Math.cos(b), radius * Math.sin(a) * Math.sin(b), radius * Math.cos(a)]);
    }
  points.push([0, 0, -1]);
  const vertex = (i: number, j: number) =>
    i === 0 ? 0 : i === n ? points.length - 1 : 1 + (i - 1) * ring + (j % ring);
  const faces: number[][] = [];
  for (let i = 0; i < n; ++i)
    for (let j = 0; j < ring; ++j) {
      if (i + 1 < n) faces.push([vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)]);
      if (i > 0) faces.push([vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)]);
    }
  return { points, faces };
}

/** With each polygon cut into triangles. */
export function triangulated({ points, faces }: { points: number[][]; faces: number[][] }) {
  const fan = (face: number[]) => face.slice(2).map((corner, i) => [face[0], face[i + 1], corner]);
  return { points, faces: faces.flatMap(fan) };
}

/** A turned shaft with steps: cylinders of these radii, each as long as its radius, beside each other, and the flat rings between. */
export function shaft(radii: number[], n = 48): { points: number[][]; faces: number[][] } {
  const rows = 4; // of faces along each cylinder and each ring
  const profile: [number, number][] = [[0, 0]];
  let z = 0;
  const lineTo = (radius: number, height: number) => {
    const [from, start] = profile[profile.length - 1];
    for (let i = 1; i <= rows; ++i)
      profile.push([from + ((radius - from) * i) / rows, start + ((height - start) * i) / rows]);
  };
  for (const radius of radii) {
    lineTo(radius, z);
    lineTo(radius, (z += radius));
  }
  lineTo(0, z);
  const rings = profile.slice(1, -1);
  const points = [[0, 0, 0]];
  for (const [radius, height] of rings)
    for (let j = 0; j < n; ++j) {
      const angle = (2 * Math.PI * j) / n;
      points.push([radius * Math.cos(angle), radius * Math.sin(angle), height]);
    }
  points.push([0, 0, z]);
  const vertex = (ring: number, j: number) => 1 + ring * n + (j % n);
  const faces: number[][] = [];
  for (let j = 0; j < n; ++j) {
    faces.push([0, vertex(0, j + 1), vertex(0, j)]);
    for (let ring = 0; ring + 1 < rings.length; ++ring) {
      faces.push([vertex(ring, j), vertex(ring, j + 1), vertex(ring + 1, j + 1)]);
      faces.push([vertex(ring, j), vertex(ring + 1, j + 1), vertex(ring + 1, j)]);
    }
    faces.push([vertex(rings.length - 1, j), vertex(rings.length - 1, j + 1), points.length - 1]);
  }
  return { points, faces };
}
