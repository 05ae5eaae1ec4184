#ifndef RW_SEGMENTATION_INTERNAL_READ_NORMALS_H
#define RW_SEGMENTATION_INTERNAL_READ_NORMALS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/Edge_values.h>
#include <RW_segmentation/internal/unit_vector.h>

#include <CGAL/number_utils.h>

#include <Eigen/Core>

#include <boost/graph/graph_traits.hpp>

#include <string>
#include <vector>

namespace RW_segmentation::internal {

/// A face map of vectors as unit vectors in the order of the faces; zero vectors stay zero.
/// \throws std::invalid_argument if a vector is not finite, naming the face by its number
template <class FaceListGraph, class FaceNormalMap>
std::vector<Eigen::Vector3d> read_normals(const Mesh_dual_graph<FaceListGraph>& graph, const FaceNormalMap& map) {
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  static_assert(is_readable_map<FaceNormalMap, face_descriptor>,
                "A readable property map from the mesh's face_descriptor to a vector is needed here.");
  std::vector<Eigen::Vector3d> normals;
  normals.reserve(graph.number_of_faces());
  for (const face_descriptor f : graph.face_descriptors()) {
    const auto& n = get(map, f);
    const Eigen::Vector3d normal(CGAL::to_double(n[0]), CGAL::to_double(n[1]), CGAL::to_double(n[2]));
    if (!normal.allFinite())
      throw argument_error(("the normal of face " + std::to_string(normals.size())).c_str(), normal.transpose(),
                           "finite");
    normals.push_back(unit_vector(normal));
  }
  return normals;
}

}  // namespace RW_segmentation::internal

#endif
