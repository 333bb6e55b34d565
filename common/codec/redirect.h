#pragma once
/// The message that sends a client to another server.

#include <cstdint>
#include <string>

namespace seam {

/// Server -> client, in a session: the room goes on at another server.
struct Redirect {
  std::int64_t utime = 0;
  std::string address;     ///< as ToString(Address)
  std::string room;        ///< name of the room there
  std::int32_t epoch = 1;  ///< of the room there; no lower one is to be joined
};

}  // namespace seam
