// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_OUTPUT_FILE_H
#define MESH_FILES_OUTPUT_FILE_H

#include "Polygon_soup.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace mesh_files {

/// A file that appears whole or not at all: it is written under a temporary name in its own folder and gets its name
/// by `commit()`. Without that, nothing remains. What is there and no file, such as a pipe or a device, is written to as
/// it is; a link stays a link.
class Output_file {
 public:
  /// \throws Unwritable_file if the file cannot be created
  explicit Output_file(std::string path) : path_(std::move(path)) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path_, ignored)) throw Unwritable_file(path_ + ": this is a folder");
    if (std::filesystem::exists(path_, ignored) && !std::filesystem::is_regular_file(path_, ignored)) {
      file_ = std::fopen(path_.c_str(), "wb");
      if (!file_) fail();
      return;
    }
    if (std::filesystem::is_symlink(path_, ignored)) target_ = std::filesystem::canonical(path_, ignored).string();
    if (target_.empty()) target_ = path_;
    // "x" refuses a name that is taken.
    do temporary_path_ = target_ + ".part" + std::to_string(std::random_device()());
    while (!(file_ = std::fopen(temporary_path_.c_str(), "wbx")) && errno == EEXIST);
    if (!file_) fail();
  }

  Output_file(const Output_file&) = delete;
  Output_file& operator=(const Output_file&) = delete;

  ~Output_file() {
    if (file_) std::fclose(file_);
    if (!temporary_path_.empty()) std::remove(temporary_path_.c_str());
  }

  const std::string& path() const { return path_; }

  /// \throws Unwritable_file if the disk is full, for example
  void write(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail();
  }

  /// Hands all bytes to the disk. Several files that belong together are flushed before the first is committed.
  void flush() {
    if (std::fflush(file_) != 0) fail();
  }

  /// Gives the file its name, in place of a file that has it.
  void commit() {
    const bool is_closed = std::fclose(file_) == 0;
    file_ = nullptr;
    if (!is_closed) fail();
    if (!temporary_path_.empty() && std::rename(temporary_path_.c_str(), target_.c_str()) != 0) fail();
    temporary_path_.clear();
  }

 private:
  [[noreturn]] void fail() const { throw Unwritable_file(path_ + ": " + std::strerror(errno)); }

  std::string path_, target_;
  std::string temporary_path_;  // empty if there is none
  std::FILE* file_ = nullptr;
};

/// A new or empty folder for outputs. One that was made for them is removed again unless they are kept.
class Output_folder {
 public:
  /// \throws Unwritable_file if the folder cannot be made or has something in it
  explicit Output_folder(std::string path) : path_(std::move(path)) {
    std::error_code error;
    is_new_ = std::filesystem::create_directory(path_, error);
    if (error) throw Unwritable_file(path_ + ": " + error.message());
    if (!std::filesystem::is_empty(path_, error)) throw Unwritable_file(path_ + ": the folder is not empty");
  }

  Output_folder(const Output_folder&) = delete;
  Output_folder& operator=(const Output_folder&) = delete;

  ~Output_folder() {
    std::error_code ignored;
    if (is_new_) std::filesystem::remove(path_, ignored);
  }

  void keep() { is_new_ = false; }

 private:
  std::string path_;
  bool is_new_ = false;
};

}  // namespace mesh_files

#endif
