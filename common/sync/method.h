#pragma once
/// A way to synchronise a room by its names, as flags, sweep files and messages have them.

#include <string>
#include <vector>

#include "common/codec/messages.h"
#include "common/sync/mode.h"

namespace seam {

const char* ToString(Predict predict);

struct MethodNames {
  std::string mode;
  std::string reconcile;  ///< of mode buffer; "": its default
  std::string predict;    ///< own | all, of mode central; "": all
};

/// "strict", "buffer/fade", "central/own": mode, and what stands behind the slash. Nothing is
/// looked up.
MethodNames SplitMethod(const std::string& method);

/// Fills mode, reconciler and what is predicted. Throws OperatorError when a name is unknown or
/// belongs to another mode.
SyncConfig MakeSyncConfig(const MethodNames& names);

/// The names in full, defaults filled in; what does not apply to the mode is "".
MethodNames NamesOf(const SyncConfig& config);

/// What tells methods of one mode apart: the reconciler, or what is predicted; "" in other modes.
std::string VariantOf(const MethodNames& names);
std::string VariantOf(const Room& room);

/// Names of the rules of mode buffer, as --reconcile takes them.
std::vector<std::string> ReconcilerNames();

}  // namespace seam
