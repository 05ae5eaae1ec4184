// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_HELP_SECTIONS_H
#define SEGMENT_MESH_HELP_SECTIONS_H

#include <array>

namespace segment_mesh {

constexpr const char* summary =
    "Cuts a surface mesh into segments by random walks: from seeds that you give, or all by itself.";

/// A part of the help that is about no single option.
struct Help_section {
  const char* title;
  const char* text;
  bool is_preformatted;
};

constexpr std::array<Help_section, 8> help_sections = {{
    {"Which way",
     "Animals, people, furniture: no option at all. Parts of machines: --engineering. Too many or too few segments:\n"
     "--segments. Parts that you have in mind: --seed, one or more for each. A seed is a face or the closest face to "
     "a\n"
     "point; faces are numbered from 0 in the order of the file. Edges that no segment may cross: --constraints.\n",
     false},
    {"Outputs",
     "Every output keeps the order of the faces in the file, only OBJ, glTF, 3MF, Gmsh and STL texts have them "
     "segment\n"
     "by segment. Faces that a repair leaves out get the label of the closest face; with --refine, the mesh is "
     "written\n"
     "without them. Outputs are written whole or not at all: what was there stays until a new file is complete. Only "
     "a\n"
     "program that is killed by SIGKILL leaves files .part* behind, which may be removed. Without an output, the\n"
     "segments are only listed; they are not where an output is /dev/stdout.\n",
     false},
    {"CAD files",
     "With --engineering, an --output that ends with .step (.stp), .iges (.igs) or .brep is a solid whose faces lie "
     "on\n"
     "the surfaces found, free forms on fitted ones, and whose edges are lines, circles and splines. Meshes with a "
     "border\n"
     "become shells. The shape is checked: it must be valid and closed, and have the mesh's area and volume. What "
     "fails "
     "is\n"
     "not written unless --keep-invalid is given, and the exit code is 8. --report has the checks, face by face. This "
     "needs\n"
     "Open CASCADE when segment_mesh is built; "
#ifdef SEGMENT_MESH_CAD_LIBRARY
     "this one has it.\n",
#else
     "this one lacks it.\n",
#endif
     false},
    {"Input",
     "OFF, PLY, OBJ, STL, 3MF, Gmsh (.msh), Medit (.mesh, .meshb) and VTK's polygons (.vtp), packed by gzip or not;\n"
     "where the program is built with Assimp, also glTF, GLB, COLLADA, FBX, 3DS, AMF, Blender, LWO and X3D, with all\n"
     "meshes of their scenes. The first bytes tell which, and where they do not, the name or --format. A file without\n"
     "faces is refused. - and /dev/stdin are standard input; other pipes are read, too.\n",
     false},
    {"Several meshes",
     "They are worked through one after the other, and one that fails does not end the work. In the paths of outputs\n"
     "(and of --seeds-file and --constraints), % stands for the name of the mesh, without folder and extension,\n"
     "{folder} for the folders on its path, joined by _, and %% for a percent sign, also where there is one mesh. A\n"
     "--report without a % gets one line for each mesh as soon as it is done, with \"error\" in it if it failed. With\n"
     "--resume, meshes are passed over whose outputs are all there and not older than the mesh and the files of\n"
     "--seeds-file, --constraints and --page; the report goes on after its last line. Whether other options have\n"
     "changed is not looked at.\n",
     false},
    {"Tiles of one mesh",
     "With --tiled, the meshes are tiles of one mesh that may be larger than the memory. Segments, labels and the one\n"
     "--report are those of the whole; outputs with % are written for each tile. Seeds are points, each for the "
     "closest\n"
     "face of all tiles. With --engineering, surfaces go on from tile to tile. --smooth and --refine leave the "
     "borders\n"
     "of tiles as they are. Workers are processes of their own: one that is killed is started again. A tile that\n"
     "cannot be read is told at the end, and the exit code is 6; the others have their segments. --tile-step does one\n"
     "step, as Snakemake, Dask and others that share jobs among machines need it; examples/collections has recipes.\n",
     false},
    {"Exit codes",
     "  0  success\n"
     "  1  wrong usage\n"
     "  2  unreadable input\n"
     "  3  argument out of range\n"
     "  4  failed computation\n"
     "  5  output that cannot be written\n"
     "  6  one or more of several meshes failed\n"
     "  7  the limit of time or memory was reached\n"
     "  8  a CAD file fails its checks\n"
     "130  cancelled by Ctrl-C or another signal\n",
     true},
    {"Examples",
     "  segment_mesh hand.off --output hand.ply\n"
     "  segment_mesh hand.off --segments 6 --split fingers\n"
     "  segment_mesh hand.off --segments 6 --cap-parts --output hand.3mf\n"
     "  segment_mesh part.stl --engineering --output part.ply --report part.json\n"
     "  segment_mesh part.stl --engineering --output part.step --unit inch\n"
     "  segment_mesh hand.off --seed 120 --seed 2303 --seed 77 --output hand.ply\n"
     "  segment_mesh hand.off --html hand.html\n"
     "  segment_mesh part.stl --constraints-angle 40 --segments 9 --labels part.seg\n"
     "  segment_mesh part.stl --seed 0.1,2,3=5 --seed 812=5 --seed 44=9 --labels part.seg\n"
     "  segment_mesh meshes/*.off --labels out/%.seg --output out/%.ply --report out/report.jsonl --resume\n"
     "  segment_mesh tiles/*.ply --tiled --workers 8 --labels out/%.seg --tile-folder work\n"
     "  segment_mesh tiles/*.ply --tiled --seeds-file seeds.txt --labels out/%.seg --tile-folder work\n"
     "  segment_mesh tiles/*.stl --tiled --engineering --labels out/%.seg --report report.json\n",
     true},
}};

}  // namespace segment_mesh

#endif
