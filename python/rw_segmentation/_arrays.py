# SPDX-License-Identifier: MIT
"""Arrays of the user's, as the compiled module takes them."""

from __future__ import annotations

import operator
import warnings
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, Union

import numpy as np

from rw_segmentation import _core

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class Polygons(NamedTuple):
    """Faces with different numbers of corners.

    Parameters
    ----------
    corners : array_like of int, shape (c,)
        The vertices at the corners, counterclockwise from outside, one face after the other.
    offsets : array_like of int, shape (m + 1,)
        Where each of the m faces begins in `corners`, and the end of the last: it begins with 0 and ends with c.

    See Also
    --------
    from_lists : of a list for each face
    """

    corners: ArrayLike
    offsets: ArrayLike

    @classmethod
    def from_lists(cls, faces: Iterable[Sequence[int]]) -> Polygons:
        """Make polygons of a sequence of vertices for each face."""
        rows = [integers_of(face, "the vertices of a face").astype(np.int64, copy=False).reshape(-1) for face in faces]
        offsets = np.zeros(len(rows) + 1, dtype=np.int64)
        np.cumsum([len(row) for row in rows], out=offsets[1:])
        return cls(np.concatenate(rows) if rows else np.zeros(0, dtype=np.int64), offsets)


# What is taken for faces: m x 3 integers, m x k, or polygons of any degree.
Faces = Union["ArrayLike", Polygons]


class MeshRepairWarning(UserWarning):
    """The faces did not form an oriented surface as they were, or a file held more; the message tells what was done."""


def array_of(values: ArrayLike, name: str) -> NDArray[Any]:
    """Make an array; entries that are masked have no value that could be taken."""
    if isinstance(values, np.ma.MaskedArray) and np.ma.is_masked(values):
        raise ValueError(f"{name} must not be masked: fill the entries that are, or leave them out")
    return np.asarray(values)


def vertices_of(vertices: ArrayLike) -> NDArray[np.float32] | NDArray[np.float64]:
    """Make an array of rows of three floats; float32 and float64 in rows are not copied."""
    array = array_of(vertices, "vertices")
    if array.size == 0 and array.ndim < 2:
        return np.zeros((0, 3))
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"vertices must be of shape (n, 3), but are of shape {array.shape}")
    if array.dtype.kind not in "iuf":
        raise ValueError(f"vertices must be real numbers, but are of type {array.dtype}")
    if array.dtype == np.float32:
        return np.ascontiguousarray(array, dtype=np.float32)
    return np.ascontiguousarray(array, dtype=np.float64)


def integers_of(values: ArrayLike, name: str) -> NDArray[Any]:
    """Make an array of integers of 32 or 64 bits; such integers in rows are not copied."""
    array = array_of(values, name)
    if array.size == 0 and array.dtype.kind == "f":
        array = array.astype(np.int64)
    if array.dtype.kind not in "iu":
        raise ValueError(f"{name} must be integers, but are of type {array.dtype}")
    width = max(4, array.dtype.itemsize)
    return np.ascontiguousarray(array, dtype=np.dtype(f"{array.dtype.kind}{width}"))


def integer_of(value: Any, name: str, least: int | None = None) -> int:
    """Take an integer, of Python's or NumPy's, of 64 bits at most."""
    try:
        number = operator.index(value)
    except TypeError:
        raise ValueError(f"{name} is {value!r}, but must be an integer") from None
    if least is not None and number < least:
        requirement = "must not be negative" if least == 0 else f"must be at least {least}"
        raise ValueError(f"{name} is {number}, but {requirement}")
    if not -(2**63) <= number < 2**63:
        raise ValueError(f"{name} is {number}, which is out of range")
    return number


def polygons_of(faces: Faces) -> tuple[NDArray[Any], NDArray[np.int64] | None, int]:
    """Make corners, and offsets or the number of corners of all faces."""
    if isinstance(faces, Polygons):
        corners = integers_of(faces.corners, "corners")
        offsets = integers_of(faces.offsets, "offsets").astype(np.int64, copy=False)
        if corners.ndim != 1 or offsets.ndim != 1:
            raise ValueError("corners and offsets must each be in one row")
        return corners, offsets, 0
    if isinstance(faces, np.ndarray):
        faces = array_of(faces, "faces")
    try:
        array = np.asarray(faces)
    except ValueError:
        return polygons_of(Polygons.from_lists(faces))  # type: ignore[arg-type]
    if array.size == 0 and array.ndim < 2:
        return np.zeros(0, dtype=np.int64), None, 3
    if array.ndim != 2 or array.shape[1] < 3:
        raise ValueError(
            f"faces must be of shape (m, 3) or (m, k), or Polygons(corners, offsets), but are of shape {array.shape}"
        )
    array = integers_of(array, "faces")
    return array.reshape(-1), None, array.shape[1]


def mesh_of(vertices: ArrayLike, faces: Faces, repair: bool, *, warn: bool = True) -> _core.Mesh:
    """Make the compiled module's mesh, and warn the caller of the public function of what was repaired."""
    corners, offsets, degree = polygons_of(faces)
    mesh = _core.Mesh(vertices_of(vertices), corners, offsets, degree, repair)
    if warn and mesh.remarks:
        warnings.warn("; ".join(mesh.remarks), MeshRepairWarning, stacklevel=3)
    return mesh


def labels_of(labels: ArrayLike, mesh: _core.Mesh, name: str = "labels") -> NDArray[np.int64]:
    """Make an array with one label a face."""
    array = integers_of(labels, name)
    if array.dtype == np.uint64 and array.size and int(array.max()) >= 2**63:
        raise ValueError(f"{name} must be less than 2**63, but one is {array.max()}")
    array = array.astype(np.int64, copy=False)
    if array.shape != (mesh.number_of_faces,):
        raise ValueError(
            f"{name} must be of shape ({mesh.number_of_faces},), one a face, but are of shape {array.shape}"
        )
    return array


def numbers_of(values: ArrayLike, name: str, dimensions: int = 1) -> NDArray[np.float64]:
    """Make an array of doubles in rows."""
    array = array_of(values, name)
    if array.dtype.kind not in "biuf":
        raise ValueError(f"{name} must be real numbers, but are of type {array.dtype}")
    if array.ndim != dimensions:
        raise ValueError(f"{name} must have {dimensions} dimension(s), but has the shape {array.shape}")
    return np.ascontiguousarray(array, dtype=np.float64)


def walls_of(walls: ArrayLike | None) -> NDArray[np.int64] | None:
    """Make pairs of vertices."""
    if walls is None:
        return None
    array = integers_of(walls, "walls").astype(np.int64, copy=False)
    if array.size == 0:
        return None
    if array.ndim != 2 or array.shape[1] != 2:
        raise ValueError(f"walls must be of shape (w, 2), pairs of vertices, but are of shape {array.shape}")
    return np.ascontiguousarray(array)
