/// Addresses as text.

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstring>

#include "common/base/check.h"
#include "common/net/udp.h"

namespace seam {
namespace {

/// Reads all of `text` as a port. Throws OperatorError quoting `whole`.
std::uint16_t ParsePort(const std::string& text, const std::string& whole) {
  const bool digits = !text.empty() && text.size() <= 5 &&
                      text.find_first_not_of("0123456789") == std::string::npos;
  const unsigned long port = digits ? std::stoul(text) : 65536;
  if (port > 65535) {
    throw OperatorError("address \"" + whole + "\": the port must be a number from 0 to 65535");
  }
  return static_cast<std::uint16_t>(port);
}

Address FromBytes(const in6_addr& in) {
  std::uint8_t bytes[16];
  std::memcpy(bytes, &in, sizeof bytes);
  Address address;
  address.high = GetNumber(bytes, 8);
  address.middle = static_cast<std::uint32_t>(GetNumber(bytes + 8, 4));
  address.ip = static_cast<std::uint32_t>(GetNumber(bytes + 12, 4));
  return address;
}

/// Asks the resolver for the first IPv4 address of `host`, or else its first IPv6 address.
Address Resolve(const std::string& host, const std::string& whole) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.c_str(), nullptr, &hints, &found);
  if (error != 0 || found == nullptr) {
    throw OperatorError("address \"" + whole + "\": cannot find host \"" + host +
                        "\": " + gai_strerror(error));
  }
  const addrinfo* best = nullptr;
  for (const addrinfo* each = found; each != nullptr; each = each->ai_next) {
    const bool known = each->ai_family == AF_INET || each->ai_family == AF_INET6;
    const bool better =
        best == nullptr || (each->ai_family == AF_INET && best->ai_family != AF_INET);
    if (known && better) best = each;
  }
  Address address;
  if (best != nullptr && best->ai_family == AF_INET) {
    sockaddr_in four{};
    std::memcpy(&four, best->ai_addr, sizeof four);
    address.ip = ntohl(four.sin_addr.s_addr);
  } else if (best != nullptr) {
    sockaddr_in6 six{};
    std::memcpy(&six, best->ai_addr, sizeof six);
    address = FromBytes(six.sin6_addr);
  }
  freeaddrinfo(found);
  if (best == nullptr) {
    throw OperatorError("address \"" + whole + "\": host \"" + host + "\" has no address");
  }
  return address;
}

/// Splits "host:port", "host", "[IPv6]:port", "[IPv6]" or "IPv6".
void Split(const std::string& text, std::string* host, std::string* port, bool* six) {
  const std::size_t colon = text.find(':'), close = text.find(']');
  *six = std::count(text.begin(), text.end(), ':') > 1;
  if (*six && text[0] == '[' && close != std::string::npos) {
    *host = text.substr(1, close - 1);
    *port = text.substr(close + 1);
    const bool named = port->size() > 1 && (*port)[0] == ':';
    if (!named && !port->empty()) host->clear();
    if (named) port->erase(0, 1);
    return;
  }
  *host = *six ? text : text.substr(0, colon);
  *port = *six || colon == std::string::npos ? "" : text.substr(colon + 1);
}

}  // namespace

Address ParseAddress(const std::string& text, std::uint16_t default_port) {
  std::string host, port;
  bool six = false;
  Split(text, &host, &port, &six);
  const bool no_port = port.empty() && (six || text.find(':') == std::string::npos);
  const std::uint16_t number = no_port ? default_port : ParsePort(port, text);
  Address address;
  in6_addr numeric6{};
  in_addr numeric{};
  if (six) {
    if (inet_pton(AF_INET6, host.c_str(), &numeric6) != 1) {
      throw OperatorError("address \"" + text + "\": expected host:port or [IPv6]:port");
    }
    address = FromBytes(numeric6);
  } else if (host.empty() || host.size() > 253 || host.find('\0') != std::string::npos) {
    throw OperatorError("address \"" + text + "\": the host is missing");
  } else if (inet_pton(AF_INET, host.c_str(), &numeric) == 1) {
    address.ip = ntohl(numeric.s_addr);
  } else if (host.find_first_not_of("0123456789.") == std::string::npos) {
    throw OperatorError("address \"" + text + "\": \"" + host + "\" is not an IPv4 address");
  } else {
    address = Resolve(host, text);
  }
  address.port = number;
  return address;
}

bool ReadAddress(const std::string& text, Address* address) {
  const std::size_t colon = text.rfind(':');
  const bool six = !text.empty() && text.front() == '[';
  if (colon == std::string::npos || text.size() > INET6_ADDRSTRLEN + 8) return false;
  if (text.find_first_not_of("0123456789abcdefABCDEF:.[]") != std::string::npos) return false;
  if (!six && text.find_first_not_of("0123456789.:") != std::string::npos) return false;
  try {
    *address = ParseAddress(text, 0);
  } catch (const OperatorError&) {
    return false;
  }
  return address->port != 0;
}

std::string ToString(const Address& address) {
  char text[INET6_ADDRSTRLEN] = {};
  const std::string port = std::to_string(address.port);
  if (address.ipv4()) {
    const in_addr four{htonl(address.ip)};
    (void)inet_ntop(AF_INET, &four, text, sizeof text);
    return text + (":" + port);
  }
  (void)inet_ntop(AF_INET6, BytesOf(address).data(), text, sizeof text);
  return "[" + std::string(text) + "]:" + port;
}

}  // namespace seam
