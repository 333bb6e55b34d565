#pragma once
/// Errors of the C interface: keeps the line, and lets no exception through.

#include <exception>
#include <string>
#include <utility>

#include "common/base/check.h"
#include "common/base/status.h"
#include "common/scene/types.h"

struct seam2d_input;

namespace seam {

/// Most ticks of one call.
constexpr int kCallTicksMax = 1000000;

/// Keeps the reason of this thread's last failure.
void KeepError(const std::string& line) noexcept;
/// Returns it; "" if there was none.
const char* LastError() noexcept;

/// Calls `call`; if it throws, keeps the reason and returns `failed`.
template <class Result, class Call>
Result Guarded(Result failed, Call&& call) noexcept {
  try {
    return std::forward<Call>(call)();
  } catch (const std::exception& error) {
    KeepError(error.what());
  } catch (...) {
    KeepError("an unknown error");
  }
  return failed;
}

/// Throws OperatorError unless the condition holds.
inline void Demand(bool condition, const char* otherwise) {
  if (!condition) throw OperatorError(otherwise);
}
inline void Demand(const Status& status) {
  if (!status.ok()) throw OperatorError(status.why());
}
/// Throws OperatorError unless `ticks` is within 0 and kCallTicksMax.
void DemandTicks(int ticks);
/// Returns the input of a C program. Throws OperatorError if it is NULL or out of range.
Input InputOf(const seam2d_input* input);

}  // namespace seam
