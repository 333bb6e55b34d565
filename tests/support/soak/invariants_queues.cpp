#include "tests/support/client_test_access.h"
#include "tests/support/replica_test_access.h"
#include "tests/support/soak/invariants.h"
#include "tests/support/soak/server_test_access.h"

namespace seam {
namespace {

/// Edits, states and links that wait: what is more grows without end. A Link gives up at 4096.
constexpr std::size_t kLinkMax = 1500, kEditsMax = 300, kQueueMax = 600;

}  // namespace

void Invariants::LookAtQueues() {
  const auto note = [&](const std::string& queue, std::size_t count, std::size_t most) {
    queues_[queue] = std::max(queues_[queue], count);
    if (count > most) Say("queues are bounded", queue + ": " + std::to_string(count));
  };
  note("server's links", ServerTestAccess::WaitingOfLinks(cluster_.server()), kLinkMax);
  note("server's edits", ServerTestAccess::WaitingEdits(cluster_.server()), kEditsMax);
  for (int c = 0; c < cluster_.client_count(); ++c) {
    const Client* client = cluster_.client(c);
    if (client != nullptr) note("client's link", ClientTestAccess::Waiting(*client), kLinkMax);
  }
  for (const Peer& peer : peers_) {
    if (peer.replica == nullptr) continue;
    for (const auto& [queue, count] : ReplicaTestAccess::Queues(*peer.replica)) {
      note(queue, count, kQueueMax);
    }
  }
}

}  // namespace seam
