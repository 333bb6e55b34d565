#pragma once
/// A client's network that lets a test change messages: the client is honest, the messages from it
/// or to it are not. Sequence numbers and acknowledgements stay right.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "common/base/check.h"
#include "common/net/datagram.h"
#include "common/net/net.h"

namespace seam {

class RewritingNet : public Net {
 public:
  /// Called with the time and each message of a datagram that is sent; may replace the message.
  /// False: the datagram is lost.
  using Rewrite = std::function<bool(std::int64_t now_us, Bytes* message)>;

  /// Called with the time and the header of each datagram that is sent; may change it.
  using RewriteHeader = std::function<void(std::int64_t now_us, DatagramHeader* header)>;
  RewriteHeader rewrite_header;
  /// Called with the time and each message that arrives; may change it.
  std::function<void(std::int64_t now_us, Bytes* message)> rewrite_received;

  RewritingNet(std::unique_ptr<Net> net, Rewrite rewrite)
      : net_(std::move(net)), rewrite_(std::move(rewrite)) {}

  void Advance(std::int64_t now_us) override {
    now_us_ = now_us;
    net_->Advance(now_us);
  }
  void Flush() override { net_->Flush(); }
  bool Receive(Address* from, Bytes* datagram) override {
    if (!net_->Receive(from, datagram)) return false;
    if (!rewrite_received) return true;
    std::optional<Bytes> changed =
        Rewritten(*datagram, [this](std::int64_t now_us, Bytes* message) {
          rewrite_received(now_us, message);
          return true;
        });
    *datagram = std::move(*changed);
    return true;
  }
  std::int64_t discarded() const override { return net_->discarded(); }

  void Send(const Address& to, ByteView datagram) override {
    const std::optional<Bytes> changed = Rewritten(datagram, rewrite_, rewrite_header);
    if (changed) net_->Send(to, *changed);
  }

 private:
  std::optional<Bytes> Rewritten(ByteView datagram, const Rewrite& rewrite,
                                 const RewriteHeader& rewrite_head = {}) const {
    DatagramHeader header;
    std::vector<DatagramMessage> messages;
    SEAM_ASSERT(ReadHeader(datagram, &header) && ReadMessages(datagram, &messages));
    DatagramWriter writer;
    for (DatagramMessage message : messages) {
      Bytes bytes(message.bytes.begin(), message.bytes.end());
      if (!rewrite(now_us_, &bytes)) return std::nullopt;
      message.bytes = bytes;
      writer.Append(message);
    }
    if (rewrite_head) rewrite_head(now_us_, &header);
    return writer.Finish(header);
  }

  std::unique_ptr<Net> net_;
  Rewrite rewrite_;
  std::int64_t now_us_ = 0;
};

}  // namespace seam
