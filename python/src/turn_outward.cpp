// SPDX-License-Identifier: MIT

#include "turn_outward.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <utility>
#include <vector>

namespace rw_python {
namespace {

/// A part of a mesh that hangs together by edges.
struct Component {
  std::vector<Index> faces;
  Eigen::AlignedBox3d box;
  bool is_closed = true;
  double volume = 0;  ///< signed, in cubes of the mesh's largest extent; of closed components only
};

Eigen::Vector3d position(const Array_mesh& mesh, Index vertex) {
  const Point p = mesh.point(vertex);
  return {p.x(), p.y(), p.z()};
}

/// Calls a function for each halfedge of a face.
template <class Visit>
void for_each_halfedge(const Array_mesh& mesh, Index face, const Visit& visit) {
  const Index first = mesh.halfedge_of_face[face];
  Index h = first;
  do {
    visit(h);
    h = mesh.next[h];
  } while (h != first);
}

std::vector<Component> components_of(const Array_mesh& mesh) {
  std::vector<Component> components;
  std::vector<char> is_met(mesh.number_of_faces(), false);
  for (Index f = 0; f < is_met.size(); ++f) {
    if (is_met[f]) continue;
    is_met[f] = true;
    Component component;
    component.faces.push_back(f);
    for (std::size_t i = 0; i < component.faces.size(); ++i)
      for_each_halfedge(mesh, component.faces[i], [&](Index h) {
        component.box.extend(position(mesh, mesh.target[h]));
        const Index neighbour = mesh.face[h ^ 1];
        if (neighbour == none) {
          component.is_closed = false;
        } else if (!is_met[neighbour]) {
          is_met[neighbour] = true;
          component.faces.push_back(neighbour);
        }
      });
    components.push_back(std::move(component));
  }
  return components;
}

void measure_volumes(const Array_mesh& mesh, std::vector<Component>& components) {
  Eigen::AlignedBox3d box;
  for (const Component& component : components) box.extend(component.box);
  const double extent = box.isEmpty() ? 0 : box.sizes().maxCoeff();
  for (Component& component : components) {
    if (!component.is_closed || !(extent > 0)) continue;
    const Eigen::Vector3d origin = position(mesh, mesh.target[mesh.halfedge_of_face[component.faces.front()]]);
    const auto scaled = [&](Index v) -> Eigen::Vector3d { return (position(mesh, v) - origin) / extent; };
    for (const Index f : component.faces) {
      const Eigen::Vector3d apex = scaled(mesh.target[mesh.halfedge_of_face[f]]);
      for_each_halfedge(mesh, f, [&](Index h) {
        component.volume += apex.dot(scaled(mesh.source(h)).cross(scaled(mesh.target[h]))) / 6;
      });
    }
  }
}

bool is_strictly_inside(const Eigen::AlignedBox3d& inner, const Eigen::AlignedBox3d& outer) {
  return (outer.min().array() < inner.min().array()).all() && (inner.max().array() < outer.max().array()).all();
}

void turn(Array_mesh& mesh, const Component& component) {
  std::vector<Index> loop;
  for (const Index f : component.faces) {
    loop.clear();
    for_each_halfedge(mesh, f, [&](Index h) { loop.push_back(h); });
    for (std::size_t i = 0; i < loop.size(); ++i) mesh.next[loop[(i + 1) % loop.size()]] = loop[i];
    for (const Index h : loop)
      if (h % 2 == 0) std::swap(mesh.target[h], mesh.target[h + 1]);
  }
}

}  // namespace

std::size_t turn_components_outward(Array_mesh& mesh) {
  constexpr double rounding = 1e-14;
  std::vector<Component> components = components_of(mesh);
  measure_volumes(mesh, components);
  std::vector<const Eigen::AlignedBox3d*> closed;
  for (const Component& component : components)
    if (component.is_closed) closed.push_back(&component.box);
  std::sort(closed.begin(), closed.end(), [](const auto* a, const auto* b) { return a->min().x() < b->min().x(); });
  std::size_t turned = 0;
  for (const Component& component : components) {
    if (!component.is_closed || !(component.volume < -rounding)) continue;
    bool may_be_cavity = false;
    for (const auto* outer : closed) {
      if (may_be_cavity || !(outer->min().x() < component.box.min().x())) break;
      may_be_cavity = is_strictly_inside(component.box, *outer);
    }
    if (may_be_cavity) continue;
    turn(mesh, component);
    ++turned;
  }
  return turned;
}

}  // namespace rw_python
