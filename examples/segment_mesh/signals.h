// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_SIGNALS_H
#define SEGMENT_MESH_SIGNALS_H

#include "../mesh_files/Partial_files.h"
#include "Options.h"

#include <sys/time.h>
#include <unistd.h>

#include <csignal>
#include <string_view>

namespace segment_mesh {

/// Whether the work is to end: it looks at it now and then.
inline volatile std::sig_atomic_t is_interrupted = 0;
/// Whether files are getting their names, all or none of them.
inline volatile std::sig_atomic_t is_committing = 0;

/// While it lives, files are getting their names.
struct Committing {
  Committing() { is_committing = 1; }
  Committing(const Committing&) = delete;
  Committing& operator=(const Committing&) = delete;
  ~Committing() { is_committing = 0; }
};

constexpr std::string_view cancelled_message = "cancelled, nothing was written";

/// Ends the program and leaves no file behind that is not complete.
inline void end_at_once(int) {
  if (is_committing) return;
  mesh_files::Partial_files::remove_all();
  constexpr std::string_view begin = "segment_mesh: ", end = "\n";
  for (const std::string_view text : {begin, cancelled_message, end})
    if (::write(STDERR_FILENO, text.data(), text.size()) < 0) break;
  ::_exit(cancelled);
}

/// Ends the program when a mesh file, which memory is mapped to, is shortened while it is read.
inline void end_for_lost_file(int) {
  mesh_files::Partial_files::remove_all();
  constexpr std::string_view message = "segment_mesh: a file was shortened while it was read\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, message.data(), message.size());
  ::_exit(unreadable_input);
}

/// Asks the work to end; where it does not in a time that people hardly notice, and at the second signal, the program ends.
inline void interrupt(int signal) {
  constexpr int patience_in_microseconds = 250000;
  if (is_interrupted && signal != SIGXCPU) end_at_once(signal);
  is_interrupted = 1;
  itimerval patience{};
  patience.it_value.tv_usec = patience_in_microseconds;
  setitimer(ITIMER_REAL, &patience, nullptr);
}

/// Asks the work to end, which looks at it often and has a folder to remove then, at further signals, too.
inline void ask_to_end(int) { is_interrupted = 1; }

/// Answers what would end the program while files are not complete. Who has it run after hanging up goes on to.
inline void survive_signals(void (*answer)(int) = interrupt) {
  struct sigaction action {};
  action.sa_flags = SA_RESTART;
  action.sa_handler = end_at_once;
  sigaction(SIGALRM, &action, nullptr);
  action.sa_handler = answer;
  for (const int signal : {SIGINT, SIGTERM, SIGQUIT, SIGXCPU}) sigaction(signal, &action, nullptr);
  struct sigaction old {};
  if (sigaction(SIGHUP, nullptr, &old) == 0 && old.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
}

}  // namespace segment_mesh

#endif
