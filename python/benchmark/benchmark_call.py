# SPDX-License-Identifier: MIT
"""What a call from Python costs beside C++: ``python benchmark_call.py PROGRAMS MESH.off [ROUNDS]``.

PROGRAMS is the folder of segment_mesh, whose report tells how long it took to make a mesh of the arrays and to segment it
without reading and writing, and of benchmark_seed_editing. Both sides run on one core, in turns, and the least time of each
segmentation counts: what else a machine does only adds to it. Of edits the medians are compared, as that program tells
them. Memory is that of the process at its peak, less what it held before the call.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median

import numpy as np
import trimesh
from numpy.typing import NDArray

import rw_segmentation as rw
from rw_segmentation import _core

# What the tool does besides.
NOT_COUNTED = {"reading", "writing", "boundaries"}
SEEDS, EDITS = 24, 20  # those of benchmark_seed_editing


def milliseconds_of_tool(tool: Path, mesh: Path) -> float:
    """Run the tool once."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        subprocess.run([tool, mesh, "--quiet", "--report", report], check=True)
        known = json.loads(report.read_text())["milliseconds"]
    return float(sum(value for name, value in known.items() if name not in NOT_COUNTED))


def milliseconds_of(call: Callable[[], object]) -> float:
    """Time a call."""
    begin = time.perf_counter()
    call()
    return 1000 * (time.perf_counter() - begin)


def bytes_at_peak(call: Callable[[], object]) -> int:
    """Measure how much more memory the process holds at its peak during a call (Linux)."""

    def status(name: str) -> int:
        lines = Path("/proc/self/status").read_text().splitlines()
        return 1024 * int(next(line for line in lines if line.startswith(name)).split()[1])

    Path("/proc/self/clear_refs").write_text("5")  # the peak starts anew
    before = status("VmRSS")
    kept = call()
    peak = status("VmHWM")
    del kept
    return peak - before


def edits_of_program(program: Path, mesh: Path) -> tuple[float, float]:
    """Run benchmark_seed_editing once: the medians of a seed added and of a seed removed, in milliseconds."""
    command = [program, "--mesh", mesh, "--seeds", str(SEEDS), "--edits", str(EDITS)]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    result = dict(re.findall(r"(\w+)=(\S+)", printed[printed.index("RESULT") :]))
    return float(result["add_ms"]), float(result["remove_ms"])


def edits_from_python(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> tuple[float, float]:
    """Do what benchmark_seed_editing does: the same medians."""
    random = np.random.default_rng(1)
    seeds = random.choice(len(faces), SEEDS + EDITS + 1, replace=False)
    walk = rw.RandomWalk(vertices, faces)

    def add(label: int) -> None:
        walk.add_seed(seeds[label], label)
        walk.labels()

    def remove(face: int) -> None:
        walk.remove_seed(face)
        walk.labels()

    for label in range(SEEDS):
        walk.add_seed(seeds[label], label)
    walk.labels()
    left = list(seeds[:SEEDS])
    added, removed = [], []
    for step in range(SEEDS, SEEDS + EDITS + 1):
        added.append(milliseconds_of(lambda label=step: add(label)))  # type: ignore[misc]
        left.append(seeds[step])
        chosen = left.pop(random.integers(len(left)))
        removed.append(milliseconds_of(lambda face=chosen: remove(face)))  # type: ignore[misc]
    # The first edit makes a column of each seed.
    return median(added[1:]), median(removed[1:])


def main() -> None:
    """Compare."""
    programs, path = Path(sys.argv[1]), Path(sys.argv[2])
    rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 7
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    mesh = trimesh.load_mesh(path, process=False)
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    # Before anything else has been allocated and freed.
    arrays = (vertices.nbytes + faces.nbytes) / len(faces)
    corners = np.ascontiguousarray(faces).reshape(-1)
    held = bytes_at_peak(lambda: _core.Mesh(vertices, corners, None, 3, True)) / len(faces)
    whole = bytes_at_peak(lambda: rw.segment(vertices, faces)) / len(faces)
    print(f"RESULT arrays {arrays:.0f} bytes a face, the mesh at its peak {held:.0f}, a segmentation {whole:.0f}")
    from_cpp, from_python, reading = [], [], []
    for _ in range(rounds):
        from_cpp.append(milliseconds_of_tool(programs / "segment_mesh", path))
        from_python.append(milliseconds_of(lambda: rw.segment(vertices, faces)))
        reading.append(milliseconds_of(lambda: rw.interior_edges(vertices, faces)))
    overhead = min(from_python) / min(from_cpp) - 1
    print(f"RESULT faces {len(faces)}")
    print(f"RESULT C++ {min(from_cpp):.1f} ms, Python {min(from_python):.1f} ms, overhead {100 * overhead:.1f} %")
    print(f"RESULT reading the arrays and listing the edges {min(reading):.1f} ms")
    for _ in range(2):
        for name, (added, removed) in (
            ("C++", edits_of_program(programs / "benchmark_seed_editing", path)),
            ("Python", edits_from_python(vertices, faces)),
        ):
            print(f"RESULT {name}: a seed added {added:.2f} ms, a seed removed {removed:.2f} ms")


if __name__ == "__main__":
    main()
