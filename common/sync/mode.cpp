#include "common/sync/mode.h"

#include <cstdlib>

#include "common/base/check.h"
#include "common/base/nearest.h"

namespace seam {

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
  const Policy* policy = FindPolicy(mode, "all", false);
  if (policy == nullptr) {
    throw OperatorError(
        "unknown mode \"" + mode + "\"" + DidYouMean(mode, ModeNames()) +
        ": use oracle, central, strict, touch, buffer, lockstep, lockstep-adaptive or "
        "ggpo");
  }
  config.policy = policy;
  if (!policy->PlansFollowers()) {
    if (!reconcile.empty()) {
      throw OperatorError("--reconcile belongs to --mode buffer, not to --mode " + mode);
    }
    // A client of mode central rolls back to the server's states, and one of mode ggpo for inputs;
    // the server never rolls back.
    if (policy->GoesBack(1)) config.reconcile = ReconcileRollback;
    return config;
  }
  config.reconcile_name = reconcile.empty() ? kDefaultReconciler : reconcile;
  const NamedReconciler& rule = FindReconciler(config.reconcile_name);
  config.reconcile = rule.rule;
  config.pull = rule.pull;
  config.policy = &BufferPolicy(rule.rolls_back);
  return config;
}

}  // namespace seam
