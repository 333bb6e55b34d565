#pragma once
/// What the server knows of one client.

#include <cstdint>
#include <string>

#include "common/net/link.h"
#include "common/net/net.h"

namespace seam {

enum class SessionStage {
  kGreeted,  ///< Welcome sent; its acknowledgement proves the address before much is sent there
  kLoading,  ///< the Room is under way
  kReady,    ///< simulates (or will from tick 0)
};

struct Session {
  explicit Session(std::uint64_t session) : number(session), link(session) {}

  std::uint64_t number;  ///< drawn by the client
  Link link;
  Address address;
  std::string name;
  int peer = 0;
  int player = -1;
  SessionStage stage = SessionStage::kGreeted;
  std::int64_t created_us = 0;
  std::int64_t repaired_us = -1000000000;
  bool leaving = false;  ///< to be dropped at the next opportunity
  std::string leaving_why;
};

}  // namespace seam
