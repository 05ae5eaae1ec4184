// SPDX-License-Identifier: MIT

#ifndef RW_PYTHON_WITHOUT_LOCK_H
#define RW_PYTHON_WITHOUT_LOCK_H

#include <RW_segmentation/Progress.h>
#include <nanobind/nanobind.h>

#include <chrono>
#include <exception>
#include <functional>

namespace rw_python {

namespace nb = nanobind;

/// Told how far the library has come, it lets Python see signals and tells the user's function.
class Python_progress {
 public:
  /// \param function called with the fraction done; None: nobody is told. It cancels by returning False.
  explicit Python_progress(nb::object function) : function_(std::move(function)) {}

  /// \returns whether to go on
  bool operator()(double fraction) {
    const auto now = Clock::now();
    if (is_complete_ || (fraction < 1 && now - last_ < interval)) return true;
    is_complete_ = fraction >= 1;
    last_ = now;
    const nb::gil_scoped_acquire lock;
    try {
      if (PyErr_CheckSignals() != 0) throw nb::python_error();
      return function_.is_none() || function_(fraction).ptr() != Py_False;
    } catch (...) {
      error_ = std::current_exception();
      return false;
    }
  }

  /// What the user's function or a signal has thrown goes on to the caller.
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  /// Asking for Python's lock more often would slow other threads down; less often, Ctrl-C seems not to work.
  static constexpr std::chrono::milliseconds interval{30};

  nb::object function_;
  bool is_complete_ = false;
  Clock::time_point last_ = Clock::now();
  std::exception_ptr error_;
};

/// Calls `work(callback)` while other threads of Python run. The callback is the library's: it tells the user's function
/// and cancels for it, and for Ctrl-C. The function is told the end in any case.
template <class Work>
auto without_lock(const nb::object& progress, const Work& work) {
  Python_progress told(progress);
  try {
    const nb::gil_scoped_release release;
    auto result = work(std::function<bool(double)>([&told](double fraction) { return told(fraction); }));
    if (!told(1)) throw RW_segmentation::Cancelled();
    return result;
  } catch (const RW_segmentation::Cancelled&) {
    told.rethrow();
    throw;
  }
}

/// The callback of a stretch of a computation that has several.
inline std::function<bool(double)> part(const std::function<bool(double)>& callback, double begin, double end) {
  return [callback, begin, end](double fraction) { return callback(begin + fraction * (end - begin)); };
}

}  // namespace rw_python

#endif
