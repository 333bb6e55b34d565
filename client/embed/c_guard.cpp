#include "client/embed/c_guard.h"

#include <algorithm>

#include "client/embed/seam2d/seam2d.h"
#include "common/base/version.h"

namespace seam {
namespace {

/// Largest set of buttons: bits 0 to 14.
constexpr int kButtonsMost = 0x7fff;

std::string& ErrorOfThread() {
  thread_local std::string line;
  return line;
}

}  // namespace

void KeepError(const std::string& line) noexcept {
  try {
    std::string& kept = ErrorOfThread();
    kept = line;
    std::replace(kept.begin(), kept.end(), '\n', ' ');
  } catch (...) {  // no memory: the older line stays
  }
}

const char* LastError() noexcept { return ErrorOfThread().c_str(); }

void DemandTicks(int ticks) {
  if (ticks >= 0 && ticks <= kCallTicksMax) return;
  throw OperatorError(std::to_string(ticks) + " ticks: a call takes 0 to " +
                      std::to_string(kCallTicksMax));
}

Input InputOf(const seam2d_input* input) {
  Demand(input != nullptr, "the input is NULL");
  const auto axis = [](std::int32_t value) { return value >= -127 && value <= 127; };
  Demand(axis(input->drive) && axis(input->lift), "drive and lift are from -127 to 127");
  Demand(input->buttons >= 0 && input->buttons <= kButtonsMost, "buttons are bits 0 to 14");
  return {static_cast<std::int8_t>(input->drive), static_cast<std::int8_t>(input->lift),
          static_cast<std::int16_t>(input->buttons)};
}

}  // namespace seam

int seam2d_abi_version(void) { return SEAM2D_ABI_VERSION; }
const char* seam2d_version(void) { return seam::kVersion; }
const char* seam2d_error(void) { return seam::LastError(); }
