#pragma once
/// The text of a scene that is too long for one message of the bus: cut into parts, and put
/// together again from parts in any order, from any of the times that they are sent.

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "common/base/bytes.h"
#include "common/codec/scene_part.h"

namespace seam {

/// Returns the parts of a text of 1 to kSceneTextBytesMax bytes, without time and session.
std::vector<ScenePart> CutScene(const std::string& text);

/// Collects parts until the text is whole. Costs memory in proportion to the parts that came, and
/// at most kSceneTextBytesMax for the text.
class SceneParts {
 public:
  /// Takes a part; ignored once the text is whole. Returns false, and begins anew, if all parts are
  /// there and are no text.
  bool Take(ScenePart& part);
  bool whole() const { return whole_; }
  /// Returns the text once it is whole, and keeps none.
  std::string TakeText() { return std::move(text_); }
  /// Number of different parts that came, and of all; 0 before the first and once whole.
  int have() const { return have_; }
  int parts() const { return static_cast<int>(data_.size()); }

 private:
  std::vector<Bytes> data_;  // by part; empty: did not come yet
  int have_ = 0;
  bool whole_ = false;
  std::string text_;
};

}  // namespace seam
