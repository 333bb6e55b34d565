#pragma once
/// One player's own path, slower than the rest: a network impaired in both directions.

#include <memory>
#include <string>
#include <utility>

#include "common/net/impair.h"

namespace seam {

/// Impairs datagrams by one profile either way. In virtual time a datagram is taken up to 5 ms
/// after it is due, because the cluster does not wake for it.
class LaggingNet : public Net {
 public:
  /// `profile` as FindProfile reads it; throws OperatorError.
  LaggingNet(std::unique_ptr<Net> inner, const std::string& profile, std::uint64_t seed)
      : inner_(std::move(inner)), net_(*inner_, FindProfile(profile), FindProfile(profile), seed) {}

  void Advance(std::int64_t now_us) override { net_.Advance(now_us); }
  void Send(const Address& to, ByteView datagram) override { net_.Send(to, datagram); }
  void Flush() override { net_.Flush(); }
  bool Receive(Address* from, Bytes* datagram) override { return net_.Receive(from, datagram); }
  std::int64_t discarded() const override { return net_.discarded(); }

 private:
  std::unique_ptr<Net> inner_;
  ImpairedNet net_;
};

}  // namespace seam
