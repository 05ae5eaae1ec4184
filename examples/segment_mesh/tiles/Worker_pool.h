// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_TILES_WORKER_POOL_H
#define SEGMENT_MESH_TILES_WORKER_POOL_H

#include "../../mesh_files/Partial_files.h"
#include "../Options.h"
#include "../signals.h"

#include <RW_segmentation/Progress.h>

#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <deque>
#include <functional>
#include <map>
#include <system_error>
#include <vector>

namespace segment_mesh {

/// What jobs have cost.
struct Job_costs {
  double seconds = 0;             ///< of processors, all jobs together
  double megabytes = 0;           ///< of memory, the largest job
  std::size_t again = 0;          ///< jobs that were lost and done once more
  std::vector<std::size_t> lost;  ///< jobs that were lost each time
};

/// Does jobs in processes of their own, several at a time. A job whose process is killed is done again.
class Worker_pool {
 public:
  explicit Worker_pool(std::size_t workers) : workers_(workers) {}

  /// \param jobs their numbers
  /// \param work does a job and tells how it ended; it is called in another process
  /// \param show_done is told now and then how many are done
  /// \returns how the first job ended that failed; the jobs that run then are waited for, no further ones begin
  /// \throws RW_segmentation::Cancelled if a signal asks the program to end
  Exit_code run(const std::vector<std::size_t>& jobs, const std::function<Exit_code(std::size_t)>& work,
                const std::function<void(std::size_t)>& show_done, Job_costs& costs) {
    constexpr std::size_t most_attempts = 3;
    std::deque<std::size_t> waiting(jobs.begin(), jobs.end());
    std::map<std::size_t, std::size_t> attempts;
    Exit_code outcome = success;
    std::size_t done = 0;
    while (!running_.empty() || (outcome == success && !waiting.empty())) {
      while (outcome == success && !waiting.empty() && running_.size() < workers_) {
        start(waiting.front(), work);
        waiting.pop_front();
      }
      const Ended ended = wait_for_one(costs);
      if (ended.is_killed && ++attempts[ended.job] < most_attempts) {
        waiting.push_back(ended.job);
        ++costs.again;
      } else if (ended.is_killed || ended.code != success) {
        if (ended.is_killed) costs.lost.push_back(ended.job);
        if (outcome == success) outcome = ended.is_killed ? failed_computation : ended.code;
      } else {
        show_done(++done);
      }
    }
    return outcome;
  }

 private:
  struct Ended {
    std::size_t job;
    bool is_killed;
    Exit_code code;
  };

  static void end_quietly(int) {
    mesh_files::Partial_files::remove_all();
    ::_exit(cancelled);
  }

  void start(std::size_t job, const std::function<Exit_code(std::size_t)>& work) {
    std::fflush(nullptr);  // or both processes would write what is in the buffers
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child < 0) throw std::system_error(errno, std::generic_category(), "a worker cannot be started");
    if (child > 0) {
      running_[child] = job;
      return;
    }
    for (const int signal : {SIGINT, SIGTERM, SIGQUIT, SIGHUP, SIGXCPU}) std::signal(signal, end_quietly);
    if (is_interrupted) ::_exit(cancelled);
#ifdef __linux__
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // no worker outlives the program
    if (::getppid() != parent) ::_exit(cancelled);
#else
    static_cast<void>(parent);
#endif
    const Exit_code code = work(job);
    std::fflush(nullptr);
    ::_exit(code);
  }

  Ended wait_for_one(Job_costs& costs) {
    constexpr unsigned int between_looks = 5000;  // microseconds
    for (;;) {
      int status = 0;
      rusage usage{};
      const pid_t child = ::wait4(-1, &status, WNOHANG, &usage);
      if (is_interrupted) stop();
      const auto found = running_.find(child);
      if (found == running_.end()) {
        ::usleep(between_looks);
        continue;
      }
      const std::size_t job = found->second;
      running_.erase(found);
      for (const timeval& time : {usage.ru_utime, usage.ru_stime})
        costs.seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
      costs.megabytes = std::max(costs.megabytes, static_cast<double>(usage.ru_maxrss) * 1024 / 1e6);
      const Exit_code code = WIFEXITED(status) ? static_cast<Exit_code>(WEXITSTATUS(status)) : failed_computation;
      return {job, WIFSIGNALED(status) || code == cancelled, code};  // cancelled by a signal that only the worker got
    }
  }

  [[noreturn]] void stop() {
    for (const auto& [child, job] : running_) ::kill(child, SIGTERM);
    for (const auto& [child, job] : running_) ::waitpid(child, nullptr, 0);
    running_.clear();
    throw RW_segmentation::Cancelled();
  }

  std::size_t workers_;
  std::map<pid_t, std::size_t> running_;  // the job of each process
};

}  // namespace segment_mesh

#endif
