#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs segment_mesh on every mesh of a folder and checks each answer by a second reader of the file, trimesh.

Right is an answer with a label for each face, a report that agrees with the labels, and the area and the box that trimesh
finds; or a refusal of what trimesh cannot read either, or finds no face in. All else is printed as different, and the exit
code is 1: one of the two is wrong then, and it need not be the tool. What trimesh refuses and the tool reads is told, but
does not count: nobody is there to ask.

Usage: check_folder.py TOOL FOLDER [--seconds S] [-- OPTION ...]     the options go to the tool
Needs NumPy and trimesh: pip install trimesh
"""

from __future__ import annotations

import argparse
import collections
import gzip
import io
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import trimesh

EXTENSIONS = {".off", ".ply", ".obj", ".stl"}
# Readers keep single precision in places.
TOLERANCE = 1e-4


def format_of(path: Path) -> str:
    """Name the format by the extension, before .gz if that is there."""
    return (Path(path.stem) if path.suffix.lower() == ".gz" else path).suffix.lower()


def second_reading(path: Path) -> trimesh.Trimesh | None:
    """Read a mesh by trimesh; none if it cannot, or if there are no faces."""
    try:
        content = path.read_bytes()
        if content[:2] == b"\x1f\x8b":
            content = gzip.decompress(content)
        mesh = trimesh.load(io.BytesIO(content), file_type=format_of(path)[1:], process=False, force="mesh")
    except Exception:  # whatever it does not expect
        return None
    return mesh if isinstance(mesh, trimesh.Trimesh) and len(mesh.faces) else None


def difference(first: trimesh.Trimesh, second: trimesh.Trimesh) -> str:
    """Tell how two meshes differ; nothing if they do not."""
    boxes = [np.asarray(mesh.triangles).reshape(-1, 3) for mesh in (first, second)]
    bounds = [np.array([box.min(axis=0), box.max(axis=0)]) for box in boxes]
    extent = float(np.ptp(bounds[1], axis=0).max())
    if not np.allclose(bounds[0], bounds[1], rtol=TOLERANCE, atol=TOLERANCE * extent):
        return f"the box is {bounds[0].tolist()}, but trimesh finds {bounds[1].tolist()}"
    if not np.isclose(first.area, second.area, rtol=TOLERANCE, atol=TOLERANCE**2 * extent**2):
        return f"the area is {first.area}, but trimesh finds {second.area}"
    return ""


def fault_of_answer(folder: Path, second: trimesh.Trimesh | None) -> str:
    """Tell what is wrong with the files that the tool wrote; nothing if all is right."""
    labels = np.loadtxt(folder / "labels.seg", dtype=np.int64, ndmin=1)
    report = json.loads((folder / "report.json").read_text())
    if len(labels) != report["faces"]:
        return f"there are {len(labels)} labels for {report['faces']} faces"
    counted = collections.Counter(labels.tolist())
    reported = {segment["label"]: segment["faces"] for segment in report["segments"]}
    if counted != reported:
        return f"the labels are {dict(counted)}, but the report says {reported}"
    written = trimesh.load_mesh(folder / "out.obj", process=False, skip_materials=True)
    return difference(written, second) if second else ""


def outcome(tool: Path, mesh: Path, options: list[str], seconds: float) -> tuple[str, str]:
    """Run the tool on a mesh. The first word is "right", "refused", "alone" (read by the tool only) or "DIFFERENT"."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        outputs = {"--labels": "labels.seg", "--output": "out.obj", "--report": "report.json"}
        command = [str(tool), str(mesh), "--quiet", *options]
        for option, file in outputs.items():
            command += [option, str(folder / file)]
        try:
            run = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=seconds)
        except subprocess.TimeoutExpired:
            return "DIFFERENT", f"no answer in {seconds:g} s"
        said = run.stderr.strip()
        second = second_reading(mesh)
        if run.returncode == 2:
            if second:
                return "DIFFERENT", f"refused, but trimesh reads {len(second.faces)} triangles: {said}"
            return "refused", said
        if run.returncode != 0:
            return "DIFFERENT", f"exit code {run.returncode}: {said}"
        fault = fault_of_answer(folder, second)
        return ("DIFFERENT", fault) if fault else ("right" if second else "alone", "")


def main() -> int:
    """Go through the folder and print what is not right."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tool", type=Path, help="the path of segment_mesh")
    parser.add_argument("folder", type=Path, help="where the meshes are, folders in it included")
    parser.add_argument("--seconds", type=float, default=120, help="of a run at most (120)")
    words = sys.argv[1:]
    end = words.index("--") if "--" in words else len(words)
    arguments, options = parser.parse_args(words[:end]), words[end + 1 :]
    meshes = [path for path in sorted(arguments.folder.rglob("*")) if path.is_file() and format_of(path) in EXTENSIONS]
    counts: collections.Counter[str] = collections.Counter()
    for mesh in meshes:
        word, text = outcome(arguments.tool, mesh, options, arguments.seconds)
        counts[word] += 1
        if word != "right":
            print(f"{word}: {mesh}{': ' if text else ''}{text}", flush=True)
    print(
        f"{len(meshes)} meshes: {counts['right']} right, {counts['alone']} that trimesh does not read, "
        f"{counts['refused']} refused by both, {counts['DIFFERENT']} different"
    )
    return 1 if counts["DIFFERENT"] else 0


if __name__ == "__main__":
    sys.exit(main())
