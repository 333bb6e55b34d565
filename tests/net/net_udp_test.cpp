/// UDP on loopback, addresses as text, and the network inside one process.

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <ctime>
#include <string>
#include <thread>
#include <vector>

#include "common/base/check.h"
#include "common/net/memory.h"
#include "common/net/udp.h"

namespace seam {
namespace net_udp_test {

constexpr std::uint32_t kLoopback = 0x7f000001;

std::int64_t NowUs() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// Receives, waiting up to two seconds; empty when nothing comes.
Bytes Await(UdpNet& net, Address* from) {
  Bytes data;
  for (const std::int64_t end_us = NowUs() + 2'000'000; NowUs() < end_us;) {
    if (net.Receive(from, &data)) return data;
    net.Wait(100'000);
  }
  return {};
}

std::string ErrorOf(const std::string& address) {
  try {
    (void)ParseAddress(address, 7777);
  } catch (const OperatorError& error) {
    return error.what();
  }
  return "";
}

TEST(Udp, CarriesADatagramBothWaysWithItsSender) {
  UdpNet a({kLoopback, 0}), b({kLoopback, 0});
  const Bytes ping = {1, 2, 3}, pong(kDatagramBytesMax, 9);
  a.Send(b.local(), ping);
  a.Flush();
  Address from;
  EXPECT_EQ(Await(b, &from), ping);
  EXPECT_EQ(from, a.local());
  b.Send(from, pong);
  b.Flush();
  EXPECT_EQ(Await(a, &from), pong);
  EXPECT_EQ(from, b.local());
}

TEST(Udp, SendsNothingBeforeFlushUnlessABatchIsFull) {
  UdpNet a({kLoopback, 0}), b({kLoopback, 0});
  a.Send(b.local(), Bytes{1});
  b.Wait(20'000);
  Address from;
  Bytes data;
  EXPECT_FALSE(b.Receive(&from, &data));
  a.Flush();
  EXPECT_EQ(Await(b, &from), Bytes{1});
}

TEST(Udp, CarriesMoreThanOneBatchInOrder) {
  UdpNet a({kLoopback, 0}), b({kLoopback, 0});
  for (int i = 0; i < 200; ++i) a.Send(b.local(), Bytes{static_cast<std::uint8_t>(i)});
  a.Flush();
  Address from;
  for (int i = 0; i < 200; ++i) EXPECT_EQ(Await(b, &from), Bytes{static_cast<std::uint8_t>(i)});
}

TEST(Udp, OversizedAndEmptyDatagramsOfOthersAreSkipped) {
  UdpNet a({kLoopback, 0}), b({kLoopback, 0});
  const int fd = socket(AF_INET, SOCK_DGRAM, 0);
  ASSERT_GE(fd, 0);
  const Bytes large(kDatagramBytesMax + 1, 7);
  const std::uint16_t port = b.local().port;
  // A sockaddr_in by hand: family, then port and address in network order.
  const std::uint8_t to[16] = {AF_INET,
                               0,
                               static_cast<std::uint8_t>(port >> 8),
                               static_cast<std::uint8_t>(port & 255),
                               127,
                               0,
                               0,
                               1};
  const auto* sockaddr_to = reinterpret_cast<const sockaddr*>(to);
  EXPECT_EQ(sendto(fd, large.data(), large.size(), 0, sockaddr_to, sizeof to), 1201);
  EXPECT_EQ(sendto(fd, large.data(), 0, 0, sockaddr_to, sizeof to), 0);
  close(fd);
  a.Send(b.local(), Bytes{5});
  a.Flush();
  Address from;
  EXPECT_EQ(Await(b, &from), Bytes{5});
  EXPECT_EQ(from, a.local());
  EXPECT_EQ(b.discarded(), 2);
}

TEST(Udp, APortInUseIsOneClearLine) {
  UdpNet first({kLoopback, 0});
  const Address taken = first.local();
  try {
    UdpNet second(taken);
    FAIL() << "bound the same port twice";
  } catch (const OperatorError& error) {
    const std::string line = error.what();
    EXPECT_NE(line.find("port " + std::to_string(taken.port) + " is in use"), std::string::npos);
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
}

TEST(Udp, AnAddressOfAnotherMachineCannotBeBound) {
  EXPECT_THROW(UdpNet(Address{0x08080808, 0}), OperatorError);
}

TEST(Udp, SendingToAClosedPortIsLossAndHurtsNobodyElse) {
  UdpNet a({kLoopback, 0}), b({kLoopback, 0});
  Address gone;
  {
    UdpNet c({kLoopback, 0});
    gone = c.local();
  }
  Address from;
  for (std::uint8_t round = 0; round < 5; ++round) {
    a.Send(gone, Bytes{1});             // refused
    a.Send({kLoopback, 0}, Bytes{2});   // port 0: invalid
    a.Send({0xffffffff, 9}, Bytes{3});  // broadcast: not permitted
    a.Send(b.local(), Bytes{round});
    a.Flush();
    EXPECT_EQ(Await(b, &from), Bytes{round});
    b.Send(a.local(), Bytes{round});
    b.Flush();
    EXPECT_EQ(Await(a, &from), Bytes{round});
  }
}

TEST(Udp, WaitTimesOutWithoutSpinning) {
  UdpNet net({kLoopback, 0});
  const std::int64_t begin_us = NowUs();
  const std::clock_t cpu = std::clock();
  net.Wait(50'000);
  EXPECT_GE(NowUs() - begin_us, 49'000);
  EXPECT_LT(static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC, 0.04);
  net.Wait(-5);  // the past: returns at once
}

TEST(Udp, WaitWakesForADatagramAndForTheOtherDescriptor) {
  UdpNet a({kLoopback, 0}), b({kLoopback, 0});
  a.Send(b.local(), Bytes{1});
  a.Flush();
  const std::int64_t begin_us = NowUs();
  b.Wait(30'000'000);
  Address from;
  Bytes data;
  EXPECT_TRUE(b.Receive(&from, &data));
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  std::thread writer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(write(ends[1], "x", 1), 1);
  });
  b.Wait(30'000'000, ends[0]);
  writer.join();
  EXPECT_LT(NowUs() - begin_us, 20'000'000);  // woken, not timed out
  close(ends[0]);
  close(ends[1]);
}

TEST(Udp, WaitDoesNotSleepOnDatagramsAlreadyFetched) {
  UdpNet a({kLoopback, 0}), b({kLoopback, 0});
  for (std::uint8_t i = 0; i < 3; ++i) a.Send(b.local(), Bytes{i});
  a.Flush();
  Address from;
  EXPECT_EQ(Await(b, &from), Bytes{0});  // the batch of three is in our hands now
  const std::int64_t begin_us = NowUs();
  b.Wait(30'000'000);
  EXPECT_LT(NowUs() - begin_us, 20'000'000);
}

bool HasIpv6() {
  try {
    UdpNet net(ParseAddress("[::1]:0", 0));
    return true;
  } catch (const OperatorError&) {
    return false;
  }
}

TEST(Udp, OneSocketTakesIpv4AndIpv6AndAnswersBoth) {
  UdpNet both(kAnyAddress);
  for (const char* const from_text : {"127.0.0.1:0", "[::1]:0"}) {
    const Address own = ParseAddress(from_text, 0);
    if (!own.ipv4() && !HasIpv6()) continue;
    UdpNet other(own);
    Address to = own, from;
    to.port = both.local().port;
    other.Send(to, Bytes{1});
    other.Flush();
    EXPECT_EQ(Await(both, &from), Bytes{1}) << from_text;
    EXPECT_EQ(from, other.local());
    EXPECT_EQ(from.ipv4(), own.ipv4());
    both.Send(from, Bytes{2});
    both.Flush();
    EXPECT_EQ(Await(other, &from), Bytes{2}) << from_text;
    EXPECT_EQ(from, to);
  }
}

TEST(Udp, AnIpv4SocketLosesWhatIsForIpv6AndGoesOn) {
  UdpNet a({kLoopback, 0}), b({kLoopback, 0});
  a.Send(ParseAddress("[::1]:9", 9), Bytes{1});
  a.Send(b.local(), Bytes{2});
  a.Flush();
  Address from;
  EXPECT_EQ(Await(b, &from), Bytes{2});
}

TEST(Addresses, AreReadWithAndWithoutAPort) {
  EXPECT_EQ(ParseAddress("127.0.0.1:80", 7777), (Address{kLoopback, 80}));
  EXPECT_EQ(ParseAddress("10.1.2.3", 7777), (Address{0x0a010203, 7777}));
  EXPECT_EQ(ParseAddress("localhost:9", 7777), (Address{kLoopback, 9}));
  EXPECT_EQ(ParseAddress("0.0.0.0:0", 7777), (Address{0, 0}));
  EXPECT_EQ(ToString(ParseAddress("192.168.0.1:65535", 1)), "192.168.0.1:65535");
  const Address one{0x00000002, 80, 1, 0x20010db8000000ffULL};
  EXPECT_EQ(ParseAddress("[2001:db8:0:ff:0:1:0:2]:80", 7777), one);
  EXPECT_EQ(ToString(one), "[2001:db8:0:ff:0:1:0:2]:80");
  EXPECT_EQ(ToString(ParseAddress("::1", 7777)), "[::1]:7777");
  EXPECT_EQ(ToString(ParseAddress("[::1]", 7777)), "[::1]:7777");
  EXPECT_EQ(ParseAddress("[::ffff:10.1.2.3]:5", 1), (Address{0x0a010203, 5})) << "IPv4, mapped";
}

TEST(Addresses, NonsenseIsQuotedInOneLine) {
  const std::string no_host(70, 'x');  // no resolver is asked for a label above 63 letters
  for (const std::string& text : std::vector<std::string>{
           "", ":80", "127.0.0.1:", "127.0.0.1:65536", "127.0.0.1:-1", "127.0.0.1:8o",
           "127.0.0.1:123456", "256.0.0.1", "1.2.3", "::1x", "[::1]:", "[::1]80", "[::1]:x",
           "[127.0.0.1]:80", "a:b:c", no_host + ":80"}) {
    const std::string line = ErrorOf(text);
    EXPECT_NE(line.find('"' + text + '"'), std::string::npos) << text;
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
}

TEST(MemoryNetwork, DeliversInOrderAndOnlyToEndpointsThatExist) {
  MemoryNetwork network;
  const Address here{1, 1}, there{1, 2}, nowhere{1, 3};
  auto a = network.Attach(here), b = network.Attach(there);
  a->Send(nowhere, Bytes{0});
  a->Send(there, Bytes{1});
  a->Send(there, Bytes{2});
  auto late = network.Attach(nowhere);
  Address from;
  Bytes data;
  EXPECT_FALSE(late->Receive(&from, &data));
  ASSERT_TRUE(b->Receive(&from, &data));
  EXPECT_EQ(from, here);
  EXPECT_EQ(data, Bytes{1});
  ASSERT_TRUE(b->Receive(&from, &data));
  EXPECT_EQ(data, Bytes{2});
  EXPECT_FALSE(b->Receive(&from, &data));
}

TEST(MemoryNetwork, ARestartedEndpointReplacesTheOldOne) {
  MemoryNetwork network;
  const Address here{1, 1}, there{1, 2};
  auto a = network.Attach(here), old = network.Attach(there);
  a->Send(there, Bytes{1});
  auto fresh = network.Attach(there);
  a->Send(there, Bytes{2});
  old->Send(here, Bytes{3});
  Address from;
  Bytes data;
  EXPECT_FALSE(old->Receive(&from, &data));
  EXPECT_FALSE(a->Receive(&from, &data));
  old.reset();  // must not take the new one with it
  ASSERT_TRUE(fresh->Receive(&from, &data));
  EXPECT_EQ(data, Bytes{2});
  a->Send(there, Bytes{4});
  EXPECT_TRUE(fresh->Receive(&from, &data));
}

}  // namespace net_udp_test
}  // namespace seam
