#pragma once
/// A client's own network with an impairment of its own, in both directions.

#include <memory>
#include <utility>

#include "common/net/impair.h"

namespace seam {

class ThinNet : public Net {
 public:
  ThinNet(std::unique_ptr<Net> inner, const ImpairProfile& up, const ImpairProfile& down,
          std::uint64_t seed)
      : inner_(std::move(inner)), impaired_(*inner_, up, down, seed) {}
  void Advance(std::int64_t now_us) override { impaired_.Advance(now_us); }
  void Send(const Address& to, ByteView datagram) override { impaired_.Send(to, datagram); }
  void Flush() override { impaired_.Flush(); }
  bool Receive(Address* from, Bytes* datagram) override {
    return impaired_.Receive(from, datagram);
  }
  std::int64_t discarded() const override { return impaired_.discarded(); }

 private:
  std::unique_ptr<Net> inner_;
  ImpairedNet impaired_;
};

}  // namespace seam
