// SPDX-License-Identifier: MIT

// How rightly, how fast and with how much memory the readers of mesh_files.h, CGAL and Assimp read OFF, PLY, OBJ, STL and VTP.
// benchmark/readers_of_python.py does the same for readers of Python, with the files that this program writes.

#include "../examples/mesh_files.h"
#include "../test/defects.h"
#include "../test/dialects.h"
#include "../test/large_shapes.h"
#include "measurement.h"

#include <CGAL/IO/polygon_soup_io.h>

#include <CLI/CLI.hpp>

#ifdef RW_SEGMENTATION_WITH_ASSIMP
#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace measurement;

namespace {

using Triangle = std::array<std::array<float, 3>, 3>;

/// The triangles in an order of their own, each from its lowest corner on; single precision is what all formats have.
std::vector<Triangle> sorted(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

/// Adds the triangles of a polygon, cut as a fan.
template <class Place>
void add_fan(std::size_t corners, const Place& place, std::vector<Triangle>& triangles) {
  const auto corner = [&](std::size_t i) {
    const auto p = place(i);
    return std::array<float, 3>{float(p[0]), float(p[1]), float(p[2])};
  };
  for (std::size_t i = 2; i < corners; ++i) triangles.push_back({corner(0), corner(i - 1), corner(i)});
}

std::vector<Triangle> triangles_of(const defects::Soup& soup) {
  std::vector<Triangle> triangles;
  for (const auto& face : soup.faces)
    add_fan(
        face.size(), [&](std::size_t i) { return soup.points[face[i]]; }, triangles);
  return triangles;
}

/// A small mesh whose coordinates have few digits, so that rounding does not matter.
defects::Soup small_mesh() {
  constexpr double unit = 64;
  defects::Soup soup = large_shapes::free_form(12, 8);
  for (Eigen::Vector3d& p : soup.points)
    for (double& x : p) x = std::round(x * unit) / unit;
  return soup;
}

struct Reader {
  const char* name;
  /// The triangles of a file; an exception if it refuses the file. None are taken for a refusal, too.
  std::function<std::vector<Triangle>(const std::string&)> read;
};

std::vector<Triangle> read_by_mesh_files(const std::string& path) {
  const mesh_files::Polygon_soup soup = mesh_files::read_mesh(path);
  std::vector<Triangle> triangles;
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    add_fan(
        static_cast<std::size_t>(soup.face(f).size()),
        [&](std::size_t i) { return soup.points[soup.corners[soup.first_corner[f] + i]]; }, triangles);
  return triangles;
}

std::vector<Triangle> read_by_cgal(const std::string& path) {
  std::vector<CGAL::Simple_cartesian<double>::Point_3> points;
  std::vector<std::vector<std::size_t>> faces;
  if (!CGAL::IO::read_polygon_soup(path, points, faces)) throw std::runtime_error("refused");
  std::vector<Triangle> triangles;
  for (const auto& face : faces)
    add_fan(
        face.size(), [&](std::size_t i) { return points.at(face[i]); }, triangles);
  return triangles;
}

#ifdef RW_SEGMENTATION_WITH_ASSIMP
std::vector<Triangle> read_by_assimp(const std::string& path) {
  Assimp::Importer importer;
  const aiScene* const scene = importer.ReadFile(path, 0);
  if (!scene) throw std::runtime_error("refused");
  std::vector<Triangle> triangles;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f)
      add_fan(
          mesh.mFaces[f].mNumIndices,
          [&](std::size_t i) {
            const aiVector3D& p = mesh.mVertices[mesh.mFaces[f].mIndices[i]];
            return std::array<float, 3>{float(p.x), float(p.y), float(p.z)};
          },
          triangles);
  }
  return triangles;
}
#endif

const std::vector<Reader> readers = {{"mesh_files", read_by_mesh_files},
                                     {"CGAL", read_by_cgal},
#ifdef RW_SEGMENTATION_WITH_ASSIMP
                                     {"Assimp", read_by_assimp}
#endif
};

/// Small files that promise billions of elements.
std::vector<std::pair<std::string, std::string>> liars() {
  const std::string ply =
      "\nelement vertex 2000000000\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2000000000\nproperty list uchar int vertex_indices\nend_header\n";
  return {{"mesh.off", "OFF\n2000000000 2000000000 0\n0 0 0\n"},
          {"text/mesh.ply", "ply\nformat ascii 1.0" + ply + "0 0 0\n"},
          {"bytes/mesh.ply", "ply\nformat binary_little_endian 1.0" + ply + std::string(120, '\0')},
          {"mesh.stl", std::string(80, ' ') + "\xff\xff\xff\x7f" + std::string(100, '\0')},
          {"mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2000000000\n"},
          {"mesh.vtp",
           "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\"><PolyData><Piece NumberOfPoints=\"2000000000\" "
           "NumberOfPolys=\"2000000000\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" "
           "format=\"ascii\">0 0 0</DataArray></Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\" "
           "format=\"ascii\">0</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">1</DataArray>"
           "</Polys></Piece></PolyData></VTKFile>"}};
}

void write(const std::filesystem::path& path, const std::string& content) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << content;
}

/// All files, in one folder for each kind.
void write_files(const std::filesystem::path& folder, const defects::Soup& small, const defects::Soup& large) {
  write(folder / "small.off", defects::off_text(small));
  std::ofstream list(folder / "dialects.txt");
  for (const dialects::Dialect& dialect : dialects::all()) {
    const std::string content = dialect.content(small);
    if (content.empty()) continue;
    write(folder / "dialects" / dialect.name / dialect.file, content);
    list << "dialects/" << dialect.name << '/' << dialect.file << (dialect.refusal.empty() ? " mesh\n" : " none\n");
  }
  const std::vector<std::pair<const char*, std::string>> files = {{"mesh.off", dialects::off(large)},
                                                                  {"mesh.ply", dialects::binary_ply(large)},
                                                                  {"mesh.obj", dialects::obj(large)},
                                                                  {"mesh.stl", dialects::binary_stl(large)},
                                                                  {"mesh.vtp", dialects::appended_vtp(large)}};
  for (const auto& [name, content] : files) write(folder / "large" / name, content);
  for (const auto& [name, content] : liars()) write(folder / "liars" / name, content);
}

/// What became of reading a file, in a process of its own: 1 for the right triangles, 0 for others and -1 for none, and the
/// milliseconds of processor time and the megabytes that it took.
Outcome outcome_of(const Reader& reader, const std::string& path,
                   const std::function<bool(std::vector<Triangle>)>& is_right) {
  constexpr rlim_t seconds = 60, bytes = rlim_t(4) << 30;
  return in_own_process([&] {
    const rlimit time = {seconds, seconds}, memory = {bytes, bytes};
    setrlimit(RLIMIT_CPU, &time);
    setrlimit(RLIMIT_AS, &memory);
    const double before = peak_mb();
    const std::clock_t start = std::clock();
    std::vector<Triangle> triangles;
    try {
      triangles = reader.read(path);
    } catch (const std::exception&) {
    }
    const double milliseconds = 1000. * double(std::clock() - start) / double(CLOCKS_PER_SEC),
                 megabytes = peak_mb() - before;
    const bool is_refused = triangles.empty();
    return std::vector<double>{is_refused ? -1. : double(is_right(std::move(triangles))), milliseconds, megabytes};
  });
}

Result dialect_result(const Reader& reader, const std::filesystem::path& folder, const defects::Soup& small,
                      bool lists_faults) {
  const auto is_small = [expected = sorted(triangles_of(small))](std::vector<Triangle> triangles) {
    return sorted(std::move(triangles)) == expected;
  };
  std::size_t right = 0, wrong = 0, refused = 0, crashes = 0;
  std::ifstream list(folder / "dialects.txt");
  for (std::string file, kind; list >> file >> kind;) {
    const Outcome outcome = outcome_of(reader, (folder / file).string(), is_small);
    const bool is_crash = !outcome.failure.empty() || outcome.numbers.empty();
    const bool is_refused = !is_crash && outcome.numbers[0] < 0;
    const bool is_right = !is_crash && (kind == "mesh" ? outcome.numbers[0] == 1 : is_refused);
    right += is_right;
    crashes += is_crash;
    refused += !is_right && is_refused;
    wrong += !is_right && !is_refused && !is_crash;
    if (lists_faults && !is_right)
      std::cout << reader.name << ": " << file << (is_crash ? ": crash" : is_refused ? ": refused" : ": wrong") << '\n';
  }
  Result result("readers");
  result.add("reader", reader.name).add("set", "dialects").add("right", right).add("wrong", wrong);
  return result.add("refused", refused).add("crashes", crashes);
}

Result file_result(const Reader& reader, const std::filesystem::path& folder, const std::string& set,
                   const std::string& file, std::size_t faces) {
  const Outcome outcome = outcome_of(reader, (folder / set / file).string(),
                                     [&](const std::vector<Triangle>& triangles) { return triangles.size() == faces; });
  Result result("readers");
  result.add("reader", reader.name).add("set", set).add("file", file);
  if (!outcome.failure.empty() || outcome.numbers.size() < 3) return result.add("outcome", "crash");
  const double answer = outcome.numbers[0];
  result.add("outcome", answer == 1 ? "right" : answer < 0 ? "refused" : "wrong");
  return result.add("ms", outcome.numbers[1]).add("megabytes", outcome.numbers[2]);
}

}  // namespace

int main(int argc, char** argv) try {
  std::string folder;
  std::size_t rows = 1000;
  bool lists_faults = false;
  CLI::App app(
      "Reads files of OFF, PLY, OBJ, STL and VTP by several readers: dialects of a small mesh, large files, and small "
      "files "
      "that promise billions of elements. Right are all triangles of a dialect, or refusing what is no mesh.");
  app.add_option("FOLDER", folder, "The files are written here, and stay for readers_of_python.py")->required();
  app.add_option("--rows", rows, "The large mesh has 2 * rows * rows faces")->capture_default_str();
  app.add_flag("--faults", lists_faults, "Name the dialects that a reader does not read rightly");
  CLI11_PARSE(app, argc, argv);

  const defects::Soup small = small_mesh(), large = large_shapes::free_form(rows, rows);
  write_files(folder, small, large);
  std::vector<Result> results;
  for (const Reader& reader : readers) results.push_back(dialect_result(reader, folder, small, lists_faults));
  for (const Reader& reader : readers) {
    for (const char* file : {"mesh.off", "mesh.ply", "mesh.obj", "mesh.stl", "mesh.vtp"})
      results.push_back(file_result(reader, folder, "large", file, large.faces.size()));
    for (const auto& [file, content] : liars()) results.push_back(file_result(reader, folder, "liars", file, 0));
  }
  print(results);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "benchmark_readers: " << error.what() << '\n';
  return 1;
}
