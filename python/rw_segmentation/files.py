# SPDX-License-Identifier: MIT
"""Files of meshes, read and written as by the tool segment_mesh."""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import tempfile
import warnings
import zlib
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO, Union

import numpy as np

from rw_segmentation import _core
from rw_segmentation._arrays import (
    Faces,
    MeshRepairWarning,
    Polygons,
    integers_of,
    mesh_of,
    polygons_of,
    vertices_of,
)
from rw_segmentation.colors import segment_colors

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

# A file that belongs with others, and what writes its bytes.
OutputFile = tuple[Path, Callable[[BinaryIO], object]]
AnyPath = Union[str, "os.PathLike[str]"]


def read_mesh(path: AnyPath) -> tuple[NDArray[np.float64], NDArray[np.int64] | Polygons]:
    """Read an OFF, PLY, OBJ, STL, 3MF, Gmsh, Medit or VTP file as the tool segment_mesh does.

    Faces keep their order and their corners, whatever materials, groups or degrees they have.

    Parameters
    ----------
    path : str or path
        The file, which may be packed by gzip.

    Returns
    -------
    vertices : ndarray of float64, shape (n, 3)
    faces : ndarray of int64, shape (m, 3), or Polygons
        Polygons where some face is no triangle.

    Warns
    -----
    MeshRepairWarning
        If the file holds what is no surface as well, such as tetrahedra.

    Raises
    ------
    OSError
        If there is no such file.
    ValueError
        If the file is broken, cut off, or of another format.
    """
    return mesh_in(path, content_of(path))


def write_segments(path: AnyPath, vertices: ArrayLike, faces: Faces, labels: ArrayLike) -> None:
    """Write a mesh with its segments, in colours that neighbours do not share, as the tool segment_mesh does.

    The file appears when it is whole; until then one of that name stays.

    Parameters
    ----------
    path : str or path
        Its extension tells the format: .ply, .off, .obj (with a file .mtl beside it), .stl, .glb, .3mf, .msh, .mesh, .vtp.
        Those from .stl to .mesh hold triangles alone; polygons are cut.
    vertices, faces
        See `segment()`.
    labels : array_like of int, shape (m,)
        The segment of each face, from 0 to 2**32 - 1.

    Raises
    ------
    OSError
        If the file cannot be written.
    ValueError
        If the format is not known or cannot hold the mesh.
    """
    write_whole(files_of_segments(path, vertices, faces, labels))


def content_of(path: AnyPath) -> bytes:
    """Read a file and unpack it if it is packed by gzip."""
    content = Path(path).read_bytes()
    return _unpacked(_shown(path), content) if _core.is_packed(content) else content


def is_mesh_file(path: AnyPath, content: bytes) -> bool:
    """Tell whether a file is of a format that `read_mesh()` reads, whole or broken."""
    return _core.is_mesh_file(_shown(path), content)


def mesh_in(path: AnyPath, content: bytes) -> tuple[NDArray[np.float64], NDArray[np.int64] | Polygons]:
    """Read the mesh in the content of a file, see `read_mesh()`."""
    vertices, corners, offsets, remarks = _core.read_mesh_file(_shown(path), content)
    if remarks:
        warnings.warn(f"{_shown(path)}: {'; '.join(remarks)}", MeshRepairWarning, stacklevel=3)
    are_triangles = bool((np.diff(offsets) == 3).all())
    return vertices, corners.reshape(-1, 3) if are_triangles else Polygons(corners, offsets)


def triangulated(vertices: ArrayLike, faces: Faces) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Cut polygons into triangles, and tell of which face each is."""
    mesh_of(vertices, faces, repair=True, warn=False)  # refuses corners that are no vertices
    return _core.triangles_of(vertices_of(vertices).astype(np.float64, copy=False), *_corners_and_offsets(faces))


def format_of(path: AnyPath) -> str:
    """Tell the format that a file is written in by its extension, without the dot."""
    name = Path(path).suffix.lower().removeprefix(".")
    known = _core.output_formats()
    if name not in known:
        raise ValueError(f"{_shown(path)} is none of {', '.join('.' + each for each in known)}")
    return name


def paths_of_segments(path: AnyPath) -> list[Path]:
    """List the files that a mesh with segments is written to: OBJ files have their materials beside them."""
    path = Path(path)
    return [path, path.with_suffix(".mtl")] if format_of(path) == "obj" else [path]


def files_of_segments(path: AnyPath, vertices: ArrayLike, faces: Faces, labels: ArrayLike) -> list[OutputFile]:
    """Prepare what `write_segments()` writes."""
    name, shown, paths = format_of(path), _shown(path), paths_of_segments(path)
    corners, offsets = _corners_and_offsets(faces)
    known = integers_of(labels, "labels")
    if known.shape != (len(offsets) - 1,):
        raise ValueError(f"labels must be of shape ({len(offsets) - 1},), one a face, but are of shape {known.shape}")
    if known.size and not (int(known.min()) >= 0 and int(known.max()) < 2**32):
        raise ValueError(f"{shown}: labels in files are from 0 to {2**32 - 1}, not {known.min()} to {known.max()}")
    color_of_label = segment_colors(vertices, faces, known)  # refuses corners that are no vertices
    labels_with_colors = np.array(list(color_of_label), dtype=np.int64)
    colors = np.array(list(color_of_label.values()), dtype=np.uint8).reshape(-1, 3)

    def write_mesh(file: BinaryIO) -> None:
        points = vertices_of(vertices).astype(np.float64, copy=False)
        own = known.astype(np.int64, copy=False)
        materials = os.fsencode(paths[-1].name)
        _core.write_mesh_file(
            file.write, shown, name, points, corners, offsets, own, labels_with_colors, colors, materials
        )

    def write_materials(file: BinaryIO) -> None:
        _core.write_materials(file.write, shown, labels_with_colors, colors)

    return list(zip(paths, (write_mesh, write_materials), strict=False))


def open_file_of(path: AnyPath) -> int | None:
    """Give the number of an open file that a path stands for, such as 1 for /dev/stdout; None for all others."""
    match = re.fullmatch(r"/dev/(stdout|stderr)|(?:/dev/fd|/proc/self/fd)/(\d+)", os.fspath(path))
    return None if match is None else {"stdout": 1, "stderr": 2}[match[1]] if match[1] else int(match[2])


def write_whole(files: Sequence[OutputFile]) -> None:
    """Write files that belong together by temporary names: all are there and whole, or those before stay."""
    with contextlib.ExitStack() as stack:
        ready = []
        for path, fill in files:
            target = path.resolve()  # a link stays a link
            try:
                descriptor = open_file_of(path)
                if descriptor is not None:
                    with os.fdopen(os.dup(descriptor), "wb") as file:
                        fill(file)
                    continue
                if target.exists() and not target.is_file():  # a pipe or a device
                    with target.open("wb") as file:
                        fill(file)
                    continue
                folder = stack.enter_context(tempfile.TemporaryDirectory(dir=target.parent, prefix=".segments-"))
                temporary = Path(folder) / target.name
                with temporary.open("wb") as file:
                    fill(file)
            except OSError as error:
                if error.errno is None:
                    raise
                raise type(error)(error.errno, error.strerror, os.fspath(path)) from error
            if target.exists():
                _give_permissions(target, temporary)
            ready.append((temporary, target))
        for temporary, target in ready:
            temporary.replace(target)


def _give_permissions(replaced: Path, path: Path) -> None:
    """Give a file the permissions of the one that it replaces, and its owner and group where the user may."""
    if hasattr(os, "chown"):
        known = replaced.stat()
        with contextlib.suppress(OSError):
            os.chown(path, known.st_uid, known.st_gid)
    shutil.copymode(replaced, path)


def _corners_and_offsets(faces: Faces) -> tuple[NDArray[np.uint32], NDArray[np.int64]]:
    """Give the corners of all faces, and where each face begins and the last one ends."""
    corners, offsets, degree = polygons_of(faces)
    if offsets is None:
        offsets = np.arange(0, len(corners) + 1, degree, dtype=np.int64)
    return corners.astype(np.uint32, copy=False), offsets


def _shown(path: AnyPath) -> str:
    """Write a path such that it is text in any case."""
    return os.fspath(path).encode(errors="replace").decode()


def _unpacked(shown: str, content: bytes) -> bytes:
    """Give what a gzip file holds, which may be several parts one after the other."""
    block, view, begin = 2**20, memoryview(content), 0
    blocks = []
    while bytes(view[begin : begin + 2]) == b"\x1f\x8b":  # bytes behind the last part have no meaning
        part = zlib.decompressobj(wbits=zlib.MAX_WBITS + 16)
        while not part.eof:
            packed = view[begin : begin + block]
            if not packed:
                raise ValueError(f"{shown}: the gzip file is cut off")
            try:
                blocks.append(part.decompress(packed))
            except zlib.error:
                raise ValueError(f"{shown}: the gzip file is broken") from None
            begin += len(packed) - len(part.unused_data)
    return b"".join(blocks)
