/// Modes strict and touch: each mechanism has one authority, and nobody else simulates it. In touch
/// a mechanism goes to the player that drives it or is about to touch it, whatever the scene's
/// regions, and to the server when it sleeps (after Fiedler, "Networked Physics in Virtual
/// Reality", 2018).

#include "common/sync/policy/policy.h"

namespace seam {
namespace {

class Strict : public Policy {
 public:
  explicit Strict(bool touch) : touch_(touch) {}

  const char* mode() const override { return touch_ ? "touch" : "strict"; }
  std::string about() const override { return touch_ ? "authority on touch" : "no buffer zone"; }
  bool Follows(const Roles&, int) const override { return false; }
  bool PlansAuthority() const override { return true; }
  bool PlansByTouch() const override { return touch_; }
  bool ServerFeelsAll() const override { return false; }

 private:
  const bool touch_;
};

}  // namespace

const Policy& StrictPolicy() {
  static const Strict policy(false);
  return policy;
}

const Policy& TouchPolicy() {
  static const Strict policy(true);
  return policy;
}

}  // namespace seam
