#pragma once
/// A client's network that sees its messages, and may change them. Sequence numbers stay right.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "common/net/net.h"
#include "tests/support/path/middle.h"

namespace seam {

class OpenedNet : public Net {
 public:
  /// Called with the time and each datagram of a session; see Middle::Change.
  using Look = std::function<bool(std::int64_t now_us, DatagramHeader* header,
                                  std::vector<Bytes>* messages)>;

  OpenedNet(std::unique_ptr<Net> net, Look sent, Look received)
      : net_(std::move(net)), sent_(std::move(sent)), received_(std::move(received)) {}

  void Advance(std::int64_t now_us) override {
    now_us_ = now_us;
    net_->Advance(now_us);
  }
  void Flush() override { net_->Flush(); }
  bool Receive(Address* from, Bytes* datagram) override {
    while (net_->Receive(from, datagram)) {
      std::optional<Bytes> passed = middle_.Down(*datagram, At(received_));
      if (!passed) continue;
      *datagram = std::move(*passed);
      return true;
    }
    return false;
  }
  void Send(const Address& to, ByteView datagram) override {
    const std::optional<Bytes> passed = middle_.Up(datagram, At(sent_));
    if (passed) net_->Send(to, *passed);
  }
  std::int64_t discarded() const override { return net_->discarded(); }

 private:
  Middle::Change At(const Look& look) const {
    if (!look) return {};
    return [this, &look](DatagramHeader* header, std::vector<Bytes>* messages) {
      return look(now_us_, header, messages);
    };
  }

  std::unique_ptr<Net> net_;
  Look sent_, received_;
  Middle middle_;
  std::int64_t now_us_ = 0;
};

}  // namespace seam
