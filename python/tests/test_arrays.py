# SPDX-License-Identifier: MIT
"""Arrays of every kind that users hold, and what is wrong with those that cannot be taken."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from numpy.typing import NDArray

import rw_segmentation as rw
from meshes import Mesh, grid, same_partition, sphere, together

TETRAHEDRON = Mesh(
    np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=float),
    np.array([(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]),
)


@pytest.mark.parametrize("dtype", [np.int8, np.uint8, np.int16, np.uint16, np.int32, np.uint32, np.int64, np.uint64])
def test_faces_are_taken_of_every_integer_type(dtype: type) -> None:
    mesh = grid(6, 5)
    expected = rw.segment(*mesh, 2)
    assert np.array_equal(rw.segment(mesh.vertices, mesh.faces.astype(dtype), 2), expected)


@pytest.mark.parametrize("dtype", [np.float16, np.float32, np.float64, np.longdouble, np.int64, ">f8", ">f4"])
def test_vertices_are_taken_of_every_real_type(dtype: type) -> None:
    mesh = grid(6, 5)  # its coordinates are the same numbers in all of these
    assert np.array_equal(rw.segment(mesh.vertices.astype(dtype), mesh.faces, 2), rw.segment(*mesh, 2))


def test_arrays_are_taken_however_they_lie_in_memory(elephant: Mesh) -> None:
    expected = rw.segment(*elephant, 4)
    vertices, faces = elephant.vertices, elephant.faces
    wide = np.zeros((len(vertices), 6))
    wide[:, ::2] = vertices
    read_only = vertices.copy(), faces.copy()
    for array in read_only:
        array.flags.writeable = False
    backwards = vertices[::-1].copy()[::-1], faces[::-1].copy()[::-1]
    for given_vertices, given_faces in [
        (np.asfortranarray(vertices), np.asfortranarray(faces)),
        (wide[:, ::2], faces),
        read_only,
        backwards,
        (vertices.tolist(), faces.tolist()),
    ]:
        assert np.array_equal(rw.segment(given_vertices, given_faces, 4), expected)


def test_no_array_is_changed(elephant: Mesh) -> None:
    vertices, faces = elephant.vertices.copy(), elephant.faces.copy()
    rw.segment(vertices, faces)
    rw.split_along_boundaries(vertices, faces, rw.segment(vertices, faces, 3))
    assert np.array_equal(vertices, elephant.vertices)
    assert np.array_equal(faces, elephant.faces)


def test_polygons_are_the_same_as_an_array_or_lists_or_offsets(cube: Mesh) -> None:
    expected = rw.segment(*cube, 4, policy="paper")
    offsets = np.arange(0, 25, 4)
    for faces in (
        rw.Polygons(cube.faces.reshape(-1), offsets),
        rw.Polygons(cube.faces.reshape(-1).astype(np.uint32), offsets.astype(np.int32)),
        rw.Polygons.from_lists(cube.faces.tolist()),
    ):
        assert np.array_equal(rw.segment(cube.vertices, faces, 4, policy="paper"), expected)


def test_corners_in_lists_are_integers_as_in_arrays(cube: Mesh) -> None:
    triangles = cube.faces[0][[0, 1, 2]].tolist(), cube.faces[0][[0, 2, 3]].tolist()
    for wrong in ([corner + 0.5 for corner in triangles[1]], [corner > 0 for corner in triangles[1]]):
        lists = [*cube.faces[1:].tolist(), triangles[0], wrong]
        for take in (rw.Polygons.from_lists, lambda rows: rw.segment(cube.vertices, rows)):
            with pytest.raises(ValueError, match="the vertices of a face must be integers"):
                take(lists)


def test_masked_entries_are_refused_and_others_of_masked_arrays_taken() -> None:
    mesh = grid(6, 5)
    expected = rw.segment(*mesh, 2)
    assert np.array_equal(rw.segment(np.ma.array(mesh.vertices), np.ma.array(mesh.faces), 2), expected)
    vertices, faces = np.ma.array(mesh.vertices), np.ma.array(mesh.faces)
    labels, features = np.ma.array(expected), np.ma.array(np.ones((len(expected), 2)))
    for array in (vertices, faces, labels, features):
        array[3] = np.ma.masked
    for call in (
        lambda: rw.segment(vertices, mesh.faces),
        lambda: rw.segment(mesh.vertices, faces),
        lambda: rw.segment_colors(*mesh, labels),
        lambda: rw.segment(*mesh, face_features=features),
        lambda: rw.refine(*mesh, features),
    ):
        with pytest.raises(ValueError, match="must not be masked"):
            call()


def test_labels_of_64_bits_are_taken_with_a_sign_and_never_wrapped() -> None:
    mesh = grid(6, 5)
    labels = rw.segment(*mesh, 2)
    for first in (-(2**63), -1, 2**63 - 1):
        assert set(rw.segment_colors(*mesh, np.where(labels == 0, first, 7))) == {first, 7}
    with pytest.raises(ValueError, match=r"labels must be less than 2\*\*63, but one is 9223372036854775808"):
        rw.segment_colors(*mesh, np.where(labels == 0, 2**63, 7).astype(np.uint64))


def test_mixed_polygons_may_be_lists(cube: Mesh) -> None:
    lists = [*cube.faces[1:].tolist(), cube.faces[0][[0, 1, 2]].tolist(), cube.faces[0][[0, 2, 3]].tolist()]
    labels = rw.segment(cube.vertices, lists)
    assert labels.shape == (7,)
    assert np.array_equal(labels, rw.segment(cube.vertices, rw.Polygons.from_lists(lists)))


@pytest.mark.parametrize(
    ("vertices", "faces", "message"),
    [
        (np.zeros((4, 2)), TETRAHEDRON.faces, r"vertices must be of shape \(n, 3\), but are of shape \(4, 2\)"),
        (np.zeros(12), TETRAHEDRON.faces, r"but are of shape \(12,\)"),
        (np.zeros((4, 3), dtype=complex), TETRAHEDRON.faces, "vertices must be real numbers"),
        (np.full((4, 3), "a"), TETRAHEDRON.faces, "vertices must be real numbers"),
        (TETRAHEDRON.vertices, TETRAHEDRON.faces.astype(float), "faces must be integers, but are of type float64"),
        (TETRAHEDRON.vertices, TETRAHEDRON.faces.astype(bool), "faces must be integers"),
        (TETRAHEDRON.vertices, TETRAHEDRON.faces[:, :2], r"faces must be of shape \(m, 3\)"),
        (TETRAHEDRON.vertices, TETRAHEDRON.faces.reshape(-1), r"or Polygons\(corners, offsets\)"),
        (TETRAHEDRON.vertices, TETRAHEDRON.faces + 1, "face 1 has a corner at vertex 4, but there are 4 vertices"),
        (TETRAHEDRON.vertices, TETRAHEDRON.faces - 1, "face 0 has a corner at vertex -1"),
        (TETRAHEDRON.vertices, TETRAHEDRON.faces + 2**40, "has a corner at vertex 1099511627776"),
        (np.zeros((0, 3)), TETRAHEDRON.faces, "there are 0 vertices"),
        (
            TETRAHEDRON.vertices,
            rw.Polygons([0, 1, 2], [0, 2]),
            "the last offset is 2, but must be the number of corners, 3",
        ),
        (TETRAHEDRON.vertices, rw.Polygons([0, 1, 2], [1, 3]), "offset 0 is 1"),
        (TETRAHEDRON.vertices, rw.Polygons([0, 1, 2], [0, 4, 3]), "offset 1 is 4"),
        (TETRAHEDRON.vertices, rw.Polygons([0, 1, 2], [0, -1, 3]), "offset 1 is -1"),
        (TETRAHEDRON.vertices, rw.Polygons([0, 1, 2], []), "offsets must begin with 0"),
        (TETRAHEDRON.vertices, rw.Polygons([[0, 1, 2]], [0, 3]), "in one row"),
    ],
)
def test_wrong_arrays_are_refused_with_the_reason(
    vertices: NDArray[np.float64], faces: rw.Polygons, message: str
) -> None:
    for call in (rw.segment, rw.hierarchy, rw.RandomWalk, rw.segment_surfaces, rw.curvatures, rw.interior_edges):
        with pytest.raises(ValueError, match=message):
            call(vertices, faces)


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_coordinates_that_are_not_finite_are_named(wrong: float, dtype: type) -> None:
    vertices = TETRAHEDRON.vertices.astype(dtype)
    vertices[2, 1] = wrong
    with pytest.raises(ValueError, match="vertex 2 has a coordinate that is not finite"):
        rw.segment(vertices, TETRAHEDRON.faces)
    unused = np.vstack([TETRAHEDRON.vertices, [[wrong] * 3]])
    assert np.array_equal(rw.segment(unused, TETRAHEDRON.faces), rw.segment(*TETRAHEDRON))


@pytest.mark.parametrize("faces", [[], np.zeros((0, 3), dtype=int), np.zeros((0, 4), dtype=int), rw.Polygons([], [0])])
def test_a_mesh_without_faces_has_no_labels(faces: rw.Polygons) -> None:
    for vertices in ([], np.zeros((0, 3)), TETRAHEDRON.vertices):
        for policy in ("automatic", "paper", "coarse", "surfaces"):
            labels = rw.segment(vertices, faces, policy=policy)
            assert labels.shape == (0,)
            assert labels.dtype == np.int64
        assert rw.segment_surfaces(vertices, faces)[1] == []
        assert rw.thickness(vertices, faces).shape == (0,)
        assert rw.curvatures(vertices, faces).max_direction.shape == (0, 3)
        assert rw.refine(vertices, faces, np.zeros((0, 2))).labels.shape == (0,)
        assert rw.hierarchy(vertices, faces).to_linkage().shape == (0, 4)
    assert rw.RandomWalk([], faces).labels().shape == (0,)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"segments": 0}, "the number of segments is 0"),
        ({"segments": -1}, "must not be negative"),
        ({"policy": "quick"}, "policy 'quick' is none of automatic"),
        ({"difference": "colour"}, "difference: colour is none of dihedral, concavity, curvature"),
        ({"policy": rw.Policy(radius=2)}, "radius is that of curvatures"),
        ({"policy": rw.Policy(sigma=-1)}, "sigma is -1, but must be positive"),
        ({"policy": rw.Policy(sigma=float("nan"))}, "sigma is nan"),
        ({"policy": rw.Policy(convex_weight=2)}, "convex_weight"),
        ({"policy": rw.Policy(seeding="near")}, "seeding: near is none of farthest"),  # type: ignore[arg-type]
        ({"policy": "coarse", "seeds": [1]}, "the coarse policies place their own"),
        ({"policy": "surfaces", "difference": "dihedral"}, "difference: surfaces are found without it"),
        ({"difference": [1.0]}, "the difference has 1 values, but the mesh"),
        ({"difference": np.full(1, "a")}, "none of dihedral|real numbers"),
        ({"face_features": np.zeros((3, 2))}, "face_features have 3 rows"),
        ({"seeds": [-1]}, "seed -1 is not a face of the mesh"),
        ({"segments": 2.5}, "the number of segments is 2.5, but must be an integer"),
        ({"segments": 2**70}, r"the number of segments is .*, which is out of range"),
        ({"seeds": np.array([2**64 - 1], dtype=np.uint64)}, "seed is 18446744073709551615, which is out of range"),
        ({"seeds": {0: 2**64}}, "the label is 18446744073709551616"),
        ({"seeds": [10**9]}, "seed 1000000000 is not a face of the mesh"),
        ({"seeds": [0.5]}, "seeds must be integers"),
        ({"seeds": {0: -1}}, "the label is -1"),
        ({"seeds": [(0, 0), (0, 1)]}, "another seed gives the same face the label 0"),
        ({"seeds": [(0, 0)], "segments": 3}, "labels have no meaning"),
        ({"walls": [(0, 10**9)]}, "wall 0: there is no vertex 1000000000"),
        ({"walls": [(0, 0)]}, "wall 0: no edge of the mesh joins vertex 0 and vertex 0"),
        ({"walls": [0, 1, 2]}, r"walls must be of shape \(w, 2\)"),
    ],
)
def test_wrong_choices_are_refused_with_the_reason(options: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        rw.segment(*grid(6, 6), **options)  # type: ignore[arg-type]


def test_differences_that_are_no_numbers_are_refused_with_the_faces() -> None:
    mesh = grid(4, 4)
    values = np.ones(len(rw.interior_edges(*mesh).faces))
    for wrong in (-1.0, np.nan):
        values[3] = wrong
        first, second = rw.interior_edges(*mesh).faces[3]
        with pytest.raises(ValueError, match=f"on the edge between faces ({first} and {second}|{second} and {first})"):
            rw.segment(*mesh, difference=values)


def test_a_soup_gets_the_labels_of_the_surface_it_stands_for() -> None:
    mesh = together(sphere(2), sphere(2, 0.5, (1.2, 0, 0)))
    soup = Mesh(mesh.vertices[mesh.faces].reshape(-1, 3), np.arange(mesh.faces.size).reshape(-1, 3))
    soup.faces[::3] = soup.faces[::3, ::-1]  # some look inward
    with pytest.warns(rw.MeshRepairWarning, match="merged .* turned"):
        labels = rw.segment(*soup, 2)
    assert same_partition(labels, rw.segment(*mesh, 2))
    with pytest.raises(ValueError, match="the faces do not form an oriented surface"):
        rw.segment(mesh.vertices, np.vstack([mesh.faces, mesh.faces[:1]]), repair=False)


def test_each_face_gets_a_label_though_it_is_left_out_of_the_mesh() -> None:
    mesh = together(sphere(2), sphere(2, 1.0, (5, 0, 0)))
    half = len(mesh.faces) // 2
    degenerate = [(0, 0, 1), (len(mesh.vertices) - 1,) * 3]
    faces = np.vstack([mesh.faces, mesh.faces[:1], degenerate])
    with pytest.warns(rw.MeshRepairWarning, match="left 3 faces out"):
        labels = rw.segment(mesh.vertices, faces, 2)
    assert len(labels) == len(faces)
    assert labels[2 * half] == labels[0]
    assert labels[2 * half + 1] == labels[0]
    assert labels[2 * half + 2] == labels[half]
    with (
        pytest.warns(rw.MeshRepairWarning, match="left out|left 3"),
        pytest.raises(ValueError, match=r"seed .* was left out of the mesh"),
    ):
        rw.segment(mesh.vertices, faces, seeds=[2 * half + 1])
    with pytest.raises(ValueError, match="no face has three different corners"):
        rw.segment(mesh.vertices, [(0, 0, 0)])


def test_a_mesh_inside_out_is_turned() -> None:
    mesh = sphere(2)
    with pytest.warns(rw.MeshRepairWarning, match="turned 1 closed part"):
        inside_out = rw.thickness(mesh.vertices, mesh.faces[:, ::-1])
    assert np.median(inside_out) == pytest.approx(np.median(rw.thickness(*mesh)), rel=0.01)


def test_surfaces_are_cut_where_more_than_two_faces_meet() -> None:
    fins = [(0, 1, 2), (0, 1, 3), (0, 1, 4)]
    vertices = [(0, 0, 0), (0, 0, 1), (1, 0, 0), (-1, 1, 0), (-1, -1, 0)]
    with pytest.warns(rw.MeshRepairWarning, match="cut the surface along 1 edge where more than two faces meet"):
        labels = rw.segment(vertices, fins)
    assert len(np.unique(labels)) == 3


def test_parts_that_touch_in_a_vertex_are_parts() -> None:
    mesh = together(sphere(1), sphere(1, 1.0, (2, 0, 0)))
    rightmost = int(np.argmax(mesh.vertices[: len(mesh.vertices) // 2, 0]))
    leftmost = len(mesh.vertices) // 2 + int(np.argmin(mesh.vertices[len(mesh.vertices) // 2 :, 0]))
    faces = np.where(mesh.faces == leftmost, rightmost, mesh.faces)
    labels = rw.segment(mesh.vertices, faces, 2, repair=False)
    half = len(faces) // 2
    assert len(set(labels[:half])) == len(set(labels[half:])) == 1
    assert labels[0] != labels[-1]


@settings(max_examples=150, deadline=None)
@given(
    st.integers(0, 12).flatmap(
        lambda n: st.tuples(
            hnp.arrays(np.float64, (n, 3), elements=st.floats(-3, 3, width=16)),
            hnp.arrays(np.int64, st.tuples(st.integers(0, 20), st.integers(3, 5)), elements=st.integers(-1, n)),
        )
    ),
    st.sampled_from(["automatic", "paper", "coarse", "surfaces"]),
)
def test_any_arrays_give_a_label_for_each_face_or_an_error(
    mesh: tuple[NDArray[np.float64], NDArray[np.int64]], policy: str
) -> None:
    vertices, faces = mesh
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", rw.MeshRepairWarning)
        try:
            labels = rw.segment(vertices, faces, policy=policy)  # type: ignore[arg-type]
        except ValueError:
            assert faces.size
            return
    assert labels.shape == (len(faces),)
    if len(labels):
        assert np.array_equal(np.unique(labels), np.arange(labels.max() + 1))


@settings(max_examples=30, deadline=None)
@given(st.permutations(range(4)), st.floats(1e-6, 1e6), st.integers(0, 2**31 - 1))
def test_labels_do_not_depend_on_position_size_and_the_numbers_of_vertices(
    axes: list[int], scale: float, seed: int
) -> None:
    mesh = grid(8, 6)
    expected = rw.segment(*mesh, 2)
    order = np.random.default_rng(seed).permutation(len(mesh.vertices))
    vertices = np.empty_like(mesh.vertices)
    vertices[order] = mesh.vertices * scale + np.array(axes[:3]) * scale
    assert same_partition(rw.segment(vertices, order[mesh.faces], 2), expected)
