// SPDX-License-Identifier: MIT

// How much memory the automatic segmentation takes above the mesh, which is the same on every machine.

#include <RW_segmentation/segmentation_via_random_walks.h>

#include <CGAL/tags.h>

#include <gtest/gtest.h>
#include "counted_memory.h"
#include "face_labels.h"
#include "meshes.h"

#include <cstddef>

using namespace RW_segmentation;

namespace {

/// The bytes a face that one call takes at most, with the walk over clusters of faces as large meshes have it.
double bytes_a_face(const meshes::Shape& shape) {
  const meshes::Surface_mesh mesh = meshes::surface_mesh(shape);
  Face_labels<meshes::Surface_mesh> labels(mesh);
  Automatic_segmentation policies;
  policies.reduction.largest_direct = 0;
  const std::size_t peak = counted_memory::peak_of(
      [&] { segmentation_via_random_walks<CGAL::Sequential_tag>(mesh, labels.map(), policies); });
  return static_cast<double>(peak) / static_cast<double>(mesh.number_of_faces());
}

TEST(Memory_of_segmentation, IsAtMost400BytesAFaceOfALargeMesh) {
  EXPECT_LE(bytes_a_face(meshes::sphere(6)), 400);
  EXPECT_LE(bytes_a_face(meshes::torus(1, 0.3, 400, 100)), 400);
}

TEST(Memory_of_segmentation, IsAtMost450BytesAFaceUnderHeavyNoise) {  // which adds a second set of points
  EXPECT_LE(bytes_a_face(meshes::with_noise(meshes::sphere(6), 0.02)), 450);
}

}  // namespace
