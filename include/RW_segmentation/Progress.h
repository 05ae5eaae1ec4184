// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_PROGRESS_H
#define RW_SEGMENTATION_PROGRESS_H

#include <RW_segmentation/internal/named_parameters.h>

#include <CGAL/Named_function_parameters.h>

#include <functional>
#include <stdexcept>
#include <utility>

namespace RW_segmentation {

/// Thrown when the user's callback asks a computation to stop. All outputs are as they were before the call.
class Cancelled : public std::runtime_error {
 public:
  /// With a message that says so.
  Cancelled() : std::runtime_error("cancelled by the callback") {}
};

/// How far a long computation has come, told to a user's `std::function<bool(double)>`, which may end it.
///
/// The callback receives a fraction in [0, 1] and returns `false` to cancel. It is called from the thread that called
/// the computation. Exceptions of the callback pass through.
class Progress {
 public:
  /// Reports to nobody.
  Progress() = default;

  /// Reports to `callback`; to nobody if it is empty.
  explicit Progress(std::function<bool(double)> callback) : callback_(std::move(callback)) {}

  /// Reports that `fraction` of this part is done.
  /// \throws Cancelled if the callback returns `false`
  void operator()(double fraction) const {
    if (callback_ && !callback_(begin_ + fraction * (end_ - begin_))) throw Cancelled();
  }

  /// The stretch from `begin` to `end` of this one, for a stage that reports from 0 to 1 by itself.
  Progress part(double begin, double end) const {
    Progress stretch(callback_);
    stretch.begin_ = begin_ + begin * (end_ - begin_);
    stretch.end_ = begin_ + end * (end_ - begin_);
    return stretch;
  }

 private:
  std::function<bool(double)> callback_;
  double begin_ = 0;
  double end_ = 1;
};

namespace internal {

/// The CGAL named parameter `callback`, or silence.
template <class NamedParameters>
Progress progress_of([[maybe_unused]] const NamedParameters& np) {
  if constexpr (has_parameter<NamedParameters, Callback>)
    return Progress(CGAL::parameters::get_parameter(np, CGAL::internal_np::callback));
  else
    return Progress();
}

}  // namespace internal
}  // namespace RW_segmentation

#endif
