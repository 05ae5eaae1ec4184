# SPDX-License-Identifier: MIT
"""Segments in Blender: materials and vertex groups of the active object.

    blender --background scene.blend --python blender_segments.py -- [SEGMENTS] [OUTPUT.blend]

The Python of Blender needs the package: ``BLENDER_PYTHON -m pip install rw-segmentation``, or its folder in ``PYTHONPATH``.
"""

from __future__ import annotations

import sys

import bpy
import numpy as np

import rw_segmentation as rw


def segment_object(thing: object, segments: int | None) -> np.ndarray:
    """Segment a mesh object; each segment becomes a material and a vertex group."""
    mesh = thing.data  # type: ignore[attr-defined]
    vertices = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", vertices)
    corners = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    starts = np.empty(len(mesh.polygons), dtype=np.int32)
    mesh.polygons.foreach_get("loop_start", starts)
    faces = rw.Polygons(corners, np.append(starts, len(corners)))
    labels = rw.segment(vertices.reshape(-1, 3), faces, segments)
    mesh.materials.clear()
    for label, color in rw.segment_colors(vertices.reshape(-1, 3), faces, labels).items():
        material = bpy.data.materials.new(f"segment {label}")
        material.diffuse_color = (*(channel / 255 for channel in color), 1)
        mesh.materials.append(material)
        group = thing.vertex_groups.new(name=f"segment {label}")  # type: ignore[attr-defined]
        corner_labels = np.repeat(labels, np.diff(faces.offsets))
        group.add(np.unique(corners[corner_labels == label]).tolist(), 1.0, "REPLACE")
    mesh.polygons.foreach_set("material_index", labels.astype(np.int32))
    mesh.update()
    return labels


if __name__ == "__main__":
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    wanted = next((int(word) for word in arguments if word.isdigit()), None)
    found = segment_object(bpy.context.active_object, wanted)
    print(f"{len(np.unique(found))} segments")
    for word in arguments:
        if word.endswith(".blend"):
            bpy.ops.wm.save_as_mainfile(filepath=word)
