#pragma once
/// Bodies that an edit wakes: the neighbours, by contact or joint, of a part or joint that appears,
/// leaves or changes. A body that sleeps on a shelf would otherwise stay in the air without it.

#include <vector>

#include "common/physics/activity.h"
#include "common/physics/world.h"
#include "common/physics/world_build.h"

namespace seam {

class EditWake {
 public:
  /// Notes the touching parts before the edits. `held`: by joint, true if it is made.
  EditWake(const b2World& world, const Scene& scene, const BuiltScene& built,
           std::vector<bool> held);

  /// The world after the edits, its contacts found.
  struct Edited {
    const b2World& world;
    const Scene& scene;
    const Composition &before, &now;
    const BuiltScene& built;
    const std::vector<Activity>& activities;  ///< by moving body
  };
  /// Returns the moving bodies to wake, ascending. `held`: as above, after the edits. The engine
  /// wakes what these touch, and so on, among simulated bodies. Where one in between is not, the
  /// bodies behind it are in the result.
  std::vector<int> Bodies(const Edited& edited, const std::vector<bool>& held) const;

 private:
  void AddBehindDisplayed(const Edited& edited, const std::vector<PartTouch>& touches,
                          const std::vector<bool>& held, std::vector<int>* bodies) const;

  std::vector<bool> held_;
  std::vector<PartTouch> touches_;  // before the edits
};

}  // namespace seam
