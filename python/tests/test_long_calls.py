# SPDX-License-Identifier: MIT
"""Long calls: progress, cancelling, Ctrl-C, and threads beside each other."""

from __future__ import annotations

import itertools
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import rw_segmentation as rw
from meshes import Mesh, sphere, together


@pytest.fixture(scope="module")
def large() -> Mesh:
    """Give a mesh that takes some time: two bumpy spheres."""
    return bumpy(together(sphere(6), sphere(6, 1, (3, 0, 0))))


@pytest.fixture(scope="module")
def small() -> Mesh:
    """Give one on which the slowest functions do not take long."""
    return bumpy(sphere(4))


def bumpy(mesh: Mesh) -> Mesh:
    """Bend a mesh."""
    return Mesh(mesh.vertices + 0.1 * np.sin(5 * mesh.vertices[:, [1, 2, 0]]), mesh.faces)


def long_calls(mesh: Mesh) -> dict[str, Callable[[rw._progress.Progress], object]]:
    """List all functions that take progress."""
    half = np.arange(mesh.number_of_faces) % 2
    return {
        "segment": lambda p: rw.segment(*mesh, progress=p),
        "paper": lambda p: rw.segment(*mesh, policy="paper", progress=p),
        "coarse": lambda p: rw.segment(*mesh, policy="coarse", progress=p),
        "seeds": lambda p: rw.segment(*mesh, seeds=[0, 100], progress=p),
        "hierarchy": lambda p: rw.hierarchy(*mesh, progress=p),
        "segment_surfaces": lambda p: rw.segment_surfaces(*mesh, progress=p),
        "RandomWalk": lambda p: rw.RandomWalk(*mesh, progress=p),
        "refine": lambda p: rw.refine(*mesh, np.eye(2)[half], progress=p),
        "curvatures": lambda p: rw.curvatures(*mesh, progress=p),
        "curvature_difference": lambda p: rw.curvature_difference(*mesh, progress=p),
        "dihedral_difference": lambda p: rw.dihedral_difference(*mesh, smoothing=0.01, progress=p),
        "smoothed_normals": lambda p: rw.smoothed_normals(*mesh, progress=p),
        "thickness": lambda p: rw.thickness(*mesh, progress=p),
        "smooth_boundaries": lambda p: rw.smooth_boundaries(*mesh, half, progress=p),
        "transfer_labels": lambda p: rw.transfer_labels(*mesh, half, *mesh, progress=p),
    }


NAMES = list(long_calls(sphere(1)))


@pytest.mark.parametrize("name", NAMES)
def test_progress_rises_to_1_at_most_and_false_cancels(name: str, small: Mesh) -> None:
    told: list[float] = []
    call = long_calls(small)[name]
    call(told.append)
    assert told
    assert all(0 <= fraction <= 1 for fraction in told)
    # Stages that are told from 0 to 1 by themselves follow each other.
    assert sum(later < earlier for earlier, later in itertools.pairwise(told)) <= 1
    asked: list[float] = []

    def cancel(fraction: float) -> bool:
        asked.append(fraction)
        return False

    with pytest.raises(rw.Cancelled, match="cancelled by the callback"):
        call(cancel)
    assert len(asked) == 1


def test_false_of_numpy_cancels_and_other_answers_do_not(small: Mesh) -> None:
    with pytest.raises(rw.Cancelled):
        rw.segment(*small, progress=lambda fraction: np.float64(fraction) < 0)
    assert len(rw.segment(*small, progress=lambda _: 0)) == small.number_of_faces


def test_errors_of_the_progress_function_go_through(large: Mesh) -> None:
    def fail(_: float) -> None:
        raise LookupError("the window is closed")

    with pytest.raises(LookupError, match="the window is closed"):
        rw.segment(*large, progress=fail)


def test_a_walk_may_be_asked_again_after_it_was_cancelled(large: Mesh) -> None:
    walk = rw.RandomWalk(*large)
    walk.add_seed(0, 0)
    walk.add_seed(60000, 1)
    with pytest.raises(rw.Cancelled):
        walk.labels(progress=lambda _: False)
    expected = rw.segment(*large, seeds={0: 0, 60000: 1})
    assert np.array_equal(walk.labels(), expected)

    def meddle(_: float) -> None:
        walk.add_seed(5, 2)

    walk.add_seed(7, 3)
    with pytest.raises(RuntimeError, match="cannot be used by the progress function of its own call"):
        walk.labels(progress=meddle)
    walk.remove_seed(7)
    assert np.array_equal(walk.labels(), expected)


def test_a_walk_that_works_ahead_is_the_same_walk(large: Mesh) -> None:
    walk = rw.RandomWalk(*large)
    walk.add_seed(0, 0)
    with pytest.raises(rw.Cancelled):
        walk.anticipate(progress=lambda _: False)
    told: list[float] = []
    walk.anticipate(progress=told.append)
    assert told[-1] == 1
    walk.add_seed(60000, 1)
    assert np.array_equal(walk.labels(), rw.segment(*large, seeds={0: 0, 60000: 1}))


def test_a_bar_of_tqdm_is_shown(large: Mesh, capfd: pytest.CaptureFixture[str]) -> None:
    rw.segment(*large, progress=True)
    shown = capfd.readouterr().err
    assert "segmentation:" in shown
    assert "%" in shown


def test_ctrl_c_ends_a_long_call() -> None:
    code = """
import numpy as np, rw_segmentation as rw, sys, time
x, y = np.meshgrid(np.arange(700.0), np.arange(700.0), indexing="ij")
vertices = np.column_stack([x.ravel(), y.ravel(), 5 * np.sin(x / 9).ravel() * np.sin(y / 7).ravel()])
corner = (np.arange(699)[:, None] * 700 + np.arange(699)).ravel()
faces = np.concatenate([np.column_stack([corner, corner + 700, corner + 1]),
                        np.column_stack([corner + 700, corner + 701, corner + 1])])
print("begin", flush=True)
try:
    rw.segment(vertices, faces)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "begin\n"
        time.sleep(0.5)
        os.kill(process.pid, signal.SIGINT)
        assert process.stdout.read() == "interrupted\n"
        assert process.wait() == 0


def test_other_threads_run_during_a_call(large: Mesh) -> None:
    done = threading.Event()
    steps = 0

    def count() -> None:
        nonlocal steps
        while not done.is_set():
            steps += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    rw.segment(*large)
    done.set()
    thread.join()
    assert steps > 10  # a call that kept Python's lock would let it do one or two


def test_several_threads_segment_meshes_at_once(elephant: Mesh, anchor: Mesh, large: Mesh) -> None:
    meshes = [elephant, anchor, large] * 2
    expected = [rw.segment(*mesh) for mesh in meshes[:3]] * 2
    with ThreadPoolExecutor(6) as pool:
        found = list(pool.map(lambda mesh: rw.segment(*mesh, progress=lambda _: None), meshes))
    for labels, wanted in zip(found, expected, strict=True):
        assert np.array_equal(labels, wanted)


def test_several_threads_may_use_one_walk(elephant: Mesh) -> None:
    walk = rw.RandomWalk(*elephant)
    walk.add_seed(0, 0)
    walk.add_seed(1000, 1)
    expected = {False: walk.labels()}
    walk.add_seed(4000, 2)
    expected[True] = walk.labels()

    def edit(number: int) -> bool:
        if number % 2:
            walk.add_seed(4000, 2)
        else:
            walk.remove_seed(4000)
        labels = walk.labels()
        return any(np.array_equal(labels, known) for known in expected.values())

    with ThreadPoolExecutor(4) as pool:
        assert all(pool.map(edit, range(24)))
