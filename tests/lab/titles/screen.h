#pragma once
/// What one peer showed of a recorded session, asked by the names of the scene.

#include <optional>
#include <string>
#include <vector>

#include "common/measure/revisions.h"
#include "common/record/recording.h"
#include "common/scene/scene.h"

namespace seam {

/// A recorded session and what its world was made of at each time.
struct Played {
  explicit Played(Recording made);

  Recording recording;
  Scene scene;                 ///< as it was at first
  std::vector<Edit> edits;     ///< in the room's order
  std::vector<double> edit_s;  ///< by edit: when, s
  RevisionHistory history;
};

class Screen {
 public:
  Screen(const Played& played, int peer) : played_(played), peer_(peer) {}

  int peer() const { return peer_; }
  const Scene& scene() const { return played_.scene; }
  const Recording& recording() const { return played_.recording; }
  /// s, of the last tick that it showed.
  double end_s() const;

  /// Where a part was shown at the tick next to a time, s; nullopt: it was not. Throws
  /// OperatorError where the scene has no part of that name.
  std::optional<BodyState> Find(const std::string& part, double time_s) const;
  /// The same. Throws OperatorError when it was not shown.
  BodyState At(const std::string& part, double time_s) const;
  /// Where the scene puts it, at tick 0.
  BodyState AtStart(const std::string& part) const;
  BodyState AtEnd(const std::string& part) const { return At(part, end_s()); }
  /// Names of all parts that begin so, in the scene's order.
  std::vector<std::string> All(const std::string& prefix) const;
  /// How many of those fulfil something where they were shown last.
  template <class Predicate>
  int CountAtEnd(const std::string& prefix, Predicate fulfils) const {
    int count = 0;
    for (const std::string& part : All(prefix)) {
      const std::optional<BodyState> state = Find(part, end_s());
      if (state && fulfils(part, *state)) ++count;
    }
    return count;
  }

  /// A player's points as the room was told last; by the scene's index.
  double Score(int player) const;

  /// Edits of a kind that the room ordered from a time on, s.
  template <class Kind>
  int Edits(double from_s = 0) const {
    int count = 0;
    for (std::size_t i = 0; i < played_.edits.size(); ++i) {
      if (played_.edit_s[i] >= from_s && played_.edits[i].As<Kind>() != nullptr) ++count;
    }
    return count;
  }

 private:
  const Played& played_;
  const int peer_;
};

}  // namespace seam
