#include "client/top/loads.h"

#include <utility>

#include "common/codec/codec.h"
#include "common/net/http_page.h"
#include "common/record/bus.h"

namespace seam {
namespace {

constexpr std::int64_t kLookUs = 1000000;
constexpr std::int64_t kPatienceOfLookUs = 500000;
/// Bus messages taken in one call: a second of 1000 rooms.
constexpr int kBusMessagesMax = 1000;

class BusLoads : public Loads {
 public:
  explicit BusLoads(const std::string& lcm_url) : bus_(lcm_url) {
    bus_.Subscribe("SEAM\\..*\\.load",
                   [this](const std::string& channel, std::int64_t, ByteView message) {
                     const AnyMessage any = Decode(message);
                     const auto* load = std::get_if<Load>(&any);
                     if (load == nullptr) return;
                     // "SEAM.<room>.load"; a room's name has no dot.
                     const std::size_t end = channel.find('.', 5);
                     RoomLoad& heard = heard_.emplace_back();
                     heard.room = channel.substr(5, end - 5);
                     heard.load = *load;
                   });
  }
  std::vector<RoomLoad> Take(std::int64_t) override {
    for (std::size_t n = 0, before = 0; n < kBusMessagesMax; ++n, before = heard_.size()) {
      bus_.Poll(0);
      if (heard_.size() == before) break;
    }
    return std::exchange(heard_, {});
  }

 private:
  Bus bus_;
  std::vector<RoomLoad> heard_;
};

class PageLoads : public Loads {
 public:
  explicit PageLoads(std::string address) : address_(std::move(address)) {}
  std::vector<RoomLoad> Take(std::int64_t now_us) override {
    return now_us < next_us_ ? std::vector<RoomLoad>{} : TakeNow(now_us);
  }
  std::vector<RoomLoad> TakeNow(std::int64_t now_us) override {
    next_us_ = now_us + kLookUs;
    std::string page;
    const Status status = FetchPage(address_, kPatienceOfLookUs, &page);
    trouble_ = status.why();
    return status.ok() ? ReadLoadPage(page) : std::vector<RoomLoad>{};
  }
  std::string trouble() const override { return trouble_; }

 private:
  std::string address_, trouble_;
  std::int64_t next_us_ = 0;
};

}  // namespace

std::unique_ptr<Loads> LoadsOnBus(const std::string& lcm_url) {
  return std::make_unique<BusLoads>(lcm_url);
}

std::unique_ptr<Loads> LoadsOnPage(const std::string& address) {
  return std::make_unique<PageLoads>(address);
}

}  // namespace seam
