#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# tests_collection.sh PROGRAM SEGMENT_MESH DATA_MESHES FOLDER COMMAND ...
# Runs a recipe for a collection, of which PROGRAM is needed, on ten meshes, one of which is broken: the others must be
# segmented all the same. Then the mesh is mended and another one added, and the recipe must do these alone. The recipe works in FOLDER, where it
# finds `meshes` and writes `outputs`. Returns 77 where the program is missing; in CI (CI=true) that is a failure.
set -euo pipefail
program=$1 tool=$2 data=$3 folder=$4
shift 4
PATH=$(dirname "$tool"):$PATH
names=(hand P tripod geosphere pipe ellipsoid sphere u mpi double-torus-3-holes)
fail() { echo "FAILED: $1"; exit 1; }

if ! command -v "$program" >/dev/null; then
  [ "${CI:-}" != true ] || fail "$program is not installed"
  echo "SKIPPED: $program is not installed (scripts/install-dependencies)"
  exit 77
fi

rm -rf "$folder"
mkdir -p "$folder/meshes"
cd "$folder"
for name in "${names[@]}"; do cp "$data/$name.off" meshes/; done
head -n 5 "$data/hand.off" >meshes/hand.off

"$@" && fail "a broken mesh went unnoticed"
for name in "${names[@]:1}"; do [ -s "outputs/$name.seg" ] || fail "$name has not been segmented"; done
[ ! -e outputs/hand.seg ] || fail "a broken mesh was segmented"
cp "$data/hand.off" meshes/
cp "$data/anchor.off" meshes/A.off  # the first by its name
touch marker
"$@" || fail "the second run failed"
[ -s outputs/hand.seg ] || fail "the second run did not segment the mended mesh"
again=$(find outputs -name '*.seg' -newer marker | LC_ALL=C sort | xargs)
[ "$again" = "outputs/A.seg outputs/hand.seg" ] || fail "the second run wrote $again"
