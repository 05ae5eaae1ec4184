# SPDX-License-Identifier: MIT
"""What is measured on a mesh: differences, conductances, curvatures, thickness."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from rw_segmentation import _core
from rw_segmentation._arrays import Faces, array_of, integer_of, labels_of, mesh_of, numbers_of, walls_of
from rw_segmentation._progress import Progress, reporting

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


# The smoothing length of normals as a part of the root of the area, as the automatic segmentation sees shapes.
SMOOTHING = 0.01
# Of the balls in which curvatures are measured, in mean edge lengths.
RADIUS = 3.0


class InteriorEdges(NamedTuple):
    """The edges between two faces, in the order of all arrays by edge: `faces` and `vertices` are of shape (e, 2)."""

    faces: NDArray[np.int64]
    vertices: NDArray[np.int64]


@dataclass(frozen=True)
class Curvatures:
    """How a surface bends at the centre of each face, at the scale of balls of a radius.

    Curvatures are positive where the solid is convex; their unit is 1 over that of the mesh.

    Attributes
    ----------
    max, min : ndarray of float64, shape (m,)
        The principal curvatures.
    mean_by_volume : ndarray of float64, shape (m,)
        A second estimate of the mean; far from `mean` where the surface is not smooth at this scale.
    offset : ndarray of float64, shape (m,)
        How high the smooth surface lies above the centre of the face.
    max_direction, min_direction, normal : ndarray of float64, shape (m, 3)
        Unit vectors.
    radius : float
        Of the balls, in the mesh's unit.
    """

    max: NDArray[np.float64]
    min: NDArray[np.float64]
    mean_by_volume: NDArray[np.float64]
    offset: NDArray[np.float64]
    max_direction: NDArray[np.float64]
    min_direction: NDArray[np.float64]
    normal: NDArray[np.float64]
    radius: float

    @property
    def mean(self) -> NDArray[np.float64]:
        """H, the mean of the principal curvatures."""
        return (self.max + self.min) / 2

    @property
    def gaussian(self) -> NDArray[np.float64]:
        """K, the product of the principal curvatures."""
        return self.max * self.min


def interior_edges(vertices: ArrayLike, faces: Faces, *, repair: bool = True) -> InteriorEdges:
    """List the edges between two different faces, in the order of all arrays by edge.

    Returns
    -------
    InteriorEdges
        The two faces and the two vertices of each edge; the first face has the edge in the direction of the vertices.
    """
    return InteriorEdges(*mesh_of(vertices, faces, repair).interior_edges())


def sharp_edges(vertices: ArrayLike, faces: Faces, degrees: float, *, repair: bool = True) -> NDArray[np.int64]:
    """List the edges over which the surface turns by more than an angle, for `walls`.

    Parameters
    ----------
    vertices, faces, repair
        See `segment()`.
    degrees : float
        The angle, between 0 and 180.

    Returns
    -------
    ndarray of int64, shape (w, 2)
        Pairs of vertices.
    """
    return mesh_of(vertices, faces, repair).sharp_edges(float(degrees))


def dihedral_difference(
    vertices: ArrayLike,
    faces: Faces,
    *,
    convex_weight: float = 0.2,
    measure: Literal["cosine", "angle"] = "cosine",
    smoothing: float = 0,
    ordinary_difference: float = 0,
    repair: bool = True,
    progress: Progress = None,
) -> NDArray[np.float64]:
    """Measure how faces differ by the angle between their normals (Eq. 4 and 5 of the paper).

    Parameters
    ----------
    vertices, faces, repair, progress
        See `segment()`.
    convex_weight : float
        How much convex edges count beside concave ones, from 0 to 1.
    measure : {"cosine", "angle"}
        1 - cos(theta), or 2 sin(theta / 2).
    smoothing : float
        The smoothing length of the normals as a part of the root of the area; 0 takes the faces' own.
    ordinary_difference : float
        Differences up to so many times the mean count as none.

    Returns
    -------
    ndarray of float64, shape (e,)
        By interior edge, 1 on average.
    """
    mesh = mesh_of(vertices, faces, repair)
    with reporting(progress, "normals") as told:
        return _core.dihedral_difference(mesh, convex_weight, measure, smoothing, ordinary_difference, told)


def curvature_difference(
    vertices: ArrayLike,
    faces: Faces,
    *,
    radius: float | None = None,
    radius_in_edge_lengths: float = RADIUS,
    repair: bool = True,
    progress: Progress = None,
) -> NDArray[np.float64]:
    """Measure how faces differ by normals and curvatures, for parts of machines (Eq. 7 and 8 of the paper).

    Parameters
    ----------
    vertices, faces, repair, progress
        See `segment()`.
    radius, radius_in_edge_lengths
        See `curvatures()`.

    Returns
    -------
    ndarray of float64, shape (e,)
        By interior edge.
    """
    mesh = mesh_of(vertices, faces, repair)
    with reporting(progress, "curvatures") as told:
        return _core.curvature_difference(
            mesh, radius_in_edge_lengths if radius is None else radius, radius is None, told
        )


def feature_difference(
    vertices: ArrayLike, faces: Faces, features: ArrayLike, *, repair: bool = True
) -> NDArray[np.float64]:
    """Measure how faces differ by features: their Euclidean distance over each edge, divided by the mean of all.

    Parameters
    ----------
    vertices, faces, repair
        See `segment()`.
    features : array_like of float, shape (m, k)
        Such as colours, normals, or what a network makes of the faces. All columns count alike: scale them as wanted.

    Returns
    -------
    ndarray of float64, shape (e,)
        By interior edge, 1 on average; 0 everywhere where all features are the same.
    """
    return feature_difference_of_mesh(mesh_of(vertices, faces, repair), features)


def feature_difference_of_mesh(mesh: _core.Mesh, features: ArrayLike) -> NDArray[np.float64]:
    """Measure it on a mesh that has been read."""
    table = array_of(features, "face_features")
    table = numbers_of(table.reshape(-1, 1) if table.ndim == 1 else table, "face_features", 2)
    if table.shape[0] != mesh.number_of_faces:
        raise ValueError(f"face_features have {table.shape[0]} rows, but the mesh has {mesh.number_of_faces} faces")
    if not np.isfinite(table).all():
        raise ValueError(f"the features of face {int(np.argwhere(~np.isfinite(table))[0][0])} are not finite")
    sides = mesh.interior_edges()[0]
    distance: NDArray[np.float64] = np.linalg.norm(table[sides[:, 0]] - table[sides[:, 1]], axis=1)
    mean = distance.mean() if distance.size else 0.0
    return distance / mean if mean > 0 else distance


def conductance(
    vertices: ArrayLike,
    faces: Faces,
    difference: ArrayLike,
    *,
    sigma: float = 1,
    cap: float = 20,
    walls: ArrayLike | None = None,
    repair: bool = True,
) -> NDArray[np.float64]:
    """Make conductances of differences (Eq. 6): w = |e| exp(-min(d / sigma, cap)), lengths in diagonals of the mesh.

    Parameters
    ----------
    vertices, faces, walls, repair
        See `segment()`.
    difference : array_like of float, shape (e,)
        By interior edge, 1 on average.
    sigma : float
        The difference that divides the conductance by e.
    cap : float
        The largest exponent.

    Returns
    -------
    ndarray of float64, shape (e,)
        By interior edge; 0 on walls, positive elsewhere.

    Raises
    ------
    ValueError
        If a difference is negative or NaN (names the faces), or a number is out of range.
    """
    mesh = mesh_of(vertices, faces, repair)
    return _core.conductance(mesh, numbers_of(difference, "the difference"), sigma, cap, walls_of(walls))


def curvatures(
    vertices: ArrayLike,
    faces: Faces,
    *,
    radius: float | None = None,
    radius_in_edge_lengths: float = RADIUS,
    repair: bool = True,
    progress: Progress = None,
) -> Curvatures:
    """Measure principal curvatures and directions at the centres of faces, from balls (integral invariants).

    Parameters
    ----------
    vertices, faces, repair, progress
        See `segment()`.
    radius : float, optional
        Of the balls, in the mesh's unit.
    radius_in_edge_lengths : float
        The same in mean edge lengths, where `radius` is not given. On clean meshes 2 to 3 serve; noise asks for more.

    Returns
    -------
    Curvatures

    Notes
    -----
    After Yang, Lai, Hu, Pottmann: *Robust principal curvatures on multiple scales*, 2006. Time grows with the number of
    triangles that a ball meets.
    """
    mesh = mesh_of(vertices, faces, repair)
    with reporting(progress, "curvatures") as told:
        rows, vectors, length = _core.curvatures(
            mesh, radius_in_edge_lengths if radius is None else radius, radius is None, told
        )
    numbers = [np.ascontiguousarray(column) for column in rows.T]
    directions = [np.ascontiguousarray(vectors[:, i : i + 3]) for i in (0, 3, 6)]
    return Curvatures(
        max=numbers[0],
        min=numbers[1],
        mean_by_volume=numbers[2],
        offset=numbers[3],
        max_direction=directions[0],
        min_direction=directions[1],
        normal=directions[2],
        radius=length,
    )


def thickness(
    vertices: ArrayLike,
    faces: Faces,
    *,
    rays: int = 25,
    cone_angle: float = np.pi / 3,
    smoothed: bool = False,
    scale: Literal["length", "linear", "logarithmic"] = "length",
    repair: bool = True,
    progress: Progress = None,
) -> NDArray[np.float64]:
    """Measure how thick the solid is below each face, as the shape diameter function does.

    Parameters
    ----------
    vertices, faces, repair, progress
        See `segment()`.
    rays : int
        For each face.
    cone_angle : float
        Between the outermost ray and the inward normal, in radians, below pi / 2.
    smoothed : bool
        Whether noise is smoothed away; steps of the thickness are kept.
    scale : {"length", "linear", "logarithmic"}
        In the mesh's unit, or from 0 for the thinnest to 1 for the thickest face.

    Returns
    -------
    ndarray of float64, shape (m,)
        0 only where no ray leaves the solid anywhere.
    """
    mesh = mesh_of(vertices, faces, repair)
    rays = integer_of(rays, "rays", 1)
    with reporting(progress, "thickness") as told:
        return _core.thickness(mesh, rays, cone_angle, smoothed, scale, told)


def smoothed_normals(
    vertices: ArrayLike,
    faces: Faces,
    *,
    smoothing: float = SMOOTHING,
    repair: bool = True,
    progress: Progress = None,
) -> NDArray[np.float64]:
    """Smooth the normals of faces, so that they tell the shape and not single triangles.

    Parameters
    ----------
    vertices, faces, repair, progress
        See `segment()`.
    smoothing : float
        The smoothing length as a part of the root of the area.

    Returns
    -------
    ndarray of float64, shape (m, 3)
        Unit vectors.
    """
    mesh = mesh_of(vertices, faces, repair)
    with reporting(progress, "normals") as told:
        return _core.smoothed_normals(mesh, smoothing, told)


def transfer_labels(
    reduced_vertices: ArrayLike,
    reduced_faces: Faces,
    reduced_labels: ArrayLike,
    vertices: ArrayLike,
    faces: Faces,
    *,
    band: int = 6,
    difference: ArrayLike | None = None,
    sigma: float = 1,
    cap: float = 20,
    walls: ArrayLike | None = None,
    repair: bool = True,
    progress: Progress = None,
) -> NDArray[np.int64]:
    """Carry the labels of a reduced mesh to the mesh that it was made of; boundaries move to the features of the full one.

    Parameters
    ----------
    reduced_vertices, reduced_faces
        The reduced mesh, in the place of the full one: simplified or remeshed in any way.
    reduced_labels : array_like of int, shape (faces of the reduced mesh,)
        Its labels.
    vertices, faces, walls, repair, progress
        The full mesh, see `segment()`.
    band : int
        How many faces on either side of a boundary are walked on; 0 leaves what the closest faces say.
    difference : array_like of float, shape (e,), optional
        By interior edge of the full mesh; by default `dihedral_difference()`.
    sigma, cap : float
        See `conductance()`.

    Returns
    -------
    ndarray of int64, shape (m,)
        Labels of the reduced mesh.
    """
    reduced = mesh_of(reduced_vertices, reduced_faces, repair)
    labels = labels_of(reduced_labels, reduced, "reduced_labels")
    mesh = mesh_of(vertices, faces, repair)
    band = integer_of(band, "band", 0)
    with reporting(progress, "transfer") as told:
        if difference is None:
            values = _core.dihedral_difference(mesh, 0.2, "cosine", 0.0, 0.0, None)
        else:
            values = numbers_of(difference, "the difference")
        return _core.transfer_labels(reduced, labels, mesh, values, sigma, cap, band, walls_of(walls), told)
