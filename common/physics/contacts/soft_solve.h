#pragma once
/// Solves soft contacts in substeps (docs/solver.md, Soft contacts), four contacts at a time.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/physics/contacts/soft_contact.h"
#include "common/physics/contacts/wide.h"

namespace seam {

/// Response of a soft constraint: a spring and damper, solved implicitly.
struct Softness {
  float bias_rate = 0, mass_scale = 1, impulse_scale = 0;
};

class SoftContacts {
 public:
  std::vector<SoftBody> bodies;  ///< moving bodies, then one that rests, then kinematic ones
  std::size_t moving = 0;        ///< number of moving bodies
  std::vector<SoftContact> contacts;

  /// Advances the bodies by `substeps` substeps of h s, each with `sweeps` rounds over the contacts
  /// and one without bias. `warm`: begin with the impulses in the engine's manifolds.
  void Step(float h, int substeps, int sweeps, bool warm);
  /// Writes the last Step's impulses of a contact into its manifold, as if the last substep's were
  /// those of a whole step, and sets `impulse` to their sums over the step. Returns the sum of the
  /// normal ones.
  float Take(const SoftContact& contact, b2ContactImpulse* impulse) const;

 private:
  /// SoftContact::Point of four contacts. An arm's first number is its part along the surface
  /// times -1, the turning axis' lever of the normal impulse; the second that of friction.
  struct Points {
    Wide lever_an, lever_bn, lever_at, lever_bt;
    Wide pushed, rubbed;            // N s, in this substep
    Wide bias, soft_mass, lasting;  // of the normal impulse with bias, at this substep's poses
    Wide mass_n, mass_t;
    Wide turn_an, turn_ac, turn_bn, turn_bc;  // m: turning arms along the normal; across
    Wide apart, used;                         // used: 1 where a lane has this point
    Wide sum_n, sum_t;
    Wide closing;  // m/s, before it was first pushed
  };
  struct Block {                         // four contacts without a moving body in common
    int a[kBlockLanes], b[kBlockLanes];  // indices into bodies
    int count;                           // of points, the most of the four
    bool returns;                        // one has restitution
    Wide nx, ny, friction, belt;
    Wide im_a, ii_a, im_b, ii_b;
    Points point[b2_maxManifoldPoints];
    Wide restitution, threshold, bias_rate, mass_scale, impulse_scale;
  };
  enum class Work { kPrepare, kWarmStart, kWatch, kPush, kRelax, kRestore };
  struct Rounds;

  void Arrange(float h);
  void Put(const SoftContact& contact);
  /// Does one round of work over the blocks from `from` on. `number`: the rate of substeps, or the
  /// share of the impulses to begin with.
  void Do(Work work, float number, std::size_t from);
  void Kick(float h, int times);
  void Drift(float h);
  void Centre(float h, float step_s);
  void Sum();

  Softness soft_, stiff_;
  bool returns_ = false;  // a contact has restitution
  float parts_ = 1;  // substeps of the last Step
  std::vector<Block> blocks_;
  std::vector<int> layer_;      // by body: the first layer that has no contact of it
  std::vector<int> first_;      // by layer: its first lane
  std::size_t small_from_ = 0;  // index of the first block of small islands
};

}  // namespace seam
