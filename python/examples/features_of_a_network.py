# SPDX-License-Identifier: MIT
"""Features and coarse labels of a network: ``python features_of_a_network.py [FIGURE.png]``.

The network is made up: for each true part a smooth random field, with noise, and a few views that vote for labels and miss
some of the faces. The walk makes segments of the features, and clean labels of the votes.
"""

from __future__ import annotations

import numpy as np
import pyvista
from example_meshes import figure_path, hand

import rw_segmentation as rw

random = np.random.default_rng(3)
mesh = hand()
vertices, faces = rw.from_trimesh(mesh)
centers = mesh.triangles_center
true = rw.segment(vertices, faces, 6)

# Features: a direction for each part that turns slowly over the part, and noise.
FEATURES, WAVES = 16, 0.7
means = random.standard_normal((6, FEATURES))
waves = np.sin(centers @ (WAVES * random.standard_normal((3, FEATURES))) + random.uniform(0, 2 * np.pi, FEATURES))
features = means[true] + 0.3 * waves + 0.05 * random.standard_normal((len(faces), FEATURES))
by_features = rw.segment(vertices, faces, 6, face_features=features)

# Votes: of every third face nothing is known, and of the others a third are wrong.
votes = np.eye(6)[np.where(random.random(len(faces)) < 0.33, random.integers(0, 6, len(faces)), true)]
votes[random.random(len(faces)) < 0.33] = 0
refined = rw.refine(vertices, faces, votes)

for name, labels in (("features", by_features), ("votes", votes.argmax(axis=1)), ("votes, refined", refined.labels)):
    print(f"{name}: Rand index error {rw.segmentation_errors(labels, true).rand_index:.3f}")

colors = rw.segment_colors(vertices, faces, true)
plotter = pyvista.Plotter(shape=(1, 3), off_screen=True, window_size=[1200, 420])
for column, (title, labels) in enumerate(
    (("features", by_features), ("votes", votes.argmax(axis=1)), ("refined", refined.labels))
):
    plotter.subplot(0, column)
    rw.to_pyvista(vertices, faces, labels).rw.plot_segments(
        plotter=plotter, colors=colors, boundary_width=2 if title != "votes" else 0
    )
    plotter.add_text(title, font_size=10)
    plotter.camera_position = "xz"
plotter.screenshot(figure_path("features_of_a_network.png"))
