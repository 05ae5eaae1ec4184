# SPDX-License-Identifier: MIT
"""Meshes of other packages: their arrays in, labels back into them."""

from __future__ import annotations

import sys
from pathlib import Path

import meshio
import numpy as np
import pytest
import pyvista
import trimesh

import rw_segmentation as rw
from meshes import Mesh

pyvista.OFF_SCREEN = True
PICTURE = Path(__file__).parent / "segments.png"


def test_trimesh_and_back(elephant: Mesh) -> None:
    mesh = trimesh.Trimesh(*elephant, process=False)
    vertices, faces = rw.from_trimesh(mesh)
    assert np.shares_memory(vertices, mesh.vertices)
    labels = rw.segment(vertices, faces)
    assert np.array_equal(labels, rw.segment(*elephant))
    back = rw.to_trimesh(vertices, faces, labels)
    assert np.array_equal(back.faces, mesh.faces)
    assert np.array_equal(back.face_attributes["segment"], labels)
    assert np.array_equal(back.visual.face_colors[:, :3], rw.face_colors(*elephant, labels))


def test_others_read_what_trimesh_writes(elephant: Mesh, tmp_path: Path) -> None:
    labels = rw.segment(*elephant)
    path = tmp_path / "elephant.ply"
    rw.to_trimesh(*elephant, labels).export(path)
    header = path.read_bytes().split(b"end_header")[0]
    assert b"property int segment" in header  # PLY has no int64, at which VTK ends the program
    assert pyvista.read(path).n_cells == elephant.number_of_faces
    large = rw.to_trimesh(*elephant, labels + 2**40)
    assert np.array_equal(large.face_attributes["segment"], labels + 2**40)


def test_only_triangles_go_to_trimesh(cube: Mesh) -> None:
    with pytest.raises(ValueError, match="trimesh takes triangles alone"):
        rw.to_trimesh(*cube)


def test_meshio_and_back(cube: Mesh) -> None:
    cells = [("line", [[0, 1]]), ("triangle", [[0, 1, 3], [0, 3, 2]]), ("quad", cube.faces[1:])]
    mesh = meshio.Mesh(cube.vertices, cells)
    vertices, faces = rw.from_meshio(mesh)
    labels = rw.segment(vertices, faces, 6, policy=rw.Policy(convex_weight=1, smoothing=0, number_of_seeds=7))
    assert labels.shape == (7,)
    filled = rw.to_meshio(mesh, labels)
    assert [column.tolist() for column in filled.cell_data["segment"]] == [
        [-1],
        labels[:2].tolist(),
        labels[2:].tolist(),
    ]
    mesh.field_data["part"] = np.array([1, 2])
    mesh.cell_sets["first"] = [np.array([0]), np.array([0]), np.array([], dtype=int)]
    again = rw.to_meshio(mesh, labels.astype(np.uint32))
    assert again.cell_data["segment"][0].tolist() == [-1]
    assert again.field_data.keys() == {"part"}
    assert again.cell_sets.keys() == {"first"}
    with pytest.raises(ValueError, match="no triangles, quads or polygons, but cells of the types: line"):
        rw.from_meshio(meshio.Mesh(cube.vertices, cells[:1]))
    with pytest.raises(ValueError, match="there are 6 labels, but the mesh has 7 faces"):
        rw.to_meshio(mesh, labels[1:])


def test_flat_points_of_meshio_lie_in_a_plane() -> None:
    vertices, faces = rw.from_meshio(meshio.Mesh([[0.0, 0], [1, 0], [0, 1]], [("triangle", [[0, 1, 2]])]))
    assert rw.segment(vertices, faces).tolist() == [0]


def test_open3d_and_back(elephant: Mesh) -> None:
    if sys.version_info >= (3, 13):
        pytest.skip("Open3D has no wheels for this Python")
    open3d = pytest.importorskip("open3d")
    mesh = rw.to_open3d(*elephant)
    vertices, faces = rw.from_open3d(mesh)
    assert np.array_equal(rw.segment(vertices, faces), rw.segment(*elephant))
    tensor = open3d.t.geometry.TriangleMesh.from_legacy(mesh)
    assert np.array_equal(rw.from_open3d(tensor)[1], elephant.faces)
    colored = rw.to_open3d(*elephant, rw.segment(*elephant))
    assert len(colored.vertex_colors) == 3 * elephant.number_of_faces


class StandInForOpen3D:
    """What an adapter asks of a mesh of Open3D's."""

    def __init__(self, mesh: Mesh) -> None:
        self.vertices, self.triangles = mesh.vertices, mesh.faces.astype(np.int32)


def test_arrays_are_taken_of_what_looks_like_a_mesh_of_open3d(elephant: Mesh) -> None:
    assert np.array_equal(rw.segment(*rw.from_open3d(StandInForOpen3D(elephant))), rw.segment(*elephant))


def test_pyvista_finds_the_accessor_by_its_entry_point(elephant: Mesh) -> None:
    mesh = rw.to_pyvista(*elephant)
    assert mesh.rw.segment(6) is mesh
    assert np.array_equal(mesh.cell_data["segment"], rw.segment(*elephant, 6))
    mesh.rw.segment(policy="paper", name="paper")
    assert np.array_equal(
        mesh.cell_data["paper"], rw.segment(elephant.vertices.astype(mesh.points.dtype), elephant.faces, policy="paper")
    )
    assert mesh.rw.boundaries().n_cells > 0


def test_points_and_lines_of_pyvista_are_passed_over(cube: Mesh) -> None:
    mesh = rw.to_pyvista(*cube)
    mesh.lines = [2, 0, 1]
    mesh.rw.segment(policy="paper")
    assert mesh.cell_data["segment"].tolist() == [-1, *rw.segment(*cube, policy="paper")]
    back = rw.from_pyvista(mesh)
    assert np.array_equal(back[1].corners, cube.faces.ravel())
    assert np.shares_memory(back[0], mesh.points)


def test_the_picture_of_segments_is_the_stored_one(elephant: Mesh, tmp_path: Path) -> None:
    mesh = rw.to_pyvista(*elephant)
    mesh.rw.segment(6)
    shown = tmp_path / "segments.png"
    mesh.rw.plot_segments(off_screen=True, window_size=(200, 200), cpos="xy", screenshot=shown)
    image, stored = pyvista.read(shown), pyvista.read(PICTURE)
    # Renderers differ in how they draw edges of shapes; a wrong colour, or boundaries left out, give far more than this.
    assert pyvista.compare_images(image, stored) < 60


def test_boundaries_may_be_smooth_or_left_out(elephant: Mesh) -> None:
    mesh = rw.to_pyvista(*elephant)
    labels = rw.segment(*elephant, 4)
    mesh.cell_data["mine"] = labels
    drawn = [
        np.asarray(
            mesh.rw.plot_segments(
                "mine", off_screen=True, window_size=(160, 160), screenshot=True, return_img=True, **options
            )
        )
        for options in ({}, {"boundary_width": 0}, {"curves": rw.smooth_boundaries(*elephant, labels)})
    ]
    dark = [int((image.max(axis=2) < 30).sum()) for image in drawn]
    assert dark[0] > 1.5 * dark[1] + 20
    assert not np.array_equal(drawn[0], drawn[2])
    plotter = pyvista.Plotter(off_screen=True)
    assert mesh.rw.plot_segments("mine", plotter=plotter) is plotter
