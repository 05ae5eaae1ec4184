// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_PARTIAL_FILES_H
#define MESH_FILES_PARTIAL_FILES_H

#include <atomic>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace mesh_files {

/// The files and folders that are to go when the program ends before they are complete. One thread adds and forgets them;
/// a signal handler may remove them all at any moment.
class Partial_files {
 public:
  class Entry {
    friend Partial_files;
    std::string path;
    std::atomic<bool> is_there = false;
    Entry* next = nullptr;
  };

  static Entry* add(std::string path) {
    if (free_entries().empty()) {
      auto* const made = new Entry;  // stays for handlers that go through the list
      made->next = first_entry();
      first_entry() = made;
      free_entries().push_back(made);
    }
    Entry* const entry = free_entries().back();
    free_entries().pop_back();
    entry->path = std::move(path);
    entry->is_there = true;
    return entry;
  }

  static void forget(Entry* entry) {
    entry->is_there = false;
    free_entries().push_back(entry);
  }

  /// Removes those that are there: files the first time, and then the folders that have become empty. Calls nothing that
  /// a signal handler may not call.
  static void remove_all() {
    for (int round = 0; round < 2; ++round)
      for (const Entry* entry = first_entry(); entry; entry = entry->next)
        if (entry->is_there) std::remove(entry->path.c_str());
  }

 private:
  static std::atomic<Entry*>& first_entry() {
    static std::atomic<Entry*> first = nullptr;
    return first;
  }
  static std::vector<Entry*>& free_entries() {
    static std::vector<Entry*> entries;
    return entries;
  }
};

}  // namespace mesh_files

#endif
