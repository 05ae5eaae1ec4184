# SPDX-License-Identifier: MIT
"""Segments in one call, and the hierarchy that they are levels of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Union

import numpy as np

from rw_segmentation import _core
from rw_segmentation._arrays import Faces, integer_of, integers_of, mesh_of, numbers_of, walls_of
from rw_segmentation._progress import Progress, reporting
from rw_segmentation.measures import RADIUS, SMOOTHING, feature_difference_of_mesh

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

PolicyName = Literal["automatic", "paper", "coarse", "coarse_paper", "surfaces"]
DifferenceName = Literal["concavity", "dihedral", "curvature"]
# The name of a difference, or one number >= 0 for each interior edge, see `interior_edges()`.
Difference = Union[DifferenceName, "ArrayLike", None]
# Faces, whose places are their labels; rows of a face and a label; or a mapping from faces to labels.
Seeds = Union["ArrayLike", Mapping[int, int]]


@dataclass(frozen=True)
class Policy:
    """How segments are found: one of the library's ways, and what shall differ from it.

    What is None is left to `base`. The numbers mean what they mean in C++, see the chapter on parameters of the manual.

    Parameters
    ----------
    base : {"automatic", "paper", "coarse", "coarse_paper"}
        "automatic" agrees best with people; "paper" is what Lai et al. (2008) do; the coarse ones place a few seeds far apart,
        each of which is a segment.
    seeding : {"farthest", "particles", "coarse"}, optional
        Where automatic seeds are placed.
    number_of_seeds : int, optional
        How many, in each connected component (see `components`); 40 by default ("paper": 60, of the whole), or twice the number
        of segments if that is more.
    seedings : int, optional
        How many times they are placed, to merge by what all agree on; 2 by default, 1 with another seeding or merge cost.
    components : {"each", "whole"}, optional
        What tells how large parts are, and has so many seeds: each connected component by itself, though one of less than a
        hundredth of the largest one's area is one segment; or the whole mesh, the default with another seeding.
    merge_cost : {"learned", "size", "boundary"}, optional
        Which fragments are merged first: by what is learned from people (the default), by size, concavity and thickness
        alone, or by the concavity of boundaries as in the paper (the default of "paper").
    solver : {"star-mesh", "eigen"}, optional
        What computes the walk.
    smoothing : float, optional
        The smoothing length of normals as a part of the root of the area; 0 smooths nothing.
    convex_weight : float, optional
        How much convex creases count beside concave ones, from 0 to 1.
    measure : {"angle", "cosine"}, optional
        What is taken of the angle between faces.
    radius : float, optional
        Of the balls in which curvatures are measured, in mean edge lengths; for ``difference="curvature"``.
    sigma : float, optional
        The difference that divides the conductance by e; 1 is an average edge.
    cap : float, optional
        The largest difference / sigma that counts.
    """

    base: Literal["automatic", "paper", "coarse", "coarse_paper"] = "automatic"
    seeding: Literal["farthest", "particles", "coarse"] | None = None
    number_of_seeds: int | None = None
    seedings: int | None = None
    components: Literal["each", "whole"] | None = None
    merge_cost: Literal["learned", "size", "boundary"] | None = None
    solver: Literal["star-mesh", "eigen"] | None = None
    smoothing: float | None = None
    convex_weight: float | None = None
    measure: Literal["angle", "cosine"] | None = None
    radius: float | None = None
    sigma: float | None = None
    cap: float | None = None

    def __post_init__(self) -> None:
        """Refuse a base that there is not."""
        bases = ("automatic", "paper", "coarse", "coarse_paper")
        if self.base not in bases:
            raise ValueError(f"policy {self.base!r} is none of {', '.join(bases)}, surfaces")
        if self.number_of_seeds is not None:
            integer_of(self.number_of_seeds, "number_of_seeds", 1)
        if self.seedings is not None:
            integer_of(self.seedings, "seedings", 1)

    def choices(self, segments: int | None = None, difference: str | None = None) -> _core.Choices:
        """Make what the compiled module takes."""
        choices = _core.Choices()
        choices.is_paper = self.base in ("paper", "coarse_paper")
        choices.is_coarse = self.base in ("coarse", "coarse_paper")
        choices.seeds = self.number_of_seeds
        choices.seedings = self.seedings
        choices.segments = None if segments is None else integer_of(segments, "the number of segments", 0)
        choices.difference = difference
        for name in (
            "components",
            "seeding",
            "merge_cost",
            "solver",
            "smoothing",
            "convex_weight",
            "measure",
            "radius",
            "sigma",
            "cap",
        ):
            setattr(choices, name, getattr(self, name))
        return choices


class Hierarchy:
    """All levels of a segmentation, from fragments to one segment for each connected component.

    Made by `hierarchy()`. Regions are numbered: first the fragments, then each region that a merge makes. Levels are nested.
    """

    def __init__(self, core: _core.Hierarchy) -> None:
        self._core = core

    def labels(self, segments: int | None = None) -> NDArray[np.int64]:
        """Read a level off, without merging again.

        Parameters
        ----------
        segments : int, optional
            From `number_of_components` to `number_of_fragments`; by default as many as the shape suggests.

        Returns
        -------
        ndarray of int64, shape (m,)
            The segment of each face, from 0 without gaps.

        Raises
        ------
        ValueError
            If there are no such levels.
        """
        if segments is None:
            return self._core.labels(self.suggested)
        return self._core.labels(integer_of(segments, "the number of segments", 0))

    @property
    def number_of_fragments(self) -> int:
        """Regions before the first merge."""
        return self._core.number_of_fragments

    @property
    def number_of_components(self) -> int:
        """Regions after the last merge."""
        return self._core.number_of_components

    @property
    def suggested(self) -> int:
        """How many segments the shape suggests."""
        return self._core.suggested

    def levels(self, segments: int | None = None) -> list[int]:
        """List the numbers of segments that people may prefer: a given one, and a coarser and a finer one.

        The coarser level has from half to 1 / 1.4 times as many segments, the finer one from 1.4 times to twice as many. Each
        is the one of these whose next merge costs the most times what the merges before it did.

        Parameters
        ----------
        segments : int, optional
            From `number_of_components` to `number_of_fragments`; by default as many as the shape suggests.

        Returns
        -------
        list of int
            One to three numbers, rising.

        Raises
        ------
        ValueError
            If there is no level of so many segments.
        """
        number = self.suggested if segments is None else integer_of(segments, "the number of segments", 0)
        return self._core.levels(number)

    @property
    def merges(self) -> NDArray[np.int64]:
        """The two regions of each merge, shape (merges, 2)."""
        return self._core.merges

    @property
    def costs(self) -> NDArray[np.float64]:
        """What each merge costs; costs need not rise. By default merging stops before the first above 1."""
        return self._core.costs

    @property
    def fragment_of_face(self) -> NDArray[np.int64]:
        """The fragment of each face."""
        return self._core.fragment_of_face

    @property
    def report(self) -> dict[str, Any]:
        """What was odd but not wrong, and how many seconds each stage took."""
        return dict(self._core.report)

    def to_linkage(self, joined_at: float | None = None) -> NDArray[np.float64]:
        """Make the table of merges that `scipy.cluster.hierarchy` takes, for a dendrogram.

        Heights are the largest cost up to each merge, since those of a dendrogram must rise. Connected components, which are
        never merged, are joined at the top, one after the other.

        Parameters
        ----------
        joined_at : float, optional
            The height of that, at least that of the last merge; by default a tenth above it.

        Returns
        -------
        ndarray of float64, shape (fragments - 1, 4)
            Two regions, the height and the number of fragments of each merge.
        """
        count = self.number_of_fragments
        heights = np.maximum.accumulate(self.costs) if len(self.costs) else self.costs
        top = float(heights[-1]) * 1.1 if len(heights) else 1.0
        if joined_at is not None and not joined_at >= (heights[-1] if len(heights) else 0.0):
            raise ValueError(f"joined_at is {joined_at}, but must be at least the height of the last merge")
        rows = [(int(a), int(b), float(height)) for (a, b), height in zip(self.merges, heights, strict=True)]
        merged = {region for a, b, _ in rows for region in (a, b)}
        roots = [region for region in range(count + len(rows)) if region not in merged]
        while len(roots) > 1:
            rows.append((roots[0], roots[1], top if joined_at is None else joined_at))
            roots = [count + len(rows) - 1, *roots[2:]]
        sizes = np.ones(count + len(rows))
        for i, (a, b, _) in enumerate(rows):
            sizes[count + i] = sizes[a] + sizes[b]
        return np.array([(a, b, height, sizes[count + i]) for i, (a, b, height) in enumerate(rows)]).reshape(-1, 4)

    def __repr__(self) -> str:
        """Tell the numbers of levels."""
        return f"Hierarchy({self.number_of_fragments} fragments, {self.suggested} segments suggested)"


def policy_of(policy: PolicyName | Policy) -> Policy:
    """Make a policy of its name."""
    return policy if isinstance(policy, Policy) else Policy(base=policy)  # type: ignore[arg-type]


def difference_of_name(mesh: _core.Mesh, name: str, policy: Policy) -> NDArray[np.float64]:
    """Measure the difference that a policy's name stands for."""
    if name == "curvature":
        return _core.curvature_difference(mesh, RADIUS if policy.radius is None else policy.radius, True, None)
    if name not in ("concavity", "dihedral"):
        raise ValueError(f"difference: {name} is none of dihedral, concavity, curvature")
    is_concavity = name == "concavity"
    weight = (0.02 if is_concavity else 0.2) if policy.convex_weight is None else policy.convex_weight
    measure = ("angle" if is_concavity else "cosine") if policy.measure is None else policy.measure
    smoothing = (0.0 if policy.base == "paper" else SMOOTHING) if policy.smoothing is None else policy.smoothing
    return _core.dihedral_difference(mesh, weight, measure, smoothing, 0.0, None)


def difference_of(
    mesh: _core.Mesh, policy: Policy, difference: Difference, face_features: ArrayLike | None
) -> tuple[str | None, NDArray[np.float64] | None]:
    """Find the name of the difference, or the values of it."""
    name = difference if isinstance(difference, str) else None
    values = None if difference is None or name else numbers_of(difference, "the difference")
    if face_features is None:
        return name, values
    features = feature_difference_of_mesh(mesh, face_features)
    if name is not None:
        values = difference_of_name(mesh, name, policy)
    if values is None:
        return None, features
    if values.shape != features.shape:
        raise ValueError(f"the difference has {values.size} values, but the mesh {features.size} interior edges")
    return None, np.maximum(values, features)


def labelled_seeds(seeds: Seeds) -> list[tuple[int, int | None]]:
    """Make pairs of faces and labels; without labels where none are given."""
    if isinstance(seeds, Mapping):
        return [(integer_of(face, "seed"), integer_of(label, "the label")) for face, label in seeds.items()]
    array = integers_of(seeds, "seeds")
    if array.ndim == 2 and array.shape[1] == 2:
        return [(int(face), int(label)) for face, label in array]
    if array.ndim != 1:
        raise ValueError(f"seeds must be of shape (s,) or (s, 2), faces and labels, but are of shape {array.shape}")
    return [(int(face), None) for face in array]


def hierarchy(
    vertices: ArrayLike,
    faces: Faces,
    *,
    segments: int | None = None,
    policy: PolicyName | Policy = "automatic",
    difference: Difference = None,
    face_features: ArrayLike | None = None,
    seeds: ArrayLike | None = None,
    walls: ArrayLike | None = None,
    repair: bool = True,
    progress: Progress = None,
) -> Hierarchy:
    """Segment a mesh at all levels: seeds place themselves, walks from them make fragments, and fragments are merged.

    Parameters
    ----------
    vertices : array_like of float32 or float64, shape (n, 3)
        Coordinates.
    faces : array_like of int, shape (m, 3) or (m, k), or Polygons
        The vertices at the corners of each face, counterclockwise from outside.
    segments : int, optional
        How many will be read off at most: there are twice as many seeds, if that is more than there are otherwise.
    policy, difference, face_features, walls, repair, progress
        See `segment()`.
    seeds : array_like of int, shape (s,), optional
        Faces to start walks from besides the automatic ones, where a part is too small to get a seed by itself.

    Returns
    -------
    Hierarchy

    Raises
    ------
    ValueError, Cancelled, KeyboardInterrupt
        See `segment()`.
    """
    mesh = mesh_of(vertices, faces, repair)
    return hierarchy_of_mesh(mesh, segments, policy, difference, face_features, seeds, walls, progress)


def hierarchy_of_mesh(
    mesh: _core.Mesh,
    segments: int | None,
    policy: PolicyName | Policy,
    difference: Difference,
    face_features: ArrayLike | None,
    seeds: Seeds | None,
    walls: ArrayLike | None,
    progress: Progress,
) -> Hierarchy:
    """Segment a mesh that has been read."""
    given = labelled_seeds(seeds) if seeds is not None else []
    if any(label is not None for _, label in given):
        raise ValueError("seeds: labels have no meaning where fragments are merged, give faces alone")
    if policy == "surfaces":
        for argument, value in (("difference", difference), ("face_features", face_features), ("seeds", seeds)):
            if value is not None:
                raise ValueError(f"{argument}: surfaces are found without it, leave it out or choose another policy")
        with reporting(progress, "surfaces") as told:
            return Hierarchy(_core.hierarchy_of_surfaces(mesh, -1.0, 1.0, walls_of(walls), told))
    chosen = policy_of(policy)
    if chosen.base in ("coarse", "coarse_paper"):
        raise ValueError('the coarse policies merge nothing: give seeding="coarse" instead, or call segment()')
    name, values = difference_of(mesh, chosen, difference, face_features)
    faces_of_seeds = np.array([integer_of(face, "seed") for face, _ in given], dtype=np.int64)
    with reporting(progress, "segmentation") as told:
        return Hierarchy(
            _core.hierarchy(mesh, chosen.choices(segments, name), faces_of_seeds, values, walls_of(walls), told)
        )


def segment(
    vertices: ArrayLike,
    faces: Faces,
    segments: int | None = None,
    *,
    policy: PolicyName | Policy = "automatic",
    difference: Difference = None,
    face_features: ArrayLike | None = None,
    seeds: Seeds | None = None,
    walls: ArrayLike | None = None,
    repair: bool = True,
    progress: Progress = None,
) -> NDArray[np.int64]:
    """Segment a mesh in one call.

    Without seeds into as many segments as the shape suggests, or as many as asked for. With seeds and without a number each
    label of a seed becomes a segment; with both the seeds make fragments besides the automatic ones.

    Parameters
    ----------
    vertices : array_like of float32 or float64, shape (n, 3)
        Coordinates. Arrays of these types with their rows one after the other are not copied.
    faces : array_like of int, shape (m, 3) or (m, k), or Polygons
        The vertices at the corners of each face, counterclockwise from outside.
    segments : int, optional
        How many, at least one for each connected component.
    policy : {"automatic", "paper", "coarse", "coarse_paper", "surfaces"} or Policy
        How segments are found. "surfaces" is for parts of machines, see `segment_surfaces()`.
    difference : {"concavity", "dihedral", "curvature"} or array_like of float, shape (e,), optional
        What makes neighbouring faces differ, or by how much the two faces of each of the interior edges do, in the order of
        `interior_edges()`: numbers >= 0, 1 for an average edge.
    face_features : array_like of float, shape (m, k), optional
        Features of the faces, such as colours or what a network makes of them. Their distance over an edge, divided by the
        mean, is the difference; the larger of the two where `difference` is given, too.
    seeds : array_like of int, shape (s,) or (s, 2), or mapping, optional
        Faces, whose places are their labels; rows of a face and a label; or labels by face.
    walls : array_like of int, shape (w, 2), optional
        Edges, as pairs of vertices, that no walk, merge or surface crosses; see `sharp_edges()`.
    repair : bool
        Whether faces that do not form an oriented surface are repaired, with a `MeshRepairWarning`: vertices with equal
        coordinates are merged where borders coincide, neighbours oriented alike, and the surface is cut where more than two
        faces meet. Closed parts that are inside out are turned. A face that has to be left out gets the label of the closest.
    progress : bool or callable, optional
        True shows a bar of tqdm's. A function is called with the fraction done, and cancels by returning False.

    Returns
    -------
    ndarray of int64, shape (m,)
        The segment of each face: from 0 without gaps, or the labels of the seeds. A connected component without a seed gets
        the next label that is not used.

    Raises
    ------
    ValueError
        If arrays are of the wrong shape or type, an index is out of range, a coordinate or a difference not finite, the
        number of segments less than that of components or more than that of fragments, or choices do not go together.
    Cancelled
        A RuntimeError: the progress function has returned False.
    KeyboardInterrupt
        At Ctrl-C, within a fraction of a second on most meshes.

    Notes
    -----
    About O(m^1.3) time and O(m log m) memory for m faces; 2.4 s for 640,000 faces on one core. Other threads of Python run
    in the meantime, and may segment other meshes. The result depends on the mesh alone. After Lai, Hu, Martin, Rosin: *Fast
    Mesh Segmentation using Random Walks*, 2008.

    Examples
    --------
    >>> labels = segment(vertices, faces)             # as many as there are   # doctest: +SKIP
    >>> labels = segment(vertices, faces, 6)          # six                    # doctest: +SKIP
    >>> labels = segment(vertices, faces, seeds={167: 0, 1483: 1})             # doctest: +SKIP
    """
    mesh = mesh_of(vertices, faces, repair)
    if policy != "surfaces":
        chosen = policy_of(policy)
        is_coarse = chosen.base in ("coarse", "coarse_paper")
        if is_coarse and seeds is not None:
            raise ValueError("seeds: the coarse policies place their own, leave them out or choose another policy")
        if is_coarse or (seeds is not None and segments is None and chosen.number_of_seeds is None):
            if mesh.number_of_faces == 0:
                return np.zeros(0, dtype=np.int64)
            name, values = difference_of(mesh, chosen, difference, face_features)
            with reporting(progress, "walk") as told:
                walk = _core.Walk(mesh, chosen.choices(segments, name), values, None, walls_of(walls), told)
                add_seeds(walk, labelled_seeds(seeds if seeds is not None else []))
                return walk.labels(told)
    levels = hierarchy_of_mesh(mesh, segments, policy, difference, face_features, seeds, walls, progress)
    return levels.labels(segments)


def add_seeds(walk: _core.Walk, seeds: list[tuple[int, int | None]]) -> None:
    """Add seeds to a walk; those without a label get their places."""
    known: dict[int, int] = {}
    for place, (face, label) in enumerate(seeds):
        chosen = place if label is None else label
        if known.setdefault(face, chosen) != chosen:
            raise ValueError(f"seed {face}: another seed gives the same face the label {known[face]}")
        walk.add_seeds([integer_of(face, "seed")], integer_of(chosen, "the label"))
