# SPDX-License-Identifier: MIT

"""Segments tiles of one mesh with Dask: each step of each tile is a task, on this machine or on a cluster.

    python segment_tiles.py WORK_FOLDER OUTPUT_FOLDER TILE ... [--scheduler ADDRESS] [--workers N] [--options "..."]

All workers must see the folders, under the same paths, and find `segment_mesh`. Files that options name need whole paths
where workers run in another folder than this program. A task whose worker is lost is done again by another one; run
again, the program does what is left. Files that options name, such as walls, are not watched: after a change remove the
work folder. Needs dask.distributed.
"""

from __future__ import annotations

import argparse
import json
import shlex
import subprocess
from pathlib import Path

from distributed import Client, LocalCluster, progress, wait

# Each step of the tool, whether it is done tile by tile, and the file that it leaves at its end.
FIRST_STEPS = (
    ("survey", True, "survey"),
    ("plan", False, "plan"),
    ("border", True, "noise"),
    ("noise", False, "noise_of_all"),
)
STEPS_OF_WALKS = (
    ("shape", True, "outline"),
    ("places", True, "places"),
    ("seeds", False, "seeds"),
    ("clusters", True, "network"),
    ("walk", False, "walk"),
    ("fragments", True, "regions"),
)
STEPS_OF_SURFACES = (("surfaces", True, "regions"),)
MERGE = ("merge", False, "segments")
STEPS_OF_SMOOTH_BOUNDARIES = (
    ("strips", True, "strip"),
    ("crossings", True, "crossings"),
)
LAST_STEPS = (
    ("labels", True, "labels"),
    ("report", False, "report"),
)


def run_step(command: list[str], step: str, tile: int | None) -> None:
    """Run one step of the tool; raise RuntimeError with its message if it fails."""
    of_tile = [] if tile is None else ["--tile", str(tile)]
    result = subprocess.run([*command, "--tile-step", step, *of_tile], capture_output=True, text=True, check=False)
    if result.returncode != 0:
        message = result.stderr.strip()
        where = "" if tile is None else f" of tile {tile}"
        raise RuntimeError(f"step {step}{where}: exit code {result.returncode}: {message}")


def version_of(tile: str) -> list[int] | None:
    """Tell a file from others that take its place, also from older ones."""
    try:
        status = Path(tile).stat()
    except OSError:
        return None
    return [status.st_size, status.st_mtime_ns]


def forget_old_work(
    work: Path, outputs: Path, steps: tuple[tuple[str, bool, str], ...], tiles: list[str], options: list[str]
) -> None:
    """Remove what all steps have left for tiles that have changed, the last ones for other options or lost labels."""
    versions = [version_of(tile) for tile in tiles]
    versions_file = work / "versions.json"
    old_versions = json.loads(versions_file.read_text()) if versions_file.exists() else []
    is_old = False
    for tile, version in enumerate(versions):
        survey = work / f"survey_{tile}"
        if version is None or old_versions[tile : tile + 1] != [version]:
            survey.unlink(missing_ok=True)
        is_old = is_old or not survey.exists()
    request = json.dumps([*tiles, str(outputs), *options])
    request_file = work / "request.json"
    is_other = not request_file.exists() or request_file.read_text() != request
    has_lost_labels = any(not (outputs / f"{Path(tile.removesuffix('.gz')).stem}.seg").exists() for tile in tiles)
    names = [step for step, _, _ in steps]
    # The report tells each time what failed.
    first = "plan" if is_old else "merge" if is_other or has_lost_labels else "report"
    for _, is_of_each_tile, file in steps[names.index(first) :]:
        for place in range(len(tiles)) if is_of_each_tile else [None]:
            (work / (file if place is None else f"{file}_{place}")).unlink(missing_ok=True)
    request_file.write_text(request)
    versions_file.write_text(json.dumps(versions))  # of before the steps: what changes meanwhile is done again


def segment(client: Client, work: Path, outputs: Path, tiles: list[str], options: list[str]) -> None:
    """Run all steps that have not left their files yet, one after the other, each on all tiles at the same time."""
    work.mkdir(parents=True, exist_ok=True)
    outputs.mkdir(parents=True, exist_ok=True)
    tile_list = work / "tiles.txt"
    tile_list.write_text("".join(f"{tile}\n" for tile in tiles))
    command = ["segment_mesh", "--quiet", "--tiled", "--list", str(tile_list)]
    labels = str(outputs).replace("%", "%%") + "/%.seg"
    command += ["--tile-folder", str(work), "--labels", labels, *options]
    of_method = STEPS_OF_SURFACES if "--engineering" in options else STEPS_OF_WALKS
    words = {word.split("=")[0] for word in options}
    smooths_boundaries = "--refine" in words or words >= {"--smooth", "--boundaries"}
    of_boundaries = STEPS_OF_SMOOTH_BOUNDARIES if smooths_boundaries else ()
    steps = (*FIRST_STEPS, *of_method, MERGE, *of_boundaries, *LAST_STEPS)
    forget_old_work(work, outputs, steps, tiles, options)
    for step, is_of_each_tile, file in steps:
        places: list[int | None] = list(range(len(tiles))) if is_of_each_tile else [None]
        left = [place for place in places if not (work / (file if place is None else f"{file}_{place}")).exists()]
        tasks = [client.submit(run_step, command, step, place, pure=False, retries=2) for place in left]
        progress(tasks)
        wait(tasks)
        client.gather(tasks)  # raises what a task has raised


def main() -> None:
    """Read the command line and do the work."""
    parser = argparse.ArgumentParser(description="Segments tiles of one mesh with Dask.")
    parser.add_argument("work", type=Path, help="folder for what steps leave")
    parser.add_argument("outputs", type=Path, help="folder for the labels")
    parser.add_argument("tiles", nargs="+", help="mesh files")
    parser.add_argument("--scheduler", help="address of a Dask scheduler; without it one is started here")
    parser.add_argument("--workers", type=int, help="processes of the one that is started here")
    parser.add_argument("--options", default="", help="options of segment_mesh, such as --segments 12")
    arguments = parser.parse_args()
    if all(version_of(tile) is None for tile in arguments.tiles):  # wrong paths would claim the work folder
        parser.error(f"{arguments.tiles[0]}: no such file, nor any of the others")
    # Workers may run in other folders, and a path that begins with "#" would be a comment in the list of tiles.
    work, outputs = arguments.work.absolute(), arguments.outputs.absolute()
    tiles = [str(Path(tile).absolute()) for tile in arguments.tiles]
    cluster = arguments.scheduler or LocalCluster(
        n_workers=arguments.workers, threads_per_worker=1, dashboard_address=":0"
    )
    with Client(cluster) as client:
        segment(client, work, outputs, tiles, shlex.split(arguments.options))


if __name__ == "__main__":
    main()
