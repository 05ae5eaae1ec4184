# SPDX-License-Identifier: MIT
"""The command line: the files it writes, and what it returns to the shell."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import trimesh

import rw_segmentation as rw
from meshes import Mesh, write_off
from rw_segmentation.__main__ import main


@pytest.fixture
def file(elephant: Mesh, tmp_path: Path) -> Path:
    path = tmp_path / "elephant.off"
    write_off(path, elephant)
    return path


def test_files_hold_the_segments(file: Path, elephant: Mesh, capsys: pytest.CaptureFixture[str]) -> None:
    labels, output, report = (file.with_name(name) for name in ("labels.seg", "segments.ply", "report.json"))
    arguments = [file, "--segments", "6", "--labels", labels, "--output", output, "--report", report]
    assert main([str(argument) for argument in arguments]) == 0
    expected = rw.segment(*elephant, 6)
    assert np.array_equal(np.loadtxt(labels, dtype=int), expected)
    colored = trimesh.load_mesh(output, process=False)
    assert np.array_equal(colored.visual.face_colors[:, :3], rw.face_colors(*elephant, expected))
    counts = [entry["faces"] for entry in json.loads(report.read_text())["segments"]]
    assert counts == np.bincount(expected).tolist()
    assert len(capsys.readouterr().out.splitlines()) == 7
    assert {path.name for path in file.parent.iterdir()} == {file.name, labels.name, output.name, report.name}


def test_modes_are_those_of_the_functions(file: Path, elephant: Mesh) -> None:
    labels = file.with_name("labels.seg")
    for options, expected in (
        (["--paper"], rw.segment(*elephant, policy="paper")),
        (["--coarse"], rw.segment(*elephant, policy="coarse")),
        (["--seed", "0", "--seed", "5=3", "--seed", "3"], rw.segment(*elephant, seeds=[(0, 0), (5, 3), (3, 1)])),
        (["--constraints-angle", "40"], rw.segment(*elephant, walls=rw.sharp_edges(*elephant, 40))),
    ):
        assert main([str(file), "--quiet", "--labels", str(labels), *options]) == 0
        assert np.array_equal(np.loadtxt(labels, dtype=int), expected)


def test_surfaces_are_reported(tmp_path: Path) -> None:
    part, report = tmp_path / "part.stl", tmp_path / "part.json"
    trimesh.creation.cylinder(radius=2, height=6, sections=64).export(part)
    assert main([str(part), "--quiet", "--engineering", "--report", str(report)]) == 0
    kinds = [entry["surface"]["type"] for entry in json.loads(report.read_text())["segments"]]
    assert sorted(kinds) == ["cylinder", "plane", "plane"]


def test_smooth_boundaries_are_cut_into_the_mesh_that_is_written(file: Path, elephant: Mesh) -> None:
    output = file.with_name("segments.ply")
    assert main([str(file), "--quiet", "--segments", "4", "--refine", "--output", str(output)]) == 0
    assert len(trimesh.load_mesh(output, process=False).faces) > elephant.number_of_faces


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        ([], 1, "required"),
        (["{mesh}", "--paper", "--coarse"], 1, "not allowed with"),
        (["{mesh}", "--engineering", "--seed", "3"], 1, "surfaces are found without it"),
        (["{mesh}", "--engineering", "--difference", "dihedral"], 1, "surfaces are found without it"),
        (["{mesh}", "--coarse", "--seed", "3"], 1, "--coarse places its seeds by itself"),
        (["{mesh}", "--segments", "3", "--seed", "3=7"], 1, "labels have no meaning"),
        (["{mesh}", "--refine"], 1, "nothing would show it"),
        (["{mesh}", "--output", "{folder}/../{folder.name}/elephant.off"], 1, "is the mesh or another output"),
        (["{mesh}", "--labels", "{folder}/a", "--report", "{folder}/a"], 1, "is the mesh or another output"),
        (["{mesh}", "--output", "{folder}/a.xyz"], 1, "a.xyz is none of .ply, .off, .obj"),
        (["{mesh}", "--output", "{folder}/a.obj", "--report", "{folder}/a.mtl"], 1, "is the mesh or another output"),
        (["{mesh}.none"], 2, "there is no such file"),
        (["{folder}/points.off"], 2, "the file has no faces"),
        (["{folder}/line.off"], 2, "no face has three different corners"),
        (["{folder}/broken.off"], 2, "broken.off"),
        (["{mesh}", "--segments", "100000"], 3, "the number of segments is 100000"),
        (["{mesh}", "--seed", "first"], 3, "first is no seed"),
        (["{mesh}", "--labels", "{folder}/none/labels.seg"], 5, "there is no such folder"),
    ],
)
def test_errors_have_codes_and_sentences(
    arguments: list[str], code: int, message: str, file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file.with_name("broken.off").write_text("OFF\n1 2")
    file.with_name("points.off").write_text("OFF\n1 0 0\n1 2 3\n")
    file.with_name("line.off").write_text("OFF\n2 1 0\n1 2 3\n1 2 4\n4 0 1 0 1\n")
    before = set(file.parent.iterdir())
    given = [argument.format(mesh=file, folder=file.parent) for argument in arguments]
    assert main(given) == code
    assert message in capsys.readouterr().err
    assert set(file.parent.iterdir()) == before


def test_the_module_runs(file: Path) -> None:
    run = subprocess.run([sys.executable, "-m", "rw_segmentation", file], capture_output=True, text=True, check=True)
    assert run.stdout.startswith("label     faces\n")
