#pragma once
/// A network of a client whose address changes, as behind a router that forgets it.

#include <memory>
#include <utility>

#include "common/net/net.h"

namespace seam {

class MovableNet : public Net {
 public:
  explicit MovableNet(std::unique_ptr<Net> inner) : inner_(std::move(inner)) {}

  /// Uses another endpoint from now on; what is on its way to the old one is lost.
  void Move(std::unique_ptr<Net> inner) { inner_ = std::move(inner); }

  void Advance(std::int64_t now_us) override { inner_->Advance(now_us); }
  void Send(const Address& to, ByteView datagram) override { inner_->Send(to, datagram); }
  void Flush() override { inner_->Flush(); }
  bool Receive(Address* from, Bytes* datagram) override { return inner_->Receive(from, datagram); }
  std::int64_t discarded() const override { return inner_->discarded(); }

 private:
  std::unique_ptr<Net> inner_;
};

}  // namespace seam
