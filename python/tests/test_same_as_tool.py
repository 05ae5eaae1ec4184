# SPDX-License-Identifier: MIT
"""Labels are those of the C++ tool, in every mode, on CGAL's data meshes."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import rw_segmentation as rw
from meshes import Mesh, read_off, waves, write_off

# Triangles and polygons, one component and several, closed and with borders, parts of machines, soups to repair. On shapes
# that are the same on several sides, rounding by the compiler decides where the first seed is placed; none is among them.
MESHES = [
    "elephant.off",
    "camel.off",
    "anchor.off",
    "fandisk.off",
    "joint.off",
    "mushroom.off",
    "blobby_3cc.off",
    "mesh_with_border.off",
    "hand.off",
    "helmet.off",
    "blobby-shuffled.off",
    "quads_to_stitch.off",
    "boeing.off",
    "waves of quads",
]
MODES: dict[str, tuple[list[str], Callable[[Mesh], NDArray[np.int64]]]] = {
    "automatic": ([], lambda m: rw.segment(*m)),
    "six segments": (["--segments", "6"], lambda m: rw.segment(*m, 6)),
    "paper": (["--paper"], lambda m: rw.segment(*m, policy="paper")),
    "paper, seven segments": (["--paper", "--segments", "7"], lambda m: rw.segment(*m, 7, policy="paper")),
    "coarse": (["--coarse"], lambda m: rw.segment(*m, policy="coarse")),
    "coarse, paper": (["--coarse", "--paper"], lambda m: rw.segment(*m, policy="coarse_paper")),
    "surfaces": (["--engineering"], lambda m: rw.segment(*m, policy="surfaces")),
    "seeds": (
        ["--seed", "0", "--seed", "5=3", "--seed", "3"],
        lambda m: rw.segment(*m, seeds=[(0, 0), (5, 3), (3, 1)]),
    ),
    "seeds and segments": (["--seed", "4", "--segments", "6"], lambda m: rw.segment(*m, 6, seeds=[4])),
    "curvature": (["--difference", "curvature"], lambda m: rw.segment(*m, difference="curvature")),
    "dihedral": (["--difference", "dihedral"], lambda m: rw.segment(*m, difference="dihedral")),
    "walls": (["--constraints-angle", "40"], lambda m: rw.segment(*m, walls=rw.sharp_edges(*m, 40))),
    "coarse seeding": (["--seeding", "coarse"], lambda m: rw.segment(*m, policy=rw.Policy(seeding="coarse"))),
    "size cost": (["--merge-cost", "size"], lambda m: rw.segment(*m, policy=rw.Policy(merge_cost="size"))),
    "boundary cost": (["--merge-cost", "boundary"], lambda m: rw.segment(*m, policy=rw.Policy(merge_cost="boundary"))),
    "components": (["--components", "whole"], lambda m: rw.segment(*m, policy=rw.Policy(components="whole"))),
    "seedings": (["--seedings", "3"], lambda m: rw.segment(*m, policy=rw.Policy(seedings=3))),
    "Eigen": (["--solver", "eigen"], lambda m: rw.segment(*m, policy=rw.Policy(solver="eigen"))),
    "numbers": (
        ["--sigma", "0.5", "--cap", "10", "--smoothing", "0.02", "--convex-weight", "0.1", "--seeds", "30"],
        lambda m: rw.segment(
            *m, policy=rw.Policy(sigma=0.5, cap=10, smoothing=0.02, convex_weight=0.1, number_of_seeds=30)
        ),
    ),
}


@pytest.mark.filterwarnings("ignore::rw_segmentation.MeshRepairWarning")
@pytest.mark.parametrize("name", MESHES)
def test_labels_are_those_of_the_tool(name: str, data: Path, tool: Path, tmp_path: Path) -> None:
    path = data / name
    if not path.exists():
        path = tmp_path / "waves.off"
        write_off(path, waves(40, 30))
    mesh = read_off(path)
    different = []
    for mode, (options, segment) in MODES.items():
        labels = tmp_path / "labels.seg"
        run = subprocess.run(
            [tool, path, "--quiet", "--labels", labels, *options], capture_output=True, text=True, check=False
        )
        if run.returncode == 3:  # an argument that does not suit the mesh, such as too many segments
            with pytest.raises(ValueError, match=r"\w+"):
                segment(mesh)
            continue
        assert run.returncode == 0, run.stderr
        expected = np.loadtxt(labels, dtype=np.int64, ndmin=1)
        if not np.array_equal(segment(mesh), expected):
            different.append(mode)
    assert not different


def test_errors_are_the_sentences_of_the_tool(elephant: Mesh, data: Path, tool: Path) -> None:
    run = subprocess.run(
        [tool, data / "elephant.off", "--segments", "100000"], capture_output=True, text=True, check=False
    )
    with pytest.raises(ValueError, match="the number of segments is 100000") as raised:
        rw.segment(*elephant, 100000)
    assert str(raised.value).replace("the number of segments", "--segments") in run.stderr
