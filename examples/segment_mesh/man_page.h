// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_MAN_PAGE_H
#define SEGMENT_MESH_MAN_PAGE_H

#include "Options.h"
#include "help_sections.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace segment_mesh {

/// Text as troff reads it: nothing in it is a command.
inline std::string troff(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    const bool starts_line = escaped.empty() || escaped.back() == '\n';
    if (starts_line && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\' || c == '-') escaped += '\\';
    escaped += c;
    if (c == '\\') escaped += '\\';
  }
  return escaped;
}

/// A title of a section of a manual page.
inline std::string man_title(std::string title) {
  for (char& c : title) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return ".SH " + title + "\n";
}

/// What the manual page says of an option.
inline std::string man_entry(const CLI::Option& option) {
  std::string head = option.get_positional() ? "" : "\\fB" + troff(option.get_name(false, true)) + "\\fR ";
  if (!option.get_option_text().empty()) head += "\\fI" + troff(option.get_option_text()) + "\\fR";
  return ".TP\n" + head + "\n" + troff(option.get_description()) + "\n";
}

/// The manual page, made of what `--help` says.
inline std::string man_page(const CLI::App& app) {
  std::string page = ".TH SEGMENT_MESH 1 \"\" \"RW_segmentation " + version() + "\" \"User Commands\"\n";
  page += man_title("Name") + "segment_mesh \\- cut surface meshes into segments by random walks\n";
  page += man_title("Synopsis") +
          ".B segment_mesh\n.I MESH\n.RI [ MESH ...]\n.RI [ option ...]\n.br\n"
          ".B segment_mesh \\-\\-list\n.I FILE\n.RI [ option ...]\n";
  page += man_title("Description") + troff(summary) + "\n";
  const auto add_section = [&](const Help_section& section) {
    const std::string text = troff(section.text);
    page += man_title(section.title) + (section.is_preformatted ? ".nf\n" + text + ".fi\n" : text);
  };
  add_section(help_sections[0]);
  page += man_title("Options");
  for (const std::string& group : app.get_groups()) {
    page += ".SS " + troff(group) + "\n";
    for (const CLI::Option* option : app.get_options())
      if (option->get_group() == group) page += man_entry(*option);
  }
  std::for_each(help_sections.begin() + 1, help_sections.end(), add_section);
  return page;
}

}  // namespace segment_mesh

#endif
