# SPDX-License-Identifier: MIT
"""Every format that the tool writes is read by a program that is not of this project, which finds the segments."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from meshes import read_off
from readers import reader

gmsh, lib3mf, meshio, pandas, pygltflib, pyvista, trimesh = map(
    reader, ["gmsh", "lib3mf", "meshio", "pandas", "pygltflib", "pyvista", "trimesh"]
)

SEED_LABELS = [("0", 0), ("1", 3), ("2", 7)]


@dataclass
class Written:
    """A mesh that the tool has segmented, and what it wrote."""

    folder: Path
    source: Path
    vertices: NDArray[np.float64]
    labels: NDArray[np.int64]
    color_of_label: dict[int, tuple[int, int, int]]

    def path(self, extension: str) -> str:
        """Name the file of a format."""
        return str(self.folder / f"out{extension}")

    def faces(self) -> list[list[int]]:
        """Give the corners of each face."""
        rows = [row for row in self.source.read_text().splitlines() if row][-len(self.labels) :]
        return [[int(word) for word in row.split()[1:]] for row in rows]

    def areas(self) -> dict[int, float]:
        """Sum the areas of the faces of each label."""
        areas: dict[int, float] = {}
        for face, label in zip(self.faces(), self.labels, strict=True):
            areas[int(label)] = areas.get(int(label), 0) + polygon_area(self.vertices[face])
        return areas


def polygon_area(corners: NDArray[np.float64]) -> float:
    """Compute the area of a flat polygon."""
    apex = corners[0]
    return float(np.linalg.norm(np.sum(np.cross(corners[1:-1] - apex, corners[2:] - apex), axis=0)) / 2)


def areas_of(triangles: NDArray[np.float64], labels: NDArray[Any]) -> dict[int, float]:
    """Sum the areas of triangles, given by their corners, of each label."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    areas = np.linalg.norm(normals, axis=1) / 2
    return {int(label): float(areas[labels == label].sum()) for label in np.unique(labels)}


# A prism on a polygon that is not convex, of quads and hexagons.
PRISM = """OFF
12 8 0
0 0 0
3 0 0
3 1 0
1 1 0
1 3 0
0 3 0
0 0 1
3 0 1
3 1 1
1 1 1
1 3 1
0 3 1
6 5 4 3 2 1 0
6 6 7 8 9 10 11
4 0 1 7 6
4 1 2 8 7
4 2 3 9 8
4 3 4 10 9
4 4 5 11 10
4 5 0 6 11
"""


@pytest.fixture(scope="session", params=["prism", "hand"])
def written(
    request: pytest.FixtureRequest, tool: Path, data: Path, tmp_path_factory: pytest.TempPathFactory
) -> Written:
    """Let the tool write a mesh of polygons or one of triangles in all formats."""
    folder = tmp_path_factory.mktemp("files")
    mesh = data / "hand.off"
    if request.param == "prism":
        mesh = folder / "prism.off"
        mesh.write_text(PRISM)
    extensions = [".stl", ".glb", ".3mf", ".msh", ".mesh", ".vtp"]
    command = [str(tool), str(mesh), "--quiet", "--report", str(folder / "report.json")]
    for face, label in SEED_LABELS:
        command += ["--seed", f"{face}={label}"]
    outputs = [argument for extension in extensions for argument in ("-o", str(folder / f"out{extension}"))]
    text = ["-o", str(folder / "text.stl"), "--output-format", "stl-text"]
    for more in (outputs, text, ["--labels", str(folder / "out.seg")], ["--labels", str(folder / "labels.npz")],
                 ["--labels", str(folder / "labels.csv")], ["--probabilities", str(folder / "p.npz")],
                 ["--probabilities", str(folder / "p.csv")]):  # fmt: skip
        subprocess.run([*command, *more], check=True)
    report = json.loads((folder / "report.json").read_text())
    colors = {segment["label"]: tuple(segment["color"]) for segment in report["segments"]}
    assert sorted(colors) == [0, 3, 7]
    return Written(folder, mesh, read_off(mesh).vertices, np.loadtxt(folder / "out.seg", dtype=np.int64), colors)


def expect_areas(found: dict[int, float], written: Written) -> None:
    """Compare the areas of segments with those of the labels."""
    assert found == pytest.approx(written.areas(), rel=1e-5)


def test_text_stl_has_a_solid_for_each_segment(written: Written) -> None:
    scene = trimesh.load(str(written.folder / "text.stl"), file_type="stl_ascii")
    expect_areas({int(name.split("_")[1]): solid.area for name, solid in scene.geometry.items()}, written)


def test_binary_stl_has_colors(written: Written) -> None:
    mesh = trimesh.load(written.path(".stl"), process=False)
    attributes = mesh.face_attributes["stl"].view("<u2").reshape(-1)
    labels = np.full(len(attributes), -1)
    for label, (red, green, blue) in written.color_of_label.items():
        labels[attributes == (1 << 15 | red >> 3 << 10 | green >> 3 << 5 | blue >> 3)] = label
    expect_areas(areas_of(mesh.triangles, labels), written)


def test_glb_has_a_primitive_and_a_material_for_each_segment(written: Written) -> None:
    scene = trimesh.load(written.path(".glb"), process=False)
    found = {}
    for part in scene.geometry.values():
        label = int(part.visual.material.name.split("_")[1])
        found[label] = part.area
        srgb = np.asarray(written.color_of_label[label]) / 255
        linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
        np.testing.assert_allclose(np.asarray(part.visual.material.baseColorFactor[:3]) / 255, linear, atol=0.003)
    expect_areas(found, written)
    gltf = pygltflib.GLTF2().load(written.path(".glb"))
    assert [primitive.extras["label"] for primitive in gltf.meshes[0].primitives] == [0, 3, 7]
    points = np.frombuffer(gltf.binary_blob(), "<f4", 3 * gltf.accessors[0].count).reshape(-1, 3)
    np.testing.assert_array_equal(np.float32(gltf.accessors[0].min), points.min(axis=0))
    np.testing.assert_array_equal(np.float32(gltf.accessors[0].max), points.max(axis=0))


def test_3mf_has_an_object_and_a_material_for_each_segment(written: Written) -> None:
    model = lib3mf.get_wrapper().CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(written.path(".3mf"))
    assert reader.GetWarningCount() == 0
    found = {}
    objects = model.GetMeshObjects()
    while objects.MoveNext():
        part = objects.GetCurrentMeshObject()
        label = int(part.GetName().split("_")[1])
        vertices = np.array([tuple(v.Coordinates) for v in part.GetVertices()])
        triangles = vertices[np.array([tuple(t.Indices) for t in part.GetTriangleIndices()])]
        found.update(areas_of(triangles, np.full(len(triangles), label)))
        resource, number, _ = part.GetObjectLevelProperty()
        color = model.GetBaseMaterialGroupByID(resource).GetDisplayColor(number)
        assert (color.Red, color.Green, color.Blue) == written.color_of_label[label]
    expect_areas(found, written)
    assert model.GetBuildItems().Count() == len(found)


def test_msh_has_a_physical_group_for_each_segment(written: Written) -> None:
    mesh = meshio.read(written.path(".msh"))
    found: dict[int, float] = {}
    for cells, groups in zip(mesh.cells, mesh.cell_data["gmsh:physical"], strict=True):
        (group,) = np.unique(groups)
        triangles = mesh.points[cells.data]
        for area in areas_of(triangles, np.full(len(triangles), group - 1)).items():
            found[area[0]] = found.get(area[0], 0) + area[1]
    expect_areas(found, written)
    assert sorted(mesh.field_data) == ["segment_0", "segment_3", "segment_7"]
    # Those of each segment come together.
    np.testing.assert_array_equal(np.unique(mesh.points, axis=0), np.unique(written.vertices, axis=0))


def test_gmsh_meshes_the_segments_as_surfaces(written: Written) -> None:
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(written.path(".msh"))
        groups = {gmsh.model.getPhysicalName(2, tag) for _, tag in gmsh.model.getPhysicalGroups(2)}
        assert groups == {"segment_0", "segment_3", "segment_7"}
        gmsh.model.mesh.createTopology()
        gmsh.model.mesh.createGeometry()
        gmsh.option.setNumber("Mesh.MeshSizeMin", 0.2)
        gmsh.option.setNumber("Mesh.MeshSizeMax", 0.2)
        gmsh.model.mesh.generate(2)
        for _, tag in gmsh.model.getPhysicalGroups(2):
            surfaces = gmsh.model.getEntitiesForPhysicalGroup(2, tag)
            assert sum(len(gmsh.model.mesh.getElements(2, s)[1][0]) for s in surfaces) > 0
    finally:
        gmsh.finalize()


def test_medit_has_a_reference_for_each_triangle_and_ridges_between_segments(written: Written) -> None:
    mesh = meshio.read(written.path(".mesh"))
    references = mesh.cell_data_dict["medit:ref"]
    expect_areas(areas_of(mesh.points[mesh.cells_dict["triangle"]], references["triangle"]), written)
    sides: dict[tuple[int, int], set[int]] = {}
    for triangle, label in zip(mesh.cells_dict["triangle"], references["triangle"], strict=True):
        for a, b in zip(triangle, np.roll(triangle, 1), strict=True):
            sides.setdefault((min(a, b), max(a, b)), set()).add(int(label))
    between = {side for side, labels in sides.items() if len(labels) > 1}
    assert {(min(a, b), max(a, b)) for a, b in mesh.cells_dict["line"]} == between


def test_vtp_has_labels_and_colors_of_cells(written: Written) -> None:
    mesh = pyvista.read(written.path(".vtp"))
    np.testing.assert_array_equal(mesh.cell_data["segment"], written.labels)
    colors = [written.color_of_label[int(label)] for label in written.labels]
    np.testing.assert_array_equal(mesh.cell_data["color"], colors)
    np.testing.assert_array_equal(mesh.points, written.vertices)
    faces = [corner for face in written.faces() for corner in (len(face), *face)]
    np.testing.assert_array_equal(mesh.faces, faces)


def test_numpy_and_pandas_read_labels_and_probabilities(written: Written) -> None:
    labels = np.load(written.folder / "labels.npz")["labels"]
    np.testing.assert_array_equal(labels, written.labels)
    table = pandas.read_csv(written.folder / "labels.csv")
    np.testing.assert_array_equal(table["label"], written.labels)
    np.testing.assert_array_equal(table["face"], np.arange(len(labels)))
    archive = np.load(written.folder / "p.npz")
    np.testing.assert_array_equal(archive["labels"], [0, 3, 7])
    np.testing.assert_allclose(archive["probabilities"].sum(axis=1), 1)
    np.testing.assert_array_equal(archive["labels"][archive["probabilities"].argmax(axis=1)], written.labels)
    frame = pandas.read_csv(written.folder / "p.csv", index_col="face")
    np.testing.assert_array_equal(frame[["0", "3", "7"]], archive["probabilities"])


@pytest.mark.parametrize("format_name", ["stl", "stl-text", "3mf", "glb", "vtp"])
def test_parts_are_written_in_any_format(format_name: str, tool: Path, tmp_path: Path) -> None:
    (tmp_path / "prism.off").write_text(PRISM)
    seeds = [argument for face, label in SEED_LABELS for argument in ("--seed", f"{face}={label}")]
    command = [str(tool), "prism.off", "--split", "parts", "--output-format", format_name, "--quiet", *seeds]
    subprocess.run(command, check=True, cwd=tmp_path)
    extension = format_name.split("-")[0]
    names = sorted(path.name for path in (tmp_path / "parts").iterdir())
    assert names == [f"segment_{label}.{extension}" for label in (0, 3, 7)]


@pytest.fixture(scope="module")
def capped(tool: Path, data: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Let the tool cut a hand into solids."""
    folder = tmp_path_factory.mktemp("capped")
    command = [str(tool), str(data / "hand.off"), "--quiet", "--segments", "6", "--cap-parts", "--report", "report.json",
               "-o", "hand.3mf", "--output-format", "3mf", "--split", "parts"]  # fmt: skip
    subprocess.run(command, check=True, cwd=folder)
    return folder


def volume_of(path: Path) -> float:
    """Read the volume of all solids of a file."""
    scene = trimesh.load_scene(str(path))
    return float(sum(solid.volume for solid in scene.geometry.values()))


def test_capped_parts_are_solids_to_trimesh(capped: Path) -> None:
    segments = json.loads((capped / "report.json").read_text())["segments"]
    volumes = {segment["label"]: segment["volume"] for segment in segments}
    assert len(volumes) == 6
    for label, volume in volumes.items():
        (solid,) = trimesh.load_scene(str(capped / f"parts/segment_{label}.3mf")).geometry.values()
        assert solid.is_watertight
        assert solid.is_winding_consistent
        assert solid.volume == pytest.approx(volume)
    assert volume_of(capped / "hand.3mf") == pytest.approx(sum(volumes.values()))


def test_capped_parts_are_solids_to_lib3mf(capped: Path) -> None:
    for path, number in ((capped / "hand.3mf", 6), *((part, 1) for part in (capped / "parts").iterdir())):
        model = lib3mf.get_wrapper().CreateModel()
        reader = model.QueryReader("3mf")
        reader.SetStrictModeActive(True)
        reader.ReadFromFile(str(path))
        assert reader.GetWarningCount() == 0
        objects = model.GetMeshObjects()
        assert objects.Count() == number
        while objects.MoveNext():
            assert objects.GetCurrentMeshObject().IsManifoldAndOriented()


def check_folder(tool: Path, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run the program that checks answers on a folder."""
    program = Path(__file__).resolve().parents[2] / "benchmark/check_folder.py"
    return subprocess.run(
        [sys.executable, str(program), str(tool), str(folder), "--", "--seed", "0"], capture_output=True, text=True
    )


def test_answers_to_a_folder_are_checked_by_a_second_reader(tool: Path, tmp_path: Path) -> None:
    meshes = tmp_path / "meshes"
    (meshes / "more").mkdir(parents=True)
    trimesh.creation.icosphere(subdivisions=2).export(meshes / "sphere.stl")
    trimesh.creation.box().export(meshes / "more/box.obj")
    (meshes / "page.off").write_text("<html></html>")
    (meshes / "readme.txt").write_text("no mesh")
    checked = check_folder(tool, meshes)
    assert checked.returncode == 0, checked.stdout + checked.stderr
    assert "3 meshes: 2 right, 0 that trimesh does not read, 1 refused by both, 0 different" in checked.stdout

    # A tool that writes the same wrong answer to all.
    wrong = tmp_path / "wrong"
    wrong.write_text(f'#!/bin/sh\nshift\nexec {tool} {meshes / "more/box.obj"} "$@"\n')
    wrong.chmod(0o755)
    checked = check_folder(wrong, meshes)
    assert checked.returncode == 1
    assert "sphere.stl: the box is" in checked.stdout


def drum_off(sides: int) -> str:
    """Write a cylinder of radius 1 and height 2 on the plane z = 0, its lids fans round their centres."""
    angles = 2 * np.pi * np.arange(sides) / sides
    ring = np.column_stack([np.cos(angles), np.sin(angles)])
    points = [(x, y, z) for z in (0.0, 2.0) for x, y in ring] + [(0.0, 0.0, 0.0), (0.0, 0.0, 2.0)]
    faces = []
    for i in range(sides):
        j = (i + 1) % sides
        faces += [
            (i, j, sides + j),
            (i, sides + j, sides + i),
            (j, i, 2 * sides),
            (sides + i, sides + j, 2 * sides + 1),
        ]
    lines = ["OFF", f"{len(points)} {len(faces)} 0"]
    lines += [" ".join(map(repr, map(float, point))) for point in points]
    lines += [f"3 {a} {b} {c}" for a, b, c in faces]
    return "\n".join(lines) + "\n"


@pytest.fixture(scope="session")
def drum(tool: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Let the tool write a solid for CAD systems in all formats, from a mesh in centimetres."""
    output = subprocess.run([tool, "--help"], check=True, capture_output=True, text=True).stdout
    if "this one lacks it" in output and os.environ.get("CI") != "true":
        pytest.skip("segment_mesh was built without Open CASCADE")
    folder = tmp_path_factory.mktemp("cad")
    (folder / "drum.off").write_text(drum_off(48))
    outputs = [word for ending in ("step", "iges", "brep") for word in ("-o", f"drum.{ending}")]
    subprocess.run([tool, "drum.off", "--engineering", "--unit", "cm", "--quiet", *outputs], check=True, cwd=folder)
    return folder


@pytest.mark.parametrize("ending", ["step", "iges", "brep"])
def test_gmsh_reads_and_fills_the_solid(drum: Path, ending: str) -> None:
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(str(drum / f"drum.{ending}"))
        types = sorted(gmsh.model.getType(*surface) for surface in gmsh.model.getEntities(2))
        assert types == ["Cylinder", "Cylinder", "Plane", "Plane"]
        solids = gmsh.model.getEntities(3)
        assert len(solids) == 1
        # Gmsh's own unit is the millimetre.
        assert gmsh.model.occ.getMass(*solids[0]) == pytest.approx(2000 * np.pi, rel=1e-6)
        gmsh.model.mesh.generate(3)
        assert sum(len(tags) for tags in gmsh.model.mesh.getElements(3)[1]) > 0
    finally:
        gmsh.finalize()


def test_freecad_reads_a_closed_solid(drum: Path) -> None:
    program = shutil.which("freecadcmd")
    if program is None:
        pytest.skip("FreeCAD is not installed")
    script = drum / "read.py"
    script.write_text(
        "import json, Part\n"
        "shape = Part.read('drum.step')\n"
        "types = sorted(type(face.Surface).__name__ for face in shape.Faces)\n"
        "print('FOUND ' + json.dumps([shape.isValid(), len(shape.Solids), shape.Volume, types]))\n"
    )
    output = subprocess.run([program, str(script)], check=True, capture_output=True, text=True, cwd=drum).stdout
    found = next(line for line in output.splitlines() if line.startswith("FOUND "))
    is_valid, solids, volume, types = json.loads(found.removeprefix("FOUND "))
    assert is_valid
    assert solids == 1
    assert volume == pytest.approx(2000 * np.pi, rel=1e-6)
    assert types == ["Cylinder", "Cylinder", "Plane", "Plane"]
