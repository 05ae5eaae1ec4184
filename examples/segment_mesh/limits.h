// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_LIMITS_H
#define SEGMENT_MESH_LIMITS_H

#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <system_error>

namespace segment_mesh {

/// Thrown when the time for a mesh is over.
class Out_of_time : public std::runtime_error {
 public:
  Out_of_time() : std::runtime_error("the time is over") {}
};

/// When the work on a mesh must end.
class Deadline {
 public:
  /// \param seconds from now; no end without them
  explicit Deadline(std::optional<double> seconds) {
    if (seconds) end_ = Clock::now() + std::chrono::duration<double>(*seconds);
  }

  /// \throws Out_of_time
  void check() const {
    if (end_ && Clock::now() >= *end_) throw Out_of_time();
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::optional<std::chrono::time_point<Clock, std::chrono::duration<double>>> end_;
};

/// Lets allocations fail once the program holds so many bytes, stacks of its threads included.
inline void limit_memory(std::uint64_t bytes) {
#ifdef __linux__
  constexpr auto memory = RLIMIT_DATA;  // addresses that are only set aside do not count
#else
  constexpr auto memory = RLIMIT_AS;
#endif
  rlimit limit{};
  if (getrlimit(memory, &limit) == 0) {
    limit.rlim_cur = std::min(static_cast<rlim_t>(bytes), limit.rlim_max);
    if (setrlimit(memory, &limit) == 0) return;
  }
  throw std::system_error(errno, std::generic_category(), "--max-memory");
}

/// Makes writing beyond the largest size of a file, or to a pipe that nobody reads, an error like that of a full disk, not
/// the end of the program.
inline void survive_full_disks() {
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace segment_mesh

#endif
