// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_READ_3MF_H
#define MESH_FILES_READ_3MF_H

#include "Polygon_soup.h"
#include "Text.h"
#include "Xml_tags.h"
#include "read_zip.h"

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Simple_cartesian.h>

#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/replace.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mesh_files {
namespace three_mf {

using Transform = CGAL::Aff_transformation_3<CGAL::Simple_cartesian<double>>;
using Id = std::uint32_t;

/// An object of a part of the package, and where it is put.
struct Placement {
  std::string part;
  Id object = 0;
  Transform transform{CGAL::IDENTITY};
};

struct Object {
  std::string name;
  Polygon_soup mesh;
  std::vector<Placement> components;

  /// The vertices and corners of its faces and of those of its components, as often as these are put into it.
  double size = 0;
  /// In how many others it was, at most, when that was counted, and one more.
  std::size_t deepest = 0;
};

/// What a part of the package holds: objects, and which of them are built.
struct Model {
  std::map<Id, Object> objects;
  std::vector<Placement> items;
  std::vector<std::string> remarks;
};

/// A value with the characters that XML spells out.
inline std::string unescaped(std::string_view value) {
  std::string text(value);
  for (const auto& [spelled, character] : {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&apos;", "'"}})
    boost::replace_all(text, spelled, character);
  boost::replace_all(text, "&amp;", "&");  // at last: it may stand before "lt;"
  return text;
}

/// A name as messages have it, which are one line whatever the file holds.
inline std::string shown(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }, '?');
  return name;
}

/// The name by which an archive has a part.
inline std::string part_name(std::string_view path) {
  if (path.substr(0, 1) == "/") path.remove_prefix(1);
  return unescaped(path);
}

/// Reads a part that holds a model.
class Model_reader {
 public:
  Model_reader(const std::string& path, std::string part, std::string_view content)
      : part_(std::move(part)), path_(path + ": " + shown(part_)), tags_(path_, content) {}

  Model model() && {
    read_root();
    while (tags_.next()) {
      const std::string_view name = core_name();
      if (tags_.is_closing()) {
        if (name == "object") object_ = nullptr;
        if (name == "model") return std::move(model_);
      } else if (name == "vertex") {
        read_vertex();
      } else if (name == "triangle") {
        read_triangle();
      } else if (name == "object") {
        begin_object();
      } else if (name == "component") {
        object("component").components.push_back(placement());
      } else if (name == "item") {
        model_.items.push_back(placement());
      }
    }
    tags_.fail("the file ends within the model");
  }

 private:
  void read_root() {
    constexpr std::string_view name = "model";
    if (!tags_.next() || tags_.is_closing() || !boost::ends_with(tags_.name(), name))
      tags_.fail("a model of a 3MF file starts with <model>, this one does not");
    prefix_ = tags_.name().substr(0, tags_.name().size() - name.size());
    const std::string_view unit = tags_.attribute("unit").value_or("millimeter");
    if (unit != "millimeter") model_.remarks.push_back("coordinates are in the unit of the file, " + printable(unit));
    remark_extensions();
  }

  /// Tells which of the extensions that a reader must know are not read.
  void remark_extensions() {
    std::string_view rest = tags_.attribute("requiredextensions").value_or("");
    while (!(rest = rest.substr(std::min(rest.find_first_not_of(blanks), rest.size()))).empty()) {
      const std::string prefix(rest.substr(0, rest.find_first_of(blanks)));
      rest.remove_prefix(prefix.size());
      const std::string_view name = tags_.attribute("xmlns:" + prefix).value_or(prefix);
      const bool is_known = boost::contains(name, "/production/") || boost::contains(name, "/material/") ||
                            boost::contains(name, "/trianglesets/");
      if (!is_known) model_.remarks.push_back("passed over what the extension " + shown(std::string(name)) + " adds");
    }
  }

  /// The name of a tag of the core specification; other names are those of extensions, which have some in common with it.
  std::string_view core_name() const {
    return boost::starts_with(tags_.name(), prefix_) ? tags_.name().substr(prefix_.size()) : std::string_view();
  }

  void begin_object() {
    Object object;
    object.name = unescaped(tags_.attribute("name").value_or(""));
    const auto id = number<Id>("id");
    const auto [place, is_new] = model_.objects.emplace(id, std::move(object));
    if (!is_new) tags_.fail("there is another object " + std::to_string(id));
    object_ = tags_.is_empty() ? nullptr : &place->second;
  }

  Object& object(const char* what) {
    if (!object_) tags_.fail(std::string("a ") + what + " is outside of an object");
    return *object_;
  }

  void read_vertex() {
    std::vector<Polygon_soup::Point>& points = object("vertex").mesh.points;
    if (points.size() == std::numeric_limits<Polygon_soup::Index>::max())
      tags_.fail("more vertices than 32 bits can number");
    const auto x = coordinate("x"), y = coordinate("y");
    points.emplace_back(x, y, coordinate("z"));
  }

  void read_triangle() {
    Polygon_soup& mesh = object("triangle").mesh;
    for (const char* corner : {"v1", "v2", "v3"}) {
      const auto vertex = number<Polygon_soup::Index>(corner);
      if (vertex >= mesh.points.size())
        tags_.fail("the triangle names vertex " + std::to_string(vertex) + ", its object has " +
                   std::to_string(mesh.points.size()) + " (the first is vertex 0)");
      mesh.corners.push_back(vertex);
    }
    mesh.end_face();
  }

  Placement placement() const {
    Placement result;
    result.object = number<Id>("objectid");
    result.part = part_;
    for (const auto& [name, value] : tags_.attributes())  // the production extension, by whatever prefix
      if (boost::ends_with(name, ":path")) result.part = part_name(value);
    if (const auto matrix = tags_.attribute("transform")) result.transform = transform(*matrix);
    return result;
  }

  /// The twelve numbers of a matrix by which points are multiplied from the left.
  Transform transform(std::string_view text) const {
    std::array<double, 12> m{};
    for (double& value : m) {
      text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
      const std::string_view word = text.substr(0, text.find_first_of(blanks));
      text.remove_prefix(word.size());
      const std::optional<double> number = number_in<double>(word);
      if (!number || !std::isfinite(*number)) tags_.fail("the transform is not twelve finite numbers");
      value = *number;
    }
    return {m[0], m[3], m[6], m[9], m[1], m[4], m[7], m[10], m[2], m[5], m[8], m[11]};
  }

  double coordinate(const char* name) const {
    const auto value = number<double>(name);
    if (!std::isfinite(value)) tags_.fail(std::string(name) + " of the vertex is not finite");
    return value;
  }

  template <class Number>
  Number number(const char* name) const {
    const std::optional<std::string_view> word = tags_.attribute(name);
    const std::optional<Number> value = word ? number_in<Number>(*word) : std::nullopt;
    if (!value)
      tags_.fail(std::string(name) + " of the " + std::string(core_name()) +
                 (word ? " is " + printable(*word) + ", not a number" : " is missing"));
    return *value;
  }

  static constexpr const char* blanks = " \t\r\n";

  std::string part_, path_;
  Xml_tags tags_;
  std::string_view prefix_;   // of the names of tags of the core specification
  Object* object_ = nullptr;  // that the tags are in
  Model model_;
};

/// Reads a package: the objects of its parts, each where it is put.
class Package_reader {
 public:
  Package_reader(const std::string& path, std::string_view content) : path_(path), files_(path, content) {}

  Polygon_soup soup() && {
    const std::string root = root_part();
    Model& model = model_of(root);
    soup_.remarks = model.remarks;
    if (model.items.empty() && !model.objects.empty()) {
      soup_.remarks.push_back("nothing is on the build platform: read all objects, each where it is");
      for (const auto& [id, object] : model.objects)
        if (object.mesh.number_of_faces() > 0) model.items.push_back({root, id});
    }
    double size = 0;
    for (const Placement& item : model.items) size += count(item, 0);
    if (size > std::numeric_limits<Polygon_soup::Index>::max())
      files_.fail(
          "more vertices and corners of faces than 32 bits can number, with each object as often as it is there");
    for (const Placement& item : model.items) add(item, Transform(CGAL::IDENTITY), "");
    return std::move(soup_);
  }

 private:
  /// The part that the package says holds its model.
  std::string root_part() const {
    if (const Zip_files::Entry* const relationships = files_.find("_rels/.rels")) {
      const std::string path = path_ + ": " + relationships->name, content = files_.bytes(*relationships);
      Xml_tags tags(path, content);
      while (tags.next())
        if (boost::ends_with(tags.attribute("Type").value_or(""), "/3dmodel"))
          return part_name(tags.attribute("Target").value_or(""));
    }
    for (const Zip_files::Entry& entry : files_.entries())
      if (boost::ends_with(entry.name, ".model")) return entry.name;
    files_.fail("the 3MF file holds no model");
  }

  Model& model_of(const std::string& part) {
    const auto [found, is_new] = models_.try_emplace(part);
    if (is_new) {
      const Zip_files::Entry* const entry = files_.find(part);
      if (!entry) files_.fail("the 3MF file has no part " + printable(part) + ", where its model should be");
      found->second = Model_reader(path_, part, files_.bytes(*entry)).model();
    }
    return found->second;
  }

  Object& object_of(const Placement& placement) {
    Model& model = model_of(placement.part);
    const auto found = model.objects.find(placement.object);
    if (found == model.objects.end())
      files_.fail(shown(placement.part) + ": there is no object " + std::to_string(placement.object));
    return found->second;
  }

  /// The size of an object, see there.
  /// \param depth in how many others it is
  double count(const Placement& placement, std::size_t depth) {
    constexpr std::size_t largest_depth = 64;  // deeper than any program nests them; what is endless is deeper
    if (depth == largest_depth) files_.fail("objects are components of themselves, or of too many others");
    Object& object = object_of(placement);
    if (object.deepest <= depth) {  // its components may be too deep now
      object.deepest = depth + 1;
      const bool has_faces = object.mesh.number_of_faces() > 0;
      object.size = has_faces ? static_cast<double>(object.mesh.points.size() + object.mesh.corners.size()) : 0;
      for (const Placement& component : object.components) object.size += count(component, depth + 1);
    }
    return object.size;
  }

  /// \param name of what it is a component of
  void add(const Placement& placement, const Transform& outer, const std::string& name) {
    const Object& object = object_of(placement);
    if (object.size == 0) return;  // however often it is put somewhere
    const Transform transform = outer * placement.transform;
    const std::string& own_name = object.name.empty() ? name : object.name;
    if (object.mesh.number_of_faces() > 0) add(object.mesh, transform, own_name);
    for (const Placement& component : object.components) add(component, transform, own_name);
  }

  void add(const Polygon_soup& mesh, const Transform& transform, const std::string& name) {
    const std::size_t first_point = soup_.points.size();
    soup_.parts.push_back({name, soup_.number_of_faces()});
    for (const Polygon_soup::Point& p : mesh.points) {
      const Polygon_soup::Point q = transform(p);
      if (!std::isfinite(q.x()) || !std::isfinite(q.y()) || !std::isfinite(q.z()))
        files_.fail("a vertex is not finite where its object is put");
      soup_.points.push_back(q);
    }
    using Order = std::array<std::ptrdiff_t, 3>;
    const Order order = transform.is_even() ? Order{0, 1, 2} : Order{0, 2, 1};  // one that mirrors turns triangles over
    for (std::size_t f = 0; f < mesh.number_of_faces(); ++f) {
      const auto triangle = mesh.face(f);
      for (const std::ptrdiff_t corner : order)
        soup_.corners.push_back(static_cast<Polygon_soup::Index>(first_point + triangle[corner]));
      soup_.end_face();
    }
  }

  std::string path_;
  Zip_files files_;
  std::map<std::string, Model> models_;  // by part
  Polygon_soup soup_;
};

}  // namespace three_mf

/// Whether a content is a ZIP archive with a model where 3MF files have it.
inline bool is_3mf(std::string_view content) {
  constexpr std::size_t none = std::string_view::npos;
  return is_zip(content) && content.find("3D/") != none && content.find(".model") != none;
}

/// Reads the triangles of a 3MF file (https://3mf.io/spec, core specification 1.3, and the production extension): of all objects on
/// the build platform, each as often as it is there, and of their components. They are `parts` of the soup.
inline Polygon_soup read_3mf(const std::string& path, std::string_view content) {
  if (!is_zip(content)) throw Unreadable_file(path + ": this is no 3MF file, which is a ZIP archive");
  return three_mf::Package_reader(path, content).soup();
}

}  // namespace mesh_files

#endif
