# SPDX-License-Identifier: MIT
"""Parts of machines: the surface that each segment lies on."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from rw_segmentation import _core
from rw_segmentation._arrays import Faces, labels_of, mesh_of, walls_of
from rw_segmentation._progress import Progress, reporting
from rw_segmentation.segmentation import Hierarchy

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Plane:
    """A plane through a point.

    `residual` is the root mean square distance of the vertices, in the mesh's unit. Errors are standard deviations, of
    positions and directions where these are known least, in the mesh's unit and in radians; infinite where the vertices
    do not tell a number.
    """

    point: Vector
    normal: Vector
    residual: float
    point_error: float = 0
    normal_error: float = 0
    type: str = field(default="plane", init=False)


@dataclass(frozen=True)
class Sphere:
    """A sphere by its centre and radius; `residual` and errors as for `Plane`."""

    center: Vector
    radius: float
    residual: float
    center_error: float = 0
    radius_error: float = 0
    type: str = field(default="sphere", init=False)


@dataclass(frozen=True)
class Cylinder:
    """A cylinder by a point of its axis, the axis and the radius; `residual` and errors as for `Plane`."""

    point: Vector
    axis: Vector
    radius: float
    residual: float
    point_error: float = 0
    axis_error: float = 0
    radius_error: float = 0
    type: str = field(default="cylinder", init=False)


@dataclass(frozen=True)
class Cone:
    """A cone by its apex, the axis along which it opens, and the angle between the two in radians."""

    apex: Vector
    axis: Vector
    half_angle: float
    residual: float
    apex_error: float = 0
    axis_error: float = 0
    half_angle_error: float = 0
    type: str = field(default="cone", init=False)


@dataclass(frozen=True)
class Torus:
    """A torus by its centre, axis, the radius of the circle that its tube is centred on, and that of the tube."""

    center: Vector
    axis: Vector
    radius: float
    tube_radius: float
    residual: float
    center_error: float = 0
    axis_error: float = 0
    radius_error: float = 0
    tube_radius_error: float = 0
    type: str = field(default="torus", init=False)


@dataclass(frozen=True)
class FreeForm:
    """A surface that is none of the others."""

    type: str = field(default="free form", init=False)


Surface = Union[Plane, Sphere, Cylinder, Cone, Torus, FreeForm]


def surface_of(numbers: dict[str, Any]) -> Surface:
    """Make the dataclass of a surface."""
    kind, point, direction = numbers["type"], numbers["point"], numbers["direction"]
    residual, radius = numbers["residual"], numbers["radius"]
    at, turn, of_radius = numbers["point_error"], numbers["direction_error"], numbers["radius_error"]
    if kind == "plane":
        return Plane(point, direction, residual, at, turn)
    if kind == "sphere":
        return Sphere(point, radius, residual, at, of_radius)
    if kind == "cylinder":
        return Cylinder(point, direction, radius, residual, at, turn, of_radius)
    if kind == "cone":
        return Cone(point, direction, numbers["half_angle"], residual, at, turn, numbers["half_angle_error"])
    if kind == "torus":
        of_tube = numbers["tube_radius_error"]
        return Torus(point, direction, radius, numbers["tube_radius"], residual, at, turn, of_radius, of_tube)
    return FreeForm()


def segment_surfaces(
    vertices: ArrayLike,
    faces: Faces,
    segments: int | None = None,
    *,
    labels: ArrayLike | None = None,
    noise: float | None = None,
    stop_cost: float = 1,
    walls: ArrayLike | None = None,
    repair: bool = True,
    progress: Progress = None,
) -> tuple[NDArray[np.int64], list[Surface]]:
    """Segment a part of a machine into planes, spheres, cylinders, cones, tori and free forms.

    Parameters
    ----------
    vertices : array_like of float32 or float64, shape (n, 3)
        Coordinates.
    faces : array_like of int, shape (m, 3) or (m, k), or Polygons
        The vertices at the corners of each face, counterclockwise from outside.
    segments : int, optional
        How many, at least one for each connected component; without it, merging stops at `stop_cost`.
    labels : array_like of int, shape (m,), optional
        Segments that are known already, of which the surfaces are wanted alone, without `segments`, `stop_cost` and `walls`;
        in the order of their labels then.
    noise : float, optional
        The standard deviation of the vertices from the surfaces, as a part of the diagonal; estimated by default.
    stop_cost : float
        The largest cost of a merge; 1 joins what one surface fits.
    walls, repair, progress
        See `segment()`.

    Returns
    -------
    labels : ndarray of int64, shape (m,)
        The segment of each face, from 0 without gaps.
    surfaces : list of Plane, Sphere, Cylinder, Cone, Torus or FreeForm
        That of each segment, in the mesh's coordinates: dataclasses that ``json`` (by ``dataclasses.asdict()``) and
        ``pandas.DataFrame`` take.

    Raises
    ------
    ValueError, Cancelled, KeyboardInterrupt
        See `segment()`.

    Notes
    -----
    Linear in the number of faces where regions have several faces each; 0.1 to 0.2 ms for each face that no region holds.
    """
    if labels is not None:
        for argument, is_given in (
            ("segments", segments is not None),
            ("stop_cost", stop_cost != 1),
            ("walls", walls is not None),
        ):
            if is_given:
                raise ValueError(f"{argument}: labels are segments that are known already, leave one of the two out")
    mesh = mesh_of(vertices, faces, repair)
    deviation = -1.0 if noise is None else float(noise)
    if noise is not None and not deviation >= 0:
        raise ValueError(f"noise is {noise}, but must not be negative")
    with reporting(progress, "surfaces") as told:
        if labels is None:
            levels = Hierarchy(_core.hierarchy_of_surfaces(mesh, deviation, float(stop_cost), walls_of(walls), told))
            result = levels.labels(segments)
        else:
            result = np.unique(labels_of(labels, mesh), return_inverse=True)[1].reshape(-1).astype(np.int64)
        count = int(result.max()) + 1 if result.size else 0
        found = _core.surfaces_of_segments(mesh, np.ascontiguousarray(result), count, deviation, told)
    return result, [surface_of(numbers) for numbers in found]
