# SPDX-License-Identifier: MIT
"""Meshes of other packages as arrays, and back. None of the packages is needed but the one whose mesh is given."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from rw_segmentation._arrays import Faces, Polygons, integers_of, polygons_of, vertices_of
from rw_segmentation.colors import segment_colors

if TYPE_CHECKING:
    import meshio
    import pyvista
    import trimesh
    from numpy.typing import ArrayLike, NDArray

_MESHIO_DEGREES = {"triangle": 3, "quad": 4}


def from_trimesh(mesh: trimesh.Trimesh) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Take the vertices and faces of a mesh of trimesh; nothing is copied.

    Examples
    --------
    >>> labels = segment(*from_trimesh(trimesh.load("bear.off", process=False)))   # doctest: +SKIP
    """
    return np.asarray(mesh.vertices), np.asarray(mesh.faces)


def to_trimesh(vertices: ArrayLike, faces: Faces, labels: ArrayLike | None = None) -> trimesh.Trimesh:
    """Make a mesh of trimesh, with the labels in ``face_attributes["segment"]`` and as colours that neighbours do not share.

    Raises
    ------
    ImportError
        If trimesh is not there.
    ValueError
        If a face is no triangle.
    """
    import trimesh

    corners, offsets, degree = polygons_of(faces)
    if degree != 3 and (offsets is None or bool((np.diff(offsets) != 3).any())):
        raise ValueError("trimesh takes triangles alone")
    triangles = corners.reshape(-1, 3)
    mesh = trimesh.Trimesh(vertices_of(vertices), triangles, process=False)
    if labels is not None:
        known = integers_of(labels, "labels")
        # trimesh writes attributes to PLY files in their own type, and PLY has no integers of 64 bits: VTK ends the program.
        limits = np.iinfo(np.int32)
        is_small = known.size == 0 or (int(known.min()) >= limits.min and int(known.max()) <= limits.max)
        mesh.face_attributes["segment"] = known.astype(np.int32) if is_small else known
        colors = face_colors(vertices, triangles, known)
        mesh.visual = trimesh.visual.ColorVisuals(mesh, face_colors=colors)
    return mesh


def from_meshio(mesh: meshio.Mesh) -> tuple[NDArray[np.float64], Polygons]:
    """Take the points, and the faces of all blocks of triangles, quads and polygons one after the other.

    See Also
    --------
    to_meshio : puts labels back where the faces were

    Raises
    ------
    ValueError
        If there is no such block.
    """
    rows = [block.data for block in mesh.cells if _degree_of(block) is not None]
    if not rows:
        kinds = ", ".join(block.type for block in mesh.cells) or "none"
        raise ValueError(f"the mesh has no triangles, quads or polygons, but cells of the types: {kinds}")
    degrees = np.concatenate([np.full(len(block), np.shape(block)[1]) for block in rows])
    corners = np.concatenate([np.asarray(block).reshape(-1) for block in rows])
    points = np.asarray(mesh.points)
    if points.ndim == 2 and points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    return points, Polygons(corners, np.concatenate([[0], np.cumsum(degrees)]).astype(np.int64))


def to_meshio(mesh: meshio.Mesh, labels: ArrayLike, name: str = "segment") -> meshio.Mesh:
    """Put labels into ``cell_data[name]`` of a copy of the mesh that they were made of; other cells get -1."""
    import meshio

    known = integers_of(labels, "labels").astype(np.int64, copy=False)
    columns: list[NDArray[Any]] = []
    begin = 0
    for block in mesh.cells:
        count = len(block.data)
        if _degree_of(block) is None:
            columns.append(np.full(count, -1, dtype=known.dtype))
            continue
        columns.append(known[begin : begin + count])
        begin += count
    if begin != len(known):
        raise ValueError(f"there are {len(known)} labels, but the mesh has {begin} faces")
    return meshio.Mesh(
        mesh.points,
        mesh.cells,
        point_data=dict(mesh.point_data),
        cell_data={**mesh.cell_data, name: columns},
        field_data=dict(mesh.field_data),  # such as the names of physical groups
        point_sets=dict(mesh.point_sets),
        cell_sets=dict(mesh.cell_sets),
        gmsh_periodic=mesh.gmsh_periodic,
        info=mesh.info,
    )


def _degree_of(block: Any) -> int | None:
    """Tell how many corners the faces of a block have; None for cells that are no faces."""
    if block.type in _MESHIO_DEGREES:
        return _MESHIO_DEGREES[block.type]
    return int(np.shape(block.data)[1]) if block.type.startswith("polygon") and len(block.data) else None


def from_open3d(mesh: Any) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Take the vertices and triangles of an ``open3d.geometry.TriangleMesh``, or of one of ``open3d.t``."""
    if hasattr(mesh, "vertex"):
        return mesh.vertex.positions.numpy(), mesh.triangle.indices.numpy()
    return np.asarray(mesh.vertices), np.asarray(mesh.triangles)


def to_open3d(vertices: ArrayLike, faces: Faces, labels: ArrayLike | None = None) -> Any:
    """Make an ``open3d.geometry.TriangleMesh``; labels become colours.

    Open3D colours vertices alone: with labels each triangle gets vertices of its own.
    """
    import open3d

    corners, offsets, degree = polygons_of(faces)
    if degree != 3 and (offsets is None or bool((np.diff(offsets) != 3).any())):
        raise ValueError("Open3D takes triangles alone")
    points = vertices_of(vertices).astype(np.float64)
    triangles = corners.reshape(-1, 3).astype(np.int32)
    mesh = open3d.geometry.TriangleMesh()
    if labels is None:
        mesh.vertices = open3d.utility.Vector3dVector(points)
        mesh.triangles = open3d.utility.Vector3iVector(triangles)
        return mesh
    mesh.vertices = open3d.utility.Vector3dVector(points[triangles.reshape(-1)])
    mesh.triangles = open3d.utility.Vector3iVector(np.arange(triangles.size, dtype=np.int32).reshape(-1, 3))
    colors = np.repeat(face_colors(vertices, triangles, labels) / 255.0, 3, axis=0)
    mesh.vertex_colors = open3d.utility.Vector3dVector(colors)
    return mesh


def from_pyvista(mesh: pyvista.PolyData) -> tuple[NDArray[Any], Polygons]:
    """Take the points and faces of a ``pyvista.PolyData``; nothing is copied. Its points and lines are passed over.

    Raises
    ------
    ValueError
        If it has strips of triangles: call ``mesh.triangulate()`` first.
    """
    import pyvista

    if mesh.n_strips > 0:
        raise ValueError("the mesh has strips of triangles: call triangulate() first")
    cells = mesh.GetPolys()
    corners = np.asarray(pyvista.convert_array(cells.GetConnectivityArray()))
    offsets = np.asarray(pyvista.convert_array(cells.GetOffsetsArray()))
    return np.asarray(mesh.points), Polygons(corners, offsets if offsets.size else np.zeros(1, dtype=np.int64))


def to_pyvista(vertices: ArrayLike, faces: Faces, labels: ArrayLike | None = None) -> pyvista.PolyData:
    """Make a ``pyvista.PolyData``, with the labels in ``cell_data["segment"]``."""
    import pyvista

    corners, offsets, degree = polygons_of(faces)
    if offsets is None:
        offsets = np.arange(0, len(corners) + 1, degree)
    counts = np.diff(offsets)
    mesh = pyvista.PolyData(vertices_of(vertices), np.insert(corners, offsets[:-1], counts))
    if labels is not None:
        mesh.cell_data["segment"] = integers_of(labels, "labels")
    return mesh


def face_colors(
    vertices: ArrayLike,
    faces: Faces,
    labels: ArrayLike,
    colors: Mapping[int, tuple[int, int, int]] | None = None,
) -> NDArray[np.uint8]:
    """List the colour of each face.

    Parameters
    ----------
    vertices, faces, labels
        See `segment_colors()`.
    colors : mapping from int to three int, optional
        Of each label; by default those of `segment_colors()`.

    Returns
    -------
    ndarray of uint8, shape (m, 3)
        Red, green and blue.
    """
    chosen = segment_colors(vertices, faces, labels) if colors is None else colors
    names, number = np.unique(integers_of(labels, "labels"), return_inverse=True)
    table = np.array([chosen[int(name)] for name in names], dtype=np.uint8).reshape(-1, 3)
    return table[number.reshape(-1)]
