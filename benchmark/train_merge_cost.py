#!/usr/bin/env python3
"""Learns the trees of Learned_cost from people's segmentations and writes them as a header.

    train_merge_cost.py --data FOLDER --program build/benchmark/merge_cost_samples

FOLDER is laid out as the Princeton Segmentation Benchmark is. The program writes samples of every mesh as it is and
changed: with vertex noise of 0.1 and 0.3 % of the diagonal, with a fifth of the faces, and with each face split in four.
The trees of all meshes go to the header, those of each category left out, with all its changed meshes, to --folds, from
where benchmark_princeton --folds category reads them. The result depends on the samples alone, not on chance.

Needs LightGBM and NumPy (pip install lightgbm). Takes a minute besides the program's.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import textwrap
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import lightgbm
import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

# Changed meshes keep the trees from asking what depends on the mesh and not on the shape.
CHANGES = {
    "as they are": [],
    "noise of 0.1 % of the diagonal": ["--noise", "0.1"],
    "noise of 0.3 %": ["--noise", "0.3"],
    "a fifth of the faces": ["--faces", "0.2"],
    "each face split in four": ["--faces", "4"],
}
MESHES_OF_A_CATEGORY = 20

# Every tree asks a part of the features. More trees or leaves agree no better with people on categories left out.
TREES = 70
LEAVES = 6
PARAMETERS: dict[str, Any] = {
    "objective": "cross_entropy",
    "num_leaves": LEAVES,
    "learning_rate": 0.1,
    "feature_fraction": 0.5,
    "lambda_l2": 1.0,
    "min_data_in_leaf": 1000,
    "max_bin": 63,
    "seed": 0,
    "deterministic": True,
    "force_row_wise": True,
    "num_threads": 1,
    "verbose": -1,
}


@dataclass
class Samples:
    """Pairs of neighbouring regions.

    features: a row a pair; agreement: of people that the two are one segment, 0 to 1; weight: mean 1; mesh: by number.
    """

    names: list[str]
    features: Array
    agreement: Array
    weight: Array
    mesh: npt.NDArray[np.int64]


def read_samples(path: Path) -> tuple[list[str], Array]:
    """Reads what merge_cost_samples writes."""
    with path.open("rb") as file:
        names = file.readline().decode().split()
        return names, np.fromfile(file, dtype=np.float32).reshape(-1, len(names)).astype(np.float64)


def make_samples(program: Path, data: Path, folder: Path, processes: int) -> list[Path]:
    """Calls the program for each change; files that are there already are kept."""

    def make(number: int, options: list[str]) -> Path:
        path = folder / f"samples_{number}"
        if not path.exists():
            subprocess.run([program, "--data", data, *options, "--output", path], check=True)
        return path

    folder.mkdir(parents=True, exist_ok=True)
    with ThreadPoolExecutor(processes) as pool:
        return list(pool.map(make, range(len(CHANGES)), CHANGES.values()))


def join_samples(paths: list[Path]) -> Samples:
    names: list[str] = []
    parts = []
    for path in paths:
        names, rows = read_samples(path)
        parts.append(rows)
    rows = np.concatenate(parts)
    # What the Rand index counts are pairs of faces; their square root leaves small regions a say.
    weight = np.sqrt(rows[:, 2])
    return Samples(
        names[3:], rows[:, 3:], np.clip(rows[:, 1], 0, 1), weight / weight.mean(), rows[:, 0].astype(np.int64)
    )


Tree = tuple[list[tuple[int, float, int, int]], list[float]]


def as_tree(root: dict[str, Any]) -> Tree:
    """The splits (feature, threshold, yes, no) and leaves of a tree; a child -1 - k is leaf k."""
    splits: list[tuple[int, float, int, int]] = []
    leaves: list[float] = []

    def visit(node: dict[str, Any]) -> int:
        if "split_feature" not in node:
            leaves.append(float(node["leaf_value"]))
            return -len(leaves)
        place = len(splits)
        splits.append((0, 0.0, 0, 0))
        yes, no = visit(node["left_child"]), visit(node["right_child"])
        splits[place] = (int(node["split_feature"]), float(node["threshold"]), yes, no)
        return place

    visit(root)
    return splits, leaves


def train(dataset: lightgbm.Dataset) -> list[Tree]:
    booster = lightgbm.train(PARAMETERS, dataset, TREES)
    trees = [as_tree(tree["tree_structure"]) for tree in booster.dump_model()["tree_info"]]
    return [tree for tree in trees if tree[0]]


def write(path: Path, text: str) -> None:
    temporary = path.with_name(path.name + ".part")
    temporary.write_text(text)
    os.replace(temporary, path)


def rows_of(tree: Tree) -> tuple[list[tuple[int, float, int, int]], list[float]]:
    """A tree filled up to the size of Decision_tree."""
    splits, leaves = tree
    return splits + [(0, 0.0, -1, -1)] * (LEAVES - 1 - len(splits)), leaves + [0.0] * (LEAVES - len(leaves))


def folds_text(trees_without: dict[int, list[Tree]]) -> str:
    """For each category its number, the number of trees, and a line a tree: the splits, then the leaves."""
    lines = []
    for category, trees in trees_without.items():
        lines.append(f"{category} {len(trees)}")
        for tree in trees:
            splits, leaves = rows_of(tree)
            numbers = [f"{f} {t:.9g} {yes} {no}" for f, t, yes, no in splits] + [f"{x:.6g}" for x in leaves]
            lines.append(" ".join(numbers))
    return "\n".join(lines) + "\n"


def header_text(trees: list[Tree], samples: Samples, guard: str) -> str:
    meshes, categories = len(np.unique(samples.mesh)), len(np.unique((samples.mesh - 1) // MESHES_OF_A_CATEGORY))
    told = (
        f"Written by benchmark/train_merge_cost.py with LightGBM {lightgbm.__version__}: {len(trees)} trees, learned from "
        f"{len(samples.agreement)} pairs of regions of {meshes} meshes of {categories} categories of the Princeton "
        f"Segmentation Benchmark, {', '.join(CHANGES)}. Validated by leaving out each category in turn, with all its "
        "changed meshes: benchmark_princeton --folds category. The manual's page on segments without seeds has the "
        "figures."
    )
    lines = [
        "// SPDX-License-Identifier: MIT",
        "",
        f"#ifndef {guard}",
        f"#define {guard}",
        "",
        *("// " + line for line in textwrap.wrap(told, 117)),
        "",
        "#include <RW_segmentation/internal/merging/Boosted_trees.h>",
        "",
        "#include <array>",
        "",
        "namespace RW_segmentation::internal {",
        "",
        "// clang-format off",
        "/// What the trees ask, in the order of their numbers.",
        f"inline constexpr std::array<const char*, {len(samples.names)}> features_of_learned_cost = {{",
        *("    " + line for line in textwrap.wrap(", ".join(f'"{name}"' for name in samples.names) + "};", 113)),
        "",
        f"inline constexpr std::array<Decision_tree, {len(trees)}> trees_of_learned_cost = {{{{",
    ]
    for tree in trees:
        splits, leaves = rows_of(tree)
        questions = ", ".join(f"{{{f}, {t:.7g}, {yes}, {no}}}" for f, t, yes, no in splits)
        lines.append(f"    {{{{{{{questions}}}}}, {{{{{', '.join(f'{x:.5g}' for x in leaves)}}}}}}},")
    lines += ["}};", "// clang-format on", "", "}  // namespace RW_segmentation::internal", "", "#endif", ""]
    return "\n".join(lines)


def main() -> int:
    package = Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description="Learns the trees of Learned_cost and writes them as a header.")
    parser.add_argument("--data", type=Path, required=True, help="folder with data/off and data/seg/Benchmark")
    parser.add_argument("--program", type=Path, required=True, help="the program merge_cost_samples")
    parser.add_argument("--samples", type=Path, default=Path("samples"), help="folder for samples, 40 MB; kept")
    parser.add_argument("--folds", type=Path, default=Path("folds.txt"), help="trees of each category left out")
    parser.add_argument(
        "--header",
        type=Path,
        default=package / "include/RW_segmentation/internal/merging/trees_of_learned_cost.h",
        help="the header that is written",
    )
    parser.add_argument("--processes", type=int, default=2, help="programs at a time")
    options = parser.parse_args()

    samples = join_samples(make_samples(options.program, options.data, options.samples, options.processes))
    dataset = lightgbm.Dataset(
        samples.features, samples.agreement, weight=samples.weight, params=PARAMETERS, free_raw_data=False
    ).construct()
    category = (samples.mesh - 1) // MESHES_OF_A_CATEGORY
    trees_without = {int(c): train(dataset.subset(np.flatnonzero(category != c).tolist())) for c in np.unique(category)}
    write(options.folds, folds_text(trees_without))
    guard = "RW_SEGMENTATION_INTERNAL_MERGING_TREES_OF_LEARNED_COST_H"
    write(options.header, header_text(train(dataset), samples, guard))
    return 0


if __name__ == "__main__":
    sys.exit(main())
