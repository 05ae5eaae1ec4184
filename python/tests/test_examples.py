# SPDX-License-Identifier: MIT
"""The examples run and say what they are expected to."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import pyvista

import rw_segmentation as rw
from meshes import Mesh, write_off

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"


def run(example: str, *arguments: object, folder: Path) -> str:
    """Run an example in a folder."""
    environment = {**os.environ, "PYVISTA_OFF_SCREEN": "true"}
    done = subprocess.run(
        [sys.executable, "-W", "error::FutureWarning", EXAMPLES / example, *map(str, arguments)],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def assert_picture(path: Path) -> None:
    """Look whether a picture shows something in several colours."""
    picture = np.asarray(pyvista.read(path).active_scalars)
    assert len(np.unique(picture.reshape(-1, picture.shape[-1]), axis=0)) > 20


@pytest.mark.parametrize(
    ("example", "said"),
    [
        ("dendrogram.py", r"76 fragments, 6 segments suggested"),
        ("seeds_and_probabilities.py", r"6 seeds, 6 segments\n5 segments without the thumb's seed"),
        ("machine_part.py", r"(?s)cylinder.*plane.*cone.*torus"),
    ],
)
def test_an_example_makes_its_picture(example: str, said: str, tmp_path: Path) -> None:
    picture = tmp_path / "picture.png"
    assert re.search(said, run(example, picture, folder=tmp_path))
    assert_picture(picture)


def test_the_features_of_a_network_are_mended(tmp_path: Path) -> None:
    picture = tmp_path / "picture.png"
    said = run("features_of_a_network.py", picture, folder=tmp_path)
    errors = {name: float(error) for name, error in re.findall(r"(.*): Rand index error (\S+)", said)}
    assert errors["votes"] > 0.2
    assert errors["votes, refined"] < 0.02
    assert errors["features"] < 0.1
    assert_picture(picture)


def test_dask_segments_a_folder_on_two_processes(elephant: Mesh, anchor: Mesh, tmp_path: Path) -> None:
    meshes, output = tmp_path / "meshes", tmp_path / "labels"
    meshes.mkdir()
    write_off(meshes / "elephant.off", elephant)
    write_off(meshes / "anchor.off", anchor)
    (meshes / "broken.off").write_text("OFF\n1 1 0\n0 0")
    said = run("folder_with_dask.py", meshes, output, folder=tmp_path)
    assert len(said.splitlines()) == 3
    assert re.search(r"broken\.off: (?!\d+ segments)", said)
    assert np.array_equal(np.load(output / "elephant.npy"), rw.segment(*elephant))
    assert np.array_equal(np.load(output / "anchor.npy"), rw.segment(*anchor))
    assert {path.name for path in output.iterdir()} == {"elephant.npy", "anchor.npy"}


@pytest.mark.skipif(shutil.which("blender") is None, reason="there is no Blender, which scripts/test does not install")
def test_segments_become_materials_and_vertex_groups_in_blender(elephant: Mesh, tmp_path: Path) -> None:
    scene = tmp_path / "scene.py"
    write_off(tmp_path / "elephant.off", elephant)
    scene.write_text(f"""
import bpy, runpy, sys
sys.path[:0] = {[str(Path(rw.__file__).parents[1]), str(Path(np.__file__).parents[1])]!r}
rows = [line.split() for line in open({str(tmp_path / "elephant.off")!r})][1:]
points = [tuple(map(float, row)) for row in rows[1 : int(rows[0][0]) + 1]]
faces = [tuple(map(int, row[1:])) for row in rows[int(rows[0][0]) + 1 :]]
mesh = bpy.data.meshes.new("elephant")
mesh.from_pydata(points, [], faces)
thing = bpy.data.objects.new("elephant", mesh)
bpy.context.collection.objects.link(thing)
bpy.context.view_layer.objects.active = thing
sys.argv = ["blender", "--", "6"]
runpy.run_path({str(EXAMPLES / "blender_segments.py")!r}, run_name="__main__")
print("materials", [sum(p.material_index == i for p in mesh.polygons) for i in range(len(mesh.materials))])
print("groups", len(thing.vertex_groups))
""")
    done = subprocess.run(
        ["blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python", scene],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    expected = np.bincount(rw.segment(elephant.vertices.astype(np.float32), elephant.faces, 6)).tolist()
    assert f"6 segments\nmaterials {expected}\ngroups 6" in done.stdout
