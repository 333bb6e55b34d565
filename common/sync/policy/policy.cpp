#include "common/sync/policy/policy.h"

namespace seam {
namespace {

class Unknown : public Policy {
 public:
  const char* mode() const override { return "?"; }
  bool Follows(const Roles&, int) const override { return false; }
};

}  // namespace

std::vector<Inputs> Policy::KnownInputs(const Scene&, std::int64_t, int) const { return {}; }

bool Policy::GoesBack(int) const { return false; }

std::vector<std::string> ModeNames() {
  return {"oracle",   "central",           "strict", "touch", "buffer",
          "lockstep", "lockstep-adaptive", "ggpo"};
}

const Policy* FindPolicy(const std::string& mode, const std::string& predict, bool rolls_back) {
  for (const Policy* policy :
       {&OraclePolicy(), &CentralPolicy(predict == "all"), &StrictPolicy(), &TouchPolicy(),
        &BufferPolicy(rolls_back), &LockstepPolicy(false), &LockstepPolicy(true), &GgpoPolicy()}) {
    if (mode == policy->mode()) return policy;
  }
  return nullptr;
}

const Policy& UnknownPolicy() {
  static const Unknown policy;
  return policy;
}

}  // namespace seam
