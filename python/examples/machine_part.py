# SPDX-License-Identifier: MIT
"""A part of a machine and the table of its surfaces: ``python machine_part.py [MESH] [FIGURE.png]``."""

from __future__ import annotations

import dataclasses
import json

import numpy as np
import pandas as pd
import pyvista
import trimesh
from example_meshes import figure_path, mesh_from_command_line

import rw_segmentation as rw


def pulley() -> trimesh.Trimesh:
    """Turn a profile round the axis: a hub, a cone, a groove and a rounded rim."""
    turns = np.linspace(np.pi / 2, -np.pi / 2, 33)
    rim = np.column_stack([4 + 0.5 * np.cos(turns), 1 + 0.5 * np.sin(turns)])
    profile = [(0.8, 2.2), (1.6, 2.2), (2.4, 1.5), *rim, (2.4, 0.5), (2.4, 0), (0.8, 0), (0.8, 2.2)]
    return trimesh.creation.revolve(np.array(profile)[::-1], sections=96)


mesh = mesh_from_command_line(pulley())
labels, surfaces = rw.segment_surfaces(*rw.from_trimesh(mesh))

table = pd.DataFrame([dataclasses.asdict(surface) for surface in surfaces])
table.insert(0, "faces", np.bincount(labels, minlength=len(surfaces)))
print(
    table[[column for column in ("type", "faces", "radius", "half_angle", "residual") if column in table]].to_string()
)
print(json.dumps(dataclasses.asdict(surfaces[0])))

shown = rw.to_pyvista(*rw.from_trimesh(mesh), labels)
shown.rw.plot_segments(off_screen=True, window_size=[600, 450], screenshot=figure_path("machine_part.png"))
assert isinstance(shown, pyvista.PolyData)
