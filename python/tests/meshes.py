# SPDX-License-Identifier: MIT
"""Meshes as arrays: read from OFF files, and made."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rw_segmentation import Polygons


class Mesh(NamedTuple):
    """What all functions take first."""

    vertices: NDArray[np.float64]
    faces: Any

    @property
    def number_of_faces(self) -> int:
        """Count the faces."""
        return len(self.faces.offsets) - 1 if isinstance(self.faces, Polygons) else len(self.faces)


def read_off(path: Path) -> Mesh:
    """Read an OFF file as it stands: no vertex is merged, no polygon cut into triangles."""
    lines = (line.split("#")[0].split() for line in path.read_text(errors="replace").splitlines())
    words = iter([line for line in lines if line])
    header = next(words)
    kind, numbers = header[0], header[1:] or next(words)
    vertices = [next(words)[:3] for _ in range(int(numbers[0]))]
    rows = [next(words) for _ in range(int(numbers[1]))]
    assert kind.endswith("OFF")
    lists = [[int(word) for word in row[1 : int(row[0]) + 1]] for row in rows]
    degrees = {len(row) for row in lists}
    faces = np.array(lists) if len(degrees) == 1 else Polygons.from_lists(lists)
    return Mesh(np.array(vertices, dtype=float), faces)


def write_off(path: Path, mesh: Mesh) -> None:
    """Write triangles or quads with all digits."""
    rows = [" ".join(f"{x!r}" for x in map(float, vertex)) for vertex in mesh.vertices]
    rows += [" ".join(map(str, [len(face), *face])) for face in np.asarray(mesh.faces).tolist()]
    path.write_text(f"OFF\n{len(mesh.vertices)} {len(mesh.faces)} 0\n" + "\n".join(rows) + "\n")


def grid(columns: int, rows: int) -> Mesh:
    """Make a bent sheet of triangles: a ridge with a sharp fold along the middle column."""
    x, y = np.meshgrid(np.arange(columns + 1.0), np.arange(rows + 1.0), indexing="ij")
    vertices = np.column_stack([x.ravel(), y.ravel(), np.abs(x - columns / 2).ravel()])
    corner = (np.arange(columns)[:, None] * (rows + 1) + np.arange(rows)[None, :]).ravel()
    right, up = corner + rows + 1, corner + 1
    faces = np.concatenate([np.column_stack([corner, right, up]), np.column_stack([right, right + 1, up])])
    return Mesh(vertices, faces)


def waves(columns: int, rows: int) -> Mesh:
    """Make a wavy sheet of quads on which no two places are alike."""
    x, y = np.meshgrid(np.arange(columns + 1.0), np.arange(rows + 1.0), indexing="ij")
    height = 3 * np.sin(x / 4.1) * np.cos(y / 3.7) + 0.5 * np.sin(x * y / 17)
    corner = (np.arange(columns)[:, None] * (rows + 1) + np.arange(rows)[None, :]).ravel()
    faces = np.column_stack([corner, corner + rows + 1, corner + rows + 2, corner + 1])
    return Mesh(np.column_stack([x.ravel(), y.ravel(), height.ravel()]), faces)


def sphere(subdivisions: int = 2, radius: float = 1.0, center: tuple[float, float, float] = (0, 0, 0)) -> Mesh:
    """Make a sphere by halving the edges of an icosahedron."""
    import trimesh

    made = trimesh.creation.icosphere(subdivisions=subdivisions, radius=radius)
    return Mesh(np.asarray(made.vertices) + np.asarray(center), np.asarray(made.faces, dtype=np.int64))


def together(*meshes: Mesh) -> Mesh:
    """Put meshes of triangles side by side in one."""
    begin = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    faces = [np.asarray(mesh.faces) + start for mesh, start in zip(meshes, begin, strict=False)]
    return Mesh(np.concatenate([mesh.vertices for mesh in meshes]), np.concatenate(faces))


def same_partition(first: NDArray[np.int64], second: NDArray[np.int64]) -> bool:
    """Tell whether two labellings are the same but for the names of labels."""
    pairs = np.unique(np.column_stack([first, second]), axis=0)
    return len(pairs) == len(np.unique(first)) == len(np.unique(second))
