// SPDX-License-Identifier: MIT

import { deflateSync } from 'node:zlib';
import { expect, test } from '@playwright/test';
import { readEmbeddedResult } from '../../src/files/embeddedResult';
import { stem } from '../../src/files/save';
import { readSeeds, seedsFile } from '../../src/files/seeds';
import type { Annotation } from '../../src/model/labels';
import type { EngineModule, FileFormat } from '../../src/worker/EngineModule';
import { answer, engineModule, engineWith } from '../browser/fixture';
import { offFile } from '../meshes';

const labels = Uint32Array.of(7, 3);
/** A pentagon, and a triangle beside it. */
const mesh = {
  points: [
    [0, 0, 0],
    [1, 0, 0],
    [1.5, 1, 0],
    [0.5, 2, 0],
    [-0.5, 1, 0],
    [2, 0, 0.1],
  ],
  faces: [
    [0, 1, 2, 3, 4],
    [1, 5, 2],
  ],
};

/** A file of that mesh with colours, as the engine writes it. */
async function fileOf(format: FileFormat): Promise<Buffer> {
  const engine = await engineWith('mesh.off', offFile(mesh.points, mesh.faces));
  const colors = Uint32Array.of(7, 255, 0, 51, 3, 0, 114, 178);
  return Buffer.from(answer(engine.file(format, 'a', 'a.mtl', labels, colors)));
}

test('PLY files have points, polygons, colours and segments', async () => {
  const file = await fileOf('ply');
  const body = file.indexOf('end_header\n') + 'end_header\n'.length;
  const header = file.toString('latin1', 0, body);
  expect(header).toContain('element vertex 6\nproperty double x');
  expect(header).toContain('property uchar blue\nproperty uint segment\n');
  const data = file.subarray(body);
  expect(data.length).toBe(6 * 24 + (1 + 5 * 4 + 3 + 4) + (1 + 3 * 4 + 3 + 4));
  expect(data.readDoubleLE(5 * 24 + 16)).toBe(0.1);
  expect(data.readUInt8(144)).toBe(5);
  expect([165, 166, 167].map((at) => data.readUInt8(at))).toEqual([255, 0, 51]);
  expect(data.readUInt32LE(168)).toBe(7);
  expect(data.readUInt32LE(data.length - 4)).toBe(3);
});

test('OBJ files have a group for each segment, and materials', async () => {
  expect((await fileOf('obj')).toString().split('\n')).toEqual([
    'mtllib a.mtl',
    'v 0 0 0',
    'v 1 0 0',
    'v 1.5 1 0',
    'v 0.5 2 0',
    'v -0.5 1 0',
    'v 2 0 0.1',
    'g segment_3',
    'usemtl segment_3',
    'f 2 6 3',
    'g segment_7',
    'usemtl segment_7',
    'f 1 2 3 4 5',
    '',
  ]);
  const materials = (await fileOf('mtl')).toString();
  expect(materials).toMatch(/^newmtl segment_3\nKd 0 0\.447058\d+ 0\.698039\d+\nnewmtl segment_7\nKd 1 0 0\.2\n$/);
});

test('glTF files have a primitive, a material and an accessor of corners for each segment', async () => {
  const file = await fileOf('glb');
  expect([file.toString('latin1', 0, 4), file.readUInt32LE(8)]).toEqual(['glTF', file.length]);
  const size = file.readUInt32LE(12);
  const scene = JSON.parse(file.toString('utf8', 20, 20 + size));
  expect(scene.meshes[0].primitives.map(({ extras }: { extras: unknown }) => extras)).toEqual([
    { label: 3 },
    { label: 7 },
  ]);
  expect(scene.materials.map(({ name }: { name: string }) => name)).toEqual(['segment_3', 'segment_7']);
  expect(scene.accessors.slice(1).map(({ count }: { count: number }) => count)).toEqual([3, 9]);
  expect(scene.accessors[0].max).toEqual([2, 2, 0.1]);
});

test('3MF and NumPy files are archives of their parts', async () => {
  const model = (await fileOf('3mf')).toString('latin1');
  expect(model.slice(0, 4)).toBe('PK\x03\x04');
  expect(model.match(/name="segment_\d" pid="1" pindex="\d"/g)).toHaveLength(2);
  expect(model.match(/<triangle /g)).toHaveLength(4);
  const archive = (await fileOf('npz')).toString('latin1');
  expect(archive).toContain("labels.npy\x93NUMPY\x01\0\x76\0{'descr': '<i8', 'fortran_order': False, 'shape': (2,), }");
});

test('labels are a line each, or rows of a table', async () => {
  expect((await fileOf('seg')).toString()).toBe('7\n3\n');
  expect((await fileOf('csv')).toString()).toBe('face,label\n0,7\n1,3\n');
});

for (const [format, faces] of [
  ['ply', 2],
  ['off', 2],
  ['obj', 2],
  ['vtp', 2],
  ['stl', 4],
  ['stl-text', 4],
  ['msh', 4],
  ['mesh', 4],
] as [FileFormat, number][])
  test(`the engine reads the ${format} files that it writes`, async () => {
    const module = await engineModule();
    const again = answer(answer(module.readMesh(await fileOf(format), 'file')).mesh());
    expect(again.notes).toEqual([]);
    expect(again.faces).toBe(faces);
    expect(again.positions.length).toBe(18);
    expect(again.faceAreas.reduce((sum, area) => sum + area)).toBeCloseTo(3.00312, 4);
  });

test('the engine reads VTP files that are compressed by zlib', async () => {
  const array = (type: string, name: string, bytes: Buffer) => {
    const packed = deflateSync(bytes);
    const header = Buffer.from(Uint32Array.of(1, bytes.length, 0, packed.length).buffer);
    const text = header.toString('base64') + packed.toString('base64');
    return `<DataArray type="${type}" Name="${name}" NumberOfComponents="3" format="binary">${text}</DataArray>`;
  };
  const points = array('Float32', 'Points', Buffer.from(Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0).buffer));
  const corners = array('Int32', 'connectivity', Buffer.from(Int32Array.of(0, 1, 2).buffer));
  const ends = array('Int32', 'offsets', Buffer.from(Int32Array.of(3).buffer));
  const file = `<VTKFile type="PolyData" compressor="vtkZLibDataCompressor"><PolyData>
<Piece NumberOfPoints="3" NumberOfPolys="1"><Points>${points}</Points><Polys>${corners}${ends}</Polys></Piece>
</PolyData></VTKFile>`;
  const read = (content: string) => (module: EngineModule) => module.readMesh(Buffer.from(content), 'a.vtp');
  const module = await engineModule();
  expect(answer(answer(read(file)(module)).mesh()).faceAreas[0]).toBe(0.5);
  const broken = file.replace(/(eJ[^<]{8})./, '$1!');
  expect(() => answer(read(broken)(module))).toThrow(/^a\.vtp:2: the array 'Points' /);
});

test('labels that do not fit the mesh and formats that are unknown are refused', async () => {
  const engine = await engineWith('mesh.off', offFile(mesh.points, mesh.faces));
  const file = (format: string, labels: Uint32Array) =>
    answer(engine.file(format as FileFormat, 'a', '', labels, Uint32Array.of(0, 1, 2, 3)));
  expect(() => file('ply', Uint32Array.of(0))).toThrow('a label for each face is needed');
  expect(() => file('xyz', Uint32Array.of(0, 0))).toThrow('xyz is none of ply, off');
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
  expect(['a.b.off', 'hand', '.off', 'a.off.gz'].map(stem)).toEqual(['a.b', 'hand', 'mesh', 'a']);
});
