/// The LCM bus, and clients of real servers, in Python.

#include <string>
#include <utility>
#include <vector>

#include "client/python/guarded.h"
#include "client/python/module.h"
#include "client/python/udp_client.h"
#include "common/base/check.h"
#include "common/base/process.h"
#include "common/codec/fingerprints.h"
#include "common/codec/lcm_types.h"
#include "common/record/bus.h"

namespace seam {
namespace {

namespace py = pybind11;

/// A bus whose messages wait until they are asked for.
class PythonBus {
 public:
  struct Arrival {
    int subscription = 0;
    std::string channel;
    std::int64_t utime = 0;  ///< of receipt, us since 1970
    std::string message;
  };

  explicit PythonBus(const std::string& url) : bus_(url) {}

  void Publish(const std::string& channel, const std::string& message) {
    const std::int64_t before = bus_.failures();
    bus_.Publish(channel, 0, TextBytes(message));
    if (bus_.failures() == before) return;
    throw OperatorError("cannot publish " + std::to_string(message.size()) +
                        " bytes on channel \"" + channel.substr(0, 80) +
                        "\": a channel has 1 to 63 bytes, a message at most 60000");
  }
  /// Messages on channels that match the whole expression are of subscription `number`.
  void Subscribe(const std::string& channels, int number) {
    bus_.Subscribe(channels, [this, number](const std::string& channel, std::int64_t utime,
                                            ByteView bytes) {
      arrived_.push_back(
          {number, channel, utime, {reinterpret_cast<const char*>(bytes.data), bytes.size}});
    });
  }
  /// Waits at most so long for the first message; returns those that have come.
  std::vector<Arrival> Poll(std::int64_t wait_us) {
    bus_.Poll(wait_us);
    return std::exchange(arrived_, {});
  }
  std::vector<std::string> warnings() const { return bus_.warnings(); }

 private:
  Bus bus_;
  std::vector<Arrival> arrived_;
};

using OneBus = Guarded<PythonBus>;
using OneClient = Guarded<UdpClient>;

py::list PollBus(OneBus& bus, std::int64_t wait_us) {
  const auto arrived = bus.Do([wait_us](PythonBus& b) { return b.Poll(wait_us); });
  py::list list;
  for (const PythonBus::Arrival& a : arrived) {
    list.append(py::make_tuple(a.subscription, a.channel, a.utime, py::bytes(a.message)));
  }
  return list;
}

template <class Message>
py::bytes EncodeChecked(const char* type, const Message& message) {
  const Status status = Check(message);
  if (!status.ok()) throw OperatorError(std::string("a ") + type + " that " + status.why());
  const Bytes bytes = Encode(message);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

template <class Message>
Message DecodeChecked(const std::string& bytes) {
  Message message;
  const Status status = Decode(TextBytes(bytes), &message);
  if (!status.ok()) throw OperatorError("a message that " + status.why());
  return message;
}

void AddBus(py::module_& module) {
  py::class_<OneBus>(module, "Bus")
      .def(py::init<const std::string&>(), py::arg("url"))
      .def(
          "publish",
          [](OneBus& bus, const std::string& channel, const std::string& message) {
            bus.Do([&](PythonBus& b) { b.Publish(channel, message); });
          },
          py::arg("channel"), py::arg("message"))
      .def(
          "subscribe",
          [](OneBus& bus, const std::string& channels, int number) {
            bus.Do([&](PythonBus& b) { b.Subscribe(channels, number); });
          },
          py::arg("channels"), py::arg("number"))
      .def("poll", &PollBus, py::arg("wait_us"))
      .def("warnings",
           [](OneBus& bus) { return bus.Quick([](PythonBus& b) { return b.warnings(); }); });
  module.def("encode_pose", [](std::int64_t utime, std::int64_t tick, int peer,
                               const std::string& name, double x, double y, double angle, double vx,
                               double vy, double spin) {
    return EncodeChecked("pose", LcmPose{utime, tick, peer, name, x, y, angle, vx, vy, spin});
  });
  module.def("decode_pose", [](const std::string& bytes) {
    const auto p = DecodeChecked<LcmPose>(bytes);
    return py::make_tuple(p.utime, p.tick, p.peer, p.name, p.x, p.y, p.angle, p.vx, p.vy, p.spin);
  });
  module.def("encode_drive", [](std::int64_t utime, double drive, double lift, int buttons) {
    return EncodeChecked("drive", LcmDrive{utime, drive, lift, buttons});
  });
  module.def("decode_drive", [](const std::string& bytes) {
    const auto d = DecodeChecked<LcmDrive>(bytes);
    return py::make_tuple(d.utime, d.drive, d.lift, d.buttons);
  });
  module.def("encode_message",
             [](std::int64_t utime, const std::string& name, const std::vector<double>& value,
                const std::string& text) {
               return EncodeChecked("message", LcmMessage{utime, name, value, text});
             });
  module.def("decode_message", [](const std::string& bytes) {
    const auto m = DecodeChecked<LcmMessage>(bytes);
    return py::make_tuple(m.utime, m.name, m.value, m.text);
  });
  module.def("fingerprints", [] {
    py::dict dict;
    for (const Fingerprint& type : Fingerprints()) dict[py::str(type.type)] = type.hash;
    return dict;
  });
}

void AddClient(py::module_& module) {
  py::class_<OneClient>(module, "Client")
      .def(py::init([](const std::string& server, const std::string& name, const std::string& room,
                       const std::string& server_key, const std::string& impair, std::int64_t seed,
                       const std::string& lcm_url, const std::string& record, bool force) {
             return std::make_unique<OneClient>(UdpClientConfig{
                 server, name, room, server_key, impair, seed, lcm_url, record, force});
           }),
           py::arg("server"), py::arg("name"), py::kw_only(), py::arg("room"),
           py::arg("server_key"), py::arg("impair"), py::arg("seed"), py::arg("lcm_url"),
           py::arg("record"), py::arg("force"))
      .def("turn", [](OneClient& one) { one.Do([](UdpClient& c) { c.Turn(); }); })
      .def("leave", [](OneClient& one) { one.Do([](UdpClient& c) { c.Leave(); }); })
      .def(
          "input",
          [](OneClient& one, int drive, int lift, int buttons) {
            const Input input = InputOf(drive, lift, buttons);
            one.Quick([&](UdpClient& c) { c.SetInput(input); });
          },
          py::arg("drive"), py::arg("lift"), py::arg("buttons"))
      .def("tick", [](OneClient& one) { return one.Quick([](UdpClient& c) { return c.tick(); }); })
      .def("tick_hz",
           [](OneClient& one) {
             return one.Quick([](UdpClient& c) { return c.client().room().tick_hz; });
           })
      .def("peer",
           [](OneClient& one) { return one.Quick([](UdpClient& c) { return c.client().peer(); }); })
      .def("ended",
           [](OneClient& one) { return one.Quick([](UdpClient& c) { return c.ended(); }); })
      .def("joining_s",
           [](OneClient& one) {
             return one.Quick([](UdpClient& c) {
               return static_cast<double>(c.client().joining_us(SteadyClockUs())) * 1e-6;
             });
           })
      .def("notice",
           [](OneClient& one) { return one.Quick([](UdpClient& c) { return c.TakeNotice(); }); })
      .def("state", [](OneClient& one) {
        return DictOf(one.Quick([](UdpClient& c) {
          const View view = c.ViewNow();  // throws before there is a world
          return BodiesOf(c.client().replica()->world().scene(), view);
        }));
      });
}

}  // namespace

void AddNet(py::module_& module) {
  AddBus(module);
  AddClient(module);
}

}  // namespace seam
