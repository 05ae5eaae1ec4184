# SPDX-License-Identifier: MIT
"""Boundaries between segments: smooth curves, and meshes cut along them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from rw_segmentation import _core
from rw_segmentation._arrays import Faces, integer_of, integers_of, labels_of, mesh_of, numbers_of, walls_of
from rw_segmentation._progress import Progress, reporting

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True)
class BoundaryCurve:
    """The boundary between two segments: a polyline whose points lie on edges or at vertices.

    Attributes
    ----------
    points : ndarray of float64, shape (p, 3)
        From one end to the other.
    faces : ndarray of int64, shape (p,)
        A face that each point lies in.
    barycentric : ndarray of float64, shape (p, 3)
        Where in that face, by its corners; one coordinate is 0.
    is_closed : bool
        Whether the first point follows the last.
    is_smoothed : bool
        False where the curve runs along the edges of the mesh, as the boundary did before.
    segments : tuple of two int
        On the left and on the right, seen from outside.
    """

    points: NDArray[np.float64]
    faces: NDArray[np.int64]
    barycentric: NDArray[np.float64]
    is_closed: bool
    is_smoothed: bool
    segments: tuple[int, int]

    @property
    def length(self) -> float:
        """In the mesh's unit."""
        points = np.vstack([self.points, self.points[:1]]) if self.is_closed else self.points
        return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


@dataclass(frozen=True)
class SplitMesh:
    """A mesh that has been cut along curves.

    Attributes
    ----------
    vertices : ndarray of float64, shape (n', 3)
        Those of the mesh first, at their places; new ones lie on its edges.
    faces : ndarray of int64, shape (m', 3)
        Those of the mesh first, or what is left of them.
    labels : ndarray of int64, shape (m',)
        The segment of each face.
    parents : ndarray of int64, shape (m',)
        The face of the mesh that each face was part of: ``values[parents]`` carries values along.
    boundary_edges : ndarray of int64, shape (b, 2)
        The edges of all curves, pairs of vertices.
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]
    labels: NDArray[np.int64]
    parents: NDArray[np.int64]
    boundary_edges: NDArray[np.int64]


def smooth_boundaries(
    vertices: ArrayLike,
    faces: Faces,
    labels: ArrayLike,
    *,
    length: float = 3,
    tension: float = 0.05,
    feature_weight: float = 0.02,
    crease_angle: float = 0.5,
    largest_displacement: float = 1,
    steps: int = 64,
    walls: ArrayLike | None = None,
    repair: bool = True,
    progress: Progress = None,
) -> list[BoundaryCurve]:
    """Make smooth curves of the jagged boundaries between segments; they keep to creases and do not cross.

    Parameters
    ----------
    vertices, faces, walls, repair, progress
        See `segment()`; all faces must be triangles.
    labels : array_like of int, shape (m,)
        The segment of each face.
    length : float
        Waves of the boundary shorter than 2 pi times this many edges are smoothed away.
    tension : float
        How much a curve pulls together, compared with how much it resists bending.
    feature_weight : float
        The length that a turn of the normal by one radian counts, as a part of the root of the area.
    crease_angle : float
        Edges whose faces' smoothed normals differ by more, in radians, are creases.
    largest_displacement : float
        How far a curve may get from the edges it ran along, in mean edge lengths; with 0 all stay as they are.
    steps : int
        In which the curves are reached.

    Returns
    -------
    list of BoundaryCurve
        A curve for each boundary, open ones first.

    Raises
    ------
    ValueError
        Also if a face is no triangle or a number is out of range.
    """
    mesh = mesh_of(vertices, faces, repair)
    known = labels_of(labels, mesh)
    smoothing = _core.BoundarySmoothing()
    smoothing.length, smoothing.tension = length, tension
    smoothing.feature_weight, smoothing.crease_angle = feature_weight, crease_angle
    smoothing.largest_displacement = largest_displacement
    smoothing.steps = integer_of(steps, "steps", 0)
    with reporting(progress, "boundaries") as told:
        curves: list[dict[str, Any]] = _core.smooth_boundaries(mesh, known, smoothing, walls_of(walls), told)
    return [BoundaryCurve(**curve) for curve in curves]


def split_along_boundaries(
    vertices: ArrayLike,
    faces: Faces,
    labels: ArrayLike,
    curves: Sequence[BoundaryCurve] | None = None,
    *,
    repair: bool = True,
    progress: Progress = None,
) -> SplitMesh:
    """Cut curves into a mesh, so that segments are bounded by smooth chains of edges. The surface does not move.

    Parameters
    ----------
    vertices, faces, repair, progress
        See `segment()`; all faces must be triangles.
    labels : array_like of int, shape (m,)
        The segment of each face.
    curves : sequence of BoundaryCurve, optional
        What `smooth_boundaries()` gives for this mesh and these labels, which is the default.

    Returns
    -------
    SplitMesh

    Raises
    ------
    ValueError
        If a face is no triangle, or the curves cross or do not bound the segments.
    """
    if curves is None:
        curves = smooth_boundaries(vertices, faces, labels, repair=repair, progress=progress)
    mesh = mesh_of(vertices, faces, repair)
    known = labels_of(labels, mesh)
    as_given: list[dict[str, object]] = [
        {
            "faces": integers_of(curve.faces, "faces").astype(np.int64, copy=False),
            "barycentric": numbers_of(curve.barycentric, "barycentric", 2),
            "is_closed": bool(curve.is_closed),
            "segments": np.array(curve.segments, dtype=np.int64),
        }
        for curve in curves
    ]
    return SplitMesh(*_core.split_along_boundaries(mesh, known, as_given))
