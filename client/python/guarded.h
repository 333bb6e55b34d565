#pragma once
/// An object that threads of Python share.

#include <pybind11/pybind11.h>

#include <mutex>
#include <utility>

namespace seam {

/// Gives its object to one call at a time. The others wait for it without Python's lock, so other
/// threads run on; a call takes Python's lock never while it has the object.
template <class T>
class Guarded {
 public:
  template <class... Arguments>
  explicit Guarded(Arguments&&... arguments) : value_(std::forward<Arguments>(arguments)...) {}
  /// Returns what `call` makes of the object, without Python's lock: it may touch nothing of
  /// Python.
  template <class Call>
  auto Do(Call call) {
    const pybind11::gil_scoped_release release;
    const std::lock_guard<std::mutex> lock(mutex_);
    return call(value_);
  }
  /// As Do, for a call that is short: with Python's lock, which takes long to come by again where
  /// other threads are busy.
  template <class Call>
  auto Quick(Call call) {
    {
      const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
      if (lock.owns_lock()) return call(value_);
    }
    return Do(call);
  }

 private:
  std::mutex mutex_;
  T value_;
};

}  // namespace seam
