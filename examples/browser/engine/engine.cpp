// SPDX-License-Identifier: MIT

// The library as a WebAssembly module for a page: its `Session` with arrays in place of vectors.
//
// Every call returns its value, or an object with the property `error` where the library throws.

#include "../../mesh_files/read_mesh.h"
#include "Session.h"
#include "generated_models.h"

#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace {

using browser_engine::Label;
using browser_engine::Session;
using emscripten::val;

/// A typed array with a copy of the values.
template <class Value>
val array_of(const std::vector<Value>& values) {
  return val(emscripten::typed_memory_view(values.size(), values.data())).call<val>("slice");
}

template <class Call>
val answer(const Call& call) {
  try {
    return call();
  } catch (const std::exception& error) {
    val failure = val::object();
    failure.set("error", std::string(error.what()));
    return failure;
  }
}

/// `answer()` of a call that returns nothing.
template <class Call>
val done(const Call& call) {
  return answer([&] {
    call();
    return val::undefined();
  });
}

val object_of(const browser_engine::Polylines& lines) {
  val result = val::object();
  result.set("points", array_of(lines.points));
  result.set("starts", array_of(lines.starts));
  return result;
}

/// The usual numbers, with the choices of the page.
segment_mesh::Method method_of(const val& way) {
  using namespace segment_mesh;
  const auto name = [&](const char* property) { return way[property].as<std::string>(); };
  Method method;
  method.difference = choice_of(difference_names, name("difference"));
  method.seeding = choice_of(seeding_names, name("seeding"));
  method.merge_cost = choice_of(merge_cost_names, name("mergeCost"));
  method.radius = RW_segmentation::Ball_radius::in_edge_lengths(way["radius"].as<double>());
  method.components = usual_components(method.seeding);
  method.seedings = usual_seedings(method.seeding, method.merge_cost);
  method.angles = angles_of(method.difference);
  take_numbers(RW_segmentation::Automatic_segmentation(), method);
  return method;
}

class Engine {
 public:
  explicit Engine(const mesh_files::Polygon_soup& soup) : session_(soup) {}

  val mesh() {
    return answer([&] {
      const browser_engine::Drawn_mesh drawn = session_.drawn_mesh();
      val notes = val::array();
      for (const std::string& remark : session_.remarks()) notes.call<void>("push", remark);
      val result = val::object();
      result.set("positions", array_of(drawn.positions));
      result.set("triangles", array_of(drawn.triangles));
      result.set("faceOfTriangle", array_of(drawn.face_of_triangle));
      result.set("faces", drawn.face_areas.size());
      result.set("faceAreas", array_of(drawn.face_areas));
      result.set("notes", notes);
      return result;
    });
  }

  /// \param walls `Walls` of the page
  val set_walls(val walls) {
    return answer([&] {
      const val file = walls["file"], angle = walls["angle"];
      std::vector<segment_mesh::Constraint> constraints;
      if (!file.isNull())
        constraints = segment_mesh::constraints_in(file["name"].as<std::string>(), file["text"].as<std::string>());
      return object_of(
          session_.set_walls(constraints, angle.isNull() ? std::nullopt : std::optional(angle.as<double>())));
    });
  }
  val prepare(double convex_weight, double sigma) {
    return done([&] { session_.prepare(convex_weight, sigma); });
  }
  val add_seed(std::size_t face, Label label) {
    return done([&] { session_.add_seed(face, label); });
  }
  val remove_seed(std::size_t face) {
    return done([&] { session_.remove_seed(face); });
  }
  val clear_seeds() {
    return done([&] { session_.clear_seeds(); });
  }
  val segment() {
    return answer([&] { return array_of(session_.segment()); });
  }
  val anticipate() {
    return done([&] { session_.anticipate(); });
  }
  val probabilities(Label label) {
    return answer([&] { return array_of(session_.probabilities(label)); });
  }

  /// \param way an `AutomaticMethod` of the page
  val hierarchy(val way, val progress) {
    return answer([&] {
      const auto callback = [&](double fraction) { return progress(fraction).as<bool>(); };
      const browser_engine::Levels levels = way["kind"].as<std::string>() == "engineering"
                                                ? session_.surface_levels(callback)
                                                : session_.levels(method_of(way), callback);
      val result = val::object();
      result.set("fragmentOfFace", array_of(levels.fragment_of_face));
      result.set("merges", array_of(levels.merged_regions));
      result.set("costs", array_of(levels.costs));
      result.set("fragments", levels.fragments);
      result.set("fewest", levels.components);
      result.set("suggested", levels.suggested);
      result.set("levels", array_of(levels.offered));
      return result;
    });
  }

  /// \param regularity a `Regularity` of the page, or null
  val surfaces(val labels, val regularity) {
    return answer([&] {
      const auto number = [&](const char* property) {
        const val given = regularity[property];
        return given.isNull() ? std::nullopt : std::optional(given.as<double>());
      };
      std::optional<segment_mesh::Regular_option> option;
      if (!regularity.isNull()) option = segment_mesh::Regular_option{number("length"), number("angle")};
      return val(session_.surfaces(emscripten::convertJSArrayToNumberVector<Label>(labels), option).dump());
    });
  }

  val smooth_boundaries(val labels) {
    return answer(
        [&] { return object_of(session_.smooth_boundaries(emscripten::convertJSArrayToNumberVector<Label>(labels))); });
  }

  /// \param colors four numbers for each label: itself, red, green and blue
  val file(const std::string& format, const std::string& name, const std::string& materials, val labels, val colors) {
    return answer([&] {
      const auto numbers = emscripten::convertJSArrayToNumberVector<Label>(labels),
                 rows = emscripten::convertJSArrayToNumberVector<Label>(colors);
      std::map<std::size_t, mesh_files::Color> color_of_label;
      for (std::size_t i = 0; i + 3 < rows.size(); i += 4)
        for (std::size_t channel = 0; channel < 3; ++channel)
          color_of_label[rows[i]][channel] = static_cast<std::uint8_t>(rows[i + 1 + channel]);
      browser_engine::Kept_file file(name);
      session_.write(format, materials, {numbers.begin(), numbers.end()}, color_of_label, file);
      const auto* const bytes = reinterpret_cast<const std::uint8_t*>(file.bytes().data());
      return val(emscripten::typed_memory_view(file.bytes().size(), bytes)).call<val>("slice");
    });
  }

 private:
  Session session_;
};

/// \param name decides the format where the content does not
val read_mesh(const std::string& bytes, const std::string& name) {
  return answer([&] { return val(std::make_shared<Engine>(mesh_files::mesh_of_content(name, bytes))); });
}

val models() {
  val names = val::array();
  for (const auto& model : browser_engine::models()) names.call<void>("push", model.name);
  return names;
}

val generate_mesh(const std::string& name) {
  return answer([&] { return val(std::make_shared<Engine>(browser_engine::generated(name))); });
}

}  // namespace

EMSCRIPTEN_BINDINGS(engine) {
  emscripten::function("readMesh", &read_mesh);
  emscripten::function("models", &models);
  emscripten::function("generateMesh", &generate_mesh);
  emscripten::class_<Engine>("Engine")
      .smart_ptr<std::shared_ptr<Engine>>("Engine")
      .function("mesh", &Engine::mesh)
      .function("setWalls", &Engine::set_walls)
      .function("prepare", &Engine::prepare)
      .function("addSeed", &Engine::add_seed)
      .function("removeSeed", &Engine::remove_seed)
      .function("clearSeeds", &Engine::clear_seeds)
      .function("segment", &Engine::segment)
      .function("anticipate", &Engine::anticipate)
      .function("probabilities", &Engine::probabilities)
      .function("hierarchy", &Engine::hierarchy)
      .function("surfaces", &Engine::surfaces)
      .function("smoothBoundaries", &Engine::smooth_boundaries)
      .function("file", &Engine::file);
}
