// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_GMSH_AND_MEDIT_FILES_H
#define RW_SEGMENTATION_TEST_GMSH_AND_MEDIT_FILES_H

// Triangles as Gmsh and Medit files in all their forms, written by code of its own, which knows nothing of what reads them.

#include "mesh_bytes.h"

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace gmsh_and_medit_files {

using mesh_bytes::bytes;
using mesh_bytes::Faces;
using mesh_bytes::Order;
using mesh_bytes::Point;

/// The tag of a node: neither from 1 on nor without gaps.
inline std::uint64_t tag(std::size_t v) { return 3 * v + 7; }

inline std::string coordinates(const Point& p) {
  std::ostringstream text;
  text.precision(17);
  text << p.x() << ' ' << p.y() << ' ' << p.z();
  return text.str();
}

template <class Real>
std::string coordinate_bytes(const Point& p, Order order) {
  return bytes<Real>({static_cast<Real>(p.x()), static_cast<Real>(p.y()), static_cast<Real>(p.z())}, order);
}

inline std::string msh_2_text(const std::vector<Point>& points, const Faces& faces) {
  std::ostringstream file;
  file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"$Nodes of all\"\n$EndPhysicalNames\n$Nodes\n"
       << points.size() << "\n";
  for (std::size_t v = 0; v < points.size(); ++v) file << tag(v) << " " << coordinates(points[v]) << "\n";
  file << "$EndNodes\n$Elements\n" << faces.size() + 1 << "\n1 15 2 0 1 " << tag(0) << "\n";
  for (std::size_t f = 0; f < faces.size(); ++f) {
    file << f + 2 << (faces[f].size() == 3 ? " 2" : " 3") << " 2 0 1";
    for (const std::size_t corner : faces[f]) file << " " << tag(corner);
    file << "\n";
  }
  file << "$EndElements\n";
  return file.str();
}

inline std::string msh_2_binary(const std::vector<Point>& points, const Faces& faces, Order order) {
  using Int = std::int32_t;
  std::string file = "$MeshFormat\n2.2 1 8\n" + bytes<Int>({1}, order) + "\n$EndMeshFormat\n$Nodes\n" +
                     std::to_string(points.size()) + "\n";
  for (std::size_t v = 0; v < points.size(); ++v)
    file += bytes<Int>({static_cast<Int>(tag(v))}, order) + coordinate_bytes<double>(points[v], order);
  file += "\n$EndNodes\n$Elements\n" + std::to_string(faces.size() + 1) + "\n" +
          bytes<Int>({15, 1, 2, 1, 0, 1, static_cast<Int>(tag(0))}, order);
  // The faces in blocks of two at most.
  for (std::size_t f = 0; f < faces.size();) {
    const bool is_pair = f + 1 < faces.size() && faces[f].size() == faces[f + 1].size();
    file += bytes<Int>({faces[f].size() == 3 ? 2 : 3, is_pair ? 2 : 1, 2}, order);
    for (const std::size_t end = f + (is_pair ? 2 : 1); f < end; ++f) {
      file += bytes<Int>({static_cast<Int>(f + 2), 0, 1}, order);
      for (const std::size_t corner : faces[f]) file += bytes<Int>({static_cast<Int>(tag(corner))}, order);
    }
  }
  return file + "\n$EndElements\n";
}

inline std::string msh_4_text(const std::vector<Point>& points, const Faces& faces) {
  std::ostringstream file;
  file << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 1 0\n1 0 0 0 1 1 1 0 0\n$EndEntities\n$Nodes\n2 "
       << points.size() << " 1 100\n2 1 1 1\n"
       << tag(0) << "\n"
       << coordinates(points[0]) << " 0.5 0.5\n2 1 0 " << points.size() - 1 << "\n";
  for (std::size_t v = 1; v < points.size(); ++v) file << tag(v) << "\n";
  for (std::size_t v = 1; v < points.size(); ++v) file << coordinates(points[v]) << "\n";
  file << "$EndNodes\n$Elements\n"
       << faces.size() + 1 << " " << faces.size() + 1 << " 1 100\n0 1 15 1\n1 " << tag(0) << "\n";
  for (std::size_t f = 0; f < faces.size(); ++f) {
    file << "2 1 " << (faces[f].size() == 3 ? 2 : 3) << " 1\n" << f + 2;
    for (const std::size_t corner : faces[f]) file << " " << tag(corner);
    file << "\n";
  }
  file << "$EndElements\n";
  return file.str();
}

inline std::string msh_4_binary(const std::vector<Point>& points, const Faces& faces, Order order) {
  using Int = std::int32_t;
  using Size = std::uint64_t;
  std::string file = "$MeshFormat\n4.1 1 8\n" + bytes<Int>({1}, order) + "\n$EndMeshFormat\n$Entities\n" +
                     bytes<Size>({0, 0, 0, 0}, order) + "\n$EndEntities\n$Nodes\n" +
                     bytes<Size>({1, points.size(), 1, 100}, order) + bytes<Int>({2, 1, 0}, order) +
                     bytes<Size>({points.size()}, order);
  for (std::size_t v = 0; v < points.size(); ++v) file += bytes<Size>({tag(v)}, order);
  for (const Point& p : points) file += coordinate_bytes<double>(p, order);
  file += "\n$EndNodes\n$Elements\n" + bytes<Size>({faces.size(), faces.size(), 1, 100}, order);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    file += bytes<Int>({2, 1, faces[f].size() == 3 ? 2 : 3}, order) + bytes<Size>({1, f + 1}, order);
    for (const std::size_t corner : faces[f]) file += bytes<Size>({tag(corner)}, order);
  }
  return file + "\n$EndElements\n";
}

inline std::string medit_text(const std::vector<Point>& points, const Faces& faces) {
  std::ostringstream file;
  file << "MeshVersionFormatted 2\n\nDimension\n3\n\nVertices # all of them\n" << points.size() << "\n";
  for (const Point& p : points) file << coordinates(p) << " 0\n";
  file << "Corners\n1\n1\n";
  for (const std::size_t corners : {3U, 4U}) {
    std::ostringstream lines;
    std::size_t number = 0;
    for (const auto& face : faces) {
      if (face.size() != corners) continue;
      for (const std::size_t corner : face) lines << corner + 1 << " ";
      lines << "5\n";
      ++number;
    }
    if (number > 0) file << (corners == 3 ? "Triangles\n" : "Quadrilaterals\n") << number << "\n" << lines.str();
  }
  file << "Normals\n1\n0 0.5 -1e-3\nEnd\n";
  return file.str();
}

/// \tparam Place the type of places in the file, \tparam Int that of numbers
template <class Real, class Place, class Int>
std::string medit_binary(const std::vector<Point>& points, const Faces& faces, std::int32_t version, Order order) {
  std::string file = bytes<std::int32_t>({1, version}, order);
  const auto add = [&](std::int32_t code, const std::string& section) {
    const std::size_t next = file.size() + 4 + sizeof(Place) + section.size();
    file += bytes<std::int32_t>({code}, order) + bytes<Place>({static_cast<Place>(next)}, order) + section;
  };
  add(3, bytes<std::int32_t>({3}, order));
  std::string vertices = bytes<Int>({static_cast<Int>(points.size())}, order);
  for (const Point& p : points) vertices += coordinate_bytes<Real>(p, order) + bytes<Int>({0}, order);
  add(4, vertices);
  add(13, bytes<Int>({1, 1}, order));  // a corner
  std::string triangles = bytes<Int>({static_cast<Int>(faces.size())}, order);
  for (const auto& face : faces) {
    for (const std::size_t corner : face) triangles += bytes<Int>({static_cast<Int>(corner + 1)}, order);
    triangles += bytes<Int>({5}, order);
  }
  add(6, triangles);
  return file + bytes<std::int32_t>({54}, order) + bytes<Place>({0}, order);
}

struct File {
  std::string name, content;
};

/// All forms of triangles.
inline std::vector<File> all(const std::vector<Point>& points, const Faces& faces) {
  std::vector<File> files = {{"text_2.msh", msh_2_text(points, faces)},
                             {"text_4.msh", msh_4_text(points, faces)},
                             {"text.mesh", medit_text(points, faces)}};
  for (const Order order : {Order::little, Order::big}) {
    files.push_back({"binary_2.msh", msh_2_binary(points, faces, order)});
    files.push_back({"binary_4.msh", msh_4_binary(points, faces, order)});
    files.push_back({"1.meshb", medit_binary<float, std::int32_t, std::int32_t>(points, faces, 1, order)});
    files.push_back({"2.meshb", medit_binary<double, std::int32_t, std::int32_t>(points, faces, 2, order)});
    files.push_back({"3.meshb", medit_binary<double, std::int64_t, std::int32_t>(points, faces, 3, order)});
    files.push_back({"4.meshb", medit_binary<double, std::int64_t, std::int64_t>(points, faces, 4, order)});
  }
  return files;
}

}  // namespace gmsh_and_medit_files

#endif
