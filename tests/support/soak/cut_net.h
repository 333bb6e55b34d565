#pragma once
/// A network that can be cut for a while: datagrams sent meanwhile, either way, are lost.

#include <memory>
#include <utility>

#include "common/net/net.h"

namespace seam {

class CutNet : public Net {
 public:
  /// `cut` is read at every call; it must outlive this.
  CutNet(std::unique_ptr<Net> inner, const bool* cut) : inner_(std::move(inner)), cut_(cut) {}

  void Advance(std::int64_t now_us) override { inner_->Advance(now_us); }
  void Send(const Address& to, ByteView datagram) override {
    if (!*cut_) inner_->Send(to, datagram);
  }
  void Flush() override { inner_->Flush(); }
  bool Receive(Address* from, Bytes* datagram) override {
    while (inner_->Receive(from, datagram)) {
      if (!*cut_) return true;
    }
    return false;
  }
  std::int64_t discarded() const override { return inner_->discarded(); }

 private:
  std::unique_ptr<Net> inner_;
  const bool* cut_;
};

}  // namespace seam
