#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes a field of models in tiles, larger than most machines hold, segments it by segment_mesh, and tells what each step took.

Models are subdivided and set out on a grid. Borders of tiles are those of boxes, at even distances that are not the models', so
that they cut through models. Tiles are binary PLY files of double precision; vertices on borders are equal to the last bit.
The table has the steps of the tool's report; a plan for more machines follows from it, which is no measurement. Last, some
tiles are segmented as meshes of their own: what all steps take of a core beyond that is the price of borders.

Usage: field_of_tiles.py TOOL FOLDER MESH.off [MESH.off ...] [--models 180] [--faces 1048576] [--tiles 10x5] [--workers 2]
Needs NumPy, and on disk 150 bytes a face in FOLDER.
"""

from __future__ import annotations

import argparse
import json
import math
import resource
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

Points = npt.NDArray[np.float64]
Triangles = npt.NDArray[np.int64]

FACE = np.dtype([("corners", "u1"), ("vertices", "<i4", 3)])
PITCH = 1.1  # between models, of their diagonal: none touches another
CORES_OF_MACHINE = 2  # of the plan


def read_off(path: Path) -> tuple[Points, Triangles]:
    """Read a triangle mesh."""
    words = path.read_text().split()
    vertices, faces = int(words[1]), int(words[2])
    numbers = np.array(words[4:], dtype=np.float64)
    triangles = numbers[3 * vertices : 3 * vertices + 4 * faces].reshape(faces, 4)
    if words[0] != "OFF" or not (triangles[:, 0] == 3).all():
        raise ValueError(f"{path}: not an OFF file of triangles")
    return numbers[: 3 * vertices].reshape(vertices, 3), triangles[:, 1:].astype(np.int64)


def subdivided(points: Points, triangles: Triangles) -> tuple[Points, Triangles]:
    """Cut each triangle into four at the middles of its sides."""
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]], axis=2).reshape(-1, 2)
    edges, edge_of_side = np.unique(sides[:, 0] * len(points) + sides[:, 1], return_inverse=True)
    middles = (points[edges // len(points)] + points[edges % len(points)]) / 2
    a, b, c = triangles.T
    ab, bc, ca = (len(points) + edge_of_side.reshape(-1, 3)).T
    parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return np.vstack([points, middles]), np.vstack([np.column_stack(part) for part in parts])


def model(path: Path, faces: int) -> tuple[Points, Triangles]:
    """Read a mesh, subdivide it up to so many faces, and scale it to a diagonal of 1 about the origin."""
    points, triangles = read_off(path)
    while 4 * len(triangles) <= faces:
        points, triangles = subdivided(points, triangles)
    low, high = points.min(axis=0), points.max(axis=0)
    return (points - (low + high) / 2) / np.linalg.norm(high - low), triangles


class Tile:
    """A file of vertices and one of faces, which become a PLY file."""

    def __init__(self, folder: Path, number: int) -> None:
        self.path = folder / f"tile_{number:03}.ply"
        self.parts = [self.path.with_suffix(suffix).open("wb") for suffix in (".vertices", ".faces")]
        self.vertices = self.faces = 0

    def add(self, points: Points, triangles: Triangles) -> None:
        """Add some faces, with the vertices that they have."""
        used, corners = np.unique(triangles, return_inverse=True)
        faces = np.empty(len(triangles), dtype=FACE)
        faces["corners"] = 3
        faces["vertices"] = self.vertices + corners.reshape(-1, 3)
        self.parts[0].write(points[used].astype("<f8").tobytes())
        self.parts[1].write(faces.tobytes())
        self.vertices += len(used)
        self.faces += len(triangles)

    def finish(self) -> None:
        """Write the PLY file; it appears whole."""
        lines = ["ply", "format binary_little_endian 1.0", f"element vertex {self.vertices}"]
        lines += [f"property double {axis}" for axis in "xyz"]
        lines += [f"element face {self.faces}", "property list uchar int vertex_indices", "end_header", ""]
        unfinished = self.path.with_suffix(".part")
        with unfinished.open("wb") as file:
            file.write("\n".join(lines).encode())
            for part in self.parts:
                part.close()
                file.write(Path(part.name).read_bytes())
                Path(part.name).unlink()
        unfinished.rename(self.path)


def make_field(folder: Path, meshes: list[Path], models: int, faces: int, grid: tuple[int, int]) -> list[str]:
    """Write the tiles, and tell their paths."""
    columns = math.ceil(math.sqrt(models * grid[0] / grid[1]))
    rows = math.ceil(models / columns)
    tiles = [Tile(folder, number) for number in range(grid[0] * grid[1])]
    shapes = [model(path, faces) for path in meshes]
    for number in range(models):
        points, triangles = shapes[number % len(shapes)]
        angle = number * (3 - math.sqrt(5)) * math.pi  # no two alike
        turn = np.array([[math.cos(angle), -math.sin(angle), 0], [math.sin(angle), math.cos(angle), 0], [0, 0, 1]])
        placed = points @ turn.T + PITCH * np.array([number % columns, number // columns, 0])
        middles = (placed[triangles, :2].mean(axis=1) / PITCH + 0.5) / np.array(
            [columns, rows]
        )  # in parts of the field
        cell = np.clip((middles * grid).astype(int), 0, np.array(grid) - 1)
        tile_of_face = cell[:, 1] * grid[0] + cell[:, 0]
        for tile in np.unique(tile_of_face):
            tiles[tile].add(placed, triangles[tile_of_face == tile])
    for tile in tiles:
        tile.finish()
    return [str(tile.path) for tile in tiles]


def seconds_of_core(command: list[str]) -> float:
    """Run a command, and tell how long it keeps cores busy."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def planned_minutes(steps: dict[str, Any], machines: int) -> float:
    """Tell how long so many machines would take."""
    at_a_time = machines * CORES_OF_MACHINE
    seconds = 0.0
    for step in steps.values():
        seconds += math.ceil(step["jobs"] / at_a_time) * step["seconds"] / max(step["jobs"], 1)
    return seconds / 60


def print_steps(steps: dict[str, Any], seconds: float) -> None:
    """Print what each step took, and the plan."""
    row = "{:10} {:>5} {:>18} {:>16}"
    print(row.format("step", "jobs", "s of a core, each", "GB, largest job"))
    for name, step in steps.items():
        each = step["seconds"] / max(step["jobs"], 1)
        print(row.format(name, step["jobs"], f"{each:.2f}", f"{step['largest_job_mb'] / 1000:.2f}"))
    largest = max(step["largest_job_mb"] for step in steps.values())
    print(row.format("all", "", f"{seconds:.1f}", f"{largest / 1000:.2f}"), end="\n\n")
    for machines in (1, 10, 100):
        minutes = planned_minutes(steps, machines)
        print(f"{machines} machines of {CORES_OF_MACHINE} cores, by plan: {minutes:.1f} minutes")


def main() -> int:
    """Make the field, segment it, and print the tables."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("tool", help="segment_mesh")
    parser.add_argument("folder", type=Path, help="for the tiles and all else")
    parser.add_argument("meshes", type=Path, nargs="+", help="OFF files of triangles")
    parser.add_argument("--models", type=int, default=180)
    parser.add_argument("--faces", type=int, default=1 << 20, help="of a model, at most")
    parser.add_argument("--tiles", default="10x5", help="columns and rows")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--alone", type=int, default=5, help="tiles to segment as meshes of their own")
    arguments = parser.parse_args()
    folder: Path = arguments.folder
    folder.mkdir(parents=True, exist_ok=True)
    columns, rows = (int(number) for number in arguments.tiles.split("x"))

    tiles = make_field(folder, arguments.meshes, arguments.models, arguments.faces, (columns, rows))
    work_folder, report_path = folder / "work", folder / "report.json"
    shutil.rmtree(work_folder, ignore_errors=True)  # steps that are done there would not be done again
    command = [arguments.tool, *tiles, "--tiled", "--quiet", "--workers", str(arguments.workers)]
    command += ["--tile-folder", str(work_folder), "--labels", str(folder / "%.seg"), "--report", str(report_path)]
    start = time.monotonic()
    subprocess.run(command, check=True)
    seconds = time.monotonic() - start
    report = json.loads(report_path.read_text())
    print(f"{len(tiles)} tiles, {report['faces']} faces, {len(report['segments'])} segments, {seconds:.0f} s\n")
    seconds_of_steps = sum(step["seconds"] for step in report["steps"].values())
    print_steps(report["steps"], seconds_of_steps)

    chosen = tiles[:: max(1, len(tiles) // arguments.alone)][: arguments.alone]
    command_alone = [arguments.tool, "--quiet", "--labels", str(folder / "alone.seg")]
    alone = [seconds_of_core([*command_alone, tile]) for tile in chosen]
    seconds_alone = len(tiles) * sum(alone) / len(alone)
    print(f"\ntiles as meshes of their own, by {len(alone)} of them: {seconds_alone:.0f} s of a core", end="; ")
    print(f"all steps take {seconds_of_steps / seconds_alone:.2f} of it")
    return 0


if __name__ == "__main__":
    sys.exit(main())
