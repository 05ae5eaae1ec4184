#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# tests_tiles.sh PROGRAM SEGMENT_MESH DATA_MESHES FOLDER OPTIONS COMMAND ...
# Runs a recipe for tiles, of which PROGRAM is needed, on a mesh in one tile and a second tile that touches it nowhere,
# and compares the labels with those of the tool by itself, with OPTIONS. Then one of the files in between is lost: the recipe
# must do what is left, with the same labels. The recipe works in FOLDER, where it finds `tiles`; it writes `work` and
# `outputs`. Returns 77 where the program is missing; in CI (CI=true) that is a failure.
set -euo pipefail
program=$1 tool=$2 data=$3 folder=$4 options=$5
shift 5
PATH=$(dirname "$tool"):$PATH
fail() { echo "FAILED: $1"; exit 1; }

if ! command -v "$program" >/dev/null; then
  [ "${CI:-}" != true ] || fail "$program is not installed"
  echo "SKIPPED: $program is not installed (scripts/install-dependencies)"
  exit 77
fi

rm -rf "$folder"
mkdir -p "$folder/tiles" "$folder/expected"
cd "$folder"
mesh=hand
[ "$options" != --engineering ] || mesh=pig  # surfaces take longest, and it has noise as well in a third of the faces
cp "$data/$mesh.off" "$data/tripod.off" tiles/
segment_mesh tiles/$mesh.off tiles/tripod.off --tiled --quiet $options --labels expected/%.seg

"$@" || fail "the recipe failed"
diff -r expected outputs || fail "the recipe gives other labels than the tool"
rm -r work/noise_of_all work/fragments_1 work/regions_1 work/labels_1 work/report outputs/tripod.seg
"$@" || fail "the second run failed"
diff -r expected outputs || fail "the second run gives other labels"
