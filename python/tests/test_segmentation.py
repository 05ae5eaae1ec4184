# SPDX-License-Identifier: MIT
"""Segments, hierarchies, walks and what is measured, held against other packages and against the equations."""

from __future__ import annotations

import dataclasses
import json

import numpy as np
import pandas as pd
import pytest
import scipy.cluster.hierarchy
import scipy.sparse as sp
import scipy.sparse.linalg
import sklearn.metrics
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from numpy.typing import NDArray

import rw_segmentation as rw
from meshes import Mesh, grid, same_partition, sphere, together


def laplacian(mesh: Mesh, conductance: NDArray[np.float64]) -> sp.csr_matrix:
    """Build the walk's Laplacian independently of the library."""
    a, b = rw.interior_edges(*mesh).faces.T
    off_diagonal = sp.coo_matrix((conductance, (a, b)), shape=(mesh.number_of_faces,) * 2)
    weights = (off_diagonal + off_diagonal.T).tocsr()
    return sp.csr_matrix(sp.diags(np.asarray(weights.sum(axis=1)).ravel()) - weights)


def face_normals(mesh: Mesh) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Compute unit normals and areas of triangles."""
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    twice = np.cross(b - a, c - a)
    length = np.linalg.norm(twice, axis=1)
    return twice / length[:, None], length / 2


def test_interior_edges_are_those_of_trimesh(elephant: Mesh) -> None:
    import trimesh

    edges = rw.interior_edges(*elephant)
    known = trimesh.Trimesh(*elephant, process=False)
    ours = np.column_stack([np.sort(edges.faces, axis=1), np.sort(edges.vertices, axis=1)])
    theirs = np.column_stack([np.sort(known.face_adjacency, axis=1), np.sort(known.face_adjacency_edges, axis=1)])
    assert np.array_equal(np.unique(ours, axis=0), np.unique(theirs, axis=0))


def test_levels_are_nested_and_have_as_many_segments_as_asked_for(elephant: Mesh) -> None:
    levels = rw.hierarchy(*elephant)
    finer = levels.labels(levels.number_of_fragments)
    assert np.array_equal(finer, levels.fragment_of_face)
    for count in range(levels.number_of_fragments, levels.number_of_components - 1, -1):
        labels = levels.labels(count)
        assert np.array_equal(np.unique(labels), np.arange(count))
        assert len(np.unique(np.column_stack([finer, labels]), axis=0)) == len(np.unique(finer))
        finer = labels
    assert np.array_equal(levels.labels(), rw.segment(*elephant))
    assert levels.merges.shape == (len(levels.costs), 2)
    for wrong in (0, levels.number_of_fragments + 1):
        with pytest.raises(ValueError, match="the number of segments"):
            levels.labels(wrong)
        with pytest.raises(ValueError, match="the number of segments"):
            levels.levels(wrong)
    assert levels.suggested in levels.levels()
    coarser, chosen, finer = levels.levels(10)
    assert 5 <= coarser <= 7
    assert chosen == 10
    assert 14 <= finer <= 20
    with pytest.raises(ValueError, match="must not be negative"):
        levels.labels(-1)


@pytest.mark.parametrize("parts", [1, 3])
def test_scipy_cuts_the_linkage_into_the_same_segments(elephant: Mesh, parts: int) -> None:
    mesh = together(*(Mesh(elephant.vertices + np.array([3.0 * i, 0, 0]), elephant.faces) for i in range(parts)))
    levels = rw.hierarchy(*mesh)
    linkage = levels.to_linkage()
    assert scipy.cluster.hierarchy.is_valid_linkage(linkage)
    assert scipy.cluster.hierarchy.is_monotonic(linkage)
    assert linkage[-1, 3] == levels.number_of_fragments
    assert linkage[-1, 2] >= linkage[:, 2].max()
    assert levels.to_linkage(joined_at=1e3)[-1, 2] == (1e3 if parts > 1 else linkage[-1, 2])
    for wrong in (float("nan"), 0.99 * levels.costs.max()):
        with pytest.raises(ValueError, match=r"joined_at is .*, but must be at least the height"):
            levels.to_linkage(joined_at=wrong)
    # Merges are numbered as scipy numbers them, so that its clusters at a height are ours at that number of merges.
    heights = linkage[:, 2]
    for height in np.unique(heights)[:-1]:
        clusters = scipy.cluster.hierarchy.fcluster(linkage, height, criterion="distance")
        count = levels.number_of_fragments - int((heights <= height).sum())
        assert same_partition(clusters[levels.fragment_of_face].astype(np.int64), levels.labels(count))
    assert len(scipy.cluster.hierarchy.dendrogram(linkage, no_plot=True)["leaves"]) == levels.number_of_fragments


def test_probabilities_solve_the_equations_of_the_walk(elephant: Mesh) -> None:
    seeds = {10: 4, 2000: 1, 4000: 7, 4010: 7}
    difference = rw.dihedral_difference(*elephant, smoothing=0.01)
    conductance = rw.conductance(*elephant, difference)
    walk = rw.RandomWalk(*elephant, conductance=conductance)
    for face, label in seeds.items():
        walk.add_seed(face, label)
    matrix = laplacian(elephant, conductance)
    known = np.array(list(seeds))
    free = np.setdiff1d(np.arange(elephant.number_of_faces), known)
    values = np.array([[float(seeds[face] == label) for label in (1, 4, 7)] for face in known])
    solved = sp.linalg.spsolve(matrix[free][:, free].tocsc(), -(matrix[free][:, known] @ values))
    expected = np.empty((elephant.number_of_faces, 3))
    expected[free], expected[known] = solved, values
    assert walk.seed_labels == [1, 4, 7]
    assert np.allclose(walk.probabilities(), expected, atol=1e-8)
    assert np.allclose(walk.probabilities().sum(axis=1), 1)
    agree = walk.labels() == np.array([1, 4, 7])[expected.argmax(axis=1)]
    assert agree.mean() > 0.99  # all but faces that are cut off from their seed


@pytest.mark.parametrize(
    ("choice", "policy"),
    [("sigma", rw.Policy(sigma=sigma)) for sigma in (float("nan"), float("inf"), -1.0, 0.5)]
    + [
        ("cap", rw.Policy(cap=10.0)),
        ("smoothing", rw.Policy(smoothing=0.0)),
        ("convex_weight", rw.Policy("paper", convex_weight=0.5)),
        ("measure", rw.Policy(measure="cosine")),
        ("radius", rw.Policy(radius=2.0)),
    ],
)
def test_conductances_leave_no_choice_of_the_policy_unused(elephant: Mesh, choice: str, policy: rw.Policy) -> None:
    conductance = np.ones(len(rw.interior_edges(*elephant).faces))
    with pytest.raises(ValueError, match=f"conductance: the policy's {choice} has no part in it"):
        rw.RandomWalk(*elephant, conductance=conductance, policy=policy)


def test_edited_seeds_give_what_a_new_walk_gives(elephant: Mesh) -> None:
    random = np.random.default_rng(5)
    walk = rw.RandomWalk(*elephant)
    seeds: dict[int, int] = {}
    for step in range(12):
        if step % 4 == 3:
            gone = int(random.choice(list(seeds)))
            assert walk.remove_seed(gone)
            assert not walk.remove_seed(gone)
            del seeds[gone]
        else:
            face, label = int(random.integers(elephant.number_of_faces)), int(random.integers(4))
            walk.add_seed(face, label)
            seeds[face] = label
        fresh = rw.RandomWalk(*elephant)
        for face, label in seeds.items():
            fresh.add_seed(face, label)
        assert walk.seeds == seeds
        assert np.allclose(walk.probabilities(), fresh.probabilities(), atol=1e-8)
        assert np.array_equal(walk.labels(), fresh.labels())
    assert np.array_equal(walk.labels(), rw.segment(*elephant, seeds=seeds))
    walk.clear_seeds()
    assert walk.seeds == {}
    assert walk.probabilities().shape == (elephant.number_of_faces, 0)
    with pytest.raises(ValueError, match="seed"):
        walk.labels()


def test_seeds_of_which_one_is_wrong_change_nothing() -> None:
    walk = rw.RandomWalk(*sphere(1))
    walk.add_seeds([0, 1], 5)
    for faces, label in (([2, 10**6], 5), ([2, -1], 5), ([1, 2], -1)):
        with pytest.raises(ValueError, match=r"seed|label"):
            walk.add_seeds(faces, label)
        assert walk.seeds == {0: 5, 1: 5}


def test_components_without_a_seed_get_labels_of_their_own() -> None:
    mesh = together(sphere(1), sphere(1, 1, (4, 0, 0)), sphere(1, 1, (8, 0, 0)))
    walk = rw.RandomWalk(*mesh)
    walk.add_seeds([0, 1], 5)
    labels = walk.labels()
    assert sorted(set(labels)) == [5, 6, 7]
    assert walk.report["unseeded_components"] == 2
    assert np.array_equal(walk.probabilities().ravel() > 0, labels == 5)


def test_dihedral_differences_and_conductances_are_those_of_the_equations() -> None:
    mesh = sphere(2)
    mesh = Mesh(mesh.vertices * [1, 2, 3] + 0.1 * np.sin(3 * mesh.vertices[:, [1, 2, 0]]), mesh.faces)
    edges = rw.interior_edges(*mesh)
    normals, _ = face_normals(mesh)
    centroids = mesh.vertices[mesh.faces].mean(axis=1)
    a, b = edges.faces.T
    turn = 1 - (normals[a] * normals[b]).sum(axis=1)
    is_concave = ((normals[b] - normals[a]) * (centroids[b] - centroids[a])).sum(axis=1) < 0
    expected = np.where(is_concave, 1, 0.3) * turn
    expected /= expected.mean()
    difference = rw.dihedral_difference(*mesh, convex_weight=0.3)
    assert np.allclose(difference, expected, rtol=1e-9, atol=1e-12)
    diagonal = np.linalg.norm(np.ptp(mesh.vertices, axis=0))
    length = np.linalg.norm(mesh.vertices[edges.vertices[:, 0]] - mesh.vertices[edges.vertices[:, 1]], axis=1)
    assert np.allclose(
        rw.conductance(*mesh, difference, sigma=2, cap=3), length / diagonal * np.exp(-np.minimum(expected / 2, 3))
    )


def test_each_component_has_the_segments_that_it_has_by_itself(elephant: Mesh) -> None:
    vertices = np.vstack([elephant.vertices, 2 * elephant.vertices + 10])
    both = Mesh(vertices, np.vstack([elephant.faces, elephant.faces + len(elephant.vertices)]))
    alone = rw.segment(*elephant)
    first, second = np.split(rw.segment(*both), 2)
    assert not set(first) & set(second)
    for part in (first, second):
        assert len(set(zip(part, alone, strict=True))) == len(set(part)) == len(set(alone))
    stored = rw.segment(*both, difference=rw.dihedral_difference(*both, convex_weight=0))
    assert not set(stored[: len(alone)]) & set(stored[len(alone) :])
    assert len(set(rw.segment(*both, policy=rw.Policy(components="whole")))) < 2 * len(set(alone))


def test_a_stored_difference_gives_the_segments_of_the_one_that_is_computed(anchor: Mesh) -> None:
    stored = rw.curvature_difference(*anchor)
    assert np.array_equal(rw.segment(*anchor, difference=stored), rw.segment(*anchor, difference="curvature"))


def test_segments_follow_the_features_of_faces() -> None:
    mesh = sphere(3)
    true = (mesh.vertices[mesh.faces].mean(axis=1) > 0) @ [1, 2, 4]  # octants, which no crease shows
    features = np.eye(8)[true] + 0.01 * np.random.default_rng(1).standard_normal((len(true), 8))
    labels = rw.segment(*mesh, 8, face_features=features)
    assert rw.segmentation_errors(labels, true).rand_index < 0.01
    assert rw.segmentation_errors(rw.segment(*mesh, 8), true).rand_index > 0.05
    with pytest.raises(ValueError, match="the features of face 7 are not finite"):
        rw.segment(*mesh, face_features=np.where(np.arange(len(true)) == 7, np.nan, 0))
    assert np.array_equal(rw.feature_difference(*mesh, np.ones(len(true))), np.zeros(len(mesh.faces) * 3 // 2))
    assert rw.feature_difference(*mesh, features).mean() == pytest.approx(1)


def test_the_larger_of_difference_and_features_counts() -> None:
    mesh = grid(10, 6)
    along = (mesh.vertices[mesh.faces][:, :, 1].mean(axis=1) > 3).astype(float)
    labels = rw.segment(
        *mesh, 4, difference="dihedral", face_features=along, policy=rw.Policy(convex_weight=1, smoothing=0)
    )
    across = mesh.vertices[mesh.faces][:, :, 0].mean(axis=1) > 5
    assert same_partition(labels, (2 * across + along).astype(np.int64))


def test_nothing_crosses_a_wall() -> None:
    mesh = grid(10, 6)
    ring = np.arange(7) + 7 * 3  # the vertices of one column
    walls = np.column_stack([ring[:-1], ring[1:]])
    left = mesh.vertices[mesh.faces][:, :, 0].mean(axis=1) < 3
    for labels in (
        rw.segment(*mesh, 2, walls=walls),
        rw.segment(*mesh, walls=walls, seeds={0: 0}),
        rw.refine(*mesh, np.column_stack([left, ~left]) * 1.0, walls=walls).labels,
    ):
        assert set(labels[left]).isdisjoint(labels[~left])
    assert (rw.conductance(*mesh, np.ones(len(rw.interior_edges(*mesh).faces)), walls=walls) == 0).sum() == 6


def test_sharp_edges_are_those_of_a_fold(cube: Mesh) -> None:
    assert len(rw.sharp_edges(*cube, 80)) == 12
    assert len(rw.sharp_edges(*cube, 100)) == 0
    fold = rw.sharp_edges(*grid(10, 6), 80)
    assert len(fold) == 6
    assert (grid(10, 6).vertices[fold][:, :, 0] == 5).all()
    for wrong in (0, 180, np.nan):
        with pytest.raises(ValueError, match="between 0 and 180 degrees"):
            rw.sharp_edges(*cube, wrong)


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**31 - 1), st.integers(1, 4))
def test_refined_probabilities_solve_the_walk_with_priors(seed: int, labels: int) -> None:
    random = np.random.default_rng(seed)
    mesh = sphere(2)
    beliefs = random.random((len(mesh.faces), labels)) * (random.random((len(mesh.faces), 1)) < 0.7)
    reach = 0.05
    difference = rw.dihedral_difference(*mesh)
    refined = rw.refine(*mesh, beliefs, reach=reach, difference=difference)
    area = face_normals(mesh)[1]
    edges = rw.interior_edges(*mesh)
    diagonal = np.linalg.norm(np.ptp(mesh.vertices, axis=0))
    length = np.linalg.norm(mesh.vertices[edges.vertices[:, 0]] - mesh.vertices[edges.vertices[:, 1]], axis=1)
    weight = length.mean() / diagonal / (np.sqrt(3) * reach**2 * area.sum() / diagonal**2)
    rate = weight * (area / diagonal**2)[:, None] * beliefs
    matrix = laplacian(mesh, rw.conductance(*mesh, difference, cap=3)) + sp.diags(rate.sum(axis=1))
    expected = sp.linalg.spsolve(matrix.tocsc(), rate).reshape(-1, labels)
    assert np.allclose(refined.probabilities, expected, atol=1e-9)
    assert np.array_equal(refined.labels, expected.argmax(axis=1)) or np.allclose(
        np.take_along_axis(expected, refined.labels[:, None], 1).ravel(), expected.max(axis=1)
    )


def test_refining_mends_what_a_network_gets_wrong(elephant: Mesh) -> None:
    true = rw.segment(*elephant, 6)
    random = np.random.default_rng(2)
    votes = np.eye(6)[np.where(random.random(len(true)) < 0.3, random.integers(0, 6, len(true)), true)]
    votes[random.random(len(true)) < 0.3] = 0  # no view shows them
    before = rw.segmentation_errors(votes.argmax(axis=1), true).rand_index
    after = rw.segmentation_errors(rw.refine(*elephant, votes).labels, true).rand_index
    assert before > 0.2
    assert after < 0.02


def test_what_no_evidence_reaches_gets_the_next_label() -> None:
    mesh = together(sphere(1), sphere(1, 1, (4, 0, 0)))
    half = len(mesh.faces) // 2
    beliefs = np.zeros((2 * half, 3))
    beliefs[0, 1] = 1
    labels, probabilities = rw.refine(*mesh, beliefs)
    assert set(labels[:half]) == {1}
    assert set(labels[half:]) == {3}
    assert np.allclose(probabilities.sum(axis=1), np.repeat([1, 0], half))
    for wrong in (-1, np.nan, np.inf):
        beliefs[3, 2] = wrong
        with pytest.raises(ValueError, match="the probability of label 2 at face 3 is"):
            rw.refine(*mesh, beliefs)
    with pytest.raises(ValueError, match="probabilities have 4 rows"):
        rw.refine(*mesh, np.zeros((4, 2)))
    with pytest.raises(ValueError, match="reach is"):
        rw.refine(*mesh, np.zeros((2 * half, 2)), reach=0)


def test_curvatures_of_a_sphere_are_1_over_its_radius() -> None:
    mesh = sphere(4, radius=5)
    measured = rw.curvatures(*mesh, radius=1)
    assert measured.radius == pytest.approx(1)
    assert np.allclose(measured.mean, 1 / 5, rtol=0.05)
    assert np.allclose(measured.gaussian, 1 / 25, rtol=0.1)
    outward = mesh.vertices[mesh.faces].mean(axis=1)
    outward /= np.linalg.norm(outward, axis=1)[:, None]
    assert np.allclose(measured.normal, outward, atol=0.05)
    assert np.allclose(rw.smoothed_normals(*mesh), outward, atol=0.05)
    with pytest.raises(ValueError, match="radius"):
        rw.curvatures(*mesh, radius=-1)


def test_thickness_of_a_plate_is_its_own() -> None:
    import trimesh

    plate = trimesh.creation.box((10, 10, 1)).subdivide().subdivide().subdivide()
    mesh = Mesh(np.asarray(plate.vertices), np.asarray(plate.faces))
    flat = np.abs(face_normals(mesh)[0][:, 2]) > 0.5
    measured = rw.thickness(*mesh, cone_angle=0.1)
    assert np.median(measured[flat]) == pytest.approx(1, rel=0.02)
    assert rw.thickness(*mesh, scale="linear").max() == pytest.approx(1)
    with pytest.raises(ValueError, match="cone"):
        rw.thickness(*mesh, cone_angle=4)


def test_labels_of_a_reduced_mesh_are_carried_to_the_full_one(elephant: Mesh) -> None:
    import trimesh

    vertices, faces, parts = trimesh.remesh.subdivide(*elephant, return_index=True)
    parent = np.empty(len(faces), dtype=int)
    for face, numbers in parts.items():
        parent[numbers] = face
    mesh = Mesh(vertices, faces)
    labels = rw.segment(*elephant, 5) + 10
    carried = rw.transfer_labels(*elephant, labels, *mesh)
    exact = rw.transfer_labels(*elephant, labels, *mesh, band=0)
    assert set(carried) == set(exact) == set(range(10, 15))
    assert np.array_equal(exact, labels[parent])
    assert rw.segmentation_errors(carried, exact).rand_index < 0.1
    with pytest.raises(ValueError, match="reduced_labels must be of shape"):
        rw.transfer_labels(*elephant, labels[1:], *mesh)


labellings = hnp.arrays(np.int64, st.shared(st.integers(0, 40), key="n"), elements=st.integers(-3, 5))


@settings(max_examples=200, deadline=None)
@given(labellings, labellings)
def test_the_rand_index_is_that_of_scikit_learn(first: NDArray[np.int64], second: NDArray[np.int64]) -> None:
    errors = rw.segmentation_errors(first, second)
    expected = 1 - sklearn.metrics.rand_score(first, second) if len(first) > 1 else 0
    assert errors.rand_index == pytest.approx(expected)
    for value in dataclasses.astuple(errors):
        assert -1e-12 <= value <= 1
    assert errors.local_consistency <= errors.global_consistency + 1e-12
    assert dataclasses.astuple(rw.segmentation_errors(second, first)) == pytest.approx(dataclasses.astuple(errors))
    assert dataclasses.astuple(rw.segmentation_errors(first, 7 - 2 * first)) == pytest.approx((0, 0, 0, 0))


def test_errors_are_those_of_an_example_by_hand() -> None:
    errors = rw.segmentation_errors([0, 0, 0, 0, 1, 1], [0, 0, 1, 1, 1, 1])
    # Of 15 pairs 2 x 2 + 2 x 2 are together in one alone; 2 of 6 faces are uncovered in either direction.
    assert errors.rand_index == pytest.approx(8 / 15)
    assert errors.hamming == pytest.approx(1 / 3)
    # Faces 2, 3 stand with half of their segment outside the other's, in either direction, and faces 0, 1 or 4, 5 in one.
    assert errors.global_consistency == pytest.approx(1 / 3)
    assert errors.local_consistency == pytest.approx(1 / 6)
    with pytest.raises(ValueError, match="cannot be compared"):
        rw.segmentation_errors([0, 1], [0])


def test_surfaces_of_a_part_are_found_with_their_numbers() -> None:
    import trimesh

    part = trimesh.creation.cylinder(radius=2, height=6, sections=96)
    part.apply_translation((10, 0, 0))
    labels, surfaces = rw.segment_surfaces(part.vertices, part.faces)
    assert sorted(surface.type for surface in surfaces) == ["cylinder", "plane", "plane"]
    cylinder = next(surface for surface in surfaces if isinstance(surface, rw.Cylinder))
    assert cylinder.radius == pytest.approx(2, rel=1e-3)
    assert 0 <= cylinder.radius_error < 1e-3
    assert 0 <= cylinder.axis_error < 1e-3
    assert 0 <= cylinder.point_error < 1e-3
    assert np.abs(cylinder.axis) == pytest.approx((0, 0, 1), abs=1e-6)
    assert cylinder.point[:2] == pytest.approx((10, 0), abs=1e-3)
    assert labels.max() + 1 == len(surfaces)
    renamed = np.array([30, -4, 7])[labels]
    again, fitted = rw.segment_surfaces(part.vertices, part.faces, labels=renamed)
    assert same_partition(again, labels)
    assert [surface.type for surface in fitted] == [surfaces[i].type for i in np.argsort([30, -4, 7])]
    table = pd.DataFrame([dataclasses.asdict(surface) for surface in surfaces])
    assert table["radius"].notna().sum() == 1
    assert json.loads(json.dumps([dataclasses.asdict(surface) for surface in surfaces]))[0]["type"] == surfaces[0].type
    with pytest.raises(ValueError, match="noise is -1"):
        rw.segment_surfaces(part.vertices, part.faces, noise=-1)


def test_surfaces_take_no_number_that_is_none(cube: Mesh) -> None:
    nan, inf = float("nan"), float("inf")
    labels = range(6)
    for options, message in [
        ({"stop_cost": nan}, "stop_cost is nan"),
        ({"noise": nan}, "noise is nan"),
        ({"noise": inf}, "noise is inf"),
        ({"noise": -0.1}, "noise is -0.1"),
        ({"noise": inf, "labels": labels}, "noise is inf"),
        ({"segments": 3, "labels": labels}, "segments: labels are segments that are known already"),
        ({"stop_cost": 2, "labels": labels}, "stop_cost: labels are"),
        ({"walls": [(0, 1)], "labels": labels}, "walls: labels are"),
    ]:
        with pytest.raises(ValueError, match=message):
            rw.segment_surfaces(*cube, **options)  # type: ignore[arg-type]
    assert len(rw.segment_surfaces(*cube, stop_cost=-inf)[1]) == 6
    assert len(rw.segment_surfaces(*cube, stop_cost=inf)[1]) == 1


def test_smooth_boundaries_lie_on_the_mesh_and_are_cut_into_it(elephant: Mesh) -> None:
    import trimesh

    labels = rw.segment(*elephant, 5)
    curves = rw.smooth_boundaries(*elephant, labels)
    assert any(curve.is_smoothed for curve in curves)
    for curve in curves:
        corners = elephant.vertices[elephant.faces[curve.faces]]
        assert np.allclose((corners * curve.barycentric[:, :, None]).sum(axis=1), curve.points)
        assert (curve.barycentric.min(axis=1) == 0).all()
        assert set(curve.segments) <= set(labels.tolist())
    split = rw.split_along_boundaries(*elephant, labels, curves)
    assert np.array_equal(split.vertices[: len(elephant.vertices)], elephant.vertices)
    assert np.array_equal(split.parents[: elephant.number_of_faces], np.arange(elephant.number_of_faces))
    cut, whole = (trimesh.Trimesh(*m, process=False) for m in (split_mesh(split), elephant))
    assert cut.is_watertight == whole.is_watertight
    assert cut.area == pytest.approx(whole.area)
    assert cut.volume == pytest.approx(whole.volume)
    edges = rw.interior_edges(split.vertices, split.faces)
    between = np.sort(edges.vertices[np.diff(split.labels[edges.faces], axis=1).ravel() != 0], axis=1)
    assert np.array_equal(np.unique(between, axis=0), np.unique(np.sort(split.boundary_edges, axis=1), axis=0))
    length = np.linalg.norm(np.diff(split.vertices[split.boundary_edges], axis=1), axis=2).sum()
    assert length == pytest.approx(sum(curve.length for curve in curves))
    jagged = rw.smooth_boundaries(*elephant, labels, largest_displacement=0)
    assert sum(curve.length for curve in jagged) > length
    assert all(not curve.is_smoothed for curve in jagged)


def split_mesh(split: rw.SplitMesh) -> Mesh:
    """Take the mesh alone."""
    return Mesh(split.vertices, split.faces)


def test_boundaries_ask_for_triangles_and_sound_curves(cube: Mesh, elephant: Mesh) -> None:
    with pytest.raises(ValueError, match="triangle"):
        rw.smooth_boundaries(*cube, np.arange(6))
    labels = rw.segment(*elephant, 3)
    curve = rw.smooth_boundaries(*elephant, labels)[0]
    inside = dataclasses.replace(curve, barycentric=np.full_like(curve.barycentric, 1 / 3))
    with pytest.raises(ValueError, match="one of its barycentric coordinates must be 0"):
        rw.split_along_boundaries(*elephant, labels, [inside])
    with pytest.raises(ValueError, match="labels must be of shape"):
        rw.smooth_boundaries(*elephant, labels[1:])
    with pytest.raises(ValueError, match="curve"):
        rw.split_along_boundaries(*elephant, labels, [curve, curve])


def test_colours_of_neighbours_can_be_told_apart_by_everybody(elephant: Mesh) -> None:
    from rw_segmentation.colors import apparent_distances, palette

    labels = rw.segment(*elephant, 12)
    colors = rw.segment_colors(*elephant, labels)
    sides = labels[rw.interior_edges(*elephant).faces]
    for a, b in np.unique(sides[sides[:, 0] != sides[:, 1]], axis=0).tolist():
        assert apparent_distances([colors[a], colors[b]])[0, 1] >= 0.1
    assert apparent_distances([(0, 0, 0), (255, 255, 255)])[0, 1] == pytest.approx(1, abs=1e-3)
    assert palette().shape == (56, 3)
    assert rw.face_colors(*elephant, labels).shape == (elephant.number_of_faces, 3)
