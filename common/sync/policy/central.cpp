/// Mode central: the server simulates everything. Players' clients simulate copies ahead of it and
/// go back to its states; with --predict own only of what they drive.

#include "common/sync/policy/policy.h"
#include "common/sync/roles.h"

namespace seam {
namespace {

class Central : public Policy {
 public:
  explicit Central(bool all) : all_(all) {}

  const char* mode() const override { return "central"; }
  const char* predict() const override { return all_ ? "all" : "own"; }
  std::string about() const override { return "server simulates all"; }

  bool Follows(const Roles& peer, int mechanism) const override {
    return peer.own_player() >= 0 && (all_ || peer.Drives(mechanism));
  }
  Simulators simulators() const override { return Simulators::kNear; }
  bool GoesBack(int self) const override { return self > 0; }
  /// The server never goes back, but clients that predict everything reproduce its bits.
  bool TakesBarriers(int self) const override { return self > 0 || all_; }
  bool CopiesAgree() const override { return all_; }
  bool TrustsSleep() const override { return true; }
  bool RunsAhead() const override { return true; }
  bool SelectsTraffic() const override { return true; }

 private:
  const bool all_;
};

}  // namespace

const Policy& CentralPolicy(bool all) {
  static const Central predicts_own(false), predicts_all(true);
  return all ? predicts_all : predicts_own;
}

}  // namespace seam
