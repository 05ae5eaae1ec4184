# SPDX-License-Identifier: MIT
"""Meshes to test on, and the tool that the same answers are expected of."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from meshes import Mesh, read_off

ROOT = Path(__file__).resolve().parents[2]


def required(variable: str, default: Path, what: str) -> Path:
    """Find a file or folder that the tests need; there is no silent way round it."""
    path = Path(os.environ.get(variable, default))
    if not path.exists():
        pytest.fail(f"{what} is not at {path}: build it with scripts/test, or set {variable}")
    return path


@pytest.fixture(scope="session")
def data() -> Path:
    """Give CGAL's data meshes."""
    return required("RW_SEGMENTATION_MESHES", ROOT / "build/test/data/meshes", "the folder of CGAL's data meshes")


@pytest.fixture(scope="session")
def tool() -> Path:
    """Give the C++ tool."""
    return required("SEGMENT_MESH", ROOT / "build/test/examples/segment_mesh", "the tool segment_mesh")


@pytest.fixture(scope="session")
def elephant(data: Path) -> Mesh:
    """Give a natural shape of one component."""
    return read_off(data / "elephant.off")


@pytest.fixture(scope="session")
def anchor(data: Path) -> Mesh:
    """Give a part of a machine."""
    return read_off(data / "anchor.off")


@pytest.fixture
def cube() -> Mesh:
    """Give a cube of quads."""
    vertices = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    faces = np.array([(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
    return Mesh(vertices, faces)
