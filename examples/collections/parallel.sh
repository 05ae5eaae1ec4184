#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Segments all meshes of a folder, as many at a time as there are cores. Run again, it does what is left, failed, was added or
# is out of date.
#
#   parallel.sh MESH_FOLDER OUTPUT_FOLDER [option of segment_mesh ...]
#
# jobs.log in the output folder has the time, machine and exit code of each mesh.
set -euo pipefail
meshes=$1
outputs=$2
shift 2
same=$(find "$meshes" -type f | sed 's|.*/||; s/[.]gz$//; s/[.][^.]*$//' | sort | uniq -d)
[ -z "$same" ] || { echo "several meshes have the name $same, but for how it ends or its folder" >&2; exit 1; }
mkdir -p "$outputs"
files=${outputs//%/%%}/%  # the name of the mesh stands for the second one
find "$meshes" -type f | sort |
  parallel --joblog "$outputs/jobs.log" --quote \
    segment_mesh {} --resume --quiet --labels "$files.seg" --report "$files.json" "$@"
