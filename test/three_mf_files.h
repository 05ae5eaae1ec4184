// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_THREE_MF_FILES_H
#define RW_SEGMENTATION_TEST_THREE_MF_FILES_H

// 3MF files in all the forms of their archives, written by code of its own, which knows nothing of what reads them.

#include "mesh_bytes.h"
#include "packed_bytes.h"

#include <boost/crc.hpp>

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace three_mf_files {

using mesh_bytes::bytes;
using Parts = std::vector<std::pair<std::string, std::string>>;  ///< names, and what they hold

/// How an archive is written.
struct Form {
  bool is_packed = false;              ///< by Deflate
  bool is_wide = false;                ///< with the numbers of ZIP64
  bool has_sizes_behind_data = false;  ///< as programs write that do not know them before
  std::string comment = "";
  std::uint16_t flags = 0, method = 0;  ///< beside or in place of what is so

  std::string name() const {
    return std::string(is_packed ? "packed" : "stored") + (is_wide ? ".wide" : "") +
           (has_sizes_behind_data ? ".sizes_behind" : "") + (comment.empty() ? "" : ".comment");
  }
};

inline std::vector<Form> all_forms() {
  std::vector<Form> forms;
#ifdef RW_SEGMENTATION_WITH_ZLIB
  constexpr bool can_pack = true;
#else
  constexpr bool can_pack = false;
#endif
  for (const bool is_packed : {false, true})
    for (const bool is_wide : {false, true})
      for (const bool has_sizes_behind_data : {false, true})
        for (const char* comment : {"", "of the archive"})
          if (can_pack || !is_packed) forms.push_back({is_packed, is_wide, has_sizes_behind_data, comment});
  return forms;
}

/// What an archive has of the bytes.
inline std::string packed(const std::string& content, [[maybe_unused]] bool is_packed) {
#ifdef RW_SEGMENTATION_WITH_ZLIB
  if (is_packed) return packed_bytes::packed(content, packed_bytes::Wrapping::none);
#endif
  return content;
}

using Short = std::uint16_t;
using Word = std::uint32_t;
using Wide = std::uint64_t;

inline std::string archive(const Parts& parts, const Form& form = {}) {
  constexpr Word elsewhere = 0xffffffff;
  std::string content, list;
  for (const auto& [name, text] : parts) {
    const std::string data = packed(text, form.is_packed);
    boost::crc_32_type sum;
    sum.process_bytes(text.data(), text.size());
    const Short method = form.method      ? form.method
                         : form.is_packed ? 8
                                          : 0,
                flags = static_cast<Short>(form.flags | (form.has_sizes_behind_data ? 8 : 0)),
                version = form.is_wide ? 45 : 20, name_size = static_cast<Short>(name.size());
    const std::string head = bytes<Short>({version, flags, method, 0, 33});
    const std::string short_sizes = bytes<Word>({static_cast<Word>(data.size()), static_cast<Word>(text.size())}),
                      sizes = form.is_wide ? bytes<Word>({elsewhere, elsewhere}) : short_sizes;
    const std::string wide_sizes = bytes<Wide>({text.size(), data.size()});
    const Wide header = content.size();
    content += "PK\3\4" + head;
    content += form.has_sizes_behind_data ? bytes<Word>({0, 0, 0}) : bytes<Word>({sum.checksum()}) + sizes;
    const std::string extra = bytes<Short>({0x5455, 1}) + "?" + bytes<Short>({1, 16}) + wide_sizes;
    content += bytes<Short>({name_size, static_cast<Short>(form.is_wide ? extra.size() : 0)}) + name;
    content += (form.is_wide ? extra : "") + data;
    if (form.has_sizes_behind_data) content += "PK\7\10" + bytes<Word>({sum.checksum()}) + short_sizes;

    const std::string wide_numbers = bytes<Short>({0x5455, 1}) + "?" + bytes<Short>({1, 24}) + wide_sizes +
                                     bytes<Wide>({header}) + bytes<Short>({0x9999, 0});
    list += "PK\1\2" + bytes<Short>({version}) + head + bytes<Word>({sum.checksum()}) + sizes;
    list += bytes<Short>({name_size, static_cast<Short>(form.is_wide ? wide_numbers.size() : 0), 2, 0, 0});
    list += bytes<Word>({0, form.is_wide ? elsewhere : static_cast<Word>(header)}) + name;
    list += (form.is_wide ? wide_numbers : "") + "hm";
  }
  const Wide begin = content.size(), end = begin + list.size(), number = parts.size();
  content += list;
  if (form.is_wide)
    content += "PK\6\6" + bytes<Wide>({44}) + bytes<Short>({45, 45}) + bytes<Word>({0, 0}) +
               bytes<Wide>({number, number, list.size(), begin}) + "PK\6\7" + bytes<Word>({0}) + bytes<Wide>({end}) +
               bytes<Word>({1});
  const Short short_number = static_cast<Short>(form.is_wide ? 0xffff : number);
  content += "PK\5\6" + bytes<Short>({0, 0, short_number, short_number}) +
             bytes<Word>({static_cast<Word>(list.size()), form.is_wide ? elsewhere : static_cast<Word>(begin)}) +
             bytes<Short>({static_cast<Short>(form.comment.size())}) + form.comment;
  return content;
}

/// A `<mesh>`.
inline std::string mesh(const std::vector<mesh_bytes::Point>& points, const mesh_bytes::Faces& triangles) {
  std::ostringstream text;
  text << "<mesh><vertices>";
  for (const auto& p : points) text << "<vertex x=\"" << p.x() << "\" y=\"" << p.y() << "\" z=\"" << p.z() << "\"/>";
  text << "</vertices>\n<triangles>";
  for (const auto& t : triangles)
    text << "<triangle v1=\"" << t[0] << "\" v2=\"" << t[1] << "\" v3=\"" << t[2] << "\"/>";
  text << "</triangles></mesh>";
  return text.str();
}

inline std::string tetrahedron() { return mesh(mesh_bytes::tetrahedron_points, mesh_bytes::tetrahedron_faces); }

/// The part of a package that holds a model.
inline std::string model(const std::string& resources, const std::string& items, const std::string& attributes = "") {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<model xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"" +
         attributes + ">\n<metadata name=\"Title\">&lt;none&gt;</metadata>\n<resources>" + resources +
         "</resources>\n<build>" + items + "</build>\n</model>\n";
}

/// A package whose relationships name its model.
inline Parts package(const std::string& model, const std::string& path = "/3D/3dmodel.model") {
  return {{"[Content_Types].xml", "<Types/>"},
          {"_rels/.rels",
           "<Relationships><Relationship Type=\"http://schemas.openxmlformats.org/package/2006/relationships/metadata/"
           "thumbnail\" Target=\"/Metadata/thumbnail.png\"/><Relationship Id=\"a\" Target=\"" +
               path + "\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>"},
          {path.substr(1), model}};
}

}  // namespace three_mf_files

#endif
