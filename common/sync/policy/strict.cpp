/// Mode strict: each mechanism has one authority, and nobody else simulates it.

#include "common/sync/policy/policy.h"

namespace seam {
namespace {

class Strict : public Policy {
 public:
  const char* mode() const override { return "strict"; }
  std::string about() const override { return "no buffer zone"; }
  bool Follows(const Roles&, int) const override { return false; }
  bool PlansAuthority() const override { return true; }
  bool ServerFeelsAll() const override { return false; }
};

}  // namespace

const Policy& StrictPolicy() {
  static const Strict policy;
  return policy;
}

}  // namespace seam
