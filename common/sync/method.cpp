#include "common/sync/method.h"

#include "common/base/check.h"

namespace seam {
namespace {

Predict ParsePredict(const std::string& name) {
  for (const Predict predict : {Predict::kOwn, Predict::kAll}) {
    if (name == ToString(predict)) return predict;
  }
  throw OperatorError("unknown prediction \"" + name + "\": use own or all");
}

}  // namespace

const char* ToString(Predict predict) { return predict == Predict::kOwn ? "own" : "all"; }

MethodNames SplitMethod(const std::string& method) {
  const std::size_t slash = method.find('/');
  MethodNames names;
  names.mode = method.substr(0, slash);
  if (slash == std::string::npos) return names;
  const bool central = names.mode == ToString(Mode::kCentral);
  (central ? names.predict : names.reconcile) = method.substr(slash + 1);
  return names;
}

SyncConfig MakeSyncConfig(const MethodNames& names) {
  SyncConfig config = MakeSyncConfig(names.mode, names.reconcile);
  if (names.predict.empty()) return config;
  if (config.mode != Mode::kCentral) {
    throw OperatorError("--predict belongs to --mode central, not to --mode " + names.mode);
  }
  config.predict = ParsePredict(names.predict);
  return config;
}

MethodNames NamesOf(const SyncConfig& config) {
  const bool central = config.mode == Mode::kCentral;
  return {ToString(config.mode), config.reconcile_name, central ? ToString(config.predict) : ""};
}

std::string VariantOf(const MethodNames& names) {
  return names.reconcile.empty() ? names.predict : names.reconcile;
}

std::string VariantOf(const Room& room) {
  return VariantOf(MethodNames{room.mode, room.reconcile, room.predict});
}

std::vector<std::string> ReconcilerNames() {
  std::vector<std::string> names;
  for (const NamedReconciler& rule : Reconcilers()) names.emplace_back(rule.name);
  return names;
}

}  // namespace seam
