# SPDX-License-Identifier: MIT
"""All levels of a segmentation as a dendrogram: ``python dendrogram.py [MESH] [FIGURE.png]``.

The height of a fork is the cost of the merge; below the line at 1, where merging stops by itself, branches are segments.
"""

from __future__ import annotations

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from example_meshes import figure_path, hand, mesh_from_command_line
from scipy.cluster.hierarchy import dendrogram

import rw_segmentation as rw

STOP_COST = 1.0

mesh = mesh_from_command_line(hand())
levels = rw.hierarchy(*rw.from_trimesh(mesh))
linkage = levels.to_linkage()
print(f"{levels.number_of_fragments} fragments, {levels.suggested} segments suggested")

figure, axes = plt.subplots(figsize=(9, 4), layout="constrained")
dendrogram(linkage, ax=axes, color_threshold=STOP_COST, above_threshold_color="black")
axes.axhline(STOP_COST, color="#d55e00", linestyle="--", label=f"merging stops: {levels.suggested} segments")
axes.set_yscale("symlog", linthresh=0.1)
axes.set_xlabel("fragment")
axes.set_ylabel("cost of the merge")
axes.legend()
figure.savefig(figure_path("dendrogram.png"), dpi=100)
