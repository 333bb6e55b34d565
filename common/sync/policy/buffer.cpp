/// Mode buffer: each mechanism has one authority; peers near it simulate copies, which rollback
/// keeps equal by going back, and the other reconcilers by corrections.

#include "common/sync/policy/policy.h"
#include "common/sync/roles.h"

namespace seam {
namespace {

class Buffer : public Policy {
 public:
  explicit Buffer(bool rolls_back) : rolls_back_(rolls_back) {}

  const char* mode() const override { return "buffer"; }
  bool Follows(const Roles& peer, int mechanism) const override {
    return peer.table().at(mechanism).secondaries.Has(peer.self());
  }
  bool PlansAuthority() const override { return true; }
  bool PlansFollowers() const override { return true; }
  bool GoesBack(int) const override { return rolls_back_; }
  bool CopiesAgree() const override { return rolls_back_; }
  bool SendsCompleteTicks() const override { return rolls_back_; }
  bool TrustsSleep() const override { return rolls_back_; }
  bool Reckons() const override { return true; }
  bool SelectsTraffic() const override { return true; }

 private:
  const bool rolls_back_;
};

}  // namespace

const Policy& BufferPolicy(bool rolls_back) {
  static const Buffer blends(false), goes_back(true);
  return rolls_back ? goes_back : blends;
}

}  // namespace seam
