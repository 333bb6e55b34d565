#pragma once
/// A bare UDP socket on loopback that sends datagrams of any content and size, as no Net does.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>

#include "common/base/bytes.h"

namespace seam {

class UdpSocket {
 public:
  UdpSocket() : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    const sockaddr_in any = Loopback(0);
    EXPECT_EQ(bind(fd_, reinterpret_cast<const sockaddr*>(&any), sizeof any), 0);
  }
  ~UdpSocket() { close(fd_); }
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;

  int fd() const { return fd_; }
  std::uint16_t port() const {
    sockaddr_in own{};
    socklen_t bytes = sizeof own;
    EXPECT_EQ(getsockname(fd_, reinterpret_cast<sockaddr*>(&own), &bytes), 0);
    return ntohs(own.sin_port);
  }
  /// Returns false if the kernel refuses the datagram.
  bool Send(std::uint16_t port, const Bytes& data) const {
    const sockaddr_in to = Loopback(port);
    return sendto(fd_, data.data(), data.size(), 0, reinterpret_cast<const sockaddr*>(&to),
                  sizeof to) == static_cast<ssize_t>(data.size());
  }
  /// Returns false if nothing has arrived.
  bool Receive(std::uint16_t* port, Bytes* data) const {
    data->resize(65536);
    sockaddr_in from{};
    socklen_t bytes = sizeof from;
    const ssize_t got =
        recvfrom(fd_, data->data(), data->size(), 0, reinterpret_cast<sockaddr*>(&from), &bytes);
    data->resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    *port = ntohs(from.sin_port);
    return got >= 0;
  }

 private:
  static sockaddr_in Loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
  }
  int fd_;
};

}  // namespace seam
