// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_OUTPUT_FILE_H
#define MESH_FILES_OUTPUT_FILE_H

#include "Output.h"
#include "Partial_files.h"
#include "Polygon_soup.h"
#include "Text.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace mesh_files {

/// The number of an open file that a path stands for, such as 1 for /dev/stdout.
inline std::optional<int> open_file_of(const std::string& path) {
  if (path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  for (const std::string folder : {"/dev/fd/", "/proc/self/fd/"})
    if (path.compare(0, folder.size(), folder) == 0) return number_in<int>(path.substr(folder.size()));
  return std::nullopt;
}

/// A file that appears whole or not at all: it is written under a temporary name in its own folder and gets its name
/// by `commit()`. Without that, nothing remains. What is there and no file, such as a pipe or a device, is written to as
/// it is, and so are files that are open already, such as /dev/stdout; a link stays a link. A file that takes the place of
/// another one has its permissions, and its owner and group where the user may give files to them.
class Output_file final : public Output {
 public:
  /// \throws Unwritable_file if the file cannot be created
  explicit Output_file(std::string path) : path_(std::move(path)) {
    std::error_code ignored;
    if (const std::optional<int> open = open_file_of(path_)) {
      file_ = ::fdopen(::dup(*open), "wb");
      if (!file_) fail();
      return;
    }
    if (std::filesystem::is_directory(path_, ignored)) throw Unwritable_file(path_ + ": this is a folder");
    if (std::filesystem::exists(path_, ignored) && !std::filesystem::is_regular_file(path_, ignored)) {
      file_ = std::fopen(path_.c_str(), "wb");
      if (!file_) fail();
      return;
    }
    if (std::filesystem::is_symlink(path_, ignored)) target_ = std::filesystem::canonical(path_, ignored).string();
    if (target_.empty()) target_ = path_;
    while (!create_temporary())
      if (errno != EEXIST) fail();
    take_permissions();
  }

  ~Output_file() override {
    if (file_) std::fclose(file_);
    if (!temporary_path_.empty()) std::remove(temporary_path_.c_str());
    if (entry_) Partial_files::forget(entry_);
  }

  const std::string& path() const override { return path_; }

  /// \throws Unwritable_file if the disk is full, for example
  void write(std::string_view bytes) override {
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

  /// The name is known before the file is there, lest a signal between the two leaves the file behind.
  bool create_temporary() {
    temporary_path_ = target_ + ".part" + std::to_string(std::random_device()());
    entry_ = Partial_files::add(temporary_path_);
    file_ = std::fopen(temporary_path_.c_str(), "wbx");  // "x" refuses a name that is taken
    if (file_) return true;
    const int error = errno;
    Partial_files::forget(std::exchange(entry_, nullptr));
    errno = error;
    return false;
  }

  /// Before anything is written, so that nobody reads it who may not.
  void take_permissions() const {
    constexpr ::mode_t permissions = 0777;
    struct ::stat replaced, created;
    const int file = ::fileno(file_);
    if (::stat(target_.c_str(), &replaced) != 0 || ::fstat(file, &created) != 0) return;
    if (replaced.st_uid != created.st_uid || replaced.st_gid != created.st_gid) [[maybe_unused]]
      const bool is_given = ::fchown(file, replaced.st_uid, replaced.st_gid) == 0;
    const ::mode_t wanted = replaced.st_mode & permissions;
    // Where no file has any of its own, as on some drives, none can be changed.
    if (wanted != (created.st_mode & permissions) && ::fchmod(file, wanted) != 0) fail();
  }

  std::string path_, target_;
  std::string temporary_path_;  // empty if there is none
  Partial_files::Entry* entry_ = nullptr;
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
    if (is_new_) entry_ = Partial_files::add(path_);
  }

  Output_folder(const Output_folder&) = delete;
  Output_folder& operator=(const Output_folder&) = delete;

  ~Output_folder() {
    std::error_code ignored;
    if (is_new_) std::filesystem::remove(path_, ignored);
    if (entry_) Partial_files::forget(entry_);
  }

  void keep() { is_new_ = false; }

 private:
  std::string path_;
  bool is_new_ = false;
  Partial_files::Entry* entry_ = nullptr;
};

}  // namespace mesh_files

#endif
