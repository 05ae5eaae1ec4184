# SPDX-License-Identifier: MIT
"""What is in the package: licences of what was compiled, types, names, and the sentence for what is missing."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import pytest

import rw_segmentation as rw

ROOT = Path(__file__).resolve().parents[2]


def headers_by_ninja(build: Path) -> dict[str, set[Path]]:
    """List for each compiled file all headers that it was compiled from, as the compiler has told Ninja."""
    cache = (build / "CMakeCache.txt").read_text()
    ninja = re.search(r"CMAKE_MAKE_PROGRAM:\w+=(.*)", cache)
    assert ninja
    listed = subprocess.run(
        [ninja.group(1), "-C", build, "-t", "deps"], capture_output=True, text=True, check=True
    ).stdout
    headers: dict[str, set[Path]] = {}
    name = ""
    for line in listed.splitlines():
        if line.startswith(" "):
            headers[name].add(build / line.strip())
        elif ":" in line:
            name = line.split(":")[0]
            headers[name] = set()
    return headers


def licence_of(path: Path) -> str:
    """Read the SPDX line of a header."""
    found = re.search(r"SPDX-License-Identifier: *(.*)", path.read_text(errors="replace")[:4000])
    return found.group(1) if found else ""


def is_gpl(licence: str) -> bool:
    """Tell whether a licence asks for the GPL: the LGPL does not."""
    return re.search(r"(?<!L)GPL", licence) is not None


def test_no_gpl_part_of_cgal_is_compiled_in() -> None:
    tag = f"cp3{min(sys.version_info.minor, 12)}"  # from 3.12 on there is one wheel for all
    builds = [path.parent for path in (ROOT / "build/python").glob(f"{tag}-*/build.ninja")]
    assert builds, "the wheel is built by scripts/test-python"
    compiled = headers_by_ninja(builds[0])
    ours = {name: found for name, found in compiled.items() if "nanobind" not in name}
    headers = set().union(*ours.values())
    sources = {path for path in headers if path.suffix == ".cpp"}  # several may be one unit
    assert len(sources) >= len(list((ROOT / "python/src").glob("*.cpp"))) + len(list((ROOT / "src").glob("*.cpp")))
    cgal = {path for path in headers if "/CGAL/" in str(path)}
    assert len(cgal) > 50
    assert [str(path) for path in sorted(cgal) if is_gpl(licence_of(path))] == []
    assert any(is_gpl(licence_of(path.parents[0] / "Surface_mesh.h")) for path in cgal if path.name == "version.h"), (
        "the look at licences would not see the GPL where it is"
    )


def test_the_wheel_has_what_it_needs_and_no_more() -> None:
    files = metadata.files("rw-segmentation")
    assert files is not None
    names = {path.name for path in files if path.parts[0] == "rw_segmentation" and path.suffix != ".pyc"}
    assert {"py.typed", "_core.pyi", "__init__.py"} <= names
    assert all(name.endswith((".py", ".pyi", ".so", ".pyd", "py.typed")) for name in names)
    assert any(path.name == "LICENSE" for path in files)
    required = metadata.requires("rw-segmentation") or []
    assert [line for line in required if "extra ==" not in line] == ["numpy>=1.24"]


def test_the_module_links_nothing_that_a_system_may_not_have() -> None:
    module = next(Path(rw.__file__).parent.glob("_core.*.so"))
    linked = subprocess.run(["ldd", module], capture_output=True, text=True, check=True).stdout
    names = {line.split()[0].split("/")[-1].split(".so")[0] for line in linked.splitlines()}
    assert names <= {
        "linux-vdso",
        "libstdc++",
        "libm",
        "libgcc_s",
        "libc",
        "libpthread",
        "ld-linux-x86-64",
        "ld-linux-aarch64",
    }


def test_every_public_function_describes_its_parameters() -> None:
    import inspect

    for name in rw.__all__:
        thing = getattr(rw, name)
        if not inspect.isfunction(thing) and not inspect.isclass(thing):
            continue
        assert thing.__doc__, name
        if not inspect.isfunction(thing):
            continue
        described = thing.__doc__ + (rw.segment.__doc__ or "")
        for parameter in inspect.signature(thing).parameters:
            assert re.search(rf"\b{parameter}\b", described), f"{name} does not describe {parameter}"


def test_versions_agree() -> None:
    header = (ROOT / "include/RW_segmentation/version.h").read_text()
    numbers = re.findall(r"#define RW_SEGMENTATION_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", header)
    assert rw.__version__ == ".".join(numbers) == metadata.version("rw-segmentation")


@pytest.mark.skipif(shutil.which("cmake") is None, reason="pip brings CMake of its own to build with")
def test_a_build_without_the_headers_says_what_to_install(tmp_path: Path) -> None:
    run = subprocess.run(
        ["cmake", "-S", ROOT / "python", "-B", tmp_path, "-DCMAKE_DISABLE_FIND_PACKAGE_CGAL=ON",
         f"-DPython_EXECUTABLE={sys.executable}"],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert run.returncode != 0
    said = " ".join(run.stderr.split())
    assert "needs the headers of CGAL." in said
    assert "apt install libcgal-dev libeigen3-dev libboost-dev" in said
