#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Segments all meshes of a folder, as many at a time as there are cores. Run again, it does what is left and what failed.
#
#   parallel.sh MESH_FOLDER OUTPUT_FOLDER [option of segment_mesh ...]
#
# jobs.log in the output folder has the time, machine and exit code of each mesh.
set -euo pipefail
meshes=$1
outputs=$2
shift 2
mkdir -p "$outputs"
find "$meshes" -type f | sort |
  parallel --joblog "$outputs/jobs.log" --resume-failed --quote \
    segment_mesh {} --quiet --labels "$outputs/{/.}.seg" --report "$outputs/{/.}.json" "$@"
