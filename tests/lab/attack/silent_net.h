#pragma once
/// A client's network that falls silent again and again.

#include <cstdint>
#include <memory>
#include <utility>

#include "common/net/net.h"

namespace seam {

/// Sends nothing for kSilentForUs of each kPeriodUs.
class SilentNet : public Net {
 public:
  explicit SilentNet(std::unique_ptr<Net> net) : net_(std::move(net)) {}
  void Advance(std::int64_t now_us) override {
    now_us_ = now_us;
    net_->Advance(now_us);
  }
  void Flush() override { net_->Flush(); }
  bool Receive(Address* from, Bytes* datagram) override { return net_->Receive(from, datagram); }
  void Send(const Address& to, ByteView datagram) override {
    if (now_us_ % kPeriodUs >= kSilentForUs) net_->Send(to, datagram);
  }
  std::int64_t discarded() const override { return net_->discarded(); }

  /// Longer than the silence after which the server stands in for a holder, and seldom enough to be
  /// excused all the time if each silence were.
  static constexpr std::int64_t kSilentForUs = 300000, kPeriodUs = 1900000;

 private:
  std::unique_ptr<Net> net_;
  std::int64_t now_us_ = 0;
};

}  // namespace seam
