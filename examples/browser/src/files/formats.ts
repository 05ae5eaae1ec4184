// SPDX-License-Identifier: MIT

import type { FileFormat } from '../worker/EngineModule';

/** What meshes and seeds are opened from end with. */
export const openedEndings = [
  '.off',
  '.ply',
  '.obj',
  '.stl',
  '.msh',
  '.mesh',
  '.meshb',
  '.vtp',
  '.3mf',
  '.gz',
  '.json',
];

/** A format that segments are saved in. */
export interface SavedFormat {
  format: FileFormat;
  /** Of the file, behind the name of the mesh. */
  ending: string;
  title: string;
}

export const meshFormats: SavedFormat[] = [
  { format: 'ply', ending: '_segments.ply', title: 'PLY, colours and segments of faces' },
  { format: 'obj', ending: '_segments.obj', title: 'OBJ, a group and a material a segment' },
  { format: 'off', ending: '_segments.off', title: 'OFF, colours of faces' },
  { format: 'stl', ending: '_segments.stl', title: 'STL, colours of facets' },
  { format: 'stl-text', ending: '_solids.stl', title: 'STL as text, a solid a segment' },
  { format: 'glb', ending: '_segments.glb', title: 'glTF, a material a segment' },
  { format: '3mf', ending: '_segments.3mf', title: '3MF for slicers, an object a segment' },
  { format: 'msh', ending: '_segments.msh', title: 'Gmsh, a physical group a segment' },
  { format: 'mesh', ending: '_segments.mesh', title: 'Medit, a reference a segment' },
  { format: 'vtp', ending: '_segments.vtp', title: 'VTP for VTK and ParaView' },
];

export const labelFormats: SavedFormat[] = [
  { format: 'seg', ending: '.seg', title: 'SEG, a line a face' },
  { format: 'csv', ending: '.csv', title: 'CSV' },
  { format: 'npz', ending: '.npz', title: 'NumPy' },
];
