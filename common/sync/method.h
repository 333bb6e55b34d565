#pragma once
/// Names of synchronisation methods, as used by flags, sweep files and messages.

#include <string>
#include <vector>

#include "common/codec/messages.h"
#include "common/sync/mode.h"

namespace seam {

struct MethodNames {
  std::string mode;
  std::string reconcile;  ///< of mode buffer; "": its default
  std::string predict;    ///< own | all, of mode central; "": all
};

/// Splits "strict", "buffer/fade" or "central/own" into the mode and the part behind the slash.
/// Names are not checked.
MethodNames SplitMethod(const std::string& method);

/// Fills in mode, reconciler and prediction. Throws OperatorError if a name is unknown or belongs
/// to another mode.
SyncConfig MakeSyncConfig(const MethodNames& names);

/// Returns the full names with defaults filled in; "" for names that do not apply to the mode.
MethodNames NamesOf(const SyncConfig& config);

/// Returns the name that distinguishes methods of one mode: the reconciler, or the prediction; ""
/// in other modes.
std::string VariantOf(const MethodNames& names);
std::string VariantOf(const Room& room);

/// Returns the policy of a recorded room; UnknownPolicy() for an unknown mode. An unknown
/// reconciler counts as one that does not go back, an unknown prediction as "own".
const Policy& PolicyOf(const Room& room);

/// Returns the rules of mode buffer, as --reconcile takes them.
std::vector<std::string> ReconcilerNames();

}  // namespace seam
