# SPDX-License-Identifier: MIT
"""What goes to other processes and into files of pickles, and what does not."""

from __future__ import annotations

import copy
import pickle
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest

import rw_segmentation as rw
from meshes import Mesh, grid, sphere, together


def assert_same(found: rw.Hierarchy, expected: rw.Hierarchy) -> None:
    """Compare all that two hierarchies tell."""
    assert found.number_of_fragments == expected.number_of_fragments
    assert found.number_of_components == expected.number_of_components
    assert found.suggested == expected.suggested
    assert found.report == expected.report
    assert list(found.report["seconds"]) == list(expected.report["seconds"])
    for name in ("merges", "costs", "fragment_of_face"):
        assert np.array_equal(getattr(found, name), getattr(expected, name))
    for segments in range(expected.number_of_components, expected.number_of_fragments + 1):
        assert np.array_equal(found.labels(segments), expected.labels(segments))
    assert found.levels() == expected.levels()


@pytest.mark.parametrize(
    "mesh", [together(sphere(3), sphere(2, 0.5, (2, 0, 0))), Mesh(np.zeros((0, 3)), np.zeros((0, 3), dtype=int))]
)
@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_a_hierarchy_is_the_same_after_it_was_pickled_or_copied(mesh: Mesh, protocol: int) -> None:
    levels = rw.hierarchy(*mesh)
    assert_same(pickle.loads(pickle.dumps(levels, protocol)), levels)
    assert_same(copy.deepcopy(levels), levels)
    assert_same(copy.copy(levels), levels)


def test_hierarchies_come_back_from_other_processes() -> None:
    mesh = grid(6, 5)
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        assert np.array_equal(pool.submit(rw.hierarchy, *mesh).result().merges, rw.hierarchy(*mesh).merges)


def test_a_pickle_of_regions_that_there_are_not_is_refused() -> None:
    core = rw.hierarchy(*together(sphere(2), sphere(2, 0.5, (2, 0, 0))))._core
    state = list(core.__getstate__())
    fragments, merges, costs, fragment_of_face = state[:4]
    for place, broken in [
        (0, fragments - 1),
        (0, len(costs) - 1),
        (1, merges + 1),
        (1, -merges),
        (1, merges[1:]),
        (2, costs[1:]),
        (3, fragment_of_face + 1),
        (3, fragment_of_face - 1),
    ]:
        with pytest.raises(ValueError, match="the hierarchy is broken"):
            type(core).__new__(type(core)).__setstate__((*state[:place], broken, *state[place + 1 :]))


def test_a_walk_is_not_pickled_nor_copied() -> None:
    walk = rw.RandomWalk(*grid(4, 4))
    for take in (pickle.dumps, copy.copy, copy.deepcopy):
        with pytest.raises(TypeError, match="a RandomWalk cannot be pickled or copied"):
            take(walk)


def test_surfaces_policies_and_errors_are_pickled() -> None:
    mesh = sphere(2)
    for thing in (rw.segment_surfaces(*mesh)[1], rw.Policy(sigma=2), rw.Polygons([0, 1, 2], [0, 3])):
        assert pickle.loads(pickle.dumps(thing)) == thing
    with pytest.raises(rw.Cancelled) as cancelled:
        rw.segment(*mesh, progress=lambda _: False)
    again = pickle.loads(pickle.dumps(cancelled.value))
    assert type(again) is rw.Cancelled
    assert str(again) == str(cancelled.value)
