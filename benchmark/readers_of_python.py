#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads the files that benchmark_readers wrote by meshio, trimesh and PyVista: the same table for readers of Python.

PyVista reads VTP, OBJ, PLY and STL by VTK, and OFF by meshio.

Usage: readers_of_python.py FOLDER [--faults]
Needs NumPy, meshio, trimesh and PyVista: pip install meshio trimesh pyvista
"""

from __future__ import annotations

import argparse
import multiprocessing
import resource
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pyvista
import trimesh

SECONDS = 60  # of processor time for a file
MEGABYTES = 8000  # of memory

Triangles = np.ndarray[Any, np.dtype[np.float32]]


def read_by_meshio(path: Path) -> Triangles:
    """Give the triangles of a file, one a row; polygons are cut as fans."""
    mesh = meshio.read(path)
    faces = [
        np.stack([np.asarray(block.data)[:, [0, i - 1, i]] for i in range(2, np.asarray(block.data).shape[1])], axis=1)
        for block in mesh.cells
        if block.dim == 2
    ]
    return np.float32(mesh.points[np.concatenate(faces).reshape(-1, 3)]).reshape(-1, 9)


def read_by_trimesh(path: Path) -> Triangles:
    """Give the triangles of a file, one a row."""
    mesh = trimesh.load(path, force="mesh", process=False)
    return np.float32(mesh.triangles).reshape(-1, 9)


def read_by_pyvista(path: Path) -> Triangles:
    """Give the triangles of a file, one a row."""
    mesh = pyvista.read(path)
    mesh = (mesh if isinstance(mesh, pyvista.PolyData) else mesh.extract_surface()).triangulate()
    return np.float32(mesh.points[mesh.regular_faces]).reshape(-1, 9)


READERS: dict[str, Callable[[Path], Triangles]] = {
    "meshio": read_by_meshio,
    "trimesh": read_by_trimesh,
    "pyvista": read_by_pyvista,
}


def in_order(triangles: Triangles) -> Triangles:
    """Sort triangles, each of which begins with its lowest corner."""
    corners = triangles.reshape(-1, 3, 3) + np.float32(0)
    order = np.lexsort((corners[:, :, 2], corners[:, :, 1], corners[:, :, 0]), axis=1)[:, 0]
    turned = corners[np.arange(len(corners))[:, None], (order[:, None] + np.arange(3)) % 3].reshape(-1, 9)
    return turned[np.lexsort(turned.T[::-1])]


def read(name: str, path: Path, is_right: Callable[[Triangles], bool], answer: Any) -> None:
    """Read a file, in a process of its own, and send what became of it."""
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
    resource.setrlimit(resource.RLIMIT_AS, (MEGABYTES << 20, MEGABYTES << 20))
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    start = time.process_time()
    try:
        triangles = READERS[name](path)
    except (Exception, SystemExit):
        outcome = "refused"
    else:
        outcome = "read"
    milliseconds = 1000 * (time.process_time() - start)
    megabytes = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * 1024 / 1e6
    if outcome == "read":
        outcome = "refused" if len(triangles) == 0 else "right" if is_right(triangles) else "wrong"
    answer.send((outcome, milliseconds, megabytes))


def outcome_of(name: str, path: Path, is_right: Callable[[Triangles], bool]) -> tuple[str, float, float]:
    """Tell what becomes of reading a file, the milliseconds of processor time and the megabytes."""
    mine, theirs = multiprocessing.Pipe(duplex=False)
    process = multiprocessing.Process(target=read, args=(name, path, is_right, theirs))
    process.start()
    theirs.close()
    try:
        result: tuple[str, float, float] = mine.recv()
    except EOFError:
        result = ("crash", 0, 0)
    process.join()
    return result


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--faults", action="store_true", help="name the dialects that a reader does not read rightly")
    arguments = parser.parse_args()
    folder: Path = arguments.folder
    small = in_order(read_by_trimesh(folder / "small.off"))
    large = len(read_by_trimesh(folder / "large/mesh.ply"))

    def is_small(triangles: Triangles) -> bool:
        return np.array_equal(in_order(triangles), small)

    def is_large(triangles: Triangles) -> bool:
        return triangles.size == 9 * large

    sys.stdout.reconfigure(line_buffering=True)  # type: ignore[union-attr]
    for name in READERS:
        counts = {"right": 0, "wrong": 0, "refused": 0, "crash": 0}
        for line in (folder / "dialects.txt").read_text().splitlines():
            file, kind = line.rsplit(" ", 1)
            outcome = outcome_of(name, folder / file, is_small)[0]
            if kind == "none":
                outcome = "right" if outcome == "refused" else "wrong"
            counts[outcome] += 1
            if arguments.faults and outcome != "right":
                print(f"{name}: {file}: {outcome}")
        print(
            f"RESULT bench=readers reader={name} set=dialects right={counts['right']} wrong={counts['wrong']} "
            f"refused={counts['refused']} crashes={counts['crash']}"
        )
        for group in ("large", "liars"):
            for path in sorted((folder / group).rglob("mesh.*")):
                outcome, milliseconds, megabytes = outcome_of(name, path, is_large)
                print(
                    f"RESULT bench=readers reader={name} set={group} file={path.relative_to(folder / group)} "
                    f"outcome={outcome} ms={milliseconds:.0f} megabytes={megabytes:.0f}"
                )


if __name__ == "__main__":
    main()
