# SPDX-License-Identifier: MIT
"""How well `refine()` mends votes, by its numbers: ``python benchmark_refinement.py MESH ...``.

True labels are seven segments of each mesh. Votes are either those with a third of the faces wrong and a third missing, or
coarse ones: those of the nearest of 200 faces.
"""

from __future__ import annotations

import sys

import numpy as np
import trimesh
from numpy.typing import NDArray

import rw_segmentation as rw

SEGMENTS = 7
WRONG = MISSING = 1 / 3
COARSE = 200


def noisy(true: NDArray[np.int64], random: np.random.Generator) -> NDArray[np.float64]:
    """Make votes that are partly wrong and partly missing."""
    wrong = random.random(len(true)) < WRONG
    votes = np.eye(SEGMENTS)[np.where(wrong, random.integers(0, SEGMENTS, len(true)), true)]
    votes[random.random(len(true)) < MISSING] = 0
    return votes


def coarse(true: NDArray[np.int64], centers: NDArray[np.float64], random: np.random.Generator) -> NDArray[np.float64]:
    """Make votes whose boundaries are off."""
    chosen = random.choice(len(true), COARSE, replace=False)
    nearest = ((centers[:, None] - centers[None, chosen]) ** 2).sum(axis=2).argmin(axis=1)
    return np.eye(SEGMENTS)[true[chosen][nearest]]


def main() -> None:
    """Print the mean Rand index error over the meshes for each pair of numbers."""
    cases = []
    for path in sys.argv[1:]:
        mesh = trimesh.load_mesh(path, process=False)
        arrays = np.asarray(mesh.vertices), np.asarray(mesh.faces)
        true = rw.segment(*arrays, SEGMENTS)
        random = np.random.default_rng(1)
        cases.append((arrays, true, noisy(true, random), coarse(true, mesh.triangles_center, random)))
    for cap in (20, 5, 3, 2, 1):
        for reach in (0.02, 0.03, 0.05, 0.08):
            errors = [
                [
                    rw.segmentation_errors(
                        rw.refine(*arrays, votes, reach=reach, policy=rw.Policy(cap=cap)).labels, true
                    ).rand_index
                    for votes in (noise, blobs)
                ]
                for arrays, true, noise, blobs in cases
            ]
            noise_error, coarse_error = np.mean(errors, axis=0)
            print(f"RESULT cap {cap} reach {reach}: noisy votes {noise_error:.4f}, coarse votes {coarse_error:.4f}")


if __name__ == "__main__":
    main()
