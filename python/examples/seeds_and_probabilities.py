# SPDX-License-Identifier: MIT
"""Seeds, and how sure the walk is of each face: ``python seeds_and_probabilities.py [MESH] [FIGURE.png]``."""

from __future__ import annotations

import numpy as np
import pyvista
from example_meshes import figure_path, hand, mesh_from_command_line

import rw_segmentation as rw

mesh = mesh_from_command_line(hand())
vertices, faces = rw.from_trimesh(mesh)
centers = mesh.triangles_center

# The palm, and the outermost face of each finger: seeds as a user would click them.
walk = rw.RandomWalk(vertices, faces)
walk.add_seed(int(np.linalg.norm(centers - centers.mean(axis=0), axis=1).argmin()), 0)
for angle in np.radians([-75, -30, -10, 10, 30]):
    direction = np.array([np.sin(angle), 0, np.cos(angle)])
    walk.add_seed(
        int((centers @ direction - 2 * np.abs(np.cross(centers, direction)).sum(axis=1)).argmax()), len(walk.seeds)
    )
labels, probabilities = walk.labels(), walk.probabilities()
print(f"{len(walk.seeds)} seeds, {len(np.unique(labels))} segments")

# After an edit the answer costs a fraction of the first one.
thumb = list(walk.seeds)[1]
walk.remove_seed(thumb)
print(f"{len(np.unique(walk.labels()))} segments without the thumb's seed")
walk.add_seed(thumb, 1)
assert np.array_equal(walk.labels(), labels)

plotter = pyvista.Plotter(shape=(1, 2), off_screen=True, window_size=[900, 450])
shown = rw.to_pyvista(vertices, faces, labels)
shown.rw.plot_segments(plotter=plotter)
plotter.add_points(centers[list(walk.seeds)], color="black", point_size=12, render_points_as_spheres=True)
plotter.camera_position = "xz"
plotter.subplot(0, 1)
sure = rw.to_pyvista(vertices, faces)
sure.cell_data["probability of the label"] = probabilities.max(axis=1)
plotter.add_mesh(sure, scalars="probability of the label", cmap="cividis")
plotter.camera_position = "xz"
plotter.screenshot(figure_path("seeds_and_probabilities.png"))
