#pragma once
/// Solves soft contacts in substeps (docs/solver.md, Soft contacts), four contacts at a time.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/physics/contacts/soft_contact.h"

namespace seam {

/// Four numbers that are computed together; each as if alone, so bits do not depend on it.
using Four = float __attribute__((vector_size(16)));

constexpr int kBlockLanes = 4;

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
  /// and one without bias. `warm`: begin with the contacts' impulses. These are those of a whole
  /// step, before and after.
  void Step(float h, int substeps, int sweeps, bool warm);

 private:
  /// SoftContact::Point of four contacts. An arm's first number is its part along the surface times
  /// -1, the turning axis' lever of the normal impulse; the second that of friction.
  struct Points {
    Four lever_an, lever_bn, lever_at, lever_bt;
    Four pushed, rubbed;            // N s, in this substep
    Four bias, soft_mass, lasting;  // of the normal impulse with bias, at this substep's poses
    Four mass_n, mass_t;
    Four turn_an, turn_ac, turn_bn, turn_bc;  // m: turning arms along the normal, and turned by 90
    Four apart;
    Four sum_n, sum_t;
    Four closing;  // m/s, before it was first pushed
  };
  struct Block {                         // four contacts without a moving body in common
    int a[kBlockLanes], b[kBlockLanes];  // indices into bodies
    int count;                           // of points, the most of the four
    bool returns;                        // one has restitution
    Four nx, ny, friction, belt;
    Four im_a, ii_a, im_b, ii_b;
    Points point[b2_maxManifoldPoints];
    Four restitution, threshold, bias_rate, mass_scale, impulse_scale;
  };
  struct Ends;

  void Arrange(float h);
  void Put(const SoftContact& contact, int lane, Block* block) const;
  void Take();
  void Scatter(const Block& block, const Ends& ends);
  void Kick(float h);
  void WarmStart(float share);
  void Watch();
  static void Bias(Four apart, float rate, const Block& block, Points* p);
  void Push(Block* block);
  void Relax(float rate, Block* block);
  static void Rub(Block* block, Ends* ends);
  void PushAll(std::size_t from);
  void RelaxAll(float rate, std::size_t from);
  void Drift(float h);
  void Centre(float h, float step_s);
  void Sum();
  void Restore();

  Softness soft_, stiff_;
  std::vector<Block> blocks_;
  std::vector<int> layer_;      // by body: the first layer that has no contact of it
  std::vector<int> first_;      // by layer: its first lane
  std::vector<int> lane_;       // by contact: its layer, then its lane in blocks_
  std::size_t small_from_ = 0;  // index of the first block of small islands
};

}  // namespace seam
