# SPDX-License-Identifier: MIT
"""How much two segmentations of one mesh differ."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from rw_segmentation._arrays import integers_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@dataclass(frozen=True)
class SegmentationErrors:
    """Measures of difference from 0, agreement, to 1, after Chen et al. (2009). Every face counts alike.

    Attributes
    ----------
    rand_index : float
        The share of the pairs of faces that are together in one segmentation and apart in the other: 1 - the Rand index.
    hamming : float
        The share of faces outside the best matching segments, averaged over both directions.
    global_consistency : float
        How far one is from a refinement of the other, all over the mesh in the same direction (GCE).
    local_consistency : float
        The same where each face may choose the direction (LCE).
    """

    rand_index: float
    hamming: float
    global_consistency: float
    local_consistency: float


def segmentation_errors(first: ArrayLike, second: ArrayLike) -> SegmentationErrors:
    """Measure how much two segmentations of one mesh differ; the names of labels do not matter.

    Parameters
    ----------
    first, second : array_like of int, shape (m,)
        The label of each face.

    Returns
    -------
    SegmentationErrors

    Raises
    ------
    ValueError
        If the two are of different lengths or no integers.

    Notes
    -----
    After Chen, Golovinskiy, Funkhouser: *A Benchmark for 3D Mesh Segmentation*, 2009. O(m log m) time, and memory for the
    pairs of labels that occur together.
    """
    one, other = integers_of(first, "labels"), integers_of(second, "labels")
    if one.ndim != 1 or one.shape != other.shape:
        raise ValueError(f"segmentations of shapes {one.shape} and {other.shape} cannot be compared")
    count = one.size
    if count == 0:
        return SegmentationErrors(0.0, 0.0, 0.0, 0.0)
    row, column = (np.unique(labels, return_inverse=True)[1].reshape(-1) for labels in (one, other))
    columns = int(column.max()) + 1
    cells, shared = np.unique(row.astype(np.int64) * columns + column, return_counts=True)
    shared = shared.astype(np.float64)
    rows_of_cells, columns_of_cells = cells // columns, cells % columns
    size_of_row, size_of_column = np.bincount(row).astype(float), np.bincount(column).astype(float)

    def pairs(n: np.ndarray[tuple[int], np.dtype[np.float64]]) -> float:
        return float((n * (n - 1) / 2).sum())

    apart = pairs(size_of_row) + pairs(size_of_column) - 2 * pairs(shared)
    most_of_row, most_of_column = np.zeros(len(size_of_row)), np.zeros(columns)
    np.maximum.at(most_of_row, rows_of_cells, shared)
    np.maximum.at(most_of_column, columns_of_cells, shared)
    outside_row = 1 - shared / size_of_column[columns_of_cells]
    outside_column = 1 - shared / size_of_row[rows_of_cells]
    return SegmentationErrors(
        rand_index=2 * apart / (count * (count - 1)) if count > 1 else 0.0,
        hamming=1 - float(most_of_row.sum() + most_of_column.sum()) / (2 * count),
        global_consistency=float(min((shared * outside_row).sum(), (shared * outside_column).sum())) / count,
        local_consistency=float((shared * np.minimum(outside_row, outside_column)).sum()) / count,
    )
