# SPDX-License-Identifier: MIT
"""The random walk from seeds, as an object whose seeds are edited."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rw_segmentation import _core
from rw_segmentation._arrays import Faces, integer_of, integers_of, mesh_of, numbers_of, walls_of
from rw_segmentation._progress import Progress, reporting
from rw_segmentation.segmentation import Difference, Policy, difference_of, policy_of

if TYPE_CHECKING:
    from typing import Literal, NoReturn

    from numpy.typing import ArrayLike, NDArray


class RandomWalk:
    """The random walk on the faces of a mesh: seeds are added and removed, and labels asked for again.

    A walk at a face steps over an edge with a probability proportional to the edge's conductance and ends at the first seed it
    meets. A face belongs to the label whose seeds it most probably meets first. The first answer factorises; after an edit the
    next costs a fraction of that.

    Parameters
    ----------
    vertices : array_like of float32 or float64, shape (n, 3)
        Coordinates.
    faces : array_like of int, shape (m, 3) or (m, k), or Polygons
        The vertices at the corners of each face.
    policy : {"automatic", "paper"} or Policy
        The difference, smoothing, conductance and solver; see `segment()`.
    difference, face_features
        See `segment()`.
    conductance : array_like of float, shape (e,), optional
        How easily a walk crosses each interior edge, in place of what the difference and the policy's choices for it make; see
        `conductance()`.
    walls, repair, progress
        See `segment()`; progress is that of reading the mesh and measuring the difference.

    Raises
    ------
    ValueError
        As `segment()`.

    Notes
    -----
    Safe to be used from several threads: one after the other works with it. The arrays are read at once; later changes of them
    have no effect.

    Examples
    --------
    >>> walk = RandomWalk(vertices, faces)                # doctest: +SKIP
    >>> walk.add_seed(167, 0); walk.add_seed(1483, 1)     # doctest: +SKIP
    >>> labels, chances = walk.labels(), walk.probabilities()   # doctest: +SKIP
    """

    def __init__(
        self,
        vertices: ArrayLike,
        faces: Faces,
        *,
        policy: Literal["automatic", "paper"] | Policy = "automatic",
        difference: Difference = None,
        face_features: ArrayLike | None = None,
        conductance: ArrayLike | None = None,
        walls: ArrayLike | None = None,
        repair: bool = True,
        progress: Progress = None,
    ) -> None:
        chosen = policy_of(policy)
        if chosen.base in ("coarse", "coarse_paper"):
            raise ValueError("policy: the seeds of a RandomWalk are yours, choose automatic or paper")
        mesh = mesh_of(vertices, faces, repair)
        self._number_of_faces = mesh.number_of_faces
        name, values = difference_of(mesh, chosen, difference, face_features)
        conductances = None if conductance is None else numbers_of(conductance, "the conductance")
        if conductances is not None and (difference is not None or face_features is not None):
            raise ValueError("conductance: it takes the place of the difference, leave one of the two out")
        if conductances is not None:
            for choice in ("smoothing", "convex_weight", "measure", "radius", "sigma", "cap"):
                if getattr(chosen, choice) is not None:
                    raise ValueError(f"conductance: the policy's {choice} has no part in it, leave one of the two out")
        with reporting(progress, "difference") as told:
            self._core = _core.Walk(mesh, chosen.choices(None, name), values, conductances, walls_of(walls), told)

    def add_seed(self, face: int, label: int) -> None:
        """Make a face a seed, or give a seed another label.

        Raises
        ------
        ValueError
            If it is not a face of the mesh, or the label is negative.
        """
        self._core.add_seeds([integer_of(face, "seed")], integer_of(label, "the label"))

    def add_seeds(self, faces: ArrayLike, label: int) -> None:
        """Make several faces seeds of one label, such as those under a stroke of a brush.

        Raises
        ------
        ValueError
            If one of them is not a face of the mesh, or the label is negative; no face has become a seed then.
        """
        seeds = [integer_of(face, "seed") for face in integers_of(faces, "faces").ravel()]
        self._core.add_seeds(seeds, integer_of(label, "the label"))

    def remove_seed(self, face: int) -> bool:
        """Make a face an ordinary one again; tells whether it was a seed."""
        return self._core.remove_seed(integer_of(face, "seed"))

    def clear_seeds(self) -> None:
        """Make all faces ordinary ones."""
        self._core.clear_seeds()

    def anticipate(self, progress: Progress = None) -> None:
        """Work ahead, while a user looks at the mesh, for the first answer of two labels.

        It takes much longer than those after it: the faces are ordered, and, once there are seeds of one label, the walk is
        factorised. Where there are two labels already this does nothing.

        Raises
        ------
        Cancelled, KeyboardInterrupt
            See `segment()`; the walk may be asked again.
        """
        with reporting(progress, "walk") as told:
            self._core.anticipate(told)

    @property
    def seeds(self) -> dict[int, int]:
        """The label of each seed, in the order in which they were added."""
        return dict(self._core.seeds())

    @property
    def seed_labels(self) -> list[int]:
        """The labels of the seeds in ascending order: what the columns of `probabilities()` stand for."""
        return sorted(set(self.seeds.values()))

    @property
    def report(self) -> dict[str, int]:
        """What was odd but not wrong in the last answer: components without a seed, faces cut off from their seed."""
        return dict(self._core.report())

    def labels(self, progress: Progress = None) -> NDArray[np.int64]:
        """Find the label of each face.

        Returns
        -------
        ndarray of int64, shape (m,)
            The seeds' own labels, and the next unused ones for components without a seed.

        Raises
        ------
        ValueError
            If there is no seed.
        Cancelled, KeyboardInterrupt
            See `segment()`; the walk may be asked again.
        """
        with reporting(progress, "walk") as told:
            return self._core.labels(told)

    def probabilities(self, progress: Progress = None) -> NDArray[np.float64]:
        """Find the probability that a walk from each face meets a seed of each label first.

        Returns
        -------
        ndarray of float64, shape (m, labels)
            A column for each of `seed_labels`. Rows add up to 1, and to 0 where no seed can be reached.

        Raises
        ------
        ValueError, Cancelled, KeyboardInterrupt
            See `labels()`.
        """
        with reporting(progress, "walk") as told:
            return self._core.probabilities(told)[1]

    def __reduce__(self) -> NoReturn:
        """Refuse to be pickled: a walk is a factorisation that is made again from the mesh."""
        raise TypeError("a RandomWalk cannot be pickled or copied: make one of the mesh where it is needed")

    def __repr__(self) -> str:
        """Tell the numbers of faces and seeds."""
        return f"RandomWalk({self._number_of_faces} faces, {len(self.seeds)} seeds)"
