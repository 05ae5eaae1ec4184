# SPDX-License-Identifier: MIT
"""Files of meshes: faces keep their order and number, and have the colours of their segments to other readers."""

from __future__ import annotations

import gzip
import os
import stat
import subprocess
import sys
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
import pyvista
import trimesh
from numpy.typing import NDArray

import rw_segmentation as rw
from meshes import Mesh, waves, write_off
from rw_segmentation.__main__ import main

FORMATS = ["ply", "off", "obj", "stl", "glb", "3mf", "msh", "mesh", "vtp"]


def write_obj(path: Path, mesh: Mesh, *, alternates: bool = False) -> None:
    """Write an OBJ file in which, if that is wished, neighbouring faces have different materials and groups."""
    lines = ["v " + " ".join(map(repr, map(float, vertex))) for vertex in mesh.vertices]
    for number, face in enumerate(np.asarray(mesh.faces).tolist()):
        if alternates:
            lines += [f"g part{number % 3}", f"usemtl material{number % 2}"]
        lines.append("f " + " ".join(str(corner + 1) for corner in face))
    path.write_text("\n".join(lines) + "\n")


def segmented_by_command(path: Path, *options: str) -> NDArray[np.int64]:
    """Run the command line on a file, and read the labels."""
    labels = path.with_name("labels.seg")
    assert main([str(path), "--quiet", "--labels", str(labels), *options]) == 0
    return np.loadtxt(labels, dtype=np.int64)


def test_labels_belong_to_the_faces_of_an_obj_file_whose_materials_alternate(elephant: Mesh, tmp_path: Path) -> None:
    path = tmp_path / "elephant.obj"
    write_obj(path, elephant, alternates=True)
    np.testing.assert_array_equal(segmented_by_command(path, "--segments", "6"), rw.segment(*elephant, 6))
    vertices, faces = rw.read_mesh(path)
    np.testing.assert_array_equal(vertices, elephant.vertices)
    np.testing.assert_array_equal(faces, elephant.faces)


@pytest.mark.parametrize("kind", ["off", "obj", "ply"])
def test_polygons_stay_whole(kind: str, tmp_path: Path) -> None:
    sheet = waves(20, 12)
    path = tmp_path / f"sheet.{kind}"
    if kind == "off":
        write_off(path, sheet)
    elif kind == "obj":
        write_obj(path, sheet)
    else:
        meshio.write(path, meshio.Mesh(sheet.vertices, [("quad", sheet.faces)]))
    labels = segmented_by_command(path, "--segments", "4")
    np.testing.assert_array_equal(labels, rw.segment(*sheet, 4))
    faces = rw.read_mesh(path)[1]
    assert isinstance(faces, rw.Polygons)
    np.testing.assert_array_equal(np.reshape(faces.corners, (-1, 4)), sheet.faces)


def test_polygons_of_several_degrees_are_read_and_written(tmp_path: Path) -> None:
    path = tmp_path / "house.off"
    path.write_text("OFF\n6 3 0\n0 0 0\n1 0 0\n1 1 0\n.5 1.5 0\n0 1 0\n2 0 1\n5 0 1 2 3 4\n3 1 5 2\n4 5 1 0 4\n")
    vertices, faces = rw.read_mesh(path)
    assert isinstance(faces, rw.Polygons)
    np.testing.assert_array_equal(faces.offsets, [0, 5, 8, 12])
    np.testing.assert_array_equal(faces.corners, [0, 1, 2, 3, 4, 1, 5, 2, 5, 1, 0, 4])
    rw.write_segments(tmp_path / "house.vtp", vertices, faces, [0, 1, 0])
    written = pyvista.read(tmp_path / "house.vtp")
    np.testing.assert_array_equal(written.faces, [5, 0, 1, 2, 3, 4, 3, 1, 5, 2, 4, 5, 1, 0, 4])
    np.testing.assert_array_equal(written.cell_data["segment"], [0, 1, 0])


@pytest.mark.parametrize("kind", ["off", "ply", "stl", "msh", "mesh", "vtp", "off.gz"])
def test_files_that_are_cut_off_are_errors(
    kind: str, elephant: Mesh, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / f"whole.{kind}"
    if kind == "off.gz":
        write_off(tmp_path / "whole.off", elephant)
        path.write_bytes(gzip.compress((tmp_path / "whole.off").read_bytes()))
    else:
        rw.write_segments(path, *elephant, np.zeros(elephant.number_of_faces, dtype=int))
    assert len(segmented_by_command(path, "--segments", "1")) == elephant.number_of_faces
    content = path.read_bytes()
    path.write_bytes(content[: len(content) * 9 // 10])
    output = tmp_path / "output.ply"
    output.write_text("as before")
    before = set(tmp_path.iterdir())
    assert main([str(path), "--output", str(output)]) == 2
    assert f"{path}" in capsys.readouterr().err
    assert output.read_text() == "as before"
    assert set(tmp_path.iterdir()) == before
    with pytest.raises(ValueError, match="whole"):
        rw.read_mesh(path)


def test_packed_files_of_several_parts_are_read(elephant: Mesh, tmp_path: Path) -> None:
    write_off(tmp_path / "elephant.off", elephant)
    content = (tmp_path / "elephant.off").read_bytes()
    path = tmp_path / "elephant.off.gz"
    path.write_bytes(gzip.compress(content[:1000]) + gzip.compress(content[1000:]) + b"anything")
    np.testing.assert_array_equal(rw.read_mesh(path)[1], elephant.faces)
    path.write_bytes(b"\x1f\x8b" + content)
    with pytest.raises(ValueError, match="the gzip file is broken"):
        rw.read_mesh(path)


def test_what_a_file_holds_besides_a_surface_is_remarked_on(tmp_path: Path) -> None:
    points = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=float)
    cells = [("triangle", np.array([(0, 1, 2)])), ("tetra", np.array([(0, 1, 2, 3)]))]
    meshio.write(tmp_path / "solid.mesh", meshio.Mesh(points, cells))
    with pytest.warns(rw.MeshRepairWarning, match="passed over 1 element of volume"):
        assert len(rw.read_mesh(tmp_path / "solid.mesh")[1]) == 1


def test_other_packages_read_other_formats(elephant: Mesh, tmp_path: Path) -> None:
    for name in ("mesh.vtu", "mesh.vtk"):
        meshio.write(tmp_path / name, meshio.Mesh(elephant.vertices, [("triangle", elephant.faces)]))
        labels = segmented_by_command(tmp_path / name, "--segments", "6")
        np.testing.assert_array_equal(labels, rw.segment(*elephant, 6))
    with pytest.raises(ValueError, match=r"mesh\.vtk: this is no OFF"):
        rw.read_mesh(tmp_path / "mesh.vtk")


@pytest.fixture(scope="module")
def colored(elephant: Mesh, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, NDArray[np.int64]]:
    """Let the command line write all formats."""
    folder = tmp_path_factory.mktemp("colored")
    write_off(folder / "elephant.off", elephant)
    for kind in FORMATS:
        assert (
            main([str(folder / "elephant.off"), "--quiet", "--segments", "6", "-o", str(folder / f"out.{kind}")]) == 0
        )
    return folder, rw.segment(*elephant, 6)


def colors_by_centroid(elephant: Mesh, parts: list[tuple[NDArray[Any], Any]]) -> NDArray[np.int64]:
    """Give the colours of triangles that come part by part to the faces in the same places."""
    found = np.full((elephant.number_of_faces, 3), -1)
    expected = {tuple(row): f for f, row in enumerate(np.float32(elephant.vertices)[elephant.faces].reshape(-1, 9))}
    for triangles, color in parts:
        for row in np.float32(triangles).reshape(-1, 9):
            found[expected[tuple(row)]] = color
    return found


def test_colors_in_ply(colored: tuple[Path, NDArray[np.int64]], elephant: Mesh) -> None:
    folder, labels = colored
    mesh = trimesh.load_mesh(folder / "out.ply", process=False)
    np.testing.assert_array_equal(mesh.faces, elephant.faces)
    np.testing.assert_array_equal(mesh.visual.face_colors[:, :3], rw.face_colors(*elephant, labels))


def test_colors_in_off(colored: tuple[Path, NDArray[np.int64]], elephant: Mesh) -> None:
    folder, labels = colored
    rows = (folder / "out.off").read_text().splitlines()[2 + len(elephant.vertices) :]
    faces = np.array([row.split() for row in rows], dtype=int)
    np.testing.assert_array_equal(faces[:, :4], np.insert(elephant.faces, 0, 3, axis=1))
    np.testing.assert_array_equal(faces[:, 4:], rw.face_colors(*elephant, labels))


@pytest.mark.parametrize("kind", ["obj", "glb"])
def test_colors_in_materials(kind: str, colored: tuple[Path, NDArray[np.int64]], elephant: Mesh) -> None:
    folder, labels = colored
    options = {"split_object": True, "group_material": True} if kind == "obj" else {}
    scene = trimesh.load_scene(folder / f"out.{kind}", process=False, **options)
    parts = []
    for part in scene.geometry.values():
        material = part.visual.material
        color = np.asarray(material.diffuse if kind == "obj" else material.baseColorFactor)[:3]
        parts.append((part.triangles, color))
    found = colors_by_centroid(elephant, parts)
    expected = rw.face_colors(*elephant, labels)
    if kind == "glb":  # its colours are of light as it is
        share = expected / 255
        expected = np.rint(255 * np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4))
    np.testing.assert_allclose(found, expected, atol=1)


def test_labels_in_vtp_and_medit(colored: tuple[Path, NDArray[np.int64]], elephant: Mesh) -> None:
    folder, labels = colored
    cells = pyvista.read(folder / "out.vtp")
    np.testing.assert_array_equal(cells.cell_data["segment"], labels)
    np.testing.assert_array_equal(cells.cell_data["color"], rw.face_colors(*elephant, labels))
    medit = meshio.read(folder / "out.mesh")
    np.testing.assert_array_equal(medit.cell_data_dict["medit:ref"]["triangle"], labels)


@pytest.mark.parametrize("kind", ["ply", "off", "obj", "glb"])
def test_quads_are_colored(kind: str, tmp_path: Path) -> None:
    sheet = waves(20, 12)
    labels = rw.segment(*sheet, 4)
    path = tmp_path / f"sheet.{kind}"
    rw.write_segments(str(path), *sheet, labels)
    assert {each.suffix for each in tmp_path.iterdir()} == ({".obj", ".mtl"} if kind == "obj" else {f".{kind}"})
    if kind == "glb":
        areas = {name: part.area for name, part in trimesh.load_scene(path, process=False).geometry.items()}
        assert len(areas) == 4
        return
    faces = rw.read_mesh(path)[1]
    assert isinstance(faces, rw.Polygons)
    order = np.argsort(labels, kind="stable") if kind == "obj" else np.arange(len(labels))
    np.testing.assert_array_equal(np.reshape(faces.corners, (-1, 4)), np.asarray(sheet.faces)[order])


def test_quads_are_refined_as_triangles(tmp_path: Path) -> None:
    sheet = waves(20, 12)
    write_off(tmp_path / "sheet.off", sheet)
    labels = segmented_by_command(
        tmp_path / "sheet.off", "--segments", "4", "--refine", "-o", str(tmp_path / "out.ply")
    )
    assert len(labels) == sheet.number_of_faces
    refined = trimesh.load_mesh(tmp_path / "out.ply", process=False)
    assert len(refined.faces) > 2 * sheet.number_of_faces
    assert len(np.unique(refined.visual.face_colors, axis=0)) == 4


def test_all_files_are_written_or_none(elephant: Mesh, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    far = Mesh(elephant.vertices * 1e100, elephant.faces)
    path, labels, output = (tmp_path / name for name in ("far.off", "labels.seg", "out.stl"))
    write_off(path, far)
    labels.write_text("as before")
    assert main([str(path), "--quiet", "--labels", str(labels), "--output", str(output)]) == 5
    assert "too large for this format" in capsys.readouterr().err
    assert labels.read_text() == "as before"
    assert {each.name for each in tmp_path.iterdir()} == {"far.off", "labels.seg"}


def test_a_link_stays_a_link(cube: Mesh, tmp_path: Path) -> None:
    (tmp_path / "link.ply").symlink_to("target.ply")
    rw.write_segments(tmp_path / "link.ply", *cube, np.arange(6))
    assert (tmp_path / "link.ply").is_symlink()
    assert (tmp_path / "target.ply").read_bytes().startswith(b"ply")


@pytest.mark.skipif(os.name != "posix", reason="permissions of POSIX")
def test_a_file_has_the_permissions_of_the_one_that_it_replaces(cube: Mesh, tmp_path: Path) -> None:
    path = tmp_path / "cube.obj"
    for mode in (0o600, 0o640, 0o444):
        for name in (path, path.with_suffix(".mtl")):
            name.touch()
            name.chmod(mode)
        rw.write_segments(path, *cube, range(6))
        for name in (path, path.with_suffix(".mtl")):
            assert stat.S_IMODE(name.stat().st_mode) == mode
            assert name.stat().st_size > 0


def test_labels_go_to_standard_output_as_it_is(elephant: Mesh, tmp_path: Path) -> None:
    write_off(tmp_path / "elephant.off", elephant)
    command = [sys.executable, "-m", "rw_segmentation", "elephant.off", "--segments", "6", "--labels", "/dev/stdout"]
    with (tmp_path / "out.txt").open("wb") as file:
        file.write(b"7\n")
        file.flush()
        subprocess.run(command, check=True, cwd=tmp_path, stdout=file)
        file.write(b"8\n")
    found = np.loadtxt(tmp_path / "out.txt", dtype=int)
    np.testing.assert_array_equal(found, [7, *rw.segment(*elephant, 6), 8])


def test_what_cannot_be_written_is_refused(cube: Mesh, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"cube\.xyz is none of \.ply, \.off, \.obj"):
        rw.write_segments(tmp_path / "cube.xyz", *cube, np.arange(6))
    with pytest.raises(ValueError, match="labels must be of shape"):
        rw.write_segments(tmp_path / "cube.ply", *cube, np.arange(5))
    for label in (-1, 2**32):
        with pytest.raises(ValueError, match="labels in files are from 0"):
            rw.write_segments(tmp_path / "cube.ply", *cube, np.full(6, label))
    with pytest.raises(ValueError, match="face 1 has a corner at vertex 7"):
        rw.write_segments(tmp_path / "cube.ply", cube.vertices[:-1], cube.faces, np.arange(6))
    (tmp_path / "folder.ply").mkdir()
    with pytest.raises(IsADirectoryError):
        rw.write_segments(tmp_path / "folder.ply", *cube, np.arange(6))
    (tmp_path / "folder.ply").rmdir()
    with pytest.raises(FileNotFoundError, match="none"):
        rw.write_segments(tmp_path / "none/cube.ply", *cube, np.arange(6))
    assert list(tmp_path.iterdir()) == []


def test_names_that_are_no_text_are_taken(cube: Mesh, tmp_path: Path) -> None:
    path = Path(f"{tmp_path}/caf\udce9.obj")
    rw.write_segments(path, *cube, np.arange(6))
    assert len(rw.read_mesh(path)[0]) == 8
    assert b"mtllib caf\xe9.mtl\n" in path.read_bytes()
    path.write_text("v 0 0 0\nf 1 2 3\n")
    with pytest.raises(ValueError, match=r"caf\?\.obj:2"):
        rw.read_mesh(path)
