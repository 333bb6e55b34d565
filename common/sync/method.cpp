#include "common/sync/method.h"

#include "common/base/check.h"

namespace seam {
MethodNames SplitMethod(const std::string& method) {
  const std::size_t slash = method.find('/');
  MethodNames names;
  names.mode = method.substr(0, slash);
  if (slash == std::string::npos) return names;
  const bool central = names.mode == CentralPolicy(true).mode();
  (central ? names.predict : names.reconcile) = method.substr(slash + 1);
  return names;
}

SyncConfig MakeSyncConfig(const MethodNames& names) {
  SyncConfig config = MakeSyncConfig(names.mode, names.reconcile);
  if (names.predict.empty()) return config;
  if (*config.policy->predict() == '\0') {
    throw OperatorError("--predict belongs to --mode central, not to --mode " + names.mode);
  }
  config.policy = FindPolicy(names.mode, names.predict, false);
  if (config.policy->predict() != names.predict) {
    throw OperatorError("unknown prediction \"" + names.predict + "\": use own or all");
  }
  return config;
}

MethodNames NamesOf(const SyncConfig& config) {
  return {config.policy->mode(), config.reconcile_name, config.policy->predict()};
}

std::string VariantOf(const MethodNames& names) {
  return names.reconcile.empty() ? names.predict : names.reconcile;
}

std::string VariantOf(const Room& room) {
  return VariantOf(MethodNames{room.mode, room.reconcile, room.predict});
}

const Policy& PolicyOf(const Room& room) {
  bool rolls_back = false;
  for (const NamedReconciler& rule : Reconcilers()) {
    if (rule.name == room.reconcile) rolls_back = rule.rolls_back;
  }
  const Policy* policy = FindPolicy(room.mode, room.predict, rolls_back);
  return policy != nullptr ? *policy : UnknownPolicy();
}

std::vector<std::string> ReconcilerNames() {
  std::vector<std::string> names;
  for (const NamedReconciler& rule : Reconcilers()) names.emplace_back(rule.name);
  return names;
}

}  // namespace seam
