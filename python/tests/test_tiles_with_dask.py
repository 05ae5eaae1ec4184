# SPDX-License-Identifier: MIT
"""The recipe that segments tiles of one mesh with Dask gives the labels of the tool, also when a worker is killed."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from readers import reader

distributed = reader("distributed")

RECIPE = Path(__file__).parents[2] / "examples/collections/segment_tiles.py"


@pytest.fixture
def tiles(data: Path) -> list[str]:
    """Give two meshes that touch each other nowhere, as tiles."""
    return [str(data / "hand.off"), str(data / "tripod.off")]


@pytest.fixture
def expected(tool: Path, tiles: list[str], tmp_path: Path) -> dict[str, str]:
    """Give the labels of the tool by itself, by tile."""
    folder = tmp_path / "expected"
    folder.mkdir()
    subprocess.run([tool, *tiles, "--tiled", "--quiet", "--labels", f"{folder}/%.seg"], check=True)
    return contents(folder)


def contents(folder: Path) -> dict[str, str]:
    return {path.name: path.read_text() for path in folder.glob("*.seg")}


def environment(tool: Path) -> dict[str, str]:
    return {**os.environ, "PATH": f"{tool.parent}:{os.environ['PATH']}"}


def command(tmp_path: Path, tiles: list[str]) -> list[str]:
    return [sys.executable, str(RECIPE), str(tmp_path / "work"), str(tmp_path / "labels"), *tiles]


def test_labels_are_those_of_the_tool(tool: Path, tiles: list[str], expected: dict[str, str], tmp_path: Path) -> None:
    subprocess.run([*command(tmp_path, tiles), "--workers", "2"], env=environment(tool), check=True)
    assert contents(tmp_path / "labels") == expected


def test_other_options_and_folders_take_the_last_steps(tool: Path, tiles: list[str], tmp_path: Path) -> None:
    subprocess.run([*command(tmp_path, tiles), "--workers", "1"], env=environment(tool), check=True)
    other = [sys.executable, str(RECIPE), str(tmp_path / "work"), str(tmp_path / "other"), *tiles]
    subprocess.run([*other, "--options=--segments 12"], env=environment(tool), check=True)
    subprocess.run(
        [tool, *tiles, "--tiled", "--quiet", "--segments", "12", "--labels", f"{tmp_path}/%.seg"], check=True
    )
    assert contents(tmp_path / "other") == contents(tmp_path)


def test_a_tile_is_segmented_anew_where_an_older_file_takes_its_place(
    tool: Path, tiles: list[str], data: Path, tmp_path: Path
) -> None:
    tile = tmp_path / "tile.off"
    for mesh, age in (("tripod.off", 0), ("u.off", 1000000)):
        shutil.copyfile(data / mesh, tile)
        os.utime(tile, (tile.stat().st_mtime - age,) * 2)
        of_recipe = [*command(tmp_path, [tiles[0], str(tile)]), "--workers", "1"]
        subprocess.run(of_recipe, env=environment(tool), check=True)
        subprocess.run([tool, tiles[0], tile, "--tiled", "--quiet", "--labels", f"{tmp_path}/%.seg"], check=True)
        assert contents(tmp_path / "labels") == contents(tmp_path)


def test_labels_that_are_lost_are_written_again(
    tool: Path, tiles: list[str], expected: dict[str, str], tmp_path: Path
) -> None:
    for _ in range(2):
        subprocess.run([*command(tmp_path, tiles), "--workers", "1"], env=environment(tool), check=True)
        assert contents(tmp_path / "labels") == expected
        (tmp_path / "labels/tripod.seg").unlink()


def test_surfaces_are_those_of_the_tool(tool: Path, tiles: list[str], tmp_path: Path) -> None:
    subprocess.run([tool, *tiles, "--tiled", "--quiet", "--engineering", "--labels", f"{tmp_path}/%.seg"], check=True)
    subprocess.run([*command(tmp_path, tiles), "--options=--engineering"], env=environment(tool), check=True)
    assert contents(tmp_path / "labels") == contents(tmp_path)


def test_a_killed_worker_changes_nothing(
    tool: Path, tiles: list[str], expected: dict[str, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", environment(tool)["PATH"])
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as cluster,
        distributed.Client(cluster) as client,
        subprocess.Popen([*command(tmp_path, tiles), "--scheduler", cluster.scheduler_address]) as recipe,
    ):
        while not (tmp_path / "work/plan").exists() and recipe.poll() is None:
            time.sleep(0.01)
        for worker in list(client.run(os.getpid).values())[:1]:
            os.kill(worker, signal.SIGKILL)
        assert recipe.wait() == 0
    assert contents(tmp_path / "labels") == expected


def test_paths_are_those_of_the_caller_wherever_workers_run(
    tool: Path, tiles: list[str], expected: dict[str, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", environment(tool)["PATH"])
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    with distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=":0") as cluster:
        scheduler = ["--scheduler", cluster.scheduler_address]
        names = [Path(tile).name for tile in tiles]
        for tile, name in zip(tiles, names, strict=True):
            shutil.copyfile(tile, tmp_path / name)
        subprocess.run([sys.executable, str(RECIPE), "work", "labels", *names, *scheduler], cwd=tmp_path, check=True)
    assert contents(tmp_path / "labels") == expected


def test_a_tile_may_have_a_name_that_would_be_a_comment(
    tool: Path, tiles: list[str], expected: dict[str, str], tmp_path: Path
) -> None:
    names = ["#hand.off", "tripod.off"]
    for tile, name in zip(tiles, names, strict=True):
        shutil.copyfile(tile, tmp_path / name)
    of_recipe = [sys.executable, str(RECIPE), "work", "labels", *names, "--workers", "1"]
    subprocess.run(of_recipe, env=environment(tool), cwd=tmp_path, check=True)
    labels = contents(tmp_path / "labels")
    assert labels == {"#hand.seg": expected["hand.seg"], "tripod.seg": expected["tripod.seg"]}


def test_a_step_that_fails_is_told(tool: Path, tiles: list[str], tmp_path: Path) -> None:
    result = subprocess.run(
        [*command(tmp_path, tiles), "--workers", "1", "--options", "--segments 1"],
        env=environment(tool),
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode != 0
    assert "step merge: exit code 3: segment_mesh:" in result.stderr


def test_wrong_paths_leave_nothing(tool: Path, tmp_path: Path) -> None:
    result = subprocess.run(
        command(tmp_path, ["none/0.off", "none/1.off"]),
        env=environment(tool),
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode != 0
    assert "none/0.off: no such file" in result.stderr
    assert not (tmp_path / "work").exists()


def test_a_tile_that_cannot_be_read_is_told_each_time(tool: Path, tiles: list[str], tmp_path: Path) -> None:
    broken = tmp_path / "broken.off"
    broken.write_text("OFF\n")
    for _ in range(2):
        result = subprocess.run(
            [*command(tmp_path, [str(broken), tiles[1]]), "--workers", "1"],
            env=environment(tool),
            capture_output=True,
            text=True,
            check=False,
        )
        assert result.returncode != 0
        assert "1 of 2 tiles could not be read" in result.stderr
