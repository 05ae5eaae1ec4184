#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# tests_snakemake.sh SEGMENT_MESH DATA_MESHES FOLDER RECIPES
# What the recipes for Snakemake do with files that Snakemake by itself mistakes: those of a name with braces are refused
# before anything is made, an older file in the place of another one is segmented anew, other options and folders are taken,
# commas stay in their column, and names of tiles may begin with "#". Works in FOLDER. Returns 77 where Snakemake is missing;
# in CI (CI=true) that is a failure.
set -euo pipefail
tool=$1 data=$2 folder=$3 recipes=$4
PATH=$(dirname "$tool"):$PATH
fail() { echo "FAILED: $1"; exit 1; }
segment() {  # MESHES OUTPUTS OPTIONS
  snakemake --quiet --snakefile "$recipes/Snakefile" --cores 2 --config meshes="$1" outputs="$2" options="${3:-}"
}
segment_tiles() {  # TILES WORK LABELS OPTIONS
  snakemake --quiet --snakefile "$recipes/Snakefile_tiles" --cores 2 \
    --config tiles="$1" work="$2" outputs="$3" options="${4:-}"
}
refuses() {  # MESSAGE OUTPUTS COMMAND ...
  local message=$1 outputs=$2
  shift 2
  "$@" >refusal 2>&1 && fail "$*: not refused"
  grep -qF "$message" refusal || fail "$*: $(cat refusal)"
  [ ! -e "$outputs" ] || fail "$*: left $outputs"
}
faces() { wc -l <"$1"; }
labels() { cat "$@" | sort -u | wc -l; }

if ! command -v snakemake >/dev/null; then
  [ "${CI:-}" != true ] || fail "snakemake is not installed"
  echo "SKIPPED: snakemake is not installed (scripts/install-dependencies)"
  exit 77
fi

rm -rf "$folder"
mkdir -p "$folder/braces" "$folder/meshes" "$folder/none"
cd "$folder"
cp "$data/u.off" 'braces/{tile}.off'
cp "$data/u.off" meshes/a,b.off
cp "$data/sphere.off" meshes/c.off

refuses 'braces/{tile}.off: Snakemake takes braces' outputs segment braces outputs
refuses 'out{puts}: Snakemake takes braces' 'out{puts}' segment meshes 'out{puts}'
refuses 'braces/{tile}.off: Snakemake takes braces' work segment_tiles braces work outputs
refuses 'wo{rk}: Snakemake takes braces' 'wo{rk}' segment_tiles meshes 'wo{rk}' outputs
refuses 'none: there are no tiles' work segment_tiles none work outputs

segment meshes outputs || fail "the recipe for collections failed"
segment_tiles meshes work 'la{bels}' || fail "the recipe for tiles failed"
grep -q '^"meshes/a,b.off",168,' outputs/segments.csv || fail "the table has $(cat outputs/segments.csv)"
[ "$(faces outputs/a,b.seg)" -eq 168 ] && [ "$(faces 'la{bels}/a,b.seg')" -eq 168 ] || fail "other meshes were segmented"

cp "$data/sphere.off" meshes/a,b.off
touch -t 200001010000 meshes/a,b.off
segment meshes outputs || fail "the second run of the recipe for collections failed"
segment_tiles meshes work 'la{bels}' || fail "the second run of the recipe for tiles failed"
[ "$(faces outputs/a,b.seg)" -eq 320 ] || fail "an older mesh went unnoticed"
[ "$(faces 'la{bels}/a,b.seg')" -eq 320 ] || fail "an older tile went unnoticed"

segment meshes outputs '--segments 5' || fail "the recipe for collections failed with other options"
segment_tiles meshes work 'la{bels}' '--segments 7' || fail "the recipe for tiles failed with other options"
[ "$(labels outputs/c.seg)" -eq 5 ] || fail "other options for meshes went unnoticed"
[ "$(labels 'la{bels}'/*.seg)" -eq 7 ] || fail "other options for tiles went unnoticed"
segment_tiles meshes work elsewhere '--segments 7' || fail "the recipe for tiles failed with another folder"
diff -r 'la{bels}' elsewhere || fail "another folder for labels went unnoticed"

mkdir numbered
cp "$data/u.off" 'numbered/#1.off'
cp "$data/sphere.off" 'numbered/#2.off'
(cd numbered && segment_tiles . ../work_of_numbered ../labels_of_numbered) || fail "the recipe failed with # in names"
[ "$(faces 'labels_of_numbered/#1.seg')" -eq 168 ] || fail "a name that begins with # was taken for a comment"
