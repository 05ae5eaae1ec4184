// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_HTML_PAGE_H
#define SEGMENT_MESH_HTML_PAGE_H

#include "../mesh_files/Buffer.h"
#include "../mesh_files/Output_file.h"
#include "../mesh_files/Polygon_soup.h"
#include "../mesh_files/read_content.h"
#include "../mesh_files/write_ply.h"
#include "Boundaries.h"
#include "Method.h"
#include "Options.h"
#include "Oriented_mesh.h"
#include "Segmentation.h"
#include "report.h"
#include "surfaces.h"
#include "walls.h"

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <boost/endian/conversion.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace segment_mesh {

/// Where the page of examples/browser is: beside the tool as it is installed, or where it was built.
inline std::string path_of_page() {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path tool = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = tool.parent_path() / "../share/RW_segmentation/segment_mesh.html";
  if (!error && fs::exists(installed, error)) return installed.string();
#ifdef SEGMENT_MESH_PAGE
  return SEGMENT_MESH_PAGE;
#else
  return installed.lexically_normal().string();
#endif
}

/// The page of examples/browser, and where a result goes in it.
class Html_page {
 public:
  /// \throws mesh_files::Unreadable_file if there is no page, or none that takes a result
  explicit Html_page(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored))
      throw mesh_files::Unreadable_file(path + ": the page is not there; build it as examples/browser/README.md tells");
    content_ = mesh_files::read_content(path);
    const std::string mark = "<script type=\"application/json\" id=\"embedded-result\">";
    begin_ = content_.find(mark);
    if (begin_ != std::string::npos) end_ = content_.find("</script>", begin_ += mark.size());
    if (begin_ == std::string::npos || end_ == std::string::npos)
      throw mesh_files::Unreadable_file(path + ": this page has no place for a result");
  }

  /// The page with a result in it.
  void write(mesh_files::Output_file& file, const Json& result) const {
    std::string text = result.dump(-1, ' ', true, Json::error_handler_t::replace);
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
    file.write(content_.substr(0, begin_));
    file.write(text);
    file.write(content_.substr(end_));
  }

 private:
  std::string content_;
  std::size_t begin_ = 0, end_ = 0;
};

inline std::string base64(const std::string& bytes) {
  namespace iterators = boost::archive::iterators;
  using Digits = iterators::base64_from_binary<iterators::transform_width<std::string::const_iterator, 6, 8>>;
  std::string digits(Digits(bytes.begin()), Digits(bytes.end()));
  return digits.append((4 - digits.size() % 4) % 4, '=');
}

/// Numbers as a page takes them: their bytes, the lowest first, in base64.
/// \tparam Written the type that they have there
template <class Written, class Value>
std::string base64_of(const std::vector<Value>& values) {
  std::string bytes(values.size() * sizeof(Written), '\0');
  auto* at = reinterpret_cast<unsigned char*>(bytes.data());
  for (const Value& value : values) {
    boost::endian::endian_store<Written, sizeof(Written), boost::endian::order::little>(at,
                                                                                        static_cast<Written>(value));
    at += sizeof(Written);
  }
  return base64(bytes);
}

/// All levels of a segmentation as a page takes them; null where nothing was merged.
inline Json levels_of(const Segmentation& result) {
  if (result.fragment.empty()) return nullptr;
  std::vector<std::size_t> regions;
  std::vector<double> costs;
  for (const auto& merge : result.tree.merges()) {
    regions.insert(regions.end(), {merge.first, merge.second});
    costs.push_back(merge.cost);
  }
  return {{"fragmentOfFace", base64_of<std::uint32_t>(result.fragment)},
          {"merges", base64_of<std::uint32_t>(regions)},
          {"costs", base64_of<double>(costs)},
          {"fragments", result.tree.number_of_fragments()},
          {"fewest", result.tree.number_of_components()},
          {"suggested", result.suggested},
          {"levels", result.tree.levels(result.suggested)}};
}

/// What a natural shape was segmented by, as a page takes it.
inline Json policies_for_page(const Options& options) {
  const Method method = method_of(options);
  Json policies = {{"difference", name_of(difference_names, method.difference)},
                   {"seeding", name_of(seeding_names, method.seeding)},
                   {"mergeCost", name_of(merge_cost_names, method.merge_cost)}};
  if (options.radius) policies["radius"] = *options.radius;
  return policies;
}

/// What separates parts that grow from seeds, as the sliders of a page have it; null where the page has no such difference.
inline Json parameters_for_page(const Options& options) {
  const Method method = method_of(options);
  if (method.difference != Difference::concavity) return nullptr;
  return {{"convexWeight", method.angles.convex_weight}, {"sigma", method.sigma}};
}

/// The walls as a file for `--constraints` beside the mesh in the page; null without any. Those of a mesh that has been cut
/// since are not known.
inline Json walls_for_page(const Mesh& mesh, const Wall_map& walls, const Options& options) {
  std::string text;
  if (!options.is_refined)
    for (const auto e : mesh.edges())
      if (walls[e])
        text += std::to_string(std::size_t(mesh.vertex(e, 0))) + " " + std::to_string(std::size_t(mesh.vertex(e, 1))) +
                "\n";
  return text.empty() ? Json() : Json(text);
}

/// The surfaces and what was made regular as a page takes them; null where segments are no surfaces.
inline Json surfaces_for_page(const Segmentation& result, const Options& options) {
  if (result.surfaces.empty()) return nullptr;
  Json regularity;
  if (options.is_regular) {
    const auto number = [](const std::optional<double>& given) { return given ? Json(*given) : Json(); };
    regularity = {{"length", number(options.regular_length)}, {"angle", number(options.regular_angle)}};
  }
  return {{"surfaces", surfaces_of(result.surfaces)}, {"regular", snaps_of(result.snaps)}, {"regularity", regularity}};
}

/// A segmentation as a page takes it.
inline Json result_for_page(const std::string& path, const Mesh& mesh, const Wall_map& walls,
                            const Segmentation& result, std::size_t segments, const Options& options) {
  std::string ply;
  mesh_files::Buffer out([&](std::string_view bytes) { ply += bytes; });
  mesh_files::write_ply(out, soup_of(mesh), {}, result.label);
  Json seeds = Json::array();
  for (const auto& [face, label] : result.labelled_seeds)
    seeds.push_back({{"face", static_cast<std::size_t>(face)}, {"label", label}});
  const std::string mode = options.mode();
  return {{"name", std::filesystem::path(path).filename().string()},
          {"mesh", base64(ply)},
          {"labels", base64_of<std::uint32_t>(result.label)},
          {"hierarchy", levels_of(result)},
          {"segments", segments},
          {"mode", mode},
          {"policies", mode == "graphical" ? policies_for_page(options) : Json()},
          {"parameters", mode == "seeds" ? parameters_for_page(options) : Json()},
          {"walls", walls_for_page(mesh, walls, options)},
          {"surfaces", surfaces_for_page(result, options)},
          {"seeds", std::move(seeds)}};
}

}  // namespace segment_mesh

#endif
