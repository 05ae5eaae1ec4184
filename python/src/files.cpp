// SPDX-License-Identifier: MIT

// Files of meshes, by the readers and writers of the tool segment_mesh. What is read comes as bytes and what is written goes
// to a function of Python's, which knows paths, packed files and temporary names.

#include "../../examples/mesh_files/Format.h"
#include "../../examples/mesh_files/read_mesh.h"
#include "../../examples/mesh_files/write_mesh.h"
#include "arrays.h"
#include "definitions.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rw_python {
namespace {

using mesh_files::Format;
using mesh_files::Polygon_soup;
using Corners = nb::ndarray<const std::uint32_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Colors = nb::ndarray<const std::uint8_t, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

std::string_view view_of(const nb::bytes& content) { return {content.c_str(), content.size()}; }

/// Whether a file is packed by gzip.
bool is_packed(const nb::bytes& content) {
  return mesh_files::is_gzip(view_of(content)) && !mesh_files::stl::is_binary(view_of(content));
}

/// Whether a file is of a format that is read here, whole or broken: by its mark, else by its name.
bool is_mesh_file(const std::string& path, const nb::bytes& bytes) {
  const std::string_view content = view_of(bytes);
  if (mesh_files::stl::is_binary(content)) return true;
  const auto marked = mesh_files::format_of_content(content), named = mesh_files::format_of_path(path);
  if (marked == Format::vtp && named != Format::vtp) {  // VTK has other files with the same mark
    constexpr std::size_t beginning = 4096;
    return content.substr(0, beginning).find("PolyData") != std::string_view::npos;
  }
  if (marked) return true;
  if (named) return named != Format::msh;  // files of other programs are called .msh, too
  return mesh_files::may_be_obj(content);
}

/// \returns points, corners of the faces, where each face begins and the last one ends, and remarks
/// \throws std::invalid_argument if the file is broken
nb::tuple read_mesh_file(const std::string& path, const nb::bytes& content) {
  std::vector<double> points;
  std::vector<std::int64_t> corners, offsets;
  std::vector<std::string> remarks;
  {
    const nb::gil_scoped_release release;
    try {
      Polygon_soup soup = mesh_files::mesh_of_content(path, view_of(content));
      points.reserve(3 * soup.points.size());
      for (const auto& p : soup.points) points.insert(points.end(), {p.x(), p.y(), p.z()});
      corners.assign(soup.corners.begin(), soup.corners.end());
      offsets.assign(soup.first_corner.begin(), soup.first_corner.end());
      remarks = std::move(soup.remarks);
    } catch (const mesh_files::Unreadable_file& error) {
      throw std::invalid_argument(error.what());
    }
  }
  return nb::make_tuple(table_of(std::move(points), 3), array_of(std::move(corners)), array_of(std::move(offsets)),
                        remarks);
}

/// Polygons whose corners and offsets the caller has checked.
Polygon_soup soup_of(const Rows& vertices, const Corners& corners, const Integers& offsets) {
  Polygon_soup soup;
  soup.points.reserve(vertices.shape(0));
  for (std::size_t v = 0; v < vertices.shape(0); ++v)
    soup.points.emplace_back(vertices(v, 0), vertices(v, 1), vertices(v, 2));
  soup.corners.assign(corners.data(), corners.data() + corners.size());
  soup.first_corner.assign(offsets.data(), offsets.data() + offsets.size());
  return soup;
}

/// Cuts polygons into triangles, as files have them that know no others.
/// \returns the triangles, and of which face each is
nb::tuple triangles_of(const Rows& vertices, const Corners& corners, const Integers& offsets) {
  std::vector<std::int64_t> triangles, face_of_triangle;
  {
    const nb::gil_scoped_release release;
    const Polygon_soup soup = soup_of(vertices, corners, offsets);
    std::vector<std::size_t> faces;
    for (std::size_t f = 0; f < soup.number_of_faces(); ++f) faces.push_back(f);
    const mesh_files::Small_faces small = mesh_files::small_faces({soup, faces, {}}, 3);
    triangles.assign(small.soup.corners.begin(), small.soup.corners.end());
    face_of_triangle.assign(small.label.begin(), small.label.end());
  }
  return nb::make_tuple(table_of(std::move(triangles), 3), array_of(std::move(face_of_triangle)));
}

/// A file whose bytes a function of Python's takes.
class Python_output final : public mesh_files::Output {
 public:
  Python_output(std::string path, const nb::callable& write) : path_(std::move(path)), write_(write) {}

  const std::string& path() const override { return path_; }

  void write(std::string_view bytes) override {
    const nb::gil_scoped_acquire lock;
    write_(nb::bytes(bytes.data(), bytes.size()));
  }

 private:
  std::string path_;
  const nb::callable& write_;
};

std::map<std::size_t, mesh_files::Color> colors_of_labels(const Integers& names, const Colors& colors) {
  std::map<std::size_t, mesh_files::Color> color_of_label;
  for (std::size_t i = 0; i < names.size(); ++i)
    color_of_label[static_cast<std::size_t>(names(i))] = {colors(i, 0), colors(i, 1), colors(i, 2)};
  return color_of_label;
}

mesh_files::Output_format format_of(const std::string& name) {
  for (const auto& [known, format] : mesh_files::output_format_names)
    if (known == name) return format;
  throw std::invalid_argument("there is no format " + name);
}

std::vector<std::string> output_formats() {
  std::vector<std::string> names;
  for (const auto& [name, format] : mesh_files::output_format_names)
    if (format != mesh_files::Output_format::text_stl) names.push_back(name);  // those that the name of a file tells
  return names;
}

/// \throws std::invalid_argument if the format cannot hold the mesh
void write_mesh_file(const nb::callable& write, const std::string& path, const std::string& format,
                     const Rows& vertices, const Corners& corners, const Integers& offsets, const Integers& labels,
                     const Integers& names, const Colors& colors, const nb::bytes& material_library) {
  const nb::gil_scoped_release release;
  const Polygon_soup soup = soup_of(vertices, corners, offsets);
  const std::vector<std::size_t> face_labels(labels.data(), labels.data() + labels.size());
  Python_output file(path, write);
  try {
    mesh_files::write_segments(file, format_of(format), {soup, face_labels, colors_of_labels(names, colors)},
                               {false, std::string(view_of(material_library))});
  } catch (const mesh_files::Unwritable_file& error) {
    throw std::invalid_argument(error.what());
  }
}

void write_materials(const nb::callable& write, const std::string& path, const Integers& names, const Colors& colors) {
  Python_output file(path, write);
  mesh_files::write_materials(file, colors_of_labels(names, colors));
}

}  // namespace

void define_files(nb::module_& m) {
  m.def("is_packed", &is_packed, nb::arg("content"));
  m.def("is_mesh_file", &is_mesh_file, nb::arg("path"), nb::arg("content"));
  m.def("read_mesh_file", &read_mesh_file, nb::arg("path"), nb::arg("content"),
        nb::sig("def read_mesh_file(path: str, content: bytes) -> tuple[numpy.typing.NDArray[numpy.float64], "
                "numpy.typing.NDArray[numpy.int64], numpy.typing.NDArray[numpy.int64], list[str]]"));
  m.def("triangles_of", &triangles_of, nb::arg("vertices"), nb::arg("corners"), nb::arg("offsets"),
        nb::sig("def triangles_of(vertices: numpy.typing.NDArray[numpy.float64], "
                "corners: numpy.typing.NDArray[numpy.uint32], offsets: numpy.typing.NDArray[numpy.int64]) -> "
                "tuple[numpy.typing.NDArray[numpy.int64], numpy.typing.NDArray[numpy.int64]]"));
  m.def("output_formats", &output_formats);
  m.def("write_mesh_file", &write_mesh_file, nb::arg("write"), nb::arg("path"), nb::arg("format"), nb::arg("vertices"),
        nb::arg("corners"), nb::arg("offsets"), nb::arg("labels"), nb::arg("names"), nb::arg("colors"),
        nb::arg("material_library"),
        nb::sig("def write_mesh_file(write: collections.abc.Callable[[bytes], object], path: str, format: str, "
                "vertices: numpy.typing.NDArray[numpy.float64], corners: numpy.typing.NDArray[numpy.uint32], "
                "offsets: numpy.typing.NDArray[numpy.int64], labels: numpy.typing.NDArray[numpy.int64], "
                "names: numpy.typing.NDArray[numpy.int64], colors: numpy.typing.NDArray[numpy.uint8], "
                "material_library: bytes) -> None"));
  m.def("write_materials", &write_materials, nb::arg("write"), nb::arg("path"), nb::arg("names"), nb::arg("colors"),
        nb::sig("def write_materials(write: collections.abc.Callable[[bytes], object], path: str, "
                "names: numpy.typing.NDArray[numpy.int64], colors: numpy.typing.NDArray[numpy.uint8]) -> None"));
}

}  // namespace rw_python
