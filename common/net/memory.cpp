#include "common/net/memory.h"

#include "common/base/check.h"

namespace seam {
namespace {

/// Most datagrams queued at one endpoint; more are lost, as in a socket that is never read.
constexpr std::size_t kInboxDatagramsMax = 65536;

}  // namespace

/// An endpoint of a MemoryNetwork. It works while the address's inbox carries its number.
class MemoryEndpoint : public Net {
 public:
  MemoryEndpoint(MemoryNetwork& network, const Address& address, std::uint64_t number)
      : network_(network), address_(address), number_(number) {}
  ~MemoryEndpoint() override {
    if (Inbox() != nullptr) network_.inbox_.erase(address_);
  }
  MemoryEndpoint(const MemoryEndpoint&) = delete;
  MemoryEndpoint& operator=(const MemoryEndpoint&) = delete;

  void Advance(std::int64_t) override {}

  void Send(const Address& to, ByteView datagram) override {
    SEAM_ASSERT(datagram.size >= 1 && datagram.size <= kDatagramBytesMax);
    const auto found = network_.inbox_.find(to);
    if (Inbox() == nullptr || found == network_.inbox_.end()) return;
    auto& waiting = found->second.datagrams;
    if (waiting.size() >= kInboxDatagramsMax) return;
    waiting.emplace_back(address_, Bytes(datagram.begin(), datagram.end()));
  }

  void Flush() override {}

  bool Receive(Address* from, Bytes* datagram) override {
    auto* waiting = Inbox();
    if (waiting == nullptr || waiting->empty()) return false;
    *from = waiting->front().first;
    *datagram = std::move(waiting->front().second);
    waiting->pop_front();
    return true;
  }

 private:
  /// Returns its inbox; nullptr once another endpoint has replaced this one.
  MemoryNetwork::Datagrams* Inbox() {
    const auto found = network_.inbox_.find(address_);
    if (found == network_.inbox_.end() || found->second.endpoint != number_) return nullptr;
    return &found->second.datagrams;
  }

  MemoryNetwork& network_;
  const Address address_;
  const std::uint64_t number_;
};

std::unique_ptr<Net> MemoryNetwork::Attach(const Address& address) {
  inbox_[address] = Inbox{++endpoints_, {}};
  return std::make_unique<MemoryEndpoint>(*this, address, endpoints_);
}

}  // namespace seam
