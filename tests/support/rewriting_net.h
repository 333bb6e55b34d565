#pragma once
/// A client's network whose outgoing messages a test may change: the client is honest, what arrives
/// from it is not. All else of the conversation (sequences, acknowledgements) stays right.

#include <cstdint>
#include <functional>
#include <memory>
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

  RewritingNet(std::unique_ptr<Net> net, Rewrite rewrite)
      : net_(std::move(net)), rewrite_(std::move(rewrite)) {}

  void Advance(std::int64_t now_us) override {
    now_us_ = now_us;
    net_->Advance(now_us);
  }
  void Flush() override { net_->Flush(); }
  bool Receive(Address* from, Bytes* datagram) override { return net_->Receive(from, datagram); }
  std::int64_t discarded() const override { return net_->discarded(); }

  void Send(const Address& to, ByteView datagram) override {
    DatagramHeader header;
    std::vector<DatagramMessage> messages;
    SEAM_ASSERT(ReadHeader(datagram, &header) && ReadMessages(datagram, &messages));
    DatagramWriter writer;
    for (DatagramMessage message : messages) {
      Bytes bytes(message.bytes.begin(), message.bytes.end());
      if (!rewrite_(now_us_, &bytes)) return;
      message.bytes = bytes;
      writer.Append(message);
    }
    if (rewrite_header) rewrite_header(now_us_, &header);
    net_->Send(to, writer.Finish(header));
  }

 private:
  std::unique_ptr<Net> net_;
  Rewrite rewrite_;
  std::int64_t now_us_ = 0;
};

}  // namespace seam
