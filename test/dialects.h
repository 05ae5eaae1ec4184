// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_DIALECTS_H
#define RW_SEGMENTATION_TEST_DIALECTS_H

// Ways in which programs of the world write one and the same mesh, each by its name, and files that are taken for meshes
// but are none. They are written by code of their own, which knows nothing of what reads them.

#include "defects.h"
#include "packed_bytes.h"
#include "vtp_files.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace dialects {

using defects::Soup;

struct Dialect {
  std::string name, file;                           ///< `file` is its name
  std::function<std::string(const Soup&)> content;  ///< empty if the mesh cannot be written so
  std::string refusal;                              ///< what the refusal must say; empty where the mesh must be read
};

/// The bytes of a number in the order of this machine, or turned around.
template <class Value>
std::string bytes(Value value, bool is_turned = false) {
  std::string result(sizeof(Value), '\0');
  std::memcpy(result.data(), &value, sizeof(Value));
  if (is_turned) std::reverse(result.begin(), result.end());
  return result;
}

inline std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
    text.replace(at, what.size(), with);
  return text;
}

/// Single precision is what all formats have in common.
inline std::string coordinates(const Eigen::Vector3d& p) {
  std::ostringstream text;
  text.precision(9);
  text << float(p.x()) << ' ' << float(p.y()) << ' ' << float(p.z());
  return text.str();
}

/// Lines of points and of triangles, with something before and behind each.
inline std::string points(const Soup& soup, const std::string& before = "", const std::string& behind = "") {
  std::string text;
  for (const auto& p : soup.points) text += before + coordinates(p) + behind + "\n";
  return text;
}

inline std::string faces(const Soup& soup, const std::string& before, std::size_t first,
                         const std::string& between = " ", const std::string& behind = "") {
  std::string text;
  for (const auto& face : soup.faces) {
    text += before;
    for (std::size_t i = 0; i < face.size(); ++i) text += (i > 0 ? between : "") + std::to_string(face[i] + first);
    text += behind + "\n";
  }
  return text;
}

inline std::string counts(const Soup& soup) {
  return std::to_string(soup.points.size()) + " " + std::to_string(soup.faces.size()) + " 0";
}

inline std::string off(const Soup& soup) { return "OFF\n" + counts(soup) + "\n" + points(soup) + faces(soup, "3 ", 0); }

inline std::string obj(const Soup& soup) { return points(soup, "v ") + faces(soup, "f ", 1); }

inline std::string ply_header(const Soup& soup, const std::string& format, const std::string& coordinate = "float",
                              const std::string& corner = "int", const std::string& size = "uchar") {
  std::string text = "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(soup.points.size()) + "\n";
  for (const char* axis : {"x", "y", "z"}) text += "property " + coordinate + " " + axis + "\n";
  return text + "element face " + std::to_string(soup.faces.size()) + "\nproperty list " + size + " " + corner +
         " vertex_indices\nend_header\n";
}

inline std::string ply(const Soup& soup) { return ply_header(soup, "ascii") + points(soup) + faces(soup, "3 ", 0); }

template <class Coordinate, class Corner, class Size>
std::string ply_data(const Soup& soup, bool is_turned) {
  std::string data;
  for (const auto& p : soup.points)
    for (const double x : p) data += bytes(static_cast<Coordinate>(float(x)), is_turned);
  for (const auto& face : soup.faces) {
    data += bytes(static_cast<Size>(face.size()), is_turned);
    for (const std::size_t corner : face) data += bytes(static_cast<Corner>(corner), is_turned);
  }
  return data;
}

inline std::string binary_format(bool is_turned) { return is_turned ? "binary_big_endian" : "binary_little_endian"; }

inline std::string binary_ply(const Soup& soup) {
  return ply_header(soup, binary_format(false)) + ply_data<float, std::int32_t, std::uint8_t>(soup, false);
}

inline std::string stl_facets(const Soup& soup, std::size_t begin, std::size_t end) {
  std::string text;
  for (std::size_t f = begin; f < end; ++f) {
    text += "facet normal 0 0 1\n outer loop\n";
    for (const std::size_t corner : soup.faces[f]) text += "  vertex " + coordinates(soup.points[corner]) + "\n";
    text += " endloop\nendfacet\n";
  }
  return text;
}

inline std::string stl(const Soup& soup, const std::string& name = "part") {
  return "solid " + name + "\n" + stl_facets(soup, 0, soup.faces.size()) + "endsolid " + name + "\n";
}

inline std::string binary_stl(const Soup& soup, const std::string& header = "part", bool is_counted = true) {
  std::string data = header;
  data.resize(80, '\0');
  data += bytes(is_counted ? static_cast<std::uint32_t>(soup.faces.size()) : 0);
  for (const auto& face : soup.faces) {
    data += std::string(12, '\0');
    for (const std::size_t corner : face)
      for (const double x : soup.points[corner]) data += bytes(float(x));
    data += std::string(2, '\0');
  }
  return data;
}

/// The triangles as strips, each of which ends with -1.
inline std::vector<long> strips(const Soup& soup) {
  std::vector<long> result;
  for (const auto& face : soup.faces) {
    for (const std::size_t corner : face) result.push_back(static_cast<long>(corner));
    result.push_back(-1);
  }
  return result;
}

inline std::string utf16(const std::string& text, bool has_mark) {
  std::string result = has_mark ? "\xff\xfe" : "";
  for (const char c : text) (result += c) += '\0';
  return result;
}

#ifdef RW_SEGMENTATION_WITH_ZLIB
inline std::string packed(const std::string& content) {
  return packed_bytes::packed(content, packed_bytes::Wrapping::gzip);
}
#endif

using Content = std::function<std::string(const Soup&)>;

/// What may happen to any text.
inline void add_texts(std::vector<Dialect>& all) {
  const std::string mark = "\xef\xbb\xbf";
  using Change = std::function<std::string(const std::string&)>;
  const std::vector<std::pair<std::string, Change>> changes = {
      {"plain", [](const std::string& t) { return t; }},
      {"byte_order_mark", [=](const std::string& t) { return mark + t; }},
      {"blank_lines_first", [](const std::string& t) { return "\n \t\n" + t; }},
      {"mark_and_blanks", [=](const std::string& t) { return mark + "\r\n  " + t; }},
      {"windows_lines", [](const std::string& t) { return replaced(t, "\n", "\r\n"); }},
      {"old_mac_lines", [](const std::string& t) { return replaced(t, "\n", "\r"); }},
      {"mixed_lines",
       [](const std::string& t) { return t.substr(0, t.size() / 2) + replaced(t.substr(t.size() / 2), "\n", "\r"); }},
      {"blank_lines", [](const std::string& t) { return replaced(t, "\n", "\n\n"); }},
      {"no_last_line_end", [](const std::string& t) { return t.substr(0, t.size() - 1); }},
      {"blanks_at_ends", [](const std::string& t) { return replaced(t, "\n", " \t\n"); }},
      {"blanks_at_the_end", [](const std::string& t) { return t + "\n \n\n"; }},
      {"tabs", [](const std::string& t) { return replaced(t, " ", "\t"); }},
      {"indented", [](const std::string& t) { return "  " + replaced(t, "\n", "\n  "); }},
      {"exponents", [](const std::string& t) { return replaced(t, " 0 ", " 0.0E+00 "); }},
  };
  const std::vector<std::pair<std::string, Content>> formats = {
      {"off", off}, {"obj", obj}, {"ply", ply}, {"stl", [](const Soup& soup) { return stl(soup); }}};
  for (const auto& [format, content] : formats) {
    for (const auto& [name, change] : changes) {
      if (name == "exponents" && format != "stl") continue;  // whole numbers elsewhere are none with an exponent
      all.push_back({format + "." + name, "mesh." + format,
                     [content = content, change = change](const Soup& soup) { return change(content(soup)); }, ""});
    }
    for (const bool has_mark : {true, false})
      all.push_back({format + ".utf_16" + (has_mark ? "" : "_without_mark"), "mesh." + format,
                     [content = content, has_mark](const Soup& soup) { return utf16(content(soup), has_mark); },
                     "UTF-16"});
    all.push_back({format + ".web_page", "mesh." + format,
                   [](const Soup&) { return "<!DOCTYPE html>\n<html><body>404</body></html>\n"; }, "HTML"});
    all.push_back({format + ".pointer_of_git_lfs", "mesh." + format,
                   [](const Soup&) {
                     return "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a214614ab2935\nsize 12345\n";
                   },
                   "Git LFS"});
    all.push_back(
        {format + ".prose", "mesh." + format,
         [](const Soup&) { return "The mesh is on the other disk, together with all that was measured then.\n"; },
         "mesh." + format});
    all.push_back({format + ".empty", "mesh." + format, [](const Soup&) { return " \n"; }, "the file is empty"});
  }
}

inline void add_off(std::vector<Dialect>& all) {
  const auto add = [&](const std::string& name, const Content& content) {
    all.push_back({"off." + name, "mesh.off", content, ""});
  };
  add("one_line", [](const Soup& s) { return replaced(off(s), "\n", " "); });
  add("counts_in_the_first_line", [](const Soup& s) { return "OFF " + off(s).substr(4); });
  add("counts_joined", [](const Soup& s) { return "OFF" + off(s).substr(4); });
  add("no_header", [](const Soup& s) { return off(s).substr(4); });
  add("small_letters", [](const Soup& s) { return "off\n" + off(s).substr(4); });
  add("no_edges", [](const Soup& s) { return replaced(off(s), counts(s), counts(s).substr(0, counts(s).size() - 2)); });
  add("word_a_line", [](const Soup& s) { return replaced(off(s), " ", "\n"); });
  add("faces_over_lines",
      [](const Soup& s) { return "OFF\n" + counts(s) + "\n" + points(s) + faces(s, "3\n", 0, "\n"); });
  add("faces_in_one_line",
      [](const Soup& s) { return "OFF\n" + counts(s) + "\n" + points(s) + replaced(faces(s, "3 ", 0), "\n", " "); });
  add("vertices_in_one_line", [](const Soup& s) {
    return "OFF\n" + counts(s) + "\n" + replaced(points(s), "\n", " ") + "\n" + faces(s, "3 ", 0);
  });
  add("four_coordinates",
      [](const Soup& s) { return "4OFF\n" + counts(s) + "\n" + points(s, "", " 1") + faces(s, "3 ", 0); });
  add("dimensions", [](const Soup& s) { return "nOFF\n3\n" + counts(s) + "\n" + points(s) + faces(s, "3 ", 0); });
  add("colors_of_points",
      [](const Soup& s) { return "COFF\n" + counts(s) + "\n" + points(s, "", " 255 0 0 255") + faces(s, "3 ", 0); });
  add("normals",
      [](const Soup& s) { return "NOFF\n" + counts(s) + "\n" + points(s, "", " 0 0 1") + faces(s, "3 ", 0); });
  add("textures",
      [](const Soup& s) { return "STOFF\n" + counts(s) + "\n" + points(s, "", " .5 .5") + faces(s, "3 ", 0); });
  add("colors_of_faces",
      [](const Soup& s) { return "OFF\n" + counts(s) + "\n" + points(s) + faces(s, "3 ", 0, " ", "  0.5 0 0"); });
  add("comments", [](const Soup& s) { return "# a\n" + replaced(off(s), "\n", " # b\n# c\n"); });
  all.push_back(
      {"off.five_dimensions", "mesh.off", [](const Soup& s) { return "nOFF 5\n" + off(s).substr(4); }, "5 dimensions"});
  all.push_back(
      {"off.binary", "mesh.off", [](const Soup&) { return "OFF BINARY\n" + std::string(99, '\1'); }, "binary OFF"});
}

inline void add_obj(std::vector<Dialect>& all) {
  const auto add = [&](const std::string& name, const Content& content) {
    all.push_back({"obj." + name, "mesh.obj", content, ""});
  };
  /// Corners written by a function of the vertex's number.
  const auto with_corners = [](const Soup& s, const std::function<std::string(std::size_t)>& corner) {
    std::string text = points(s, "v ") + "vt 0 0\nvn 0 0 1\n";
    for (const auto& face : s.faces) {
      text += "f";
      for (const std::size_t v : face) text += " " + corner(v + 1);
      text += "\n";
    }
    return text;
  };
  add("old_faces", [](const Soup& s) { return points(s, "v ") + faces(s, "fo ", 1); });
  add("textures", [=](const Soup& s) { return with_corners(s, [](auto v) { return std::to_string(v) + "/1"; }); });
  add("normals", [=](const Soup& s) { return with_corners(s, [](auto v) { return std::to_string(v) + "//1"; }); });
  add("both", [=](const Soup& s) { return with_corners(s, [](auto v) { return std::to_string(v) + "/1/1"; }); });
  add("counted_back", [=](const Soup& s) {
    return with_corners(s, [&](auto v) { return std::to_string(long(v) - long(s.points.size()) - 1); });
  });
  add("lines_joined", [](const Soup& s) { return points(s, "v ") + faces(s, "f ", 1, " \\\n "); });
  add("colors", [](const Soup& s) { return points(s, "v ", " 1 0 0") + faces(s, "f ", 1); });
  add("weights", [](const Soup& s) { return points(s, "v ", " 1.0") + faces(s, "f ", 1); });
  add("faces_first", [](const Soup& s) { return faces(s, "f ", 1) + points(s, "v "); });
  add("groups", [](const Soup& s) {
    return "mtllib a.mtl\no a\n" + points(s, "v ") + "g b\nusemtl c\ns off\n" + faces(s, "f ", 1);
  });
  add("comments", [](const Soup& s) { return "# a\n" + replaced(obj(s), "\n", " # b\n"); });
  add("polylines", [](const Soup& s) { return obj(s) + "l 1 2 3\np 1\n"; });
  all.push_back({"obj.no_name", "mesh", obj, ""});
}

template <class Corner>
void add_ply_of_corners(std::vector<Dialect>& all, const std::string& type) {
  for (const bool is_turned : {false, true})
    all.push_back({"ply." + type + (is_turned ? ".big_endian" : ".little_endian"), "mesh.ply",
                   [=](const Soup& s) {
                     if (s.points.size() > std::size_t(std::numeric_limits<Corner>::max())) return std::string();
                     return ply_header(s, binary_format(is_turned), "double", type, "ushort") +
                            ply_data<double, Corner, std::uint16_t>(s, is_turned);
                   },
                   ""});
}

inline void add_ply(std::vector<Dialect>& all) {
  const auto add = [&](const std::string& name, const Content& content) {
    all.push_back({"ply." + name, "mesh.ply", content, ""});
  };
  add_ply_of_corners<std::int8_t>(all, "char");
  add_ply_of_corners<std::uint8_t>(all, "uint8");
  add_ply_of_corners<std::int16_t>(all, "int16");
  add_ply_of_corners<std::uint16_t>(all, "ushort");
  add_ply_of_corners<std::int32_t>(all, "int32");
  add_ply_of_corners<std::uint32_t>(all, "uint");
  add_ply_of_corners<std::int64_t>(all, "int64");
  add_ply_of_corners<std::uint64_t>(all, "uint64");
  for (const bool is_turned : {false, true}) {
    const std::string suffix = is_turned ? ".big_endian" : ".little_endian";
    const auto data = [=](const Soup& s) { return ply_data<float, std::int32_t, std::uint8_t>(s, is_turned); };
    for (const auto& [name, end] :
         {std::pair<std::string, std::string>("old_mac_header", "\r"), {"windows_header", "\r\n"}})
      add(name + suffix, [=, end = end](const Soup& s) {
        return replaced(ply_header(s, binary_format(is_turned)), "\n", end) + data(s);
      });
    add("signed" + suffix, [=](const Soup& s) {
      return replaced(ply_header(s, binary_format(is_turned)), "element face", "Created by hand\nelement face") +
             data(s);
    });
    add("strips" + suffix, [=](const Soup& s) {
      std::string text = ply_header(s, binary_format(is_turned), "float", "int", "int");
      text = replaced(text, "element face " + std::to_string(s.faces.size()), "element tristrips 1");
      const Soup only_points = {s.points, {}};
      text += ply_data<float, std::int32_t, std::uint8_t>(only_points, is_turned);
      const std::vector<long> corners = strips(s);
      text += bytes(static_cast<std::int32_t>(corners.size()), is_turned);
      for (const long corner : corners) text += bytes(static_cast<std::int32_t>(corner), is_turned);
      return text;
    });
  }
  add("strips.text", [](const Soup& s) {
    std::string text = replaced(ply_header(s, "ascii", "float", "int", "int"),
                                "element face " + std::to_string(s.faces.size()), "element tristrips 1") +
                       points(s);
    const std::vector<long> corners = strips(s);
    text += std::to_string(corners.size());
    for (const long corner : corners) text += " " + std::to_string(corner);
    return text + "\n";
  });
  add("comments", [](const Soup& s) { return replaced(ply(s), "element", "comment a\nobj_info b\nelement"); });
  add("more_properties", [](const Soup& s) {
    return replaced(
               replaced(ply_header(s, "ascii"), "element face", "property uchar red\nproperty float nan\nelement face"),
               "end_header", "property list uchar float texcoord\nend_header") +
           points(s, "", " 255 nan") + faces(s, "3 ", 0, " ", " 6 0 0 1 0 0 1");
  });
  add("singular_name", [](const Soup& s) { return replaced(ply(s), "vertex_indices", "vertex_index"); });
}

inline void add_stl(std::vector<Dialect>& all) {
  const auto add = [&](const std::string& name, const Content& content) {
    all.push_back({"stl." + name, "mesh.stl", content, ""});
  };
  add("one_line", [](const Soup& s) { return replaced(stl(s), "\n", " "); });
  add("no_end", [](const Soup& s) { return stl(s).substr(0, stl(s).find("endsolid")); });
  add("no_name", [](const Soup& s) { return replaced(stl(s), " part", ""); });
  add("name_of_keywords", [](const Soup& s) { return stl(s, "facet with a vertex"); });
  add("two_solids", [](const Soup& s) {
    const std::size_t half = s.faces.size() / 2;
    return "solid a\n" + stl_facets(s, 0, half) + "endsolid a\nsolid b\n" + stl_facets(s, half, s.faces.size()) +
           "endsolid\n";
  });
  add("capitals", [](const Soup& s) {
    std::string text = stl(s);
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::toupper(c)); });
    return text;
  });
  add("binary", [](const Soup& s) { return binary_stl(s); });
  add("binary_solid", [](const Soup& s) { return binary_stl(s, "solid of a program"); });
  add("binary_blanks", [](const Soup& s) { return binary_stl(s, std::string(80, ' ')); });
  add("binary_one_byte_more", [](const Soup& s) { return binary_stl(s, "solid") + "\n"; });
  add("binary_many_bytes_more", [](const Soup& s) { return binary_stl(s) + std::string(300, '\0'); });
  add("binary_one_byte_less",
      [](const Soup& s) { return binary_stl(s, "solid").substr(0, 84 + 50 * s.faces.size() - 1); });
  add("binary_two_bytes_less", [](const Soup& s) { return binary_stl(s).substr(0, 84 + 50 * s.faces.size() - 2); });
  add("binary_not_counted", [](const Soup& s) { return binary_stl(s, "stream", false); });
  all.push_back({"stl.binary_cut", "mesh.stl",
                 [](const Soup& s) { return binary_stl(s).substr(0, 40 + 50 * s.faces.size()); },
                 "the header promises"});
  all.push_back({"stl.binary_empty", "mesh.stl", [](const Soup&) { return std::string(84, '\0'); }, "no faces"});
  all.push_back({"stl.no_name_of_file", "mesh", [](const Soup& s) { return binary_stl(s, "solid"); }, ""});
}

/// As VTK itself likes it best, without compression.
inline std::string appended_vtp(const Soup& soup) {
  vtp_files::Form form;
  form.data = vtp_files::Data::appended;
  return vtp_files::file(soup.points, soup.faces, form);
}

inline void add_vtp(std::vector<Dialect>& all) {
  const auto add = [&](const std::string& name, const Content& content, const std::string& refusal = "") {
    all.push_back({"vtp." + name, "mesh.vtp", content, refusal});
  };
  const auto written = [](const vtp_files::Form& form) {
    return [form](const Soup& s) { return vtp_files::file(s.points, s.faces, form); };
  };
  for (const vtp_files::Form& form : vtp_files::all_forms()) add(form.name(), written(form));
  vtp_files::Form form;
  const Content text = written(form);
  add("byte_order_mark", [=](const Soup& s) { return "\xef\xbb\xbf" + text(s); });
  add("windows_lines", [=](const Soup& s) { return replaced(text(s), "\n", "\r\n"); });
  add("one_line", [=](const Soup& s) { return replaced(text(s), "\n", " "); });
  add("number_a_line", [=](const Soup& s) { return replaced(replaced(text(s), " 0 ", "\n0\n"), " 1 ", "\n1\n"); });
  form.data = vtp_files::Data::base64;
  form.pieces = 2;
  add("pieces", written(form));
  form.packing = vtp_files::Packing::stored;
  const Content blocks = written(form);
  add(
      "lz4", [=](const Soup& s) { return replaced(blocks(s), "vtkZLib", "vtkLZ4"); }, "vtkLZ4DataCompressor");
  add(
      "parallel", [=](const Soup& s) { return replaced(text(s), "PolyData", "PPolyData"); }, "the pieces of a mesh");
  add(
      "volumes", [=](const Soup& s) { return replaced(text(s), "PolyData", "UnstructuredGrid"); }, "UnstructuredGrid");
  add(
      "cut", [=](const Soup& s) { return text(s).substr(0, text(s).find("</PolyData>")); }, "the file ends");
  add(
      "no_faces",
      [=](const Soup& s) {
        return text({s.points, {}});
      },
      "no faces");
}

inline void add_packed([[maybe_unused]] std::vector<Dialect>& all) {
#ifdef RW_SEGMENTATION_WITH_ZLIB
  const std::vector<std::pair<std::string, Content>> formats = {
      {"off", off}, {"obj", obj}, {"ply", binary_ply}, {"stl", [](const Soup& s) { return binary_stl(s); }}};
  for (const auto& [format, content] : formats) {
    const auto whole = [content = content](const Soup& s) { return packed(content(s)); };
    all.push_back({format + ".packed", "mesh." + format + ".gz", whole, ""});
    all.push_back({format + ".packed_without_telling", "mesh." + format, whole, ""});
    all.push_back({format + ".packed_in_parts", "mesh." + format,
                   [content = content](const Soup& s) {
                     const std::string text = content(s);
                     return packed(text.substr(0, 100)) + packed(text.substr(100));
                   },
                   ""});
    all.push_back({format + ".packed_and_cut", "mesh." + format + ".gz",
                   [whole](const Soup& s) { return whole(s).substr(0, whole(s).size() / 2); }, "cut off"});
  }
#endif
}

inline void add_without_faces(std::vector<Dialect>& all) {
  const std::vector<std::pair<std::string, Content>> formats = {
      {"off", off}, {"obj", obj}, {"ply", ply}, {"stl", [](const Soup& soup) { return stl(soup); }}};
  for (const auto& [format, content] : formats)
    all.push_back({format + ".no_faces", "mesh." + format,
                   [content = content](const Soup& s) {
                     const Soup only_points = {s.points, {}};
                     return content(only_points);
                   },
                   "no faces"});
}

inline std::vector<Dialect> all() {
  std::vector<Dialect> dialects;
  add_texts(dialects);
  add_off(dialects);
  add_obj(dialects);
  add_ply(dialects);
  add_stl(dialects);
  add_vtp(dialects);
  add_packed(dialects);
  add_without_faces(dialects);
  return dialects;
}

}  // namespace dialects

#endif
