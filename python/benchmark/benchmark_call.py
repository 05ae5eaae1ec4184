# SPDX-License-Identifier: MIT
"""What a call from Python costs beside C++: ``python benchmark_call.py SEGMENT_MESH MESH.off [ROUNDS]``.

The C++ side is the tool segment_mesh, whose report tells how long it took to make a mesh of the arrays and to segment it;
reading and writing are not counted. Both run on one core, in turns, and the least time of each counts: what else a machine
does only adds to it. Memory is that of the process at its peak, less what it held before the call.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import trimesh

import rw_segmentation as rw
from rw_segmentation import _core

# What the tool does besides.
NOT_COUNTED = {"reading", "writing", "boundaries"}


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


def main() -> None:
    """Compare."""
    tool, path = Path(sys.argv[1]), Path(sys.argv[2])
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
        from_cpp.append(milliseconds_of_tool(tool, path))
        from_python.append(milliseconds_of(lambda: rw.segment(vertices, faces)))
        reading.append(milliseconds_of(lambda: rw.interior_edges(vertices, faces)))
    overhead = min(from_python) / min(from_cpp) - 1
    print(f"RESULT faces {len(faces)}")
    print(f"RESULT C++ {min(from_cpp):.1f} ms, Python {min(from_python):.1f} ms, overhead {100 * overhead:.1f} %")
    print(f"RESULT reading the arrays and listing the edges {min(reading):.1f} ms")
    walk = rw.RandomWalk(vertices, faces)
    for face, label in ((0, 0), (len(faces) // 2, 1), (len(faces) // 3, 2)):
        walk.add_seed(face, label)
    first = milliseconds_of(walk.labels)
    walk.add_seed(len(faces) // 5, 1)
    walk.labels()
    edits = []
    for step in range(rounds):
        walk.add_seed(len(faces) // (7 + step), 2)
        edits.append(milliseconds_of(walk.labels))
    print(f"RESULT first labels of a walk {first:.1f} ms, after an edit {min(edits):.1f} ms")


if __name__ == "__main__":
    main()
