# SPDX-License-Identifier: MIT
"""Colours of segments that people with any colour-vision deficiency tell apart."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from rw_segmentation._arrays import Faces, labels_of, mesh_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

# Eight hues that suit people with a colour-vision deficiency (Okabe and Ito 2008, grey in the place of black).
_HUES = np.array(
    [
        (0, 114, 178),
        (230, 159, 0),
        (0, 158, 115),
        (204, 121, 167),
        (86, 180, 233),
        (213, 94, 0),
        (240, 228, 66),
        (153, 153, 153),
    ],
    dtype=float,
)
# More shades are too close to white or black.
_SHADES = 7
# Where neighbours are given colours at least so far apart; black and white are at 1, 0.02 can just be seen.
_DISTINCT = 0.1

# From light to the colour space OKLab (Ottosson 2020), in which distances are about as large as they look.
_TO_CONES = np.array(
    [
        (0.4122214708, 0.5363325363, 0.0514459929),
        (0.2119034982, 0.6806995451, 0.1073969566),
        (0.0883024619, 0.2817188376, 0.6299787005),
    ]
)
_TO_LAB = np.array(
    [
        (0.2104542553, 0.7936177850, -0.0040720468),
        (1.9779984951, -2.4285922050, 0.4505937099),
        (0.0259040371, 0.7827717662, -0.8086757660),
    ]
)
# Light as it reaches people with all cones, and without those for red, green or blue (Machado, Oliveira, Fernandes 2009).
_VISIONS = np.array(
    [
        [(1, 0, 0), (0, 1, 0), (0, 0, 1)],
        [(0.152286, 1.052583, -0.204868), (0.114503, 0.786281, 0.099216), (-0.003882, -0.048116, 1.051998)],
        [(0.367322, 0.860646, -0.227968), (0.280085, 0.672501, 0.047413), (-0.011820, 0.042940, 0.968881)],
        [(1.255528, -0.076749, -0.178779), (-0.078411, 0.930809, 0.147602), (0.004733, 0.691367, 0.303900)],
    ]
)


@lru_cache(maxsize=1)
def palette() -> NDArray[np.uint8]:
    """List 56 colours: eight hues, then lighter and darker shades of them; shape (56, 3)."""
    shades = []
    for shade in range(_SHADES):
        end = 255.0 if shade % 2 == 1 else 0.0
        share = 1 - 0.6 ** ((shade + 1) // 2)
        shades.append(np.rint(_HUES + share * (end - _HUES)))
    return np.concatenate(shades).astype(np.uint8)


def apparent_distances(colors: ArrayLike) -> NDArray[np.float64]:
    """Measure how far apart colours look to those who tell them apart least.

    Parameters
    ----------
    colors : array_like of uint8, shape (c, 3)
        Red, green and blue.

    Returns
    -------
    ndarray of float64, shape (c, c)
        Black and white are at a distance of 1; 0.02 can just be seen.
    """
    share = np.asarray(colors, dtype=float) / 255
    light = np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)
    seen = np.clip(np.einsum("vij,cj->vci", _VISIONS, light), 0, 1)
    lab = np.cbrt(seen @ _TO_CONES.T) @ _TO_LAB.T
    distances: NDArray[np.float64] = np.linalg.norm(lab[:, :, None] - lab[:, None, :], axis=-1).min(axis=0)
    return distances


def segment_colors(
    vertices: ArrayLike, faces: Faces, labels: ArrayLike, *, repair: bool = True
) -> dict[int, tuple[int, int, int]]:
    """Choose a colour for each label, such that neighbours never look alike, also to people with a colour-vision deficiency.

    Parameters
    ----------
    vertices, faces, repair
        See `segment()`.
    labels : array_like of int, shape (m,)
        The segment of each face.

    Returns
    -------
    dict from int to tuple of three int
        Red, green and blue from 0 to 255 of each label. Those with the most neighbours choose first, of the colours that are
        far enough from the neighbours' the least used one.
    """
    mesh = mesh_of(vertices, faces, repair, warn=False)
    names, number = np.unique(labels_of(labels, mesh), return_inverse=True)
    sides = number.reshape(-1)[mesh.interior_edges()[0]]
    pairs = np.unique(np.sort(sides[sides[:, 0] != sides[:, 1]], axis=1), axis=0)
    neighbours: list[list[int]] = [[] for _ in names]
    for a, b in pairs.tolist():
        neighbours[a].append(b)
        neighbours[b].append(a)
    known = palette()
    distance = apparent_distances(known)
    choice: dict[int, int] = {}
    uses = np.zeros(len(known), dtype=int)
    for label in sorted(range(len(names)), key=lambda segment: -len(neighbours[segment])):
        taken = [choice[neighbour] for neighbour in neighbours[label] if neighbour in choice]
        nearest = np.minimum(distance[:, taken].min(axis=1), _DISTINCT) if taken else np.full(len(known), _DISTINCT)
        choice[label] = int(np.lexsort((np.arange(len(known)), uses, -nearest))[0])
        uses[choice[label]] += 1
    return {
        int(name): (int(known[choice[i]][0]), int(known[choice[i]][1]), int(known[choice[i]][2]))
        for i, name in enumerate(names)
    }
