# SPDX-License-Identifier: MIT
"""Segmentation of surface meshes with random walks: arrays in, labels out.

    import rw_segmentation as rw

    labels = rw.segment(vertices, faces)        # as many segments as the shape suggests
    labels = rw.segment(vertices, faces, 6)     # six
    levels = rw.hierarchy(vertices, faces)      # all levels
    walk = rw.RandomWalk(vertices, faces)       # from your seeds, which you edit

After Yu-Kun Lai, Shi-Min Hu, Ralph R. Martin, Paul L. Rosin: *Fast Mesh Segmentation using Random Walks*, ACM Symposium on
Solid and Physical Modeling, 2008.
"""

from rw_segmentation._arrays import MeshRepairWarning, Polygons
from rw_segmentation._core import Cancelled
from rw_segmentation._core import version as __version__
from rw_segmentation.adapters import (
    face_colors,
    from_meshio,
    from_open3d,
    from_pyvista,
    from_trimesh,
    to_meshio,
    to_open3d,
    to_pyvista,
    to_trimesh,
)
from rw_segmentation.boundaries import BoundaryCurve, SplitMesh, smooth_boundaries, split_along_boundaries
from rw_segmentation.colors import segment_colors
from rw_segmentation.comparison import SegmentationErrors, segmentation_errors
from rw_segmentation.files import read_mesh, write_segments
from rw_segmentation.measures import (
    Curvatures,
    InteriorEdges,
    conductance,
    curvature_difference,
    curvatures,
    dihedral_difference,
    feature_difference,
    interior_edges,
    sharp_edges,
    smoothed_normals,
    thickness,
    transfer_labels,
)
from rw_segmentation.refinement import Refined, refine
from rw_segmentation.segmentation import Hierarchy, Policy, hierarchy, segment
from rw_segmentation.surfaces import Cone, Cylinder, FreeForm, Plane, Sphere, Surface, Torus, segment_surfaces
from rw_segmentation.walk import RandomWalk

__all__ = [
    "BoundaryCurve",
    "Cancelled",
    "Cone",
    "Curvatures",
    "Cylinder",
    "FreeForm",
    "Hierarchy",
    "InteriorEdges",
    "MeshRepairWarning",
    "Plane",
    "Policy",
    "Polygons",
    "RandomWalk",
    "Refined",
    "SegmentationErrors",
    "Sphere",
    "SplitMesh",
    "Surface",
    "Torus",
    "__version__",
    "conductance",
    "curvature_difference",
    "curvatures",
    "dihedral_difference",
    "face_colors",
    "feature_difference",
    "from_meshio",
    "from_open3d",
    "from_pyvista",
    "from_trimesh",
    "hierarchy",
    "interior_edges",
    "read_mesh",
    "refine",
    "segment",
    "segment_colors",
    "segment_surfaces",
    "segmentation_errors",
    "sharp_edges",
    "smooth_boundaries",
    "smoothed_normals",
    "split_along_boundaries",
    "thickness",
    "to_meshio",
    "to_open3d",
    "to_pyvista",
    "to_trimesh",
    "transfer_labels",
    "write_segments",
]
