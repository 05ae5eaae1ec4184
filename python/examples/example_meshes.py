# SPDX-License-Identifier: MIT
"""Meshes that the examples are run on: a file of yours, or something that is made here."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
import trimesh


def mesh_from_command_line(made: trimesh.Trimesh) -> trimesh.Trimesh:
    """Read the file that is given as first argument; without one take what was made."""
    if len(sys.argv) > 1 and not sys.argv[1].endswith(".png"):
        mesh = trimesh.load_mesh(sys.argv[1], process=False)
        assert isinstance(mesh, trimesh.Trimesh)
        return mesh
    return made


def figure_path(default: str) -> Path:
    """Tell where the picture goes: the last argument if it is a .png, or the working folder."""
    return Path(sys.argv[-1]) if sys.argv[-1].endswith(".png") else Path(default)


def hand() -> trimesh.Trimesh:
    """Make a palm with five fingers: one surface, bent inward where they meet."""
    parts = [trimesh.creation.icosphere(subdivisions=2, radius=1.0)]
    parts[0].apply_scale((0.75, 0.35, 0.85))
    for i, angle in enumerate(np.radians([-75, -30, -10, 10, 30])):
        length = 1.1 if i else 0.8
        finger = trimesh.creation.capsule(height=length, radius=0.17, count=(24, 24))
        finger.apply_translation((0, 0, 0.6))
        finger.apply_transform(trimesh.transformations.rotation_matrix(angle, (0, 1, 0)))
        parts.append(finger)
    return solid_union(parts)


def solid_union(parts: list[trimesh.Trimesh], cells: int = 60) -> trimesh.Trimesh:
    """Join solids to one closed surface, by the level set of their distance on a grid (marching tetrahedra of VTK's)."""
    import pyvista

    bounds = np.array([part.bounds for part in parts])
    low, high = bounds[:, 0].min(axis=0) - 0.15, bounds[:, 1].max(axis=0) + 0.15
    step = float((high - low).max()) / cells
    grid: Any = pyvista.ImageData(
        dimensions=tuple(int(n) for n in np.ceil((high - low) / step) + 1), spacing=(step,) * 3, origin=tuple(low)
    )
    distance = np.full(grid.n_points, np.inf)
    for part in parts:
        surface = pyvista.wrap(part)
        distance = np.minimum(distance, grid.compute_implicit_distance(surface)["implicit_distance"])
    grid["distance"] = distance
    surface = grid.contour([0.0], scalars="distance").clean().triangulate()
    surface = surface.smooth_taubin(n_iter=10, pass_band=0.2)
    made = trimesh.Trimesh(np.asarray(surface.points), surface.regular_faces, process=True)
    if made.volume < 0:
        made.invert()
    return made
