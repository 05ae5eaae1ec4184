# SPDX-License-Identifier: MIT
"""The main options of the tool segment_mesh: ``python -m rw_segmentation MESH --output segments.ply``."""

from __future__ import annotations

import argparse
import dataclasses
import itertools
import json
import os
import sys
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import rw_segmentation as rw
from rw_segmentation import files
from rw_segmentation._arrays import polygons_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from rw_segmentation._arrays import Faces

# What the tool returns to the shell, too.
SUCCESS, WRONG_USAGE, UNREADABLE_INPUT, WRONG_ARGUMENT, UNWRITABLE_OUTPUT, CANCELLED = 0, 1, 2, 3, 5, 130


MESH_HELP = "OFF, PLY, OBJ, STL, 3MF, Gmsh, Medit or VTP, packed by gzip or not, or what else trimesh or meshio reads"
OUTPUT_HELP = "the coloured mesh: .ply, .off, .obj (with .mtl), .stl, .glb, .3mf, .msh, .mesh, .vtp"


class UnreadableFileError(Exception):
    """A mesh cannot be read."""


def read_mesh(path: Path) -> tuple[NDArray[np.float64], Faces]:
    """Read a mesh; other formats than the tool's by trimesh, or by meshio where that does not know the file."""
    if not path.is_file():
        raise UnreadableFileError(f"{path}: there is no such file")
    try:
        content = files.content_of(path)
        if files.is_mesh_file(path, content):
            vertices, faces = files.mesh_in(path, content)
            require_surface(path, faces)
            return vertices, faces
    except (OSError, ValueError) as error:
        raise UnreadableFileError(str(error)) from error
    reasons = []
    for read in (_read_by_trimesh, _read_by_meshio):
        try:
            return read(path)
        except ImportError as error:
            reasons.append(f"{error.name} is not installed")
        except Exception as error:  # what readers raise on broken files is theirs to choose
            reasons.append(str(error) or type(error).__name__)
    raise UnreadableFileError(f"{path}: {'; '.join(reasons)}")


def require_surface(path: Path, faces: Faces) -> None:
    """Refuse what leaves nothing to segment."""
    corners, offsets, degree = polygons_of(faces)
    begin = np.arange(0, len(corners) + 1, degree) if offsets is None else offsets
    if len(begin) == 1:
        raise ValueError(f"{path}: the file has no faces, so that there is no surface to segment")
    if all(len(set(corners[first:last].tolist())) < 3 for first, last in itertools.pairwise(begin)):
        raise ValueError(f"{path}: no face has three different corners")


def _read_by_meshio(path: Path) -> tuple[NDArray[np.float64], Faces]:
    import meshio

    return rw.from_meshio(meshio.read(path))


def _read_by_trimesh(path: Path) -> tuple[NDArray[np.float64], Faces]:
    import trimesh

    mesh = trimesh.load_mesh(path, process=False)
    if not isinstance(mesh, trimesh.Trimesh) or len(mesh.faces) == 0:
        raise ValueError("the file holds no faces")
    return rw.from_trimesh(mesh)


def parser() -> argparse.ArgumentParser:
    """Define the command line."""
    options = argparse.ArgumentParser(
        prog="python -m rw_segmentation",
        description="Segments a mesh with random walks: as many segments as the shape suggests, unless told otherwise.",
    )
    options.add_argument("mesh", type=Path, help=MESH_HELP)
    options.add_argument("--version", action="version", version=f"rw-segmentation {rw.__version__}")
    options.add_argument("--segments", type=int, metavar="N", help="how many segments")
    options.add_argument("--seed", action="append", default=[], metavar="FACE[=LABEL]", help="a face; repeatable")
    ways = options.add_mutually_exclusive_group()
    ways.add_argument("--paper", action="store_true", help="what the paper does")
    ways.add_argument("--coarse", action="store_true", help="a few seeds far apart, each a segment")
    ways.add_argument("--engineering", action="store_true", help="planes, cylinders, cones, ... of a part of a machine")
    options.add_argument("--difference", choices=["dihedral", "concavity", "curvature"], help="of neighbouring faces")
    options.add_argument("--constraints-angle", type=float, metavar="DEGREES", help="sharper edges are walls")
    options.add_argument("-o", "--output", type=Path, metavar="FILE", help=OUTPUT_HELP)
    options.add_argument("--refine", action="store_true", help="cut smooth boundaries into the mesh that is written")
    options.add_argument("--labels", type=Path, metavar="FILE", help="one label a line for each face")
    options.add_argument("--report", type=Path, metavar="FILE", help="segments and surfaces as JSON")
    options.add_argument("-q", "--quiet", action="store_true", help="print nothing but errors")
    return options


def wrong_use_of(options: argparse.Namespace) -> str | None:
    """Tell what does not go together; None if all does."""
    if options.engineering:
        for name, value in (("--seed", options.seed), ("--difference", options.difference)):
            if value:
                return f"{name}: surfaces are found without it, leave out --engineering or {name}"
    if options.seed and options.coarse:
        return "--seed: --coarse places its seeds by itself, leave one of the two out"
    if options.segments is not None and any("=" in text for text in options.seed):
        return "--seed: labels have no meaning where fragments are merged, give faces alone or leave out --segments"
    if options.refine and options.output is None:
        return "--refine: nothing would show it, give --output, too"
    outputs: list[tuple[str, Path]] = []
    if options.output is not None:
        try:
            outputs = [("output", path) for path in files.paths_of_segments(options.output)]
        except ValueError as error:
            return f"--output: {error}"
    outputs += [(name, getattr(options, name)) for name in ("labels", "report") if getattr(options, name) is not None]
    taken = {options.mesh.resolve()}
    for name, path in outputs:
        if path.resolve() in taken:
            return f"--{name}: {path} is the mesh or another output"
        taken.add(path.resolve())
    return None


def seeds_of(texts: Sequence[str]) -> list[tuple[int, int]]:
    """Read FACE or FACE=LABEL; seeds without a label get the lowest ones that are not in use."""
    seeds: list[tuple[int, int | None]] = []
    for text in texts:
        face, _, label = text.partition("=")
        try:
            seeds.append((int(face), int(label) if label else None))
        except ValueError:
            raise ValueError(f"{text} is no seed: give FACE or FACE=LABEL") from None
    used = {label for _, label in seeds}
    free = (label for label in range(len(seeds) + len(used)) if label not in used)
    return [(face, next(free) if label is None else label) for face, label in seeds]


def segment(
    options: argparse.Namespace, vertices: NDArray[np.float64], faces: Faces
) -> tuple[NDArray[np.int64], list[rw.Surface]]:
    """Segment as the options tell."""
    progress = sys.stderr.isatty() and not options.quiet
    walls = None if options.constraints_angle is None else rw.sharp_edges(vertices, faces, options.constraints_angle)
    if options.engineering:
        return rw.segment_surfaces(vertices, faces, options.segments, walls=walls, progress=progress)
    seeds: Any = seeds_of(options.seed) or None
    if seeds and options.segments is not None:
        seeds = [face for face, _ in seeds]
    policy = "paper" if options.paper else "coarse" if options.coarse else "automatic"
    labels = rw.segment(
        vertices,
        faces,
        options.segments,
        policy=policy,  # type: ignore[arg-type]
        difference=options.difference,
        seeds=seeds,
        walls=walls,
        progress=progress,
    )
    return labels, []


def mesh_to_write(
    options: argparse.Namespace, vertices: NDArray[np.float64], faces: Faces, labels: NDArray[np.int64]
) -> tuple[NDArray[np.float64], Faces, NDArray[np.int64]]:
    """Cut the boundaries into the mesh, which makes triangles of it, where that is wished."""
    if not options.refine:
        return vertices, faces, labels
    triangles, face_of_triangle = files.triangulated(vertices, faces)
    split = rw.split_along_boundaries(vertices, triangles, labels[face_of_triangle])
    return split.vertices, split.faces, split.labels


def run(options: argparse.Namespace) -> int:
    """Read, segment, write."""
    for path in (options.output, options.labels, options.report):
        if path is not None and not path.resolve().parent.is_dir():
            raise OSError(f"{path}: there is no such folder")
    vertices, faces = read_mesh(options.mesh)
    labels, surfaces = segment(options, vertices, faces)
    names, counts = np.unique(labels, return_counts=True)
    report = [{"label": int(name), "faces": int(count)} for name, count in zip(names, counts, strict=True)]
    for entry, surface in zip(report, surfaces, strict=False):
        entry["surface"] = dataclasses.asdict(surface)  # type: ignore[assignment]
    outputs: list[files.OutputFile] = []
    if options.labels is not None:
        outputs.append((options.labels, lambda file: np.savetxt(file, labels, fmt="%d")))
    if options.report is not None:
        text = json.dumps({"mesh": str(options.mesh), "segments": report}) + "\n"
        outputs.append((options.report, lambda file: file.write(text.encode())))
    if options.output is not None:
        outputs += files.files_of_segments(options.output, *mesh_to_write(options, vertices, faces, labels))
    try:
        files.write_whole(outputs)
    except ValueError as error:  # the format cannot hold the mesh
        raise OSError(str(error)) from error
    if not options.quiet and all(files.open_file_of(path) != 1 for path, _ in outputs):
        print("label     faces")
        for entry in report:
            print(f"{entry['label']:5} {entry['faces']:9}")
    return SUCCESS


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Returns
    -------
    int
        0, or what the tool segment_mesh returns for the same error.
    """
    try:
        known = parser()
        options = known.parse_args(arguments)
        wrong = wrong_use_of(options)
        if wrong is not None:
            known.error(wrong)
    except SystemExit as ended:
        return WRONG_USAGE if ended.code else SUCCESS
    try:
        with warnings.catch_warnings(record=options.quiet):
            warnings.simplefilter("always" if not options.quiet else "ignore", rw.MeshRepairWarning)
            return run(options)
    except KeyboardInterrupt:
        return _fail("cancelled, nothing was written", CANCELLED)
    except UnreadableFileError as error:
        return _fail(str(error), UNREADABLE_INPUT)
    except OSError as error:
        return _fail(str(error), UNWRITABLE_OUTPUT)
    except (ValueError, RuntimeError) as error:
        return _fail(f"{os.fspath(options.mesh)}: {error}", WRONG_ARGUMENT)


def _fail(message: str, code: int) -> int:
    print(f"rw_segmentation: {message}", file=sys.stderr)
    return code


if __name__ == "__main__":
    sys.exit(main())
