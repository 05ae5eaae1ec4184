// SPDX-License-Identifier: MIT

// 3MF files: objects where a package puts them, archives in all forms, and packages that are broken.

#include "../examples/mesh_files.h"

#include "three_mf_files.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace test_3mf_files {

namespace {

using mesh_bytes::Point;
using mesh_files::Polygon_soup;
using three_mf_files::archive;
using three_mf_files::Form;
using three_mf_files::model;
using three_mf_files::package;
using three_mf_files::Parts;
using three_mf_files::tetrahedron;

constexpr std::size_t relationships = 1, main_part = 2;  // of a package

Polygon_soup soup_of(const Parts& parts, const Form& form = {}) {
  return mesh_files::mesh_of_content("test.3mf", archive(parts, form));
}

Polygon_soup soup_of(const std::string& resources, const std::string& items, const std::string& attributes = "") {
  return soup_of(package(model(resources, items, attributes)));
}

std::string object(int id, const std::string& content, const std::string& name = "") {
  return "<object id=\"" + std::to_string(id) + "\"" + (name.empty() ? "" : " name=\"" + name + "\"") + ">" + content +
         "</object>";
}

std::string placed(const char* tag, int id, const std::string& transform = "", const std::string& more = "") {
  return "<" + std::string(tag) + " objectid=\"" + std::to_string(id) + "\"" +
         (transform.empty() ? "" : " transform=\"" + transform + "\"") + more + "/>";
}

std::string item(int id, const std::string& transform = "", const std::string& more = "") {
  return placed("item", id, transform, more);
}

std::string components(const std::vector<std::string>& placements) {
  std::string text;
  for (const std::string& placement : placements) text += placement;
  return "<components>" + text + "</components>";
}

double volume(const Polygon_soup& soup) {
  double six_volumes = 0;
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    const auto corner = [&](std::ptrdiff_t i) { return soup.points[soup.face(f)[i]] - CGAL::ORIGIN; };
    six_volumes += CGAL::cross_product(corner(0), corner(1)) * corner(2);
  }
  return six_volumes / 6;
}

void expect_tetrahedron(const Polygon_soup& soup) {
  EXPECT_EQ(soup.points, mesh_bytes::tetrahedron_points);
  ASSERT_EQ(soup.number_of_faces(), mesh_bytes::tetrahedron_faces.size());
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    const auto face = soup.face(f);
    EXPECT_EQ(std::vector<std::size_t>(face.begin(), face.end()), mesh_bytes::tetrahedron_faces[f]);
  }
}

void expect_refusal(const std::string& content, const std::string& message, const std::string& name = "test.3mf") {
  try {
    mesh_files::mesh_of_content(name, content);
    ADD_FAILURE() << "read what should be refused by: " << message;
  } catch (const mesh_files::Unreadable_file& error) {
    EXPECT_EQ(std::string(error.what()), name + ": " + message);
  }
}

void expect_refusal(const Parts& parts, const std::string& message, const Form& form = {}) {
  expect_refusal(archive(parts, form), message);
}

/// Of an object with a tetrahedron and something else.
void expect_model_refused(const std::string& resources, const std::string& items, const std::string& message) {
  expect_refusal(package(model(object(1, tetrahedron()) + resources, items)), message);
}

const std::string in_model = "3D/3dmodel.model:5: ";  // in the line of the resources

}  // namespace

TEST(Files_of_3mf, AreReadWhateverTheFormOfTheArchive) {
  for (const Form& form : three_mf_files::all_forms()) {
    SCOPED_TRACE(form.name());
    const Parts parts = package(model(object(7, tetrahedron()), item(7)));
    expect_tetrahedron(soup_of(parts, form));
    for (const char* name : {"print", "print.3MF", "-"}) {
      SCOPED_TRACE(name);
      expect_tetrahedron(mesh_files::mesh_of_content(name, archive(parts, form)));
    }
  }
}

TEST(Files_of_3mf, HaveTheirModelWhereTheirRelationshipsSay) {
  const std::string right = model(object(1, tetrahedron()), item(1)), wrong = model("", "");
  Parts parts = package(right, "/3D/Right &amp; whole.MODEL");
  parts[main_part].first = "3D/right & whole.model";  // names of parts have no case
  parts.insert(parts.begin(), {"3D/3dmodel.model", wrong});
  expect_tetrahedron(soup_of(parts));
  expect_tetrahedron(soup_of(Parts{{"3D/print.model", right}}));  // without relationships
}

TEST(Files_of_3mf, HaveObjectsAsOftenAsTheyAreBuilt) {
  const Polygon_soup soup =
      soup_of(object(1, tetrahedron(), "a &lt;b&gt; &amp;amp;") + object(2, tetrahedron(), "idle"),
              item(1, "1 0 0 0 1 0 0 0 1 10 20 30") + item(1));
  ASSERT_EQ(soup.points.size(), 8U);
  ASSERT_EQ(soup.number_of_faces(), 8U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(soup.points[i], mesh_bytes::tetrahedron_points[i] + (Point(10, 20, 30) - CGAL::ORIGIN));
    EXPECT_EQ(soup.points[4 + i], mesh_bytes::tetrahedron_points[i]);
  }
  EXPECT_EQ(soup.face(4)[1], 6U);
  ASSERT_EQ(soup.parts.size(), 2U);
  EXPECT_EQ(soup.parts[0].name, "a <b> &amp;");
  EXPECT_EQ(soup.parts[1].first_face, 4U);
}

TEST(Files_of_3mf, MultiplyPointsByMatricesFromTheLeftThoseOfComponentsFirst) {
  const std::string resources =
      object(1, tetrahedron()) +
      object(2, components({placed("component", 1, "0 1 0 -1 0 0 0 0 1 1 0 0")})) +  // x to y, then one along x
      object(3, components({placed("component", 2, " 2 0 0\n0 2 0 0 0 2\t0 0 5 ")}));
  const Polygon_soup soup = soup_of(resources, item(3, "1 0 0 0 1 0 0 0 1 100 0 0"));
  const std::vector<Point> expected = {{102, 0, 5}, {102, 2, 5}, {100, 0, 5}, {102, 0, 6}};
  EXPECT_EQ(soup.points, expected);
}

TEST(Files_of_3mf, KeepTheInsideOfObjectsThatAreMirrored) {
  const std::string resources =
      object(1, tetrahedron()) + object(2, components({placed("component", 1, "-1 0 0 0 1 0 0 0 1 0 0 0")}));
  const double whole = volume(soup_of(resources, item(1)));
  EXPECT_GT(whole, 0);
  EXPECT_DOUBLE_EQ(volume(soup_of(resources, item(2))), whole);
  EXPECT_DOUBLE_EQ(volume(soup_of(resources, item(2, "1 0 0 0 1 0 0 0 -3 0 0 0"))), 3 * whole);
}

TEST(Files_of_3mf, NameMeshesByThemselvesOrByWhatTheyAreComponentsOf) {
  const std::string resources = object(1, tetrahedron()) + object(2, tetrahedron(), "lid") +
                                object(3, components({placed("component", 1), placed("component", 2)}), "box");
  const Polygon_soup soup = soup_of(resources, item(3) + item(1));
  ASSERT_EQ(soup.parts.size(), 3U);
  EXPECT_EQ(soup.parts[0].name, "box");
  EXPECT_EQ(soup.parts[1].name, "lid");
  EXPECT_EQ(soup.parts[2].name, "");
  EXPECT_EQ(soup.parts[2].first_face, 8U);
}

TEST(Files_of_3mf, HaveObjectsInOtherPartsToo) {
  const std::string elsewhere = " p:path=\"/3D/Objects/lid.model\"";
  Parts parts = package(model(object(1, components({placed("component", 1, "1 0 0 0 1 0 0 0 1 0 0 9", elsewhere)})),
                              item(1) + item(2, "", elsewhere),
                              " requiredextensions=\"p\" xmlns:p=\"http://schemas."
                              "microsoft.com/3dmanufacturing/production/2015/06\""));
  parts.emplace_back("3D/Objects/lid.model",
                     model(object(1, tetrahedron(), "lid") + object(2, components({placed("component", 1)})), ""));
  const Polygon_soup soup = soup_of(parts);
  EXPECT_EQ(soup.number_of_faces(), 8U);
  EXPECT_EQ(soup.points[0], Point(0, 0, 9));
  EXPECT_EQ(soup.points[4], Point(0, 0, 0));
  EXPECT_EQ(soup.parts[1].name, "lid");
  EXPECT_TRUE(soup.remarks.empty());
}

TEST(Files_of_3mf, AreReadWithoutWhatExtensionsAddWhichIsSaid) {
  const std::string slices =
      "<s:slicestack id=\"9\"><s:slice ztop=\"1\"><s:vertices><s:vertex x=\"1\" y=\"2\"/></s:vertices></s:slice>"
      "</s:slicestack>";
  const Polygon_soup soup =
      soup_of(slices + object(1, tetrahedron()), item(1),
              " requiredextensions=\" s  p\" xmlns:s=\"http://slices\" xmlns:p=\"a/production/b\"");
  expect_tetrahedron(soup);
  EXPECT_EQ(soup.remarks, std::vector<std::string>{"passed over what the extension http://slices adds"});
}

TEST(Files_of_3mf, MayHaveAPrefixForAllNames) {
  std::string text = model(object(1, tetrahedron()), item(1));
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos; ++at)
    if (text[at + 1] != '?') text.insert(at + (text[at + 1] == '/' ? 2 : 1), "c:");
  expect_tetrahedron(soup_of(package(text)));
}

TEST(Files_of_3mf, TellTheirUnitUnlessItIsTheUsualOne) {
  EXPECT_TRUE(soup_of(object(1, tetrahedron()), item(1), " unit=\"millimeter\"").remarks.empty());
  const Polygon_soup soup = soup_of(object(1, tetrahedron()), item(1), " unit=\"inch\"");
  EXPECT_EQ(soup.remarks, std::vector<std::string>{"coordinates are in the unit of the file, 'inch'"});
}

TEST(Files_of_3mf, AreReadWhereNothingIsToBeBuilt) {
  const Polygon_soup soup = soup_of(
      object(1, tetrahedron()) + object(2, components({placed("component", 1)})) + object(3, tetrahedron()), "");
  EXPECT_EQ(soup.number_of_faces(), 8U);
  ASSERT_EQ(soup.remarks.size(), 1U);
  EXPECT_EQ(soup.remarks[0], "nothing is on the build platform: read all objects, each where it is");
}

TEST(Files_of_3mf, WithObjectsInThemselvesOrWithoutEndAreRefused) {
  expect_model_refused(
      object(2, components({placed("component", 3)})) + object(3, components({placed("component", 2)})),
      item(1) + item(2), "objects are components of themselves, or of too many others");
  // Each twice in the next: 2^60 tetrahedra, or none.
  for (const std::string& mesh : {tetrahedron(), std::string("<mesh/>")}) {
    std::string resources = object(1, mesh);
    for (int id = 2; id <= 61; ++id)
      resources += object(id, components({placed("component", id - 1), placed("component", id - 1)}));
    if (mesh != tetrahedron()) {
      EXPECT_EQ(soup_of(resources, item(61)).number_of_faces(), 0U);
      continue;
    }
    expect_refusal(
        package(model(resources, item(61))),
        "more vertices and corners of faces than 32 bits can number, with each object as often as it is there");
  }
  // As deep as is allowed from the last item on, and one more; each is known to be deep enough from the one before.
  std::string resources = object(1, tetrahedron()), items = item(1);
  for (int id = 2; id <= 65; ++id) {
    resources += object(id, components({placed("component", id - 1)}));
    if (id == 65) {
      EXPECT_EQ(soup_of(resources, items).number_of_faces(), 64U * 4U);
    }
    items += item(id);
  }
  expect_refusal(package(model(resources, items)), "objects are components of themselves, or of too many others");
}

TEST(Files_of_3mf, WithBrokenModelsAreRefusedWithTheFault) {
  const std::string start = "<mesh><vertices><vertex x=\"0\" y=\"0\" ";
  for (const auto& [resources, items, message] : std::vector<std::array<std::string, 3>>{
           {object(2, start + "/>"), "", in_model + "z of the vertex is missing"},
           {object(2, start + "z=\"1e999\"/>"), "", in_model + "z of the vertex is not finite"},
           {object(2, start + "z=\"0,5\"/>"), "", in_model + "z of the vertex is '0,5', not a number"},
           {object(2, "<triangle v1=\"0\" v2=\"0\" v3=\"0\"/>"), "",
            in_model + "the triangle names vertex 0, its object has 0 (the first is vertex 0)"},
           {"<vertex x=\"0\" y=\"0\" z=\"0\"/>", "", in_model + "a vertex is outside of an object"},
           {"<object id=\"2\"/><triangle v1=\"0\" v2=\"0\" v3=\"0\"/>", "",
            in_model + "a triangle is outside of an object"},
           {"<component objectid=\"1\"/>", "", in_model + "a component is outside of an object"},
           {"<object/>", "", in_model + "id of the object is missing"},
           {object(1, ""), "", in_model + "there is another object 1"},
           {object(2, start), "", in_model + "the tag 'vertex' is broken"},
           {"", item(-1), "3D/3dmodel.model:6: objectid of the item is '-1', not a number"},
           {"", item(1, "1 0 0 0 1 0 0 0 1 0 0"), "3D/3dmodel.model:6: the transform is not twelve finite numbers"},
           {"", item(1, "1 0 0 0 1 0 0 0 1 0 0 inf"), "3D/3dmodel.model:6: the transform is not twelve finite numbers"},
           {"", item(8), "3D/3dmodel.model: there is no object 8"},
           {object(2, components({placed("component", 9)})), item(2), "3D/3dmodel.model: there is no object 9"},
           {"", item(1, "", " p:path=\"/3D/no.model\""),
            "the 3MF file has no part '3D/no.model', where its model should be"},
           {object(2, components({placed("component", 1, "1e300 0 0 0 1 0 0 0 1 0 0 0")})),
            item(2, "1e300 0 0 0 1 0 0 0 1 0 0 0"), "a vertex is not finite where its object is put"}})
    expect_model_refused(resources, items, message);
  expect_refusal(Parts{{"3D/\n.model", "<model/>"}}, "3D/?.model:1: the file ends within the model");
  expect_refusal(package("<html/>"),
                 "3D/3dmodel.model:1: a model of a 3MF file starts with <model>, this one does not");
  expect_refusal(package("<model>\n<resources/>"), "3D/3dmodel.model:2: the file ends within the model");
}

TEST(Files_of_3mf, WithBrokenArchivesAreRefusedWithTheFault) {
  const Parts parts = package(model(object(1, tetrahedron()), item(1)));
  const std::string whole = archive(parts);
  expect_refusal(whole.substr(0, whole.size() - 1), "the ZIP archive is cut off");
  expect_refusal("a letter", "this is no 3MF file, which is a ZIP archive");
  expect_refusal("", "the file is empty");
  expect_refusal("PK\3\4", "the ZIP archive is cut off");
  expect_refusal("PK\3\4 3D/part.off", "this is a ZIP archive; unpack it first", "folder.zip");
  expect_refusal(Parts{{"3D/part.off", "OFF"}}, "the 3MF file holds no model");
  expect_refusal(Parts{parts[relationships]}, "the 3MF file has no part '3D/3dmodel.model', where its model should be");
  Form form;
  form.flags = 1;
  expect_refusal(parts, "its part '_rels/.rels' is encrypted", form);
  form = {};
  form.method = 12;
  expect_refusal(parts, "its part '_rels/.rels' is packed by method 12, not by Deflate", form);
  form.method = 8;
  expect_refusal(parts, "its part '_rels/.rels' is damaged: it is not what was packed", form);
  std::string broken = whole;
  broken[whole.find("PK\1\2")] = 'p';
  expect_refusal(broken, "the ZIP archive is damaged: the list of its files is broken");
  broken = whole;
  broken.replace(whole.find("<vertex "), 8, "<vortex ");
  expect_refusal(broken, "its part '3D/3dmodel.model' is damaged: it is not what was packed");
}

TEST(Files_of_3mf, ThatAreDamagedAreRefusedOrHoldWhatTheyHeld) {
  for (const Form& form : three_mf_files::all_forms()) {
    if (form.has_sizes_behind_data || !form.comment.empty()) continue;  // bytes that tell nothing more
    const std::string whole = archive(package(model(object(1, tetrahedron()), item(1))), form);
    for (std::size_t at = 0; at < whole.size(); ++at)
      for (const char bits : {'\1', '\xff'}) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ bits);
        try {
          expect_tetrahedron(mesh_files::mesh_of_content("test.3mf", damaged));
        } catch (const mesh_files::Unreadable_file& error) {
          EXPECT_EQ(std::string(error.what()).substr(0, 10), "test.3mf: ") << form.name() << ", byte " << at;
        }
      }
  }
}

TEST(Files_of_3mf, ThatAreCutOffAreRefusedWhereverThatIs) {
  for (const Form& form : three_mf_files::all_forms()) {
    if (!form.comment.empty()) continue;  // without which a file is whole
    const std::string whole = archive(package(model(object(1, tetrahedron()), item(1))), form);
    for (std::size_t size = 0; size < whole.size(); ++size)
      EXPECT_THROW(mesh_files::mesh_of_content("test.3mf", whole.substr(0, size)), mesh_files::Unreadable_file)
          << form.name() << " cut to " << size;
  }
}

}  // namespace test_3mf_files
