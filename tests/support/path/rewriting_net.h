#pragma once
/// A client's network that lets a test change messages: the client is honest, the messages from it
/// or to it are not. Sequence numbers and acknowledgements stay right.

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "tests/support/path/opened_net.h"

namespace seam {

class RewritingNet : public OpenedNet {
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
      : OpenedNet(
            std::move(net),
            [this](std::int64_t now_us, DatagramHeader* header, std::vector<Bytes>* messages) {
              for (Bytes& message : *messages) {
                if (!rewrite_(now_us, &message)) return false;
              }
              if (rewrite_header) rewrite_header(now_us, header);
              return true;
            },
            [this](std::int64_t now_us, DatagramHeader*, std::vector<Bytes>* messages) {
              for (Bytes& message : *messages) {
                if (rewrite_received) rewrite_received(now_us, &message);
              }
              return true;
            }),
        rewrite_(std::move(rewrite)) {}

 private:
  Rewrite rewrite_;
};

}  // namespace seam
