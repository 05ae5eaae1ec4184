# SPDX-License-Identifier: MIT
"""The accessor ``rw`` of PyVista's surfaces, which PyVista finds by its entry point: ``mesh.rw.segment()``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import pyvista

from rw_segmentation._arrays import mesh_of
from rw_segmentation.adapters import face_colors, from_pyvista
from rw_segmentation.segmentation import segment

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from rw_segmentation.boundaries import BoundaryCurve

# Light from everywhere, so that the sides of a shape keep the colours of the palette.
_AMBIENT = 0.3
# By how much lines are drawn in front of the faces that they run between, in VTK's units of depth.
_IN_FRONT = (-2, -30)


@pyvista.register_dataset_accessor("rw", pyvista.PolyData)
class SegmentationAccessor:
    """Segments of a surface: ``mesh.rw.segment()``, ``mesh.rw.plot_segments()``."""

    def __init__(self, mesh: pyvista.PolyData) -> None:
        self._mesh = mesh

    def segment(self, segments: int | None = None, *, name: str = "segment", **options: Any) -> pyvista.PolyData:
        """Segment the surface and fill ``cell_data[name]``; cells that are no faces get -1.

        Parameters
        ----------
        segments : int, optional
            How many; by default as many as the shape suggests.
        name : str
            Of the array.
        **options
            Those of `rw_segmentation.segment()`: policy, difference, face_features, seeds, walls, repair, progress.

        Returns
        -------
        pyvista.PolyData
            The mesh itself.
        """
        vertices, faces = from_pyvista(self._mesh)
        self._fill(name, segment(vertices, faces, segments, **options))
        return self._mesh

    def plot_segments(
        self,
        name: str = "segment",
        *,
        colors: Mapping[int, tuple[int, int, int]] | None = None,
        curves: list[BoundaryCurve] | None = None,
        boundary_color: Any = "black",
        boundary_width: float = 3,
        plotter: pyvista.Plotter | None = None,
        **options: Any,
    ) -> Any:
        """Draw the segments in colours that people with any colour-vision deficiency tell apart, and their boundaries.

        Parameters
        ----------
        name : str
            Of the array in ``cell_data``; where it is missing, the surface is segmented first.
        colors : mapping from int to three int, optional
            Of each label, so that several pictures have the same ones; by default those of `segment_colors()`.
        curves : list of BoundaryCurve, optional
            Smooth boundaries to draw, see `smooth_boundaries()`; by default the edges between segments.
        boundary_color, boundary_width
            Of the boundaries; a width of 0 draws none.
        plotter : pyvista.Plotter, optional
            What to draw on; it is returned and not shown.
        **options
            Those of ``pyvista.Plotter.show()``, such as ``screenshot`` or ``cpos``, and ``off_screen``, ``window_size`` and
            ``smooth_shading``.

        Returns
        -------
        pyvista.Plotter, or what its ``show()`` returns
        """
        if name not in self._mesh.cell_data:
            self.segment(name=name)
        vertices, faces = from_pyvista(self._mesh)
        labels = np.asarray(self._mesh.cell_data[name])[self._faces()].astype(np.int64)
        created = {key: options.pop(key) for key in ("off_screen", "window_size") if key in options}
        canvas = pyvista.Plotter(**created) if plotter is None else plotter
        shading = bool(options.pop("smooth_shading", False))
        shown = self._mesh.copy(deep=False)
        shown.clear_data()
        shades = np.full((self._mesh.n_cells, 3), 128, dtype=np.uint8)
        shades[self._faces()] = face_colors(vertices, faces, labels, colors)
        shown.cell_data["colors"] = shades
        canvas.add_mesh(shown, scalars="colors", rgb=True, smooth_shading=shading, ambient=_AMBIENT)
        lines = self._edges_between(labels) if curves is None else _polylines(curves)
        if boundary_width > 0 and lines.n_cells > 0:
            actor = canvas.add_mesh(lines, color=boundary_color, line_width=boundary_width, lighting=False)
            actor.mapper.SetResolveCoincidentTopologyToPolygonOffset()
            actor.mapper.SetRelativeCoincidentTopologyLineOffsetParameters(*_IN_FRONT)
        return canvas if plotter is not None else canvas.show(**options)

    def boundaries(self, name: str = "segment") -> pyvista.PolyData:
        """List the edges between segments, as lines."""
        return self._edges_between(np.asarray(self._mesh.cell_data[name])[self._faces()].astype(np.int64))

    def _faces(self) -> slice:
        """Tell which cells are faces: points and lines come first."""
        first = self._mesh.n_verts + self._mesh.n_lines
        return slice(first, first + self._mesh.GetNumberOfPolys())

    def _fill(self, name: str, labels: NDArray[np.int64]) -> None:
        values = np.full(self._mesh.n_cells, -1, dtype=np.int64)
        values[self._faces()] = labels
        self._mesh.cell_data[name] = values

    def _edges_between(self, labels: NDArray[np.int64]) -> pyvista.PolyData:
        faces, vertices = mesh_of(*from_pyvista(self._mesh), repair=True, warn=False).interior_edges()
        sides = labels[faces]
        ends = vertices[sides[:, 0] != sides[:, 1]]
        lines = pyvista.PolyData()
        if len(ends):
            lines.points = np.asarray(self._mesh.points)
            lines.lines = np.insert(ends, 0, 2, axis=1).reshape(-1)
        return lines


def _polylines(curves: list[BoundaryCurve]) -> pyvista.PolyData:
    lines = pyvista.PolyData()
    if not curves:
        return lines
    cells: list[NDArray[np.int64]] = []
    begin = 0
    for curve in curves:
        numbers = np.arange(begin, begin + len(curve.points))
        numbers = np.append(numbers, begin) if curve.is_closed else numbers
        cells.append(np.insert(numbers, 0, len(numbers)))
        begin += len(curve.points)
    lines.points = np.concatenate([curve.points for curve in curves])
    lines.lines = np.concatenate(cells)
    return lines
