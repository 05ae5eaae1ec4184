# SPDX-License-Identifier: MIT
"""The tool reads what programs write that are not of this project."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from readers import reader

gmsh, lib3mf, meshio, pyvista, trimesh, vtk = map(reader, ["gmsh", "lib3mf", "meshio", "pyvista", "trimesh", "vtk"])


def read_by_tool(tool: Path, mesh: Path) -> tuple[Any, dict[str, Any]]:
    """Give what the tool has read, as it writes it, and its report."""
    out, report = mesh.parent / "read_by_tool.ply", mesh.parent / "report.json"
    subprocess.run([str(tool), str(mesh), "--seed", "0", "--quiet", "-o", out, "--report", report], check=True)
    return trimesh.load(out), json.loads(report.read_text())


@pytest.fixture(scope="module")
def gmsh_files(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Let Gmsh write a box with a cylinder on it: triangles alone, with tetrahedra, and curved."""
    folder = tmp_path_factory.mktemp("gmsh")
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.model.occ.addBox(0, 0, 0, 1, 2, 3)
        gmsh.model.occ.addCylinder(0.5, 1, 1, 0, 0, 4, 0.3)
        gmsh.model.occ.fuse([(3, 1)], [(3, 2)])
        gmsh.model.occ.synchronize()
        gmsh.option.setNumber("Mesh.MeshSizeMax", 0.5)
        gmsh.option.setNumber("Mesh.SaveAll", 1)
        for kind in ("faces", "volumes", "curved"):
            gmsh.model.mesh.generate(3 if kind == "volumes" else 2)
            if kind == "curved":
                gmsh.model.mesh.setOrder(2)
            for version in (2.2, 4.1):
                for is_binary in (0, 1):
                    gmsh.option.setNumber("Mesh.MshFileVersion", version)
                    gmsh.option.setNumber("Mesh.Binary", is_binary)
                    gmsh.write(str(folder / f"{kind}_{version}_{is_binary}.msh"))
            if kind == "faces":
                gmsh.option.setNumber("Mesh.Binary", 0)
                gmsh.write(str(folder / "faces.mesh"))
                meshio.read(folder / "faces.mesh").write(folder / "faces.meshb", file_format="medit")
    finally:
        gmsh.finalize()
    return folder


def test_all_that_gmsh_and_meshio_write_is_the_same_solid(gmsh_files: Path, tool: Path) -> None:
    files = sorted(path for path in gmsh_files.iterdir() if path.suffix in (".msh", ".mesh", ".meshb"))
    assert len(files) == 14
    cells = meshio.read(gmsh_files / "faces.mesh")
    expected = trimesh.Trimesh(cells.points, cells.cells_dict["triangle"])
    assert expected.is_watertight
    for path in files:
        mesh, report = read_by_tool(tool, path)
        assert mesh.is_watertight, path.name
        assert len(mesh.faces) == report["faces"]
        if not path.name.startswith("curved"):  # which have a mesh of their own
            assert mesh.volume == pytest.approx(expected.volume, rel=1e-6), path.name
            assert mesh.area == pytest.approx(expected.area, rel=1e-6), path.name
        remarks = "".join(report["repairs"])
        assert ("elements of volume" in remarks) == path.name.startswith("volumes")
        assert ("curved faces" in remarks) == path.name.startswith("curved")


def vtk_file(mesh: Any, path: Path, change: dict[str, Any]) -> None:
    """Let VTK write a mesh, by a writer that some methods have been called of."""
    writer = vtk.vtkXMLPolyDataWriter()
    writer.SetInputData(mesh)
    writer.SetFileName(str(path))
    for method, value in change.items():
        getattr(writer, method)(*([] if value is None else [value]))
    assert writer.Write() == 1


DATA = {
    "text": {"SetDataModeToAscii": None},
    "base64": {"SetDataModeToBinary": None},
    "appended": {"SetDataModeToAppended": None, "EncodeAppendedDataOff": None},
    "appended_base64": {"SetDataModeToAppended": None, "EncodeAppendedDataOn": None},
}
NUMBERS = {
    "little": {"SetByteOrderToLittleEndian": None, "SetHeaderTypeToUInt32": None},
    "big": {"SetByteOrderToBigEndian": None, "SetHeaderTypeToUInt64": None},
}
PACKING = {"plain": {"SetCompressorTypeToNone": None}, "zlib": {"SetCompressorTypeToZLib": None}}


@pytest.mark.parametrize("packing", PACKING)
@pytest.mark.parametrize("numbers", NUMBERS)
@pytest.mark.parametrize("data", DATA)
def test_vtk_writes_what_the_tool_reads(data: str, numbers: str, packing: str, tool: Path, tmp_path: Path) -> None:
    ball = pyvista.Sphere(theta_resolution=40, phi_resolution=40).points_to_double()
    block = pyvista.Box((4, 7, 4, 6, 4, 5), level=5, quads=True).clean().points_to_double()
    strips = pyvista.Cylinder(center=(-9, 0, 0), resolution=20).triangulate().strip()
    change = DATA[data] | NUMBERS[numbers] | PACKING[packing] | {"SetBlockSize": 2048}
    for name, mesh in {"ball": ball, "block": block, "strips": strips}.items():
        path = tmp_path / f"{name}.vtp"
        vtk_file(mesh, path, change)
        read, report = read_by_tool(tool, path)
        expected = pyvista.read(path).triangulate()
        assert report["faces"] == (expected.n_cells if name == "strips" else mesh.n_cells)
        np.testing.assert_allclose(read.area, expected.area, rtol=1e-6)
        np.testing.assert_allclose(read.volume, expected.volume, rtol=1e-5)
        np.testing.assert_allclose(read.bounds.T.reshape(-1), expected.bounds, atol=1e-6)


@pytest.mark.parametrize(("method", "cause"), [("SetCompressorTypeToLZ4", "LZ4"), ("SetCompressorTypeToLZMA", "LZMA")])
def test_other_compressions_of_vtk_are_refused_by_their_names(
    method: str, cause: str, tool: Path, tmp_path: Path
) -> None:
    vtk_file(pyvista.Sphere(), tmp_path / "ball.vtp", {method: None})
    refusal = subprocess.run([str(tool), "ball.vtp"], cwd=tmp_path, capture_output=True, text=True)
    assert refusal.returncode == 2
    assert f"vtk{cause}DataCompressor" in refusal.stderr
    assert refusal.stderr.count("\n") == 1


@pytest.mark.parametrize("extension", ["glb", "gltf", "3mf"])
def test_scenes_are_read_with_the_places_and_names_of_their_parts(extension: str, tool: Path, tmp_path: Path) -> None:
    scene = trimesh.Scene()
    scene.add_geometry(trimesh.creation.icosphere(subdivisions=2), node_name="ball")
    place = np.diag([-1.0, 1.0, 2.0, 1.0])  # mirrored and stretched
    place[0, 3] = 5
    scene.add_geometry(trimesh.creation.box((1, 2, 3)), node_name="block", transform=place)
    scene.export(tmp_path / f"scene.{extension}")
    command = [str(tool), f"scene.{extension}", "--seed", "0", "-q"]
    refusal = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    if "that is built with Assimp" in refusal.stderr and os.environ.get("CI") != "true":
        pytest.skip("the tool was built without Assimp")
    assert refusal.returncode == 0, refusal.stderr
    mesh, report = read_by_tool(tool, tmp_path / f"scene.{extension}")
    assert mesh.is_watertight
    np.testing.assert_allclose(mesh.bounds, scene.bounds, atol=1e-6)
    assert mesh.volume == pytest.approx(scene.to_geometry().volume, rel=1e-5)
    assert report["repairs"] == []
    assert [part["faces"] for part in report["parts"]] == [320, 12]
    if extension != "3mf":  # trimesh gives objects of 3MF files no names
        assert [part["name"] for part in report["parts"]] == ["ball", "block"]
    assert sorted(segment["faces"] for segment in report["segments"]) == [12, 320]


def test_lib3mf_writes_what_the_tool_reads(tool: Path, tmp_path: Path) -> None:
    """Objects of components, one of them mirrored, on the build platform twice."""
    ball, block = trimesh.creation.icosphere(subdivisions=2), trimesh.creation.box((1, 2, 3))
    library = lib3mf.get_wrapper()
    model = library.CreateModel()
    model.SetUnit(lib3mf.ModelUnit.Inch)

    def object_of(mesh: Any, name: str) -> Any:
        made = model.AddMeshObject()
        made.SetName(name)
        made.SetGeometry(
            [lib3mf.Position(tuple(map(float, p))) for p in mesh.vertices],
            [lib3mf.Triangle(tuple(map(int, t))) for t in mesh.faces],
        )
        return made

    def moved(x: float, scale: float = 1) -> Any:
        return lib3mf.Transform(((scale, 0, 0), (0, 1, 0), (0, 0, 1), (x, 0, 0)))

    both = model.AddComponentsObject()
    both.AddComponent(object_of(ball, 'b<a>ll & "co"'), moved(5))
    both.AddComponent(object_of(block, "block"), moved(-5, -2))
    model.AddBuildItem(both, moved(0))
    model.AddBuildItem(both, moved(100))
    model.QueryWriter("3mf").WriteToFile(str(tmp_path / "scene.3mf"))

    mesh, report = read_by_tool(tool, tmp_path / "scene.3mf")
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(2 * (ball.volume + 2 * block.volume), rel=1e-5)
    np.testing.assert_allclose(mesh.bounds, [[-6, -1, -1.5], [106, 1, 1.5]], atol=1e-6)
    assert [part["faces"] for part in report["parts"]] == 2 * [320, 12]
    assert [part["name"] for part in report["parts"]] == 2 * ['b<a>ll & "co"', "block"]
    assert report["repairs"] == ["coordinates are in the unit of the file, 'inch'"]


def test_a_broken_scene_is_refused_in_one_line(tool: Path, tmp_path: Path) -> None:
    for name, content in {
        "cut.glb": b"glTF\x02\0\0\0\xff\xff\xff\xff",
        "no.dae": b"<COLLADA>",
        "x.fbx": b"\0" * 99,
    }.items():
        (tmp_path / name).write_bytes(content)
        refusal = subprocess.run([str(tool), name], cwd=tmp_path, capture_output=True, text=True)
        assert refusal.returncode == 2
        assert refusal.stderr.startswith(f"segment_mesh: {name}: ")
        assert "Assimp" in refusal.stderr
        assert refusal.stderr.count("\n") == 1
