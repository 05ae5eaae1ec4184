// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_POLYGON_TRIANGLES_H
#define RW_SEGMENTATION_INTERNAL_BREP_POLYGON_TRIANGLES_H

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace RW_segmentation::internal::brep {

/// Cuts polygons of a mesh into triangles that do not overlap, and no two of which have an edge in common that is none
/// between them: a fan round the first corner where that is so, and other ears else.
class Polygon_triangles {
 public:
  using Point = Eigen::Vector3d;
  using Triangle = std::array<std::size_t, 3>;
  using Polygon = std::vector<std::size_t>;

  /// Keeps a reference to the points.
  /// \param polygons all of the mesh, whose sides no diagonal may be
  Polygon_triangles(const std::vector<Point>& points, const std::vector<Polygon>& polygons) : points_(points) {
    if (std::all_of(polygons.begin(), polygons.end(), [](const Polygon& p) { return p.size() <= 3; })) return;
    for (const Polygon& p : polygons)
      for (std::size_t i = 0; i < p.size(); ++i) edges_.insert(edge(p[i], p[(i + 1) % p.size()]));
  }

  /// Complexity: O(n^2) for n corners, as a rule.
  std::vector<Triangle> of(Polygon polygon) {
    std::vector<Triangle> triangles;
    const Point normal = twice_area(polygon);
    std::size_t at = 1;
    while (polygon.size() > 3) {
      at = next_ear(polygon, normal, at);
      const Triangle ear = corner(polygon, at);
      triangles.push_back(ear);
      edges_.insert(edge(ear[0], ear[2]));
      polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(at));
      at = std::max<std::size_t>(at, 2) - 1;  // lest corners on one line are left to the end
    }
    if (polygon.size() == 3) triangles.push_back({polygon[0], polygon[1], polygon[2]});
    return triangles;
  }

 private:
  using Edge = std::pair<std::size_t, std::size_t>;

  static Edge edge(std::size_t v, std::size_t w) { return std::minmax(v, w); }

  static Triangle corner(const Polygon& polygon, std::size_t i) {
    const std::size_t n = polygon.size();
    return {polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n]};
  }

  Point twice_area(const Polygon& polygon) const {
    Point sum = Point::Zero();
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
      sum += twice_area(Triangle{polygon[0], polygon[i], polygon[i + 1]});
    return sum;
  }
  Point twice_area(const Triangle& t) const {
    return (points_[t[1]] - points_[t[0]]).cross(points_[t[2]] - points_[t[0]]);
  }

  /// What an ear need not be where there is none.
  enum class Ear { whole, empty_or_not, of_any_area };

  /// The first corner from one on that can be cut off.
  std::size_t next_ear(const Polygon& polygon, const Point& normal, std::size_t first) const {
    for (const Ear ear : {Ear::whole, Ear::empty_or_not, Ear::of_any_area})
      for (std::size_t k = 0; k < polygon.size(); ++k)
        if (const std::size_t i = (first + k) % polygon.size(); is_ear(polygon, normal, corner(polygon, i), ear))
          return i;
    return first % polygon.size();
  }

  bool is_ear(const Polygon& polygon, const Point& normal, const Triangle& t, Ear ear) const {
    constexpr double least_area = 1e-12;  // of the polygon's
    if (t[0] == t[2] || edges_.count(edge(t[0], t[2])) > 0) return false;
    if (ear == Ear::of_any_area) return true;
    if (!(twice_area(t).dot(normal) > least_area * normal.squaredNorm())) return false;
    return ear == Ear::empty_or_not || std::none_of(polygon.begin(), polygon.end(), [&](std::size_t v) {
             return v != t[0] && v != t[1] && v != t[2] && contains(t, normal, v);
           });
  }

  /// Seen along the normal, with its sides.
  bool contains(const Triangle& t, const Point& normal, std::size_t v) const {
    for (std::size_t i = 0; i < 3; ++i)
      if (twice_area(Triangle{t[i], t[(i + 1) % 3], v}).dot(normal) < 0) return false;
    return true;
  }

  const std::vector<Point>& points_;
  std::set<Edge> edges_;
};

}  // namespace RW_segmentation::internal::brep

#endif
