import { expect, test } from '@playwright/test';
import { readEmbeddedResult } from '../../src/files/embeddedResult';
import { materialsFile, objFile } from '../../src/files/obj';
import { plyFile } from '../../src/files/ply';
import { polygonsOf } from '../../src/files/polygons';
import { stem } from '../../src/files/save';
import { readSeeds, seedsFile } from '../../src/files/seeds';
import { segFile } from '../../src/files/seg';
import type { Color } from '../../src/model/colorVision';
import type { Annotation } from '../../src/model/labels';
import type { MeshData } from '../../src/worker/EngineModule';

/** A pentagon as a fan, and a triangle beside it. */
const mesh: MeshData = {
  positions: Float32Array.of(0, 0, 0, 1, 0, 0, 1.5, 1, 0, 0.5, 2, 0, -0.5, 1, 0, 2, 0, 0.25),
  triangles: Uint32Array.of(0, 1, 2, 0, 2, 3, 0, 3, 4, 1, 5, 2),
  faceOfTriangle: Uint32Array.of(0, 0, 0, 1),
  faces: 2,
  faceAreas: Float64Array.of(2.5, 0.5),
  notes: [],
};
const labels = Uint32Array.of(7, 3);
const colors = new Map<number, Color>([
  [7, [255, 0, 51]],
  [3, [0, 114, 178]],
]);

test('polygons are put together from their fans', () => {
  expect(polygonsOf(mesh)).toEqual([
    [0, 1, 2, 3, 4],
    [1, 5, 2],
  ]);
});

test('PLY files have points, polygons, colours and segments', () => {
  const file = plyFile(mesh, labels, colors);
  const text = new TextDecoder('latin1').decode(file);
  const body = text.indexOf('end_header\n') + 'end_header\n'.length;
  expect(text.slice(0, body)).toContain('element vertex 6\nproperty double x');
  expect(text.slice(0, body)).toContain('property uchar blue\nproperty uint segment\n');
  const data = new DataView(file.buffer, body);
  expect(data.byteLength).toBe(6 * 24 + (1 + 5 * 4 + 3 + 4) + (1 + 3 * 4 + 3 + 4));
  expect(data.getFloat64(5 * 24 + 16, true)).toBe(0.25);
  expect(data.getUint8(144)).toBe(5);
  expect([165, 166, 167].map((at) => data.getUint8(at))).toEqual([255, 0, 51]);
  expect(data.getUint32(168, true)).toBe(7);
  expect(data.getUint32(data.byteLength - 4, true)).toBe(3);
});

test('OBJ files have a group for each segment, and materials', () => {
  expect(objFile(mesh, labels, 'a.mtl').split('\n')).toEqual([
    'mtllib a.mtl',
    'v 0 0 0',
    'v 1 0 0',
    'v 1.5 1 0',
    'v 0.5 2 0',
    'v -0.5 1 0',
    'v 2 0 0.25',
    'g segment_3',
    'usemtl segment_3',
    'f 2 6 3',
    'g segment_7',
    'usemtl segment_7',
    'f 1 2 3 4 5',
    '',
  ]);
  expect(materialsFile(colors)).toBe('newmtl segment_3\nKd 0 0.447059 0.698039\nnewmtl segment_7\nKd 1 0 0.2\n');
});

test('SEG files have a line for each face', () => {
  expect(segFile(labels)).toBe('7\n3\n');
});

const annotation: Annotation = {
  labels: [
    { id: 0, name: 'Körper "a"', color: '#0072b2' },
    { id: 4, name: 'Hand', color: '#e69f00' },
  ],
  seeds: new Map([
    [9, 0],
    [2, 4],
  ]),
};

test('seeds are read as they were written', () => {
  expect(readSeeds(seedsFile(annotation, 'a.off', 10), 10)).toEqual(annotation);
});

for (const [what, change, message] of [
  ['no JSON', (text: string) => text.slice(5), 'The file is no JSON'],
  ['another file', () => '{"a": 1}', 'The file has no seeds'],
  ['a list', () => '[]', 'The file is no JSON object'],
  ['another mesh', (text: string) => text.replace('"faces": 10', '"faces": 11'), 'a mesh of 11 faces; this one has 10'],
  ['a face that is not there', (text: string) => text.replace('"face": 9', '"face": 10'), 'Seed 1 is on face 10'],
  ['a face that is no number', (text: string) => text.replace('"face": 9', '"face": "9"'), '"face" of seed 1'],
  ['an unknown label', (text: string) => text.replace('"label": 4', '"label": 5'), 'Seed 2 has the label 5'],
  ['a label twice', (text: string) => text.replace('"id": 4', '"id": 0'), 'Two labels have the same "id"'],
  ['a colour that is none', (text: string) => text.replace('#e69f00', 'url(x)'), 'Label 2 has no "color"'],
  ['no name', (text: string) => text.replace('"Hand"', '5'), 'Label 2 has no "name"'],
] as [string, (text: string) => string, string][])
  test(`seeds files with ${what} are refused`, () => {
    expect(() => readSeeds(change(seedsFile(annotation, 'a.off', 10)), 10)).toThrow(message);
  });

test('embedded results are read', () => {
  const base64 = (array: Uint32Array | Float64Array | Uint8Array) => Buffer.from(array.buffer).toString('base64');
  const written = {
    name: 'a.off',
    mesh: base64(Uint8Array.of(1, 2)),
    labels: base64(labels),
    hierarchy: {
      fragmentOfFace: base64(Uint32Array.of(0, 1)),
      merges: base64(Uint32Array.of(0, 1)),
      costs: base64(Float64Array.of(0.5)),
      fragments: 2,
      fewest: 1,
      suggested: 2,
      levels: [2],
    },
    segments: 2,
    mode: 'graphical',
    seeds: [],
  };
  const result = readEmbeddedResult(JSON.stringify(written));
  expect(result?.segmentOfFace).toEqual(labels);
  expect(result?.mesh).toEqual(Uint8Array.of(1, 2));
  expect(result?.hierarchy?.costs).toEqual(Float64Array.of(0.5));
  expect(readEmbeddedResult('null')).toBeNull();
});

test('names of files lose their endings', () => {
  expect(['a.b.off', 'hand', '.off'].map(stem)).toEqual(['a.b', 'hand', 'mesh']);
});
