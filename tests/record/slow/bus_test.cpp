#include "common/record/bus.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "common/base/check.h"
#include "common/base/random.h"
#include "common/codec/codec.h"
#include "common/record/doctor.h"
#include "common/record/log_file.h"
#include "common/record/recording.h"
#include "tests/support/child_process.h"
#include "tests/support/temporary_file.h"

namespace seam {
namespace bus_test {

/// LCM wants multicast, and a test should not speak on the machine's network: each test here runs
/// itself again in a network namespace of its own, where `network` has been typed.
class BusInNamespace : public ::testing::Test {
 protected:
  static constexpr const char* kMulticast = "ip link set lo up; ip route add 224.0.0.0/4 dev lo";

  /// True inside, where the test does its work. Outside: runs it inside and judges the result.
  bool Enter(const std::string& network) {
    if (std::getenv("SEAM_TEST_IN_NAMESPACE") != nullptr) return true;
    ChildProcess probe({"unshare", "-rn", "true"});
    if (!probe.Wait(10) || probe.exit_status() != 0) {
      skip_reason_ = "no network namespace of its own: " + probe.output();
      return false;
    }
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    char self[4096] = {};
    EXPECT_GT(readlink("/proc/self/exe", self, sizeof self - 1), 0);
    const std::string filter =
        std::string("--gtest_filter=") + info->test_suite_name() + "." + info->name();
    ChildProcess inner({"unshare", "-rn", "env", "SEAM_TEST_IN_NAMESPACE=1", "LCM_DEFAULT_URL=",
                        "sh", "-c", network + "; exec \"$@\"", "sh", self, filter});
    EXPECT_TRUE(inner.Wait(120)) << "hangs";
    EXPECT_EQ(inner.exit_status(), 0) << inner.output();
    if (inner.output().find("[  SKIPPED ] 1 test") != std::string::npos) {
      skip_reason_ = inner.output();
    } else {
      EXPECT_NE(inner.output().find("[  PASSED  ] 1 test."), std::string::npos) << inner.output();
    }
    return false;
  }
  std::string skip_reason_;
};

/// Runs the rest of the test inside only.
#define SEAM_ENTER(network)                                  \
  if (!Enter(network)) {                                     \
    if (!skip_reason_.empty()) GTEST_SKIP() << skip_reason_; \
    return;                                                  \
  }

struct HeardMessage {
  std::string channel;
  Bytes data;
};

/// Polls until `count` messages came, at most about 20 s.
void PollUntil(Bus* bus, const std::vector<HeardMessage>& heard, std::size_t count) {
  for (int i = 0; i < 2000 && heard.size() < count; ++i) bus->Poll(10000);
}

Bus::Handler Into(std::vector<HeardMessage>* heard) {
  return [heard](const std::string& channel, std::int64_t, ByteView message) {
    heard->push_back({channel, Bytes(message.begin(), message.end())});
  };
}

View MakeView(std::int32_t sequence, std::size_t bodies) {
  View view;
  view.peer = 1;
  view.tick = view.sequence = sequence;
  for (std::size_t i = 0; i < bodies; ++i) view.id.push_back(static_cast<std::int32_t>(i));
  view.role.assign(bodies, kRoleAuthority);
  view.authority.assign(bodies, 1);
  view.x = view.y = view.angle = std::vector<float>(bodies, static_cast<float>(sequence));
  view.vx = view.vy = view.spin = view.age = view.x;
  return view;
}

TEST_F(BusInNamespace, ReceivesMessagesUpToTheLargest) {
  SEAM_ENTER(kMulticast);
  Bus speaker(""), listener("");
  std::vector<HeardMessage> heard;
  EXPECT_EQ(listener.fd(), -1);
  listener.Poll(1000000000);  // returns at once: nothing is subscribed
  listener.Subscribe("SEAM\\..*", Into(&heard));
  EXPECT_GE(listener.fd(), 0);
  Random random(1);
  std::vector<Bytes> sent;
  for (const std::size_t size : {1u, 100u, 1400u, 1500u, 9000u, 30000u, 59999u, 60000u}) {
    Bytes bytes(size);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.Next());
    speaker.Publish("SEAM.r.view", 0, bytes);
    sent.push_back(bytes);
  }
  PollUntil(&listener, heard, sent.size());
  ASSERT_EQ(heard.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) EXPECT_EQ(heard[i].data, sent[i]) << i;
  EXPECT_EQ(speaker.failures() + listener.failures(), 0);
}

TEST_F(BusInNamespace, ABurstOfLargeMessagesArrivesWhole) {
  SEAM_ENTER(kMulticast);
  Bus speaker(""), listener("");
  std::vector<HeardMessage> heard;
  listener.Subscribe(".*", Into(&heard));
  if (!listener.warnings().empty()) GTEST_SKIP() << listener.warnings()[0];
  // Sixty views of 28 kB at once: 1.7 MB, eight times the default socket buffer.
  for (std::int32_t i = 0; i < 60; ++i) {
    speaker.Publish("SEAM.r.view.1", 0, Encode(MakeView(i, 1000)));
  }
  PollUntil(&listener, heard, 60);
  EXPECT_EQ(heard.size(), 60u);
}

TEST_F(BusInNamespace, RefusesAndCountsOversizedMessages) {
  SEAM_ENTER(kMulticast);
  Bus bus("");
  bus.Publish("A", 0, Bytes(kBusMessageBytesMax + 1));
  bus.Publish("", 0, Bytes{1});
  bus.Publish(std::string(64, 'A'), 0, Bytes{1});
  EXPECT_EQ(bus.failures(), 3);
  bus.Publish(std::string(63, 'A'), 0, Bytes(kBusMessageBytesMax));
  EXPECT_EQ(bus.failures(), 3);
}

TEST_F(BusInNamespace, ChannelExpressionsMatchAsAWhole) {
  SEAM_ENTER(kMulticast);
  Bus speaker(""), listener("");
  std::vector<HeardMessage> heard, all;
  listener.Subscribe("A|B", Into(&heard));
  listener.Subscribe(".*", Into(&all));
  for (const char* channel : {"A", "AX", "XB", "B", "XAX"}) speaker.Publish(channel, 0, Bytes{1});
  PollUntil(&listener, all, 5);
  ASSERT_EQ(heard.size(), 2u);
  EXPECT_EQ(heard[0].channel, "A");
  EXPECT_EQ(heard[1].channel, "B");
  EXPECT_THROW(listener.Subscribe("(", Into(&all)), OperatorError);
}

TEST_F(BusInNamespace, AHandlerThatThrowsIsCountedAndTheNextMessageArrives) {
  SEAM_ENTER(kMulticast);
  Bus bus("");
  int heard = 0;
  bus.Subscribe("A", [&heard](const std::string&, std::int64_t, ByteView) {
    ++heard;
    throw std::runtime_error("handler");
  });
  for (int i = 0; i < 3; ++i) bus.Publish("A", 0, Bytes{1});
  for (int i = 0; i < 2000 && heard < 3; ++i) bus.Poll(10000);
  EXPECT_EQ(heard, 3);
  EXPECT_EQ(bus.failures(), 3);
}

/// Returns the error of the constructor or of Subscribe; "" on success.
std::string Complaint(const std::string& url) {
  try {
    Bus bus(url);
    bus.Subscribe(".*", [](const std::string&, std::int64_t, ByteView) {});
  } catch (const OperatorError& error) {
    return error.what();
  }
  return "";
}

TEST_F(BusInNamespace, NamesTheFixForAMissingRoute) {
  SEAM_ENTER("ip link set lo up");
  ::testing::internal::CaptureStderr();
  const std::string line = Complaint("");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << "LCM's own words are held back";
  EXPECT_NE(line.find("ip route add 224.0.0.0/4 dev lo"), std::string::npos) << line;
  EXPECT_EQ(line.find('\n'), std::string::npos) << line;
}

TEST_F(BusInNamespace, AWrongUrlIsNamed) {
  SEAM_ENTER(kMulticast);
  for (const char* url : {"nonsense", "tcp9://1.2.3.4", "udpm://not.an.address:1"}) {
    const std::string line = Complaint(url);
    EXPECT_NE(line.find(url), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
}

TEST_F(BusInNamespace, ReportsAFirewallInsteadOfCrashing) {
  SEAM_ENTER(std::string(kMulticast) +
             "; tc qdisc add dev lo root pfifo limit 0 || export SEAM_TEST_NO_TC=1");
  if (std::getenv("SEAM_TEST_NO_TC") != nullptr) GTEST_SKIP() << "tc cannot play the firewall";
  const std::string line = Complaint("");
  EXPECT_NE(line.find("firewall"), std::string::npos) << line;
  EXPECT_EQ(line.find('\n'), std::string::npos) << line;
}

std::string Text(const DoctorReport& report) {
  std::string text;
  for (const std::string& line : report.lines) text += line + "\n";
  return text;
}

TEST_F(BusInNamespace, TheDoctorFindsAHealthyMachineHealthy) {
  SEAM_ENTER(kMulticast);
  const DoctorReport report = RunDoctor("");
  EXPECT_TRUE(report.healthy) << Text(report);
  EXPECT_NE(Text(report).find("interface lo"), std::string::npos) << Text(report);
  EXPECT_NE(Text(report).find("60000 bytes comes back"), std::string::npos) << Text(report);
}

TEST_F(BusInNamespace, TheDoctorNamesTheFixForAMissingRoute) {
  SEAM_ENTER("ip link set lo up");
  const DoctorReport report = RunDoctor("");
  EXPECT_FALSE(report.healthy) << Text(report);
  EXPECT_NE(Text(report).find("ip route add 224.0.0.0/4 dev lo"), std::string::npos);
}

TEST_F(BusInNamespace, TheDoctorSaysHowFarMessagesGo) {
  SEAM_ENTER(kMulticast);
  EXPECT_NE(Text(RunDoctor("")).find("ok       messages stay on this machine (ttl 0)"),
            std::string::npos)
      << Text(RunDoctor(""));
  EXPECT_NE(Text(RunDoctor("udpm://239.255.76.67:7667?ttl=1"))
                .find("warning  ttl 1, but multicast takes interface lo"),
            std::string::npos);
}

TEST(Doctor, ReadsTheTimeToLiveOfAUrl) {
  EXPECT_EQ(TtlOf("udpm://239.255.76.67:7667?ttl=1"), 1);
  EXPECT_EQ(TtlOf("udpm://239.255.76.67:7667?recv_buf_size=9&ttl=12"), 12);
  EXPECT_EQ(TtlOf("udpm://239.255.76.67:7667?recv_buf_size=9"), 0);
  EXPECT_EQ(TtlOf(""), 0);
  EXPECT_EQ(TtlOf("udpm://?xttl=3&"), 0);
}

TEST(Doctor, FindsTheMostSpecificUsableRoute) {
  const std::string head = "Iface Destination Gateway Flags RefCnt Use Metric Mask MTU\n";
  const std::string any = "eth0\t00000000\t0100A8C0\t0003\t0\t0\t0\t00000000\t0\t0\t0\n";
  const std::string multicast = "lo\t000000E0\t00000000\t0001\t0\t0\t0\t000000F0\t0\t0\t0\n";
  const std::string down = "wlan0\t000000E0\t00000000\t0000\t0\t0\t0\t000000F0\t0\t0\t0\n";
  const std::string reject = "*\t000000E0\t00000000\t0201\t0\t0\t0\t000000F0\t0\t0\t0\n";
  EXPECT_EQ(RouteInterface(head + any + multicast, "239.255.76.67"), "lo");
  EXPECT_EQ(RouteInterface(head + multicast + any, "239.255.76.67"), "lo");
  EXPECT_EQ(RouteInterface(head + any + down + reject, "239.255.76.67"), "eth0");
  EXPECT_EQ(RouteInterface(head + multicast, "10.0.0.1"), "");
  EXPECT_EQ(RouteInterface(head, "239.255.76.67"), "");
  EXPECT_EQ(RouteInterface("", "nonsense"), "");
}

TEST_F(BusInNamespace, TheStockLoggerRecordsItsMessages) {
  SEAM_ENTER(kMulticast);
  TemporaryFile file;
  ChildProcess logger({"lcm-logger", "--quiet", "--flush-interval=10", file.path()});
  Bus bus("");
  // The logger listens once the file has an event.
  const auto logging = [&file] { return !file.Read().empty(); };
  for (int i = 0; i < 200 && !logging(); ++i) {
    bus.Publish("PROBE", 0, Bytes{1});
    usleep(50000);
  }
  ASSERT_TRUE(logging()) << logger.output();

  // Nothing throttles a publisher: messages overflow a slow reader's socket. So at most two views
  // are in flight, on any machine.
  const std::size_t before = file.Read().size();
  std::size_t sent = 0;
  const auto written_but = [&](std::size_t under_way) {
    const std::filesystem::path path = file.path();
    for (int i = 0; i < 1000 && std::filesystem::file_size(path) + under_way < before + sent; ++i) {
      usleep(10000);
      bus.Publish("PROBE", 0, Bytes{1});  // the logger flushes when something comes
    }
  };
  const auto publish = [&](const std::string& channel, const Bytes& message) {
    bus.Publish(channel, 0, message);
    sent += message.size();
    written_but(2 * message.size());
  };
  Room room;
  room.room = "r";
  room.scene_text = "[scene]\n";
  publish(ChannelName("r", "room"), Encode(room));
  constexpr std::int32_t kViews = 120;
  for (std::int32_t i = 0; i < kViews; ++i) {
    publish(ChannelName("r", "view", 1), Encode(MakeView(i, 1700)));
  }
  const auto views_written = [&file] {
    const Recording recording = ReadRecording(file.path());
    return recording.views.count(1) == 0 ? 0 : recording.views.at(1).size();
  };
  for (int i = 0; i < 400 && views_written() < static_cast<std::size_t>(kViews); ++i) {
    bus.Publish("PROBE", 0, Bytes{1});
    usleep(50000);
  }
  logger.Stop(SIGTERM);
  EXPECT_EQ(bus.failures(), 0);

  const Recording recording = ReadRecording(file.path());
  EXPECT_EQ(recording.room.scene_text, "[scene]\n");
  ASSERT_EQ(recording.views.count(1), 1u);
  EXPECT_EQ(recording.views.at(1).size(), static_cast<std::size_t>(kViews));
  EXPECT_EQ(recording.bus_gaps, 0);
  EXPECT_EQ(recording.undecodable, 0);
  EXPECT_EQ(recording.skipped_bytes, 0);
  for (const auto& [tick, view] : recording.views.at(1)) {
    EXPECT_EQ(view.x, std::vector<float>(1700, static_cast<float>(tick)));
  }
}

TEST_F(BusInNamespace, StockPlayerReplaysOurLog) {
  SEAM_ENTER(kMulticast);
  TemporaryFile file;
  std::vector<Bytes> written;
  {
    LogWriter writer(file.path());
    for (std::int32_t i = 0; i < 100; ++i) {
      written.push_back(Encode(MakeView(i, 10 * static_cast<std::size_t>(i))));
      writer.Publish(ChannelName("r", "view", 1), 1000000 + i * 2000, written.back());
    }
  }
  Bus bus("");
  std::vector<HeardMessage> heard;
  bus.Subscribe("SEAM\\..*", Into(&heard));
  ChildProcess player({"lcm-logplayer", file.path()});
  PollUntil(&bus, heard, written.size());
  EXPECT_TRUE(player.Wait(20));
  ASSERT_EQ(heard.size(), written.size()) << player.output();
  for (std::size_t i = 0; i < written.size(); ++i) {
    EXPECT_EQ(heard[i].channel, "SEAM.r.view.1");
    EXPECT_EQ(heard[i].data, written[i]);
  }
}

}  // namespace bus_test
}  // namespace seam
