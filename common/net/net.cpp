#include "common/net/net.h"

namespace seam {

std::string ToString(const Address& address) {
  const std::uint32_t ip = address.ip;
  return std::to_string(ip >> 24) + "." + std::to_string((ip >> 16) & 255) + "." +
         std::to_string((ip >> 8) & 255) + "." + std::to_string(ip & 255) + ":" +
         std::to_string(address.port);
}

}  // namespace seam
