#include "common/sync/mode.h"

#include <cstdlib>

#include "common/base/check.h"
#include "common/base/nearest.h"

namespace seam {

const char* ToString(Mode mode) {
  switch (mode) {
    case Mode::kOracle: return "oracle";
    case Mode::kCentral: return "central";
    case Mode::kStrict: return "strict";
    case Mode::kBuffer: return "buffer";
  }
  return "?";
}

std::optional<Mode> FindMode(const std::string& name) {
  for (Mode mode : {Mode::kOracle, Mode::kCentral, Mode::kStrict, Mode::kBuffer}) {
    if (name == ToString(mode)) return mode;
  }
  return std::nullopt;
}

Mode ParseMode(const std::string& name) {
  if (const std::optional<Mode> mode = FindMode(name)) return *mode;
  throw OperatorError("unknown mode \"" + name + "\"" +
                      DidYouMean(name, {"oracle", "central", "strict", "buffer"}) +
                      ": use oracle, central, strict or buffer");
}

float ParseSmoothRate(const std::string& text) {
  if (text == "on") return kSmoothRate;
  if (text == "off") return 0;
  char* end = nullptr;
  const float rate = std::strtof(text.c_str(), &end);
  const bool number = !text.empty() && *end == '\0';
  if (!number || !(rate >= kSmoothRateMin && rate <= kSmoothRateMax)) {
    throw OperatorError("smooth takes on, off or a rate of 1 to 60 1/s, not \"" + text + "\"");
  }
  return rate;
}

SyncConfig MakeSyncConfig(const std::string& mode, const std::string& reconcile) {
  SyncConfig config;
  config.mode = ParseMode(mode);
  if (config.mode != Mode::kBuffer) {
    if (!reconcile.empty()) {
      throw OperatorError("--reconcile belongs to --mode buffer, not to --mode " + mode);
    }
    // A client of mode central rolls back to the server's states; the server never rolls back.
    if (config.mode == Mode::kCentral) config.reconcile = ReconcileRollback;
    return config;
  }
  config.reconcile_name = reconcile.empty() ? kDefaultReconciler : reconcile;
  const NamedReconciler& rule = FindReconciler(config.reconcile_name);
  config.reconcile = rule.rule;
  config.pull = rule.pull;
  config.rolls_back = rule.rolls_back;
  return config;
}

}  // namespace seam
