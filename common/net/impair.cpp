#include "common/net/impair.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "common/base/check.h"
#include "common/net/impair_path.h"

namespace seam {
namespace {

/// Paths per direction with a random stream of their own. Any more (forged senders) share one path.
constexpr std::size_t kPathsMax = 4096;
/// Most datagrams taken from the inner net at once, so that a flood cannot hold us.
constexpr int kPullMax = 4096;

/// A datagram in flight.
struct Waiting {
  std::int64_t due_us = 0;
  std::uint64_t number = 0;  // order of arrival, breaks ties
  Address peer;
  std::size_t* path_bytes = nullptr;
  Bytes data;
};

struct Later {
  bool operator()(const Waiting& a, const Waiting& b) const {
    return a.due_us != b.due_us ? a.due_us > b.due_us : a.number > b.number;
  }
};

/// One direction: a path per peer, and the datagrams in flight on all paths.
class Direction {
 public:
  Direction(const ImpairProfile& profile, const Random& random)
      : profile_(profile), random_(random) {}
  Direction(const Direction&) = delete;
  Direction& operator=(const Direction&) = delete;

  void Enter(const Address& peer, ByteView data, std::int64_t now_us) {
    Path& path = Find(peer);
    const Fate fate = path.impair->Next(now_us, data.size);
    ++traffic_.offered;
    bool entered = false;
    for (int i = 0; i < fate.count; ++i) {
      if (path.bytes + data.size > ImpairedNet::kPathBytesMax) continue;
      if (bytes_ + data.size > ImpairedNet::kQueueBytesMax) continue;
      Waiting waiting{fate.arrivals[i].due_us, ++entered_, peer, &path.bytes,
                      Bytes(data.begin(), data.end())};
      const std::int64_t bit = fate.arrivals[i].flip_bit;
      if (bit >= 0) {
        auto& byte = waiting.data[static_cast<std::size_t>(bit / 8)];
        byte = static_cast<std::uint8_t>(byte ^ (1u << (bit % 8)));
      }
      path.bytes += data.size;
      bytes_ += data.size;
      heap_.push_back(std::move(waiting));
      std::push_heap(heap_.begin(), heap_.end(), Later());
      entered = true;
    }
    traffic_.lost += entered ? 0 : 1;
  }

  /// Takes the first due datagram; false if none is due.
  bool Leave(std::int64_t now_us, Address* peer, Bytes* data) {
    if (next_due_us() > now_us) return false;
    std::pop_heap(heap_.begin(), heap_.end(), Later());
    Waiting& first = heap_.back();
    *first.path_bytes -= first.data.size();
    bytes_ -= first.data.size();
    *peer = first.peer;
    *data = std::move(first.data);
    heap_.pop_back();
    return true;
  }

  /// Begins each path anew by another profile, with random streams of its own.
  void Change(const ImpairProfile& profile) {
    profile_ = profile;
    ++changes_;
    for (auto& [key, path] : paths_) path.impair.emplace(profile_, StreamOf(key));
  }

  void Clear() {
    for (const Waiting& waiting : heap_) *waiting.path_bytes -= waiting.data.size();
    heap_.clear();
    bytes_ = 0;
  }

  std::int64_t next_due_us() const {
    return heap_.empty() ? std::numeric_limits<std::int64_t>::max() : heap_.front().due_us;
  }

  const ImpairedTraffic& traffic() const { return traffic_; }

 private:
  struct Path {
    std::optional<ImpairPath> impair;  // never empty
    std::size_t bytes = 0;             // in flight on this path
  };

  /// Returns the random stream of a path.
  Random StreamOf(const Address& key) const {
    const std::uint64_t ipv4 = (std::uint64_t{key.ip} << 16) | key.port;
    const std::uint64_t purpose =
        key.ipv4() ? ipv4 : ipv4 ^ key.high ^ (std::uint64_t{key.middle} << 32);
    return changes_ == 0 ? random_.Fork(purpose) : random_.Fork(purpose).Fork(changes_);
  }

  Path& Find(const Address& peer) {
    const auto found = paths_.find(peer);
    if (found != paths_.end()) return found->second;
    const Address key = paths_.size() < kPathsMax ? peer : Address{};
    // std::map never moves its elements, so Waiting may point into them.
    Path& path = paths_[key];
    if (!path.impair) path.impair.emplace(profile_, StreamOf(key));
    return path;
  }

  ImpairProfile profile_;
  const Random random_;
  std::uint64_t changes_ = 0;  // of the profile
  std::map<Address, Path> paths_;
  std::vector<Waiting> heap_;
  std::uint64_t entered_ = 0;
  std::size_t bytes_ = 0;
  ImpairedTraffic traffic_;
};

}  // namespace

double MeanLoss(const ImpairProfile& profile) {
  const double both = profile.loss_good_to_bad + profile.loss_bad_to_good;
  const double bad = both > 0 ? profile.loss_good_to_bad / both : 0;
  return bad * profile.loss_in_bad + (1 - bad) * profile.loss_in_good;
}

double LossDeviation(const ImpairProfile& profile, std::int64_t count) {
  const double both = profile.loss_good_to_bad + profile.loss_bad_to_good;
  const double bad = both > 0 ? profile.loss_good_to_bad / both : 0;
  const double mean = MeanLoss(profile);
  // In the Markov chain of states, the correlation falls by the factor `kept` per datagram.
  const double kept = std::clamp(1 - both, 0.0, 0.999);
  const double apart = profile.loss_in_bad - profile.loss_in_good;
  const double bursts = 2 * bad * (1 - bad) * apart * apart * kept / (1 - kept);
  return std::sqrt(static_cast<double>(count) * (mean * (1 - mean) + bursts));
}

struct ImpairedNet::Impl {
  Impl(Net& inner_net, const ImpairProfile& out_profile, const ImpairProfile& in_profile,
       std::uint64_t seed)
      : inner(inner_net),
        out(out_profile, Random(seed).Fork(1)),
        in(in_profile, Random(seed).Fork(2)) {}

  /// Takes received datagrams from the inner net.
  void Pull() {
    Address from;
    Bytes data;
    for (int i = 0; i < kPullMax && inner.Receive(&from, &data); ++i) {
      if (!cut && !data.empty()) in.Enter(from, data, now_us);
    }
  }

  /// Sends due datagrams through the inner net.
  void Push() {
    Address to;
    Bytes data;
    while (out.Leave(now_us, &to, &data)) inner.Send(to, data);
  }

  Net& inner;
  Direction out, in;
  bool cut = false;
  std::int64_t now_us = 0;
};

ImpairedNet::ImpairedNet(Net& inner, const ImpairProfile& out, const ImpairProfile& in,
                         std::uint64_t seed)
    : impl_(std::make_unique<Impl>(inner, out, in, seed)) {}

ImpairedNet::~ImpairedNet() = default;

void ImpairedNet::Advance(std::int64_t now_us) {
  SEAM_ASSERT(now_us >= impl_->now_us);
  impl_->now_us = now_us;
  impl_->inner.Advance(now_us);
  impl_->Pull();
  impl_->Push();
}

void ImpairedNet::Send(const Address& to, ByteView datagram) {
  SEAM_ASSERT(datagram.size >= 1 && datagram.size <= kDatagramBytesMax);
  if (impl_->cut) return;
  impl_->out.Enter(to, datagram, impl_->now_us);
  impl_->Push();
}

void ImpairedNet::Flush() { impl_->inner.Flush(); }

bool ImpairedNet::Receive(Address* from, Bytes* datagram) {
  impl_->Pull();
  return impl_->in.Leave(impl_->now_us, from, datagram);
}

std::int64_t ImpairedNet::discarded() const { return impl_->inner.discarded(); }

void ImpairedNet::Change(const ImpairProfile& out, const ImpairProfile& in) {
  impl_->out.Change(out);
  impl_->in.Change(in);
}

void ImpairedNet::Cut(bool cut) {
  impl_->cut = impl_->cut || cut;
  impl_->Pull();  // datagrams that arrived while cut are lost too
  impl_->cut = cut;
  if (!cut) return;
  impl_->in.Clear();
  impl_->out.Clear();
}

ImpairedTraffic ImpairedNet::traffic() const {
  const ImpairedTraffic &in = impl_->in.traffic(), &out = impl_->out.traffic();
  return {in.offered + out.offered, in.lost + out.lost};
}

std::int64_t ImpairedNet::next_due_us() const {
  return std::min(impl_->in.next_due_us(), impl_->out.next_due_us());
}

bool ImpairedNet::sending() const {
  return impl_->out.next_due_us() != std::numeric_limits<std::int64_t>::max();
}

}  // namespace seam
