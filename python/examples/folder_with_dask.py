# SPDX-License-Identifier: MIT
"""A folder of meshes on several processes, by Dask: ``python folder_with_dask.py FOLDER OUTPUT``.

Workers are processes, as one mesh keeps one core busy. A mesh that fails does not end the work: its reason is told.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import trimesh
from dask.distributed import Client, LocalCluster, as_completed

import rw_segmentation as rw


def segment_file(path: Path, output: Path) -> tuple[str, int, str]:
    """Segment a mesh and write its labels; tells its name, the number of segments, and why there are none."""
    try:
        mesh = trimesh.load_mesh(path, process=False)
        labels = rw.segment(*rw.from_trimesh(mesh))
        temporary = output / f".{path.stem}.npy"
        np.save(temporary, labels)
        temporary.replace(output / f"{path.stem}.npy")
        return path.name, len(np.unique(labels)), ""
    except Exception as error:
        return path.name, 0, str(error)


def main() -> None:
    """Segment all meshes of a folder."""
    folder, output = Path(sys.argv[1]), Path(sys.argv[2])
    output.mkdir(exist_ok=True)
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as cluster, Client(cluster) as client:
        files = sorted(path for path in folder.iterdir() if path.suffix in (".off", ".ply", ".obj", ".stl"))
        for done in as_completed(client.map(segment_file, files, output=output)):
            name, segments, reason = done.result()
            print(f"{name}: {reason or f'{segments} segments'}")


if __name__ == "__main__":
    main()
