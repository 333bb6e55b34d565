#include "common/sync/blend/reconcile.h"

#include "common/base/check.h"
#include "common/base/nearest.h"

namespace seam {

const std::vector<NamedReconciler>& Reconcilers() {
  static const std::vector<NamedReconciler> all = {
      {"snap", ReconcileSnap, "take the authority's old state as it is"},
      {"interleave", ReconcileInterleave, "half ours, half the authority's old state"},
      {"compensated", ReconcileCompensated, "half ours, half the authority's moved on by v dt"},
      {"fade", ReconcileFade, "ours just after an impact, the authority's moved-on state later"},
      {"retrospect", ReconcileRetrospect, "add what our own past differed by at the same tick"},
      {"rollback", ReconcileRollback, "go back to a late state or input and step again", nullptr,
       true},
      {"spring", ReconcileSpring, "a damped spring to the authority's moved-on state", PullSpring},
  };
  return all;
}

const NamedReconciler& FindReconciler(const std::string& name) {
  std::string list;
  std::vector<std::string> known;
  for (const NamedReconciler& r : Reconcilers()) {
    if (name == r.name) return r;
    list += (list.empty() ? "" : ", ") + std::string(r.name);
    known.emplace_back(r.name);
  }
  throw OperatorError("unknown reconciler \"" + name + "\"" + DidYouMean(name, known) +
                      ": use one of " + list);
}

}  // namespace seam
