#pragma once
/// Tells each touch of two parts once, however often its tick is stepped.

#include <cstdint>
#include <vector>

#include "common/codec/messages.h"
#include "common/physics/world.h"
#include "common/sync/roles.h"

namespace seam {

class StateArchive;

/// Two parts that began to touch.
struct NewTouch {
  PartTouch touch;
  std::int64_t tick = 0;
};

class NewTouches {
 public:
  /// World and roles must outlive this. `remember_ticks`: as far as a replay goes back.
  NewTouches(const World& world, const Roles& roles, int remember_ticks)
      : world_(world), roles_(roles), remember_ticks_(remember_ticks) {}

  /// To be called after each step, also of a tick stepped again. A touch that a replay does not
  /// find again was told too early or wrongly: the pair's next one counts as told.
  void Note();
  /// Returns the touches since the last call that this peer is to tell (Roles::Tells), in the order
  /// of their discovery.
  std::vector<NewTouch> Take();
  /// Returns the same as messages to the server; utime is left 0.
  std::vector<TouchReport> TakeReports();
  /// Saves or loads the touches told. `parts`: how many parts there have been.
  void Persist(StateArchive& a, std::size_t parts);

 private:
  struct Told {
    PartTouch touch;
    std::int64_t tick = 0;
    bool stands = true;  // found by the newest pass over its tick
  };
  Told* FindTaken(const PartTouch& touch);

  const World& world_;
  const Roles& roles_;
  const int remember_ticks_;
  std::int64_t newest_ = 0;  // the last tick noted
  std::vector<Told> told_;   // in the order of telling
  std::vector<NewTouch> fresh_;
};

}  // namespace seam
