// SPDX-License-Identifier: MIT

#include "read_by_assimp.h"

#include "../mesh_files/Text.h"
#include "../mesh_files/read_mesh.h"

#ifdef RW_SEGMENTATION_WITH_ASSIMP
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#endif

#include <boost/functional/hash.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <system_error>
#include <unordered_map>
#include <utility>
#include <vector>

namespace segment_mesh {

using mesh_files::Polygon_soup;

std::string extension_for_assimp(const std::string& path, std::string_view content) {
  const auto starts_with = [&](std::string_view mark) { return content.substr(0, mark.size()) == mark; };
  if (starts_with("glTF")) return "glb";
  if (starts_with("Kaydara FBX Binary")) return "fbx";
  constexpr std::size_t beginning = 1 << 16;
  if (content.substr(0, beginning).find("<COLLADA") != std::string_view::npos) return "dae";
  const std::string extension = mesh_files::extension_of(path);
  for (const char* known : {"glb", "gltf", "dae", "fbx", "3ds", "amf", "blend", "lwo", "x3d"})
    if (extension == std::string(".") + known && !mesh_files::format_of_content(content)) return known;
  return "";
}

#ifdef RW_SEGMENTATION_WITH_ASSIMP

namespace {

/// Collects the meshes of a scene.
class Scene_reader {
 public:
  explicit Scene_reader(const std::string& path) : path_(path) {}

  Polygon_soup soup(const aiScene& scene) && {
    add(scene, *scene.mRootNode, aiMatrix4x4());
    if (passed_over_ > 0) soup_.remarks.push_back("passed over " + std::to_string(passed_over_) + " points and lines");
    return std::move(soup_);
  }

 private:
  void add(const aiScene& scene, const aiNode& node, const aiMatrix4x4& of_parent) {
    const aiMatrix4x4 transform = of_parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
      const std::size_t first_face = soup_.number_of_faces();
      add(mesh, transform);
      const std::string name = node.mName.length > 0 ? node.mName.C_Str() : mesh.mName.C_Str();
      if (soup_.number_of_faces() > first_face) soup_.parts.push_back({name, first_face});
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) add(scene, *node.mChildren[i], transform);
  }

  void add(const aiMesh& mesh, const aiMatrix4x4& transform) {
    const std::vector<Polygon_soup::Index> points = add_points(mesh, transform);
    const bool is_mirrored = transform.Determinant() < 0;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices < 3) {
        ++passed_over_;
        continue;
      }
      const auto first = static_cast<std::ptrdiff_t>(soup_.corners.size());
      for (unsigned i = 0; i < face.mNumIndices; ++i) {
        if (face.mIndices[i] >= points.size())
          throw mesh_files::Unreadable_file(path_ + ": a face names a vertex that is not there");
        soup_.corners.push_back(points[face.mIndices[i]]);
      }
      if (is_mirrored) std::reverse(soup_.corners.begin() + first, soup_.corners.end());
      soup_.end_face();
    }
  }

  /// The numbers of the mesh's vertices in the soup. Formats repeat vertices for each of their normals and colours.
  std::vector<Polygon_soup::Index> add_points(const aiMesh& mesh, const aiMatrix4x4& transform) {
    using Place = std::array<double, 3>;
    std::unordered_map<Place, Polygon_soup::Index, boost::hash<Place>> number;
    std::vector<Polygon_soup::Index> points;
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D p = mesh.mVertices[v];
      const Place place = {double(p.x) + 0., double(p.y) + 0., double(p.z) + 0.};
      const auto [found, is_new] = number.emplace(place, static_cast<Polygon_soup::Index>(soup_.points.size()));
      if (is_new) soup_.points.push_back(moved(place, transform));
      points.push_back(found->second);
    }
    return points;
  }

  Polygon_soup::Point moved(const std::array<double, 3>& p, const aiMatrix4x4& m) const {
    std::array<double, 3> q{};
    for (unsigned i = 0; i < 3; ++i) {
      q[i] = double(m[i][0]) * p[0] + double(m[i][1]) * p[1] + double(m[i][2]) * p[2] + double(m[i][3]);
      if (!std::isfinite(q[i])) throw mesh_files::Unreadable_file(path_ + ": a coordinate is not finite");
    }
    return {q[0], q[1], q[2]};
  }

  const std::string& path_;
  Polygon_soup soup_;
  std::size_t passed_over_ = 0;
};

}  // namespace

Polygon_soup read_by_assimp(const std::string& path, std::string_view content, const std::string& extension) {
  Assimp::Importer importer;
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(path, error);
  const aiScene* const scene = is_file && mesh_files::extension_of(path) == "." + extension
                                   ? importer.ReadFile(path, aiProcess_ValidateDataStructure)
                                   : importer.ReadFileFromMemory(content.data(), content.size(),
                                                                 aiProcess_ValidateDataStructure, extension.c_str());
  if (!scene || !scene->mRootNode) {
    std::string cause = importer.GetErrorString();
    std::replace_if(
        cause.begin(), cause.end(), [](char c) { return c < ' ' || c > '~'; }, ' ');
    throw mesh_files::Unreadable_file(path + ": Assimp, which reads such files, says: " + cause);
  }
  return Scene_reader(path).soup(*scene);
}

#else

Polygon_soup read_by_assimp(const std::string& path, std::string_view, const std::string& extension) {
  throw mesh_files::Unreadable_file(
      path + ": this is a file ." + extension +
      ", which only a segment_mesh reads that is built with Assimp (Debian's libassimp-dev)");
}

#endif

}  // namespace segment_mesh
