# SPDX-License-Identifier: MIT
"""Clean labels from coarse or partial probabilities: the random walk with priors."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Literal, NamedTuple

from rw_segmentation import _core
from rw_segmentation._arrays import Faces, mesh_of, numbers_of, walls_of
from rw_segmentation._progress import Progress, reporting
from rw_segmentation.segmentation import Difference, Policy, difference_of, policy_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

# python/benchmark/benchmark_refinement.py chose the two: of six natural shapes with a third of the votes wrong and a third
# missing, 0.36 % of the pairs of faces stay wrong. With a cap of 20, as for walks from seeds, 0.89 %: faces between creases are
# left to their own votes. With a reach of 0.03, 0.69 %.
REACH = 0.05  # parts of the root of the area
CAP = 3.0  # of difference / sigma


class Refined(NamedTuple):
    """Labels, shape (m,), and the probabilities that they are the highest of, shape (m, labels)."""

    labels: NDArray[np.int64]
    probabilities: NDArray[np.float64]


def refine(
    vertices: ArrayLike,
    faces: Faces,
    probabilities: ArrayLike,
    *,
    reach: float = REACH,
    policy: Literal["automatic", "paper"] | Policy = "automatic",
    difference: Difference = None,
    face_features: ArrayLike | None = None,
    walls: ArrayLike | None = None,
    repair: bool = True,
    progress: Progress = None,
) -> Refined:
    """Turn coarse, noisy or partial probabilities, such as a network's, into clean labels with boundaries on the creases.

    Parameters
    ----------
    vertices, faces, policy, difference, face_features, walls, repair, progress
        See `RandomWalk`; the cap of the policy is 3 by default, so that no face is cut off from all others.
    probabilities : array_like of float, shape (m, labels)
        How probable each label is at each face, or how many views vote for it: numbers >= 0. A row need not add up to 1; what
        it adds up to is how much the face counts. A row of zeros says that nothing is known, as of a face that no view shows.
    reach : float
        How far evidence is carried across a flat surface, as a part of the root of the area. With more of it, boundaries
        are smoother and small mistakes vanish; with less, labels keep to what is given.

    Returns
    -------
    Refined
        Labels, columns of `probabilities`, and probabilities whose rows add up to 1. A component that nothing is known of gets
        the next label that is not used, and zeros.

    Raises
    ------
    ValueError, Cancelled, KeyboardInterrupt
        See `segment()`; also if a probability is negative or not finite.

    Notes
    -----
    At each face f the walk may also end, with label k at the rate g a(f) p(f, k), a being the area. The probability x(f, k) to
    end with label k then solves

        sum over neighbours h of w(f, h) (x(f, k) - x(h, k)) + g a(f) s(f) x(f, k) = g a(f) p(f, k),   s(f) = sum of p(f, .),

    with the conductances w of the walk: Eq. 1-3 of Lai et al. (2008) with a prior at each face, as Grady (*Multilabel random
    walker image segmentation using prior models*, 2005) has it for images, (L + g sum of P) x = g p. g is h / (sqrt(3) l^2)
    for a mean edge length h and l = reach sqrt(area). It is solved exactly, as the walk from seeds is, each face with evidence
    having a seed of its own behind an edge of conductance g a s. Cost: that of a walk, for any number of labels a pass more.

    Examples
    --------
    >>> labels, chances = refine(vertices, faces, network_output)   # doctest: +SKIP
    """
    chosen = policy_of(policy)
    if chosen.base in ("coarse", "coarse_paper"):
        raise ValueError("policy: nothing is seeded here, choose automatic or paper")
    mesh = mesh_of(vertices, faces, repair)
    rows = numbers_of(probabilities, "probabilities", 2)
    name, values = difference_of(mesh, chosen, difference, face_features)
    choices = replace(chosen, cap=CAP if chosen.cap is None else chosen.cap).choices(None, name)
    with reporting(progress, "walk") as told:
        labels, refined = _core.refine(mesh, rows, float(reach), choices, values, walls_of(walls), told)
    return Refined(labels, refined)
