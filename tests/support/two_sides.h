#pragma once
/// ann's side and bob's, for scenes of tests: her region is left of x = 0, his right of it.

#include <gtest/gtest.h>

#include "client/embed/cluster.h"

namespace seam {

inline const char* const kTwoSides = R"(
[[player]]
name = "ann"
region = [[-1000, -1000], [-0.001, 1000]]
[[player]]
name = "bob"
region = [[0, -1000], [1000, 1000]]
)";

/// Counts the clients that believe to have a mechanism, at the server's own epoch, while the server
/// names another peer. Skips clients with another revision than the server.
inline int SecondAuthorities(Cluster* cluster) {
  const Replica& server = cluster->server().replica();
  int twice = 0;
  for (int i = 0; i < cluster->client_count(); ++i) {
    const Client* client = cluster->client(i);
    if (client == nullptr || !client->running()) continue;
    const Replica& replica = *client->replica();
    if (replica.revision() != server.revision()) continue;
    for (int m = 0; m < server.authority().count(); ++m) {
      const AuthorityRecord& ours = server.authority().at(m);
      const AuthorityRecord& theirs = replica.authority().at(m);
      const bool both = theirs.epoch == ours.epoch && theirs.authority == client->peer();
      if (both && ours.authority != client->peer()) ++twice;
    }
  }
  return twice;
}

}  // namespace seam
