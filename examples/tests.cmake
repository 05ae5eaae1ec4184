# SPDX-License-Identifier: MIT

# CTest runs each example on a mesh of CGAL's data folder and looks at what it prints and writes.

# example_test(<name> <program> [ARGUMENTS ...] [INPUT <lines>...] [PRINTS <regular expression>...] [WRITES <file>...])
# The lines go to the program's standard input; its standard output must match every expression, and the files must
# have been written.
function(example_test name program)
  cmake_parse_arguments(PARSE_ARGV 2 test "" "" "ARGUMENTS;INPUT;PRINTS;WRITES")
  if(NOT TARGET ${program} OR NOT data_dir)
    return()
  endif()
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/tests/${name})
  list(JOIN test_INPUT "\n" input)
  file(CONFIGURE OUTPUT ${folder}/input.txt CONTENT "${input}\n" @ONLY)
  add_test(NAME example.${name}
    COMMAND ${CMAKE_COMMAND} "-DCOMMAND=$<TARGET_FILE:${program}>;${test_ARGUMENTS}" -DINPUT=${folder}/input.txt
      "-DPRINTS=${test_PRINTS}" "-DWRITES=${test_WRITES}" -P ${CMAKE_CURRENT_SOURCE_DIR}/run_and_compare.cmake
    WORKING_DIRECTORY ${folder})
  set_tests_properties(example.${name} PROPERTIES LABELS example TIMEOUT 300)
endfunction()

set(meshes ${data_dir}/meshes)

example_test(own_difference own_difference ARGUMENTS ${meshes}/cube-meshed.off
  PRINTS "stored map: 288 288 288 288 288 288" "lambda: 288 288 288 288 288 288" "class: 288 288 288 288 288 288")

example_test(own_policies own_policies ARGUMENTS ${meshes}/elephant.off
  PRINTS "^edge map: [1-9]" "\nsolver with settings: [1-9]" "\nall: [1-9][0-9]* segments\n30 segments, half of the fragments\n$")

# What CGAL's SDF segmentation finds, too, and diameters stored once for several numbers of segments.
example_test(from_sdf from_sdf ARGUMENTS ${meshes}/cactus.off
  PRINTS "^CGAL: [1-9][0-9]* segments\nwalks: [1-9][0-9]* segments\n" ", segments 3 4 5\n$")

# The parts of a bear, from seeds and without.
example_test(seeds seeds ARGUMENTS ${meshes}/bear.off 11763 11824 1483 8789 8748 9212 9211 167
  PRINTS "^segment 0: 962 faces, " "\nsegment 7: [0-9]+ faces, ")
example_test(automatic_segments automatic_segments ARGUMENTS ${meshes}/bear.off
  PRINTS "^8 segments\n2 segments\n3 segments\n.*\n8 segments\n$")

example_test(large_mesh large_mesh ARGUMENTS ${meshes}/elephant.off
  PRINTS "^[1-9][0-9]* segments by clusters\n[1-9][0-9]* segments by a simplified copy of 1388 faces\n$")

example_test(engineering_segments engineering_segments ARGUMENTS ${meshes}/cube-meshed.off
  PRINTS "^plane\nplane\nplane\nplane\nplane\nplane\n[1-9][0-9]* parts by the difference of curvatures\n$")

# A seed in the middle of each side.
example_test(curvature_seeds curvature_seeds ARGUMENTS ${meshes}/cube-meshed.off 401 853 1228 1239 831 1290
  PRINTS "^segment 0: 288 faces\nsegment 1: 288 faces\nsegment 2: 288 faces\nsegment 3: 288 faces\nsegment 4: 288 faces\n")

# 2390 faces in two segments, which are the same whatever holds the mesh.
foreach(program polyhedron openmesh)
  example_test(${program} ${program} ARGUMENTS ${meshes}/hand.off
    PRINTS "segment 0: 46 faces" "segment 1: 2344 faces")
endforeach()

# An ear, the head and the body of a bear. What is undone is as it was.
example_test(interactive_seeds interactive_seeds ARGUMENTS ${meshes}/bear.off
  INPUT "add 11763 0" "add 1483 1" "add 167 2" "add 11763 1" "undo" "remove 1483" "undo" "undo" "undo"
  PRINTS "add 11763 0: 0=27648 " "add 1483 1: 0=962 1=26686 " "remove 1483: 0=[0-9]+ 2=[0-9]+ "
    "\nundo: 0=962 1=6181 2=20505 .*\nundo: 0=962 1=6181 2=20505 .*\nundo: 0=962 1=26686 .*\nundo: 0=27648 ")

# The parts of a bear: from a seed in each of them, and found by the tool.
example_test(segment_mesh.seeds segment_mesh
  ARGUMENTS ${meshes}/bear.off --seed 11763 --seed 11824 --seed 1483 --seed 8789 --seed 8748 --seed 9212 --seed 9211
    --seed 167 --output segments.ply --output segments.off --labels segments.seg
  PRINTS "\n    7 +[0-9]+ +[0-9.]+ %\n$"
  WRITES segments.ply segments.off segments.seg)
example_test(segment_mesh.automatic segment_mesh
  ARGUMENTS ${meshes}/bear.off --output segments.ply --labels segments.seg --hierarchy hierarchy.json
    --report report.json
  PRINTS "\n    5 +[0-9]+ +[0-9.]+ %\n"
  WRITES segments.ply segments.seg hierarchy.json report.json)
example_test(segment_mesh.polygons segment_mesh
  ARGUMENTS ${meshes}/P.off --segments 2 --output segments.ply
  PRINTS "\n    1 +[0-9]+ +[0-9.]+ %\n$"
  WRITES segments.ply)
example_test(segment_mesh.stl segment_mesh
  ARGUMENTS ${meshes}/pig.stl --labels segments.seg
  PRINTS "\n   16 +[0-9]+ +[0-9.]+ %\n"
  WRITES segments.seg)

# Other policies, and walls: the sharp edges of a cube.
example_test(segment_mesh.policies segment_mesh
  ARGUMENTS ${meshes}/bear.off --difference dihedral --seeding particles --merge-cost boundary --solver eigen --segments 5
    --labels segments.seg
  PRINTS "\n    4 +[0-9]+ +[0-9.]+ %\n$"
  WRITES segments.seg)
example_test(segment_mesh.walls segment_mesh
  ARGUMENTS ${meshes}/cube-meshed.off --constraints-angle 45 --segments 6 --labels segments.seg
  PRINTS "\n    0 +288 +16.67 %\n" "\n    5 +288 +16.67 %\n$"
  WRITES segments.seg)

example_test(segment_mesh.engineering segment_mesh
  ARGUMENTS ${meshes}/cube-meshed.off --engineering --report report.json
  PRINTS "\n    5 +288 +16.67 %\n$"
  WRITES report.json)

# The same parts, cut along smooth boundaries.
example_test(split_and_extract split_and_extract ARGUMENTS ${meshes}/bear.off
  PRINTS "7 boundaries, [1-9][0-9]+ faces added" "segment 0: [0-9]+ faces, 1 borders" "segment 7: ")
example_test(segment_mesh.refine segment_mesh
  ARGUMENTS ${meshes}/bear.off --smooth --refine --boundaries boundaries.obj --output segments.ply --labels segments.seg
  PRINTS "\n    7 +[0-9]+ +[0-9.]+ %\n"
  WRITES boundaries.obj segments.ply segments.seg)

# What follows with a cost takes some seconds and begins before the many short tests, lest it runs alone at the end.

# Under valgrind nothing is read before it is set, nor lost. CGAL's checks of rounding modes, which valgrind does not
# know, are compiled in without NDEBUG.
find_program(VALGRIND valgrind)
mark_as_advanced(VALGRIND)
if(VALGRIND AND TARGET segment_mesh AND data_dir AND CMAKE_BUILD_TYPE STREQUAL Release)
  add_test(NAME example.segment_mesh.memcheck
    COMMAND ${VALGRIND} --quiet --leak-check=full --errors-for-leak-kinds=definite --error-exitcode=99
      $<TARGET_FILE:segment_mesh> ${meshes}/pipe.off --smooth --refine --output memcheck.ply --labels memcheck.seg
    WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  set_tests_properties(example.segment_mesh.memcheck PROPERTIES LABELS example COST 5 TIMEOUT 300)
endif()

# CGAL's remeshing and approximation of segments.
example_test(pipeline pipeline ARGUMENTS ${meshes}/bear.off 0.05 .
  PRINTS "part 7: [0-9]+ faces, remeshed [1-9][0-9]+\n$"
  WRITES part_0.off part_7.off)

example_test(approximate_segments approximate_segments ARGUMENTS ${meshes}/cube-meshed.off 5 cube.off
  PRINTS "^6 segments, 1728 faces, approximated by [0-9]+ triangles with 100 % of the area\n$"
  WRITES cube.off)

# Ten meshes, one of them broken at first, by recipes for collections and by the tool alone.
function(collection_test name program)
  if(NOT TARGET segment_mesh OR NOT data_dir)
    return()
  endif()
  add_test(NAME example.collection.${name}
    COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/tests_collection.sh ${program} $<TARGET_FILE:segment_mesh> ${meshes}
      ${CMAKE_CURRENT_BINARY_DIR}/tests/collection.${name} ${ARGN})
  set_tests_properties(example.collection.${name} PROPERTIES LABELS example COST 5 TIMEOUT 300 SKIP_RETURN_CODE 77)
endfunction()
set(collections ${CMAKE_CURRENT_SOURCE_DIR}/collections)
collection_test(parallel parallel ${collections}/parallel.sh meshes outputs)
collection_test(snakemake snakemake snakemake --snakefile ${collections}/Snakefile --cores 2 --keep-going
  --config meshes=meshes outputs=outputs)
collection_test(segment_mesh sh
  sh -c "mkdir -p outputs && segment_mesh meshes/*.off --quiet --labels outputs/%.seg --resume")

# Tiles of one mesh, by the recipe.
if(TARGET segment_mesh AND data_dir)
  foreach(options IN ITEMS "" --engineering --refine)
    add_test(NAME example.tiles.snakemake${options}
      COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/tests_tiles.sh snakemake $<TARGET_FILE:segment_mesh> ${meshes}
        ${CMAKE_CURRENT_BINARY_DIR}/tests/tiles.snakemake${options} "${options}"
        snakemake --snakefile ${collections}/Snakefile_tiles --cores 2
        --config tiles=tiles work=work outputs=outputs "options=${options}")
    set_tests_properties(example.tiles.snakemake${options} PROPERTIES LABELS example COST 5 TIMEOUT 300
      SKIP_RETURN_CODE 77)
  endforeach()
  add_test(NAME example.collection.snakemake.files
    COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/tests_snakemake.sh $<TARGET_FILE:segment_mesh> ${meshes}
      ${CMAKE_CURRENT_BINARY_DIR}/tests/collection.snakemake.files ${collections})
  set_tests_properties(example.collection.snakemake.files PROPERTIES LABELS example COST 5 TIMEOUT 300
    SKIP_RETURN_CODE 77)
endif()

# The tool's own tests run the tool.
foreach(test tests test_segment_mesh_tool test_segment_mesh_input test_capped_parts test_cad_files test_tiles_tool)
  if(TARGET ${test} AND TARGET segment_mesh)
    add_dependencies(${test} segment_mesh)
    target_compile_definitions(${test} PRIVATE SEGMENT_MESH="$<TARGET_FILE:segment_mesh>"
      $<$<TARGET_EXISTS:cad_shape>:SEGMENT_MESH_WITH_OPEN_CASCADE>)
  endif()
endforeach()
