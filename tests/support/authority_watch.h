#pragma once
/// Checks at every virtual instant of a cluster which peers believe to have authority, and which
/// peer the server names. Peers with another revision number their mechanisms differently: they are
/// skipped until they have applied the same edits.

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "client/embed/cluster.h"

namespace seam {

struct AuthorityWatch {
  std::int64_t instants = 0, one = 0, none = 0, several = 0;  ///< by the number of believed holders
  int two_holders_of_an_epoch = 0;  ///< clients that believed to have the same epoch
  int two_named_in_an_epoch = 0;    ///< peers that the server's own table named in the same epoch
  int longest_none = 0, current_none = 0;

  void Look(Cluster& cluster) {
    if (!cluster.server().started()) return;
    const AuthorityTable& table = cluster.server().replica().authority();
    const int revision = cluster.server().replica().revision();
    bool any_none = false;
    for (int m = 0; m < table.count(); ++m) {
      int believers = table.at(m).authority == 0 ? 1 : 0;
      two_named_in_an_epoch +=
          Contradicts(&named_, {revision, m}, table.at(m).epoch, table.at(m).authority);
      for (int c = 0; c < cluster.client_count(); ++c) {
        const Client* client = cluster.client(c);
        if (client == nullptr || !client->running()) continue;
        if (client->replica()->revision() != revision) continue;
        const AuthorityRecord& h = client->replica()->authority().at(m);
        if (h.authority != client->peer()) continue;
        ++believers;
        two_holders_of_an_epoch += Contradicts(&believed_, {revision, m}, h.epoch, client->peer());
      }
      ++instants;
      ++(believers == 1 ? one : believers == 0 ? none : several);
      any_none = any_none || believers == 0;
    }
    current_none = any_none ? current_none + 1 : 0;
    longest_none = std::max(longest_none, current_none);
  }

 private:
  using Mechanism = std::pair<int, int>;                                    // revision, index
  using HolderOfEpoch = std::map<std::pair<Mechanism, std::int64_t>, int>;  // by epoch: peer

  static int Contradicts(HolderOfEpoch* known, Mechanism mechanism, std::int64_t epoch, int peer) {
    const auto [it, fresh] = known->emplace(std::pair(mechanism, epoch), peer);
    return !fresh && it->second != peer ? 1 : 0;
  }

  HolderOfEpoch believed_, named_;
};

}  // namespace seam
