#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes labelled meshes of CAD solids, as benchmark_engineering --data FOLDER --suffix _5k, _30k or _t reads them.

Sources are STEP, IGES, BREP and FCStd files, folders that are searched for such files, and scripts of build123d, which are
run in their folder: the solids in their variables are taken. A script may do all that you may do: run those that you trust.
--bd-warehouse takes parts of that package. The manual has the calls for the set whose names are in cad_solids.txt. Written are

  NAME_5k.off, NAME_30k.off   even meshes of about 5000 and 30000 triangles, by gmsh
  NAME_t.off                  what the kernel of the CAD system emits, slivers and fans
  NAME_*.seg                  line i: the segment of triangle i. Faces that touch and are of one surface are one segment
  NAME.json                   of each segment the type of surface and its numbers, in the unit of the solid, "surface" (apart
                              pieces of one surface share it), and of each mesh the quality
  brep/SOURCE/NAME.brep       the solids; a source that has its folder is not read or run again

Another run does what is missing. A solid is left out, and it is told why, where one of its meshes is no closed surface, has
another area than the solid, or vertices that are off the surface of their face.

Needs pip install build123d bd_warehouse gmsh scipy
"""

from __future__ import annotations

import argparse
import importlib
import itertools
import json
import math
import multiprocessing
import os
import re
import runpy
import shutil
import sys
import tempfile
import time
import types
import zipfile
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import build123d
import gmsh  # type: ignore[import-untyped]
import numpy as np
from OCP import (  # type: ignore[import-untyped]
    BRep,
    BRepAdaptor,
    BRepBuilderAPI,
    BRepMesh,
    GeomAbs,
    GeomAdaptor,
    GeomConvert,
    IGESControl,
    TopAbs,
    TopLoc,
)
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

EVEN_MESHES = {"_5k": 5000, "_30k": 30000}  # triangles, about
DEFLECTION = 5e-4  # of the diagonal, at most between the kernel's mesh and the solid
DEFLECTION_ANGLE = 0.2  # radians between two of its triangles
SAME_POINT = 1e-7  # of the diagonal; the kernel repeats the vertices at the edges of faces
SAME_SURFACE = 1e-6  # of the diagonal, and radians
SAME_APEX = 1e-4  # of the diagonal; the apex of a flat cone is known less well than its surface
SAME_CENTER = 1e-3  # of the diagonal, between centres of a face that gmsh and the kernel tell
SEWING = 1e-5  # of the diagonal, between faces of a file that has no solids
LEAST_FACES = 5  # balls, rods and cones have fewer, and show nothing
OFF_SURFACE = 1e-3  # of the diagonal; imprecise STEP files have half of it, wrong meshes far more
AREA_ERROR = 0.1  # relative; coarse small features have a fifth of it, a face that is missing or doubled more
MOST_TRIANGLES = 150000  # of a mesh; a solid that takes the kernel more would have most of the time of a benchmark

# Types of surfaces and what the kernel calls their numbers.
ANALYTIC = {
    GeomAbs.GeomAbs_Plane: ("Plane", {}),
    GeomAbs.GeomAbs_Cylinder: ("Cylinder", {"r": "Radius"}),
    GeomAbs.GeomAbs_Cone: ("Cone", {"semi_angle": "SemiAngle"}),
    GeomAbs.GeomAbs_Sphere: ("Sphere", {"r": "Radius"}),
    GeomAbs.GeomAbs_Torus: ("Torus", {"r": "MinorRadius", "R": "MajorRadius"}),
}
FILES = {".step", ".stp", ".iges", ".igs", ".brep", ".brp", ".fcstd"}
Array = np.ndarray[Any, np.dtype[Any]]
Surface = dict[str, Any]
Found = list[tuple[str, Any]]  # solids, each with the name of its variable, or nothing


class UnusableError(Exception):
    """Why a source or a solid is left out."""


@dataclass
class Source:
    """Where solids come from."""

    name: str
    origin: str
    solids: Callable[[], Found]


# Parts of bd_warehouse: module, class, arguments. Of those that come in sizes, solids_of_part() takes a middle one.
Part = tuple[str, str, tuple[Any, ...], dict[str, Any]]
NUTS = "DomedCapNut HeatSetNut HexNut SquareNut"
SCREWS = """ButtonHeadWithCollarScrew CheeseHeadScrew CounterSunkScrew HexHeadWithFlangeScrew PanHeadScrew
    PanHeadWithCollarScrew RaisedCheeseHeadScrew SetScrew ShoulderScrew SocketHeadCapScrew"""
BEARINGS = "AngularContactBall CylindricalRoller DeepGrooveBall TaperedRoller"
FLANGES = "BlindFlange LappedFlange SlipOnFlange WeldNeckFlange"
OPEN_BUILDS = """AcmeAntiBacklashNutBlock8mm CBeamEndMount CBeamGantryPlateXLarge CBeamRiserPlate EccentricSpacer LBracket
    RouterSpindleMount TNut XtremeSolidVWheel"""
SPROCKET = {"bore_diameter": 12, "bolt_circle_diameter": 30, "num_mount_bolts": 4, "mount_bolt_diameter": 4}
GEAR = {"module": 2, "tooth_count": 14, "pressure_angle": 20, "thickness": 8, "root_fillet": 0.5}
PARTS: list[Part] = [
    *(("fastener", name, (), {"simple": True}) for name in NUTS.split()),
    *(("fastener", name, (), {"simple": True, "length": 20}) for name in SCREWS.split()),
    ("fastener", "InternalToothLockWasher", (), {}),
    *(("bearing", f"SingleRow{name}Bearing", (), {}) for name in BEARINGS.split()),
    *(("flange", name, ("2", 300), {}) for name in FLANGES.split()),
    *(("open_builds", name, (), {}) for name in OPEN_BUILDS.split()),
    ("open_builds", "FlexibleCoupler", ("8mm",), {}),
    ("open_builds", "LockCollar", ("8mm",), {}),
    ("open_builds", "StepperMotor", ("Nema17",), {}),
    ("open_builds", "VSlotLinearRail", ("20x40", 60), {}),
    ("open_builds", "CBeamLinearRail", (50,), {}),
    ("retaining_ring", "ExternalSnapRing", (), {}),
    ("retaining_ring", "InternalSnapRing", (), {}),
    ("sprocket", "Sprocket", (16,), SPROCKET),
    ("gear", "SpurGear", (), GEAR),
]


def solids_of_part(module: str, name: str, arguments: tuple[Any, ...], options: dict[str, Any]) -> Found:
    """Make a part of bd_warehouse."""
    kind = getattr(importlib.import_module(f"bd_warehouse.{module}"), name)
    if module in ("fastener", "bearing"):
        chosen = (max if module == "fastener" else min)(kind.types())
        sizes = list(kind.sizes(chosen))
        common = [size for size in sizes if module == "fastener" and size.startswith(("M6", "M8"))]
        options = {**options, "size": (common or sizes[len(sizes) // 2 :])[0], f"{module}_type": chosen}
    elif module == "retaining_ring":
        options = {"size": list(kind.sizes())[10]}
    return [("", solid) for solid in kind(*arguments, **options).solids()]


class Viewer(types.ModuleType):
    """Takes the place of ocp_vscode, by which scripts show what they make."""

    __all__ = ("Camera", "reset_show", "set_defaults", "set_port", "show", "show_all", "show_clear", "show_object")

    def __getattr__(self, name: str) -> Callable[..., None]:
        """Give a function that does nothing."""
        return lambda *_arguments, **_options: None


def solids_in(value: Any) -> list[Any]:
    """Find the solids in the value of a variable."""
    if isinstance(value, (list, tuple)):
        return [solid for element in value for solid in solids_in(element)]
    if isinstance(value, build123d.BuildPart):
        value = value.part
    is_shape = isinstance(value, (build123d.Compound, build123d.Solid))
    return list(value.solids()) if is_shape else []


def solids_of_script(path: Path) -> Found:
    """Run a script in its folder and take the solids in its variables."""
    sys.modules["ocp_vscode"] = Viewer("ocp_vscode")
    sys.path.insert(0, str(path.parent))
    sys.argv = [str(path)]
    os.chdir(path.parent)
    variables = runpy.run_path(str(path), run_name="__main__")
    return [(name, solid) for name, value in variables.items() if name[0] != "_" for solid in solids_in(value)]


def read_iges(path: Path) -> Any:
    """Read a file whose faces are alone, as a rule: they are sewn to a solid."""
    reader = IGESControl.IGESControl_Reader()
    reader.ReadFile(str(path))
    reader.TransferRoots()
    shape = build123d.Shape.cast(reader.OneShape())
    if shape.solids():
        return shape
    sewing = BRepBuilderAPI.BRepBuilderAPI_Sewing(SEWING * shape.bounding_box().diagonal)
    sewing.Add(shape.wrapped)
    sewing.Perform()
    shells = build123d.Shape.cast(sewing.SewedShape()).shells()
    return build123d.Compound(children=[build123d.Solid(shell) for shell in shells if shell.is_valid])


def solids_of_file(path: Path) -> Found:
    """Read the solids of a file, or run the script that it is."""
    extension = path.suffix.lower()
    if extension == ".py":
        return solids_of_script(path)
    if extension in (".step", ".stp"):
        shapes = [build123d.import_step(path)]
    elif extension in (".iges", ".igs"):
        shapes = [read_iges(path)]
    elif extension in (".brep", ".brp"):
        shapes = [build123d.import_brep(path)]
    else:
        shapes = []
        with zipfile.ZipFile(path) as archive, tempfile.TemporaryDirectory() as folder:
            for entry in archive.namelist():
                if entry.endswith(".brp"):
                    shapes.append(build123d.import_brep(archive.extract(entry, folder)))
    return [("", solid) for shape in shapes if shape for solid in shape.solids()]


def collect(source: Source, folder: Path) -> str:
    """Write the distinct solids of a source, those of most faces first in each variable."""
    distinct: dict[tuple[int, float, float], tuple[str, Any]] = {}
    for variable, solid in source.solids():
        key = (len(solid.faces()), float(f"{solid.area:.4g}"), float(f"{solid.volume:.4g}"))
        if key[0] >= LEAST_FACES and solid.volume > 0:
            distinct.setdefault(key, (variable, solid))
    if not distinct:
        raise UnusableError(f"it has no solid of {LEAST_FACES} faces or more that encloses a volume")
    part = folder.with_name(f"{folder.name}.part")
    shutil.rmtree(part, ignore_errors=True)
    part.mkdir(parents=True)
    counts: dict[str, int] = {}
    for _, (variable, solid) in sorted(distinct.items(), key=lambda item: -item[0][0]):
        counts[variable] = counts.get(variable, 0) + 1
        number = str(counts[variable]) if counts[variable] > 1 else ""
        name = "-".join(word for word in (source.name, variable, number) if word)
        build123d.export_brep(solid, part / f"{name}.brep")
    part.rename(folder)
    return f"solids found: {len(distinct)}"


# ---- Surfaces and segments ----


def vector(value: Any) -> list[float]:
    """Give the coordinates of a point or direction of the kernel."""
    return [value.X(), value.Y(), value.Z()]


def numbers_of(adaptor: Any) -> Surface:
    """Tell type and numbers of a surface; what has no numbers is called b-spline."""
    name, numbers = ANALYTIC.get(adaptor.GetType(), ("", {}))
    if not name:
        return {"type": "bspline"}
    shape = getattr(adaptor, name)()
    surface: Surface = {"type": name.lower(), "p": vector(shape.Apex() if name == "Cone" else shape.Location())}
    if name != "Sphere":
        surface["d"] = vector(shape.Axis().Direction())
    return {**surface, **{key: getattr(shape, number)() for key, number in numbers.items()}}


def surface_of(face: Any, diagonal: float) -> Surface:
    """Tell the surface of a face. Free forms that are analytic surfaces in fact are taken for these."""
    adaptor = BRepAdaptor.BRepAdaptor_Surface(face.wrapped, True)
    surface = numbers_of(adaptor)
    if surface["type"] == "bspline":
        bounds = [getattr(adaptor, f"{end}{axis}Parameter")() for axis in "UV" for end in ("First", "Last")]
        converter = GeomConvert.GeomConvert_SurfToAnaSurf(BRep.BRep_Tool.Surface_s(face.wrapped))
        analytic = converter.ConvertToAnalytical(SAME_SURFACE * diagonal, *bounds)
        if analytic is not None:
            surface = numbers_of(GeomAdaptor.GeomAdaptor_Surface(analytic))
    return {**surface, "step_type": face.geom_type.name.lower()}


def distances(surface: Surface, points: Array) -> Array:
    """Give how far points are off an analytic surface."""
    offsets = points - np.array(surface["p"])
    axis = np.array(surface.get("d", [0, 0, 1]))
    heights = offsets @ axis
    radii = np.linalg.norm(offsets - np.outer(heights, axis), axis=1)
    angle = abs(surface.get("semi_angle", 0))
    values: dict[str, Array] = {
        "plane": heights,
        "cylinder": radii - surface.get("r", 0),
        "cone": radii * math.cos(angle) - abs(heights) * math.sin(angle),
        "sphere": np.hypot(radii, heights) - surface.get("r", 0),
        "torus": np.hypot(radii - surface.get("R", 0), heights) - surface.get("r", 0),
    }
    return np.abs(values[surface["type"]])


def is_same(a: Surface, b: Surface, diagonal: float) -> bool:
    """Tell whether two analytic surfaces are one."""
    if a["type"] != b["type"] or a["type"] == "bspline":
        return False
    if "d" in a and np.linalg.norm(np.cross(a["d"], b["d"])) > SAME_SURFACE:
        return False
    if any(abs(a[radius] - b[radius]) > SAME_SURFACE * diagonal for radius in ("r", "R") if radius in a):
        return False
    if abs(abs(a.get("semi_angle", 0)) - abs(b.get("semi_angle", 0))) > SAME_SURFACE:
        return False
    offset = np.subtract(b["p"], a["p"])
    if a["type"] == "plane":
        return bool(abs(offset @ a["d"]) < SAME_SURFACE * diagonal)
    if a["type"] == "cylinder":
        offset = offset - (offset @ a["d"]) * np.array(a["d"])
    return bool(np.linalg.norm(offset) < (SAME_APEX if a["type"] == "cone" else SAME_SURFACE) * diagonal)


def groups(count: int, pairs: Iterable[tuple[int, int]]) -> Array:
    """Give what is joined by pairs the same number, from 0 in the order of the first members."""
    ends = np.array(list(pairs), dtype=np.int64).reshape(-1, 2)
    _, labels = connected_components(coo_array((np.ones(len(ends)), ends.T), shape=(count, count)), directed=False)
    _, first, number = np.unique(labels, return_index=True, return_inverse=True)
    return np.asarray(np.argsort(np.argsort(first))[number])


def design_of(solid: Any) -> tuple[dict[str, Any], Array]:
    """Describe the segments of a solid for the JSON file, and give the segment of each face."""
    faces = solid.faces()
    diagonal = float(solid.bounding_box().diagonal)
    surfaces = [surface_of(face, diagonal) for face in faces]
    edges = [set(face.edges()) for face in faces]
    pairs = itertools.combinations(range(len(faces)), 2)
    same = [(a, b) for a, b in pairs if is_same(surfaces[a], surfaces[b], diagonal)]
    pieces = groups(len(faces), same)
    segments = groups(len(faces), [(a, b) for a, b in same if edges[a] & edges[b]])
    rows: list[dict[str, Any]] = []
    for index, segment in enumerate(segments):
        if segment == len(rows):
            numbers = {"surface": int(pieces[index]), "n_faces": 0, "area": 0.0}
            rows.append({"id": int(segment), **surfaces[index], **numbers})
        rows[segment]["n_faces"] += 1
        rows[segment]["area"] += faces[index].area
    counts = {"n_faces": len(faces), "n_segments": len(rows)}
    return {"diag": diagonal, "area": solid.area, **counts, "segments": rows, "meshes": {}}, segments


# ---- Meshes ----


@dataclass
class Mesh:
    """Triangles with the index of their face."""

    points: Array
    triangles: Array
    faces: Array


def mesh_of_kernel(solid: Any, diagonal: float) -> Mesh:
    """Mesh a solid as CAD systems do for display and export."""
    BRepMesh.BRepMesh_IncrementalMesh(solid.wrapped, DEFLECTION * diagonal, False, DEFLECTION_ANGLE, False)
    points: list[list[float]] = []
    triangles, labels = [], []
    for index, face in enumerate(solid.faces()):
        location = TopLoc.TopLoc_Location()
        part = BRep.BRep_Tool.Triangulation_s(face.wrapped, location)
        if part is None:
            raise UnusableError("the kernel does not mesh one of its faces")
        order = [0, 2, 1] if face.wrapped.Orientation() == TopAbs.TopAbs_REVERSED else [0, 1, 2]
        for triangle in range(1, part.NbTriangles() + 1):
            corners = part.Triangle(triangle).Get()
            triangles.append([len(points) + corners[i] - 1 for i in order])
        labels += [index] * part.NbTriangles()
        move = location.Transformation()
        points += [vector(part.Node(node).Transformed(move)) for node in range(1, part.NbNodes() + 1)]
    vertices = groups(len(points), cKDTree(points).query_pairs(SAME_POINT * diagonal))
    _, first = np.unique(vertices, return_index=True)
    joined = vertices[np.array(triangles)]
    kept = np.all(joined != np.roll(joined, 1, axis=1), axis=1)  # at the poles of faces some have no area
    return Mesh(np.array(points)[first], joined[kept], np.array(labels)[kept])


def even_mesh(faces: list[Any], area: float, count: int) -> Mesh:
    """Mesh the solid that gmsh has with triangles of one size."""
    size = math.sqrt(4 / math.sqrt(3) * area / count)
    gmsh.model.mesh.clear()
    options = {"MeshSizeMin": size, "MeshSizeMax": size, "MeshSizeFromCurvature": 0, "Algorithm": 6}
    for option, value in {**options, "MeshSizeExtendFromBoundary": 0, "MeshSizeFromPoints": 0}.items():
        gmsh.option.setNumber(f"Mesh.{option}", value)
    gmsh.model.mesh.generate(2)
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    place = np.zeros(int(max(tags)) + 1, dtype=np.int64)
    place[tags.astype(np.int64)] = np.arange(len(tags))
    of_faces = [place[gmsh.model.mesh.getElementsByType(2, tag)[1].astype(np.int64)].reshape(-1, 3) for tag in faces]
    labels = np.repeat(np.arange(len(of_faces)), [len(corners) for corners in of_faces])
    return Mesh(coordinates.reshape(-1, 3), np.vstack(of_faces), labels)


def faces_of_gmsh(path: Path, faces: list[Any], diagonal: float) -> list[int]:
    """Read a solid by gmsh and check that its faces are in the same order."""
    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Verbosity", 1)
    for option in ("FixDegenerated", "FixSmallEdges", "FixSmallFaces", "SewFaces", "MakeSolids"):
        gmsh.option.setNumber(f"Geometry.OCC{option}", 0)
    gmsh.model.occ.importShapes(str(path))
    gmsh.model.occ.synchronize()
    tags = [tag for _, tag in gmsh.model.getEntities(2)]
    places = [gmsh.model.occ.getCenterOfMass(2, tag) for tag in tags]
    centers = [tuple(face.center(build123d.CenterOf.MASS)) for face in faces]
    if len(tags) != len(faces) or not np.allclose(places, centers, rtol=0, atol=SAME_CENTER * diagonal):
        raise UnusableError("gmsh has the faces in another order")
    return tags


def check(mesh: Mesh, design: dict[str, Any], labels: Array) -> dict[str, Any]:
    """Tell the quality of a mesh; raise an error where it cannot be used."""
    used, corners = np.unique(mesh.triangles, return_inverse=True)
    mesh.points, mesh.triangles = mesh.points[used], corners.reshape(-1, 3)
    edges = mesh.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    there, back = (np.unique(pairs @ [len(used), 1], return_counts=True) for pairs in (edges, edges[:, ::-1]))
    faults = int((there[1] > 1).sum()) + len(np.setxor1d(there[0], back[0])) // 2
    if faults:
        raise UnusableError(
            f"is no closed surface: {faults} edges are not between two triangles that turn the same way"
        )
    a, b, c = mesh.points[mesh.triangles].swapaxes(0, 1)
    area_error = abs(float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2 / design["area"] - 1)
    if area_error > AREA_ERROR:
        raise UnusableError(f"has an area that is wrong by {area_error:.2g} of that of the solid")
    if len(mesh.triangles) > MOST_TRIANGLES:
        raise UnusableError(f"has {len(mesh.triangles)} triangles, more than {MOST_TRIANGLES}")
    off = 0.0
    for row in design["segments"]:
        vertices = np.unique(mesh.triangles[labels == row["id"]])
        if row["type"] != "bspline" and len(vertices):
            off = max(off, float(distances(row, mesh.points[vertices]).max()) / design["diag"])
    if off > OFF_SURFACE:
        raise UnusableError(f"has vertices off the surface by {off:.1e} of the diagonal")
    missing = len(design["segments"]) - len(np.unique(labels))
    counts = {"triangles": len(mesh.triangles), "vertices": len(mesh.points), "missing_labels": missing}
    return {**counts, "area_error": area_error, "max_dist_to_surface_rel": off}


def write(path: Path, lines: Iterable[str]) -> None:
    """Write a file that is there as a whole or not at all."""
    part = path.with_name(f"{path.name}.part")
    with part.open("w", encoding="utf-8") as file:
        file.writelines(f"{line}\n" for line in lines)
    part.replace(path)


def make_meshes(path: Path, origin: str, folder: Path) -> str:
    """Write the files of a solid, NAME.json last."""
    solid = build123d.import_brep(path).solids()[0]
    faces = solid.faces()
    design, segments = design_of(solid)
    design.update({"name": path.stem, "source": origin})
    meshes = {"_t": mesh_of_kernel(solid, design["diag"])}
    tags = faces_of_gmsh(path, faces, design["diag"])
    meshes.update({suffix: even_mesh(tags, solid.area, count) for suffix, count in EVEN_MESHES.items()})
    for suffix, mesh in meshes.items():
        try:
            design["meshes"][suffix[1:]] = check(mesh, design, segments[mesh.faces])
        except UnusableError as error:
            raise UnusableError(f"{suffix} {error}") from None
    for suffix, mesh in meshes.items():
        points = ("{:.9g} {:.9g} {:.9g}".format(*point) for point in mesh.points)
        triangles = ("3 {} {} {}".format(*corners) for corners in mesh.triangles)
        sizes = f"{len(mesh.points)} {len(mesh.triangles)} 0"
        write(folder / f"{path.stem}{suffix}.seg", map(str, segments[mesh.faces]))
        write(folder / f"{path.stem}{suffix}.off", itertools.chain(["OFF", sizes], points, triangles))
    write(folder / f"{path.stem}.json", [json.dumps(design, indent=0)])
    counts = ", ".join(f"{suffix} {len(mesh.triangles)}" for suffix, mesh in meshes.items())
    return f"{len(faces)} faces, {len(design['segments'])} segments, triangles {counts}"


# ---- The program ----


def run_quietly(answer: Any, work: Callable[[], str]) -> None:
    """Do a piece of work and send what came of it; what scripts and the kernel print is dropped."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in (1, 2):
        os.dup2(nowhere, stream)
    try:
        answer.send((True, work()))
    except UnusableError as error:
        answer.send((False, str(error)))
    except (Exception, SystemExit) as error:
        answer.send((False, f"{type(error).__name__}: {error}".splitlines()[0]))


def done(what: str, work: Callable[[], str], seconds: float) -> bool:
    """Do a piece of work in a process of its own, which may crash or take too long, and print what came of it."""
    start = time.monotonic()
    mine, theirs = multiprocessing.Pipe(duplex=False)
    process = multiprocessing.Process(target=run_quietly, args=(theirs, work))
    process.start()
    theirs.close()
    is_done, text = False, f"it took more than {seconds:g} s"
    if mine.poll(seconds):
        try:
            is_done, text = mine.recv()
        except EOFError:
            text = "the process crashed"
    process.kill()
    process.join()
    print(f"{what}: {'' if is_done else 'left out: '}{text}, {time.monotonic() - start:.0f} s", flush=True)
    return is_done


def sources_of(paths: list[Path], with_warehouse: bool) -> list[Source]:
    """Find the sources, in the order of the paths."""
    files: list[Path] = []
    for path in paths:
        files += [file for file in sorted(path.rglob("*")) if file.suffix.lower() in FILES] if path.is_dir() else [path]
    found = [Source(file.stem, file.name, partial(solids_of_file, file.resolve())) for file in files]
    for module, name, arguments, options in PARTS if with_warehouse else []:
        make = partial(solids_of_part, module, name, arguments, options)
        found.append(Source(f"bd_warehouse_{name}", f"bd_warehouse.{module}.{name}", make))
    sources: dict[str, Source] = {}
    for source in found:
        source.name = re.sub(r"[^\w.-]", "_", source.name)
        if sources.setdefault(source.name, source) is not source:
            print(f"{source.origin}: left out: there is another source of the name {source.name}", flush=True)
    return list(sources.values())


def main() -> int:
    """Collect the solids and mesh them."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="where the files are written")
    parser.add_argument("sources", type=Path, nargs="*", help="files, folders and Python scripts with solids")
    parser.add_argument("--bd-warehouse", action="store_true", help="also parts of the package bd_warehouse")
    parser.add_argument("--only", type=Path, metavar="FILE", help="make the solids alone that FILE names, one a line")
    parser.add_argument("--seconds", type=float, default=420, help="for a source or a solid at most (%(default)g)")
    arguments = parser.parse_args()
    if not (arguments.sources or arguments.bd_warehouse):
        parser.error("no source is named")
    for path in arguments.sources:
        if not (path.is_dir() or (path.is_file() and path.suffix.lower() in FILES | {".py"})):
            parser.error(f"{path} is no folder, script or file of {', '.join(sorted(FILES))}")
    wanted = set(arguments.only.read_text(encoding="utf-8").split()) if arguments.only else None
    folder: Path = arguments.folder.resolve()
    solids: list[tuple[Path, str]] = []
    for source in sources_of(arguments.sources, arguments.bd_warehouse):
        if wanted is not None and not any(f"{name}-".startswith(f"{source.name}-") for name in wanted):
            continue
        kept = folder / "brep" / source.name
        if kept.is_dir() or done(source.origin, partial(collect, source, kept), arguments.seconds):
            solids += [(path, source.origin) for path in sorted(kept.glob("*.brep"))]
    solids = [solid for solid in solids if wanted is None or solid[0].stem in wanted]
    missing = [solid for solid in solids if not (folder / f"{solid[0].stem}.json").exists()]
    failed = 0
    for number, (path, origin) in enumerate(missing, start=1):
        work = partial(make_meshes, path, origin, folder)
        failed += not done(f"[{number}/{len(missing)}] {path.stem}", work, arguments.seconds)
    print(f"{len(solids) - failed} solids, {len(missing) - failed} of them new; {failed} left out")
    for name in sorted((wanted or set()) - {path.stem for path, _ in solids}):
        print(f"{name}: not found in the sources")
    return 0 if len(solids) > failed else 1


if __name__ == "__main__":
    sys.exit(main())
