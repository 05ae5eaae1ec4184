# SPDX-License-Identifier: MIT
"""Feeds the package arrays of every kind: ``python fuzz_arrays.py -max_total_time=600`` (pip install atheris).

Whatever is given, a call ends with a label for each face or with one of the package's errors; anything else stops the fuzzer.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable
from typing import Any

import atheris
import numpy as np

with atheris.instrument_imports(include=["rw_segmentation"]):
    import rw_segmentation as rw

REALS = ["f2", "f4", "f8", "g", ">f4", ">f8", "i4", "u1", "c8", "?", "O", "U3"]
INTEGERS = ["i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", ">i4", "f8", "?", "O"]
MOST_CORNERS = 64
SPECIAL = [0.0, 1.0, -1.0, 0.5, 1e300, -1e300, 1e-300, float("nan"), float("inf"), 3.0]


def strided(array: Any, data: atheris.FuzzedDataProvider) -> Any:
    """Lay an array out in another way."""
    way = data.ConsumeIntInRange(0, 4)
    if way == 1:
        return np.asfortranarray(array)
    if way == 2 and array.ndim:
        return np.repeat(array, 2, axis=0)[::2]
    if way == 3 and array.ndim:
        return array[::-1].copy()[::-1]
    if way == 4:
        array.flags.writeable = False
    return array


def real_array(data: atheris.FuzzedDataProvider, rows: int, columns: int) -> Any:
    """Make an array of numbers that may be special, or of another type."""
    values = [
        SPECIAL[data.ConsumeIntInRange(0, len(SPECIAL) - 1)]
        if data.ConsumeBool()
        else data.ConsumeIntInRange(-4, 4) / 2
        for _ in range(rows * columns)
    ]
    kind = "f8" if data.ConsumeIntInRange(0, 3) else REALS[data.ConsumeIntInRange(0, len(REALS) - 1)]
    with np.errstate(all="ignore"):
        array = np.array(values).reshape(rows, columns)
        return strided(np.nan_to_num(array).astype(kind) if kind in ("i4", "u1") else array.astype(kind), data)


def integer_array(data: atheris.FuzzedDataProvider, shape: tuple[int, ...], largest: int) -> Any:
    """Make an array of integers, most of them in range."""
    values = np.array([data.ConsumeIntInRange(-1, largest) for _ in range(int(np.prod(shape)))], dtype=np.int64)
    if data.ConsumeIntInRange(0, 20) == 0 and values.size:
        values[0] = data.ConsumeInt(8)
    kind = "i8" if data.ConsumeIntInRange(0, 3) else INTEGERS[data.ConsumeIntInRange(0, len(INTEGERS) - 1)]
    with np.errstate(all="ignore"):
        return strided(values.astype(kind).reshape(shape), data)


def mesh_of(data: atheris.FuzzedDataProvider) -> tuple[Any, Any, int]:
    """Make vertices, faces, and how many faces there seem to be."""
    vertices = real_array(data, data.ConsumeIntInRange(0, 10), 3 if data.ConsumeIntInRange(0, 9) else 2)
    largest = max(len(vertices) - (data.ConsumeIntInRange(0, 9) > 0), 0)
    count = data.ConsumeIntInRange(0, 16)
    if data.ConsumeBool():
        return vertices, integer_array(data, (count, data.ConsumeIntInRange(2, 5)), largest), count
    offsets = np.sort(integer_array(data, (count + 1,), 3 * count))
    fitting = int(offsets[-1]) if 0 <= offsets[-1] <= MOST_CORNERS else 3 * count
    corners = integer_array(data, (fitting if data.ConsumeBool() else 3 * count,), largest)
    return vertices, rw.Polygons(corners, offsets), count


def calls(data: atheris.FuzzedDataProvider) -> list[Callable[[], Any]]:
    """List what is called with a mesh."""
    vertices, faces, count = mesh_of(data)
    labels = integer_array(data, (count,), 4)
    rows = real_array(data, count, data.ConsumeIntInRange(0, 3))
    segments = data.ConsumeIntInRange(-1, 6) if data.ConsumeBool() else None
    policy: Any = ["automatic", "paper", "coarse", "coarse_paper", "surfaces"][data.ConsumeIntInRange(0, 4)]
    seeds = integer_array(data, (data.ConsumeIntInRange(0, 4),), max(count, 1)) if data.ConsumeBool() else None
    walls = integer_array(data, (data.ConsumeIntInRange(0, 3), 2), len(vertices)) if data.ConsumeBool() else None

    def walk() -> Any:
        made = rw.RandomWalk(vertices, faces, walls=walls)
        for place, face in enumerate(np.ravel(labels)):
            made.add_seed(int(face), place % 3)
        return made.probabilities(), made.labels()

    return [
        lambda: rw.segment(vertices, faces, segments, policy=policy, seeds=seeds, walls=walls),
        lambda: rw.segment(vertices, faces, segments, face_features=rows),
        lambda: rw.hierarchy(vertices, faces).to_linkage(),
        walk,
        lambda: rw.segment_surfaces(vertices, faces, labels=labels),
        lambda: rw.refine(vertices, faces, rows, walls=walls),
        lambda: rw.split_along_boundaries(vertices, faces, labels),
        lambda: rw.curvatures(vertices, faces),
        lambda: rw.thickness(vertices, faces),
        lambda: rw.transfer_labels(vertices, faces, labels, vertices, faces),
        lambda: rw.segment_colors(vertices, faces, labels),
        lambda: rw.segmentation_errors(labels, seeds if seeds is not None else labels),
    ]


def test_one(given: bytes) -> None:
    """Call one function with one mesh."""
    data = atheris.FuzzedDataProvider(given)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            functions = calls(data)
        except (ValueError, TypeError, OverflowError):
            return  # NumPy did not make the array
        try:
            result = functions[data.ConsumeIntInRange(0, len(functions) - 1)]()
        except ValueError:
            return
        assert result is not None


if __name__ == "__main__":
    atheris.Setup(sys.argv, test_one)
    atheris.Fuzz()
