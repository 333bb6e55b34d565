/// The named network profiles, and the parser of profiles spelled out on a command line.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "common/base/check.h"
#include "common/base/nearest.h"
#include "common/net/impair.h"

namespace seam {
namespace {

constexpr std::int64_t kMs = 1000;                // us
constexpr std::int64_t kDelayUsMax = 60'000'000;  // longest time a spec may name

ImpairProfile Base(const char* name, std::int64_t delay_us, std::int64_t jitter_us,
                   const char* about) {
  ImpairProfile profile;
  profile.name = name;
  profile.about = about;
  profile.delay_us = delay_us;
  profile.jitter_mean_us = jitter_us;
  return profile;
}

/// Sets independent losses.
void Loss(ImpairProfile& profile, double share) { profile.loss_in_good = share; }

/// Sets Gilbert-Elliott losses per datagram: chance of good to bad, of bad to good, loss while bad,
/// loss while good.
void Bursts(ImpairProfile& profile, double p, double r, double in_bad, double in_good) {
  profile.loss_good_to_bad = p;
  profile.loss_bad_to_good = r;
  profile.loss_in_bad = in_bad;
  profile.loss_in_good = in_good;
}

std::vector<ImpairProfile> Tame() {
  std::vector<ImpairProfile> list;
  list.push_back(Base("perfect", 0, 0, "nothing is lost or late"));
  list.push_back(Base("demo", 50 * kMs, 10 * kMs,
                      "50 ms + exponential 10 ms (mean and deviation), 1 % lost independently"));
  Loss(list.back(), 0.01);
  list.push_back(Base("lan", 300, 100, "0.3 ms + 0.1 ms"));
  list.push_back(Base("fibre", 10 * kMs, 1 * kMs, "10 ms + 1 ms, 0.01 % lost"));
  Loss(list.back(), 0.0001);
  list.push_back(Base("cable", 25 * kMs, 5 * kMs, "25 ms + 5 ms, 0.05 % lost"));
  Loss(list.back(), 0.0005);
  list.push_back(Base("broadband", 32 * kMs, 12 * kMs, "32 ms + 12 ms, 2 % lost in pairs"));
  Bursts(list.back(), 0.0102, 0.5, 1, 0);
  list.push_back(Base("oneway100", 100 * kMs, 5 * kMs, "100 ms + 5 ms, 1 % lost"));
  Loss(list.back(), 0.01);
  list.push_back(Base("oneway200", 200 * kMs, 5 * kMs, "200 ms + 5 ms, 1 % lost"));
  Loss(list.back(), 0.01);
  list.push_back(Base("geo", 300 * kMs, 0, "geostationary satellite: 300 ms"));
  return list;
}

std::vector<ImpairProfile> Mobile() {
  std::vector<ImpairProfile> list;
  list.push_back(Base("wifi_busy", 15 * kMs, 8 * kMs,
                      "15 ms + 8 ms, 1.5 % lost in bursts, a stall of 0.1-0.6 s every 8 s"));
  Bursts(list.back(), 0.0063, 0.333, 0.7, 0.002);
  list.back().spikes_per_s = 0.12;  // 0.2 % of 60 datagrams a second
  list.back().spike_min_us = 100 * kMs;
  list.back().spike_max_us = 600 * kMs;
  list.push_back(Base("4g", 50 * kMs, 20 * kMs, "50 ms + 20 ms, 4 % lost in bursts, 5 Mb/s"));
  Bursts(list.back(), 0.0115, 0.25, 0.8, 0.005);
  list.back().rate_bits_per_s = 5'000'000;
  for (const char* name : {"lte", "4g_up"}) {
    list.push_back(*(list.end() - 1));
    list.back().name = name;
  }
  (list.end() - 2)->about = "the same as 4g";
  list.back().about = "the way up of 4g: 2 Mb/s";
  list.back().rate_bits_per_s = 2'000'000;
  list.push_back(Base("4g_driving", 50 * kMs, 25 * kMs,
                      "50 ms + 25 ms, 3 % lost in bursts, stalls of 0.1-0.3 s and 0.5-4 s"));
  Bursts(list.back(), 0.00812, 0.25, 0.8, 0.005);
  list.back().spikes_per_s = 0.6;
  list.back().spike_min_us = 100 * kMs;
  list.back().spike_max_us = 300 * kMs;
  list.back().stalls_per_s = 0.06;
  list.back().stall_min_us = 500 * kMs;
  list.back().stall_max_us = 4000 * kMs;
  list.push_back(Base("3g", 180 * kMs, 30 * kMs, "180 ms + 30 ms, 7 % lost in bursts"));
  Bursts(list.back(), 0.0223, 0.25, 0.8, 0.005);
  list.push_back(Base("starlink", 25 * kMs, 8 * kMs,
                      "25 ms + 8 ms, 0.8 % lost; half is lost for 0.3-1 s every 15 s"));
  Bursts(list.back(), 0.00403, 0.5, 1, 0);
  list.back().outage_period_us = 15'000 * kMs;
  list.back().outage_min_us = 300 * kMs;
  list.back().outage_max_us = 1000 * kMs;
  list.back().outage_loss = 0.5;
  return list;
}

std::vector<ImpairProfile> Harsh() {
  std::vector<ImpairProfile> list;
  list.push_back(Base("terrible", 100 * kMs, 0, "100 ms, 20 % lost, 4 % held back by 50 ms"));
  Loss(list.back(), 0.2);
  list.back().reorder = 0.04;
  list.back().reorder_us = 50 * kMs;
  list.push_back(Base("soak", 900 * kMs, 100 * kMs, "1 s on average, 25 % lost, 25 % twice"));
  Loss(list.back(), 0.25);
  list.back().duplicate = 0.25;
  list.push_back(Base("corrupt", 0, 0, "one bit of 1 % of the datagrams is flipped"));
  list.back().corrupt = 0.01;
  return list;
}

/// Splits `text` into a leading number and the rest, `unit`. False if there is no number.
bool ReadNumber(const std::string& text, double* value, std::string* unit) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, *value);
  *unit = std::string(stop, end);
  return error == std::errc() && std::isfinite(*value) && *value >= 0;
}

/// Reads specs like "delay=50ms,loss=1%". Each function throws with the piece that it cannot read.
class SpecReader {
 public:
  ImpairProfile Read(const std::string& spec) {
    profile_.name = spec;
    profile_.about = "spelled out";
    for (std::size_t at = 0; at <= spec.size();) {
      const std::size_t comma = std::min(spec.find(',', at), spec.size());
      piece_ = spec.substr(at, comma - at);
      ReadPiece();
      at = comma + 1;
    }
    return profile_;
  }

 private:
  [[noreturn]] void Fail(const std::string& why) const {
    throw OperatorError("impairment \"" + piece_ + "\": " + why);
  }

  /// Returns the piece's `index`-th value between colons.
  std::string Value(std::size_t index, std::size_t count) const {
    std::vector<std::string> values;
    for (std::size_t at = piece_.find('=') + 1; at <= piece_.size();) {
      const std::size_t colon = std::min(piece_.find(':', at), piece_.size());
      values.push_back(piece_.substr(at, colon - at));
      at = colon + 1;
    }
    if (values.size() != count) {
      Fail(count == 1 ? "expected one value"
                      : "expected " + std::to_string(count) + " values with : between");
    }
    return values[index];
  }

  std::int64_t Time(std::size_t index, std::size_t count) const {
    static const std::map<std::string, double> kTimeUnits = {{"us", 1}, {"ms", 1e3}, {"s", 1e6}};
    const double us = Scaled(Value(index, count), kTimeUnits, "a time such as 50ms (us, ms or s)");
    if (us > static_cast<double>(kDelayUsMax)) Fail("longer than 60s");
    return std::llround(us);
  }

  double Share(std::size_t index, std::size_t count) const {
    static const std::map<std::string, double> kShareUnits = {{"%", 0.01}, {"", 1}};
    const double share = Scaled(Value(index, count), kShareUnits, "a share such as 1% or 0.01");
    if (share > 1) Fail("a share above 100%");
    return share;
  }

  std::int64_t Rate() const {
    static const std::map<std::string, double> kRateUnits = {{"b", 1}, {"kb", 1e3}, {"Mb", 1e6}};
    const double rate =
        Scaled(Value(0, 1), kRateUnits, "a rate such as 5Mb (b, kb or Mb per second)");
    if (rate < 1000 || rate > 1e11) Fail("the rate must be from 1kb to 100000Mb");
    return std::llround(rate);
  }

  double PerSecond(std::size_t index, std::size_t count) const {
    const double rate = Scaled(Value(index, count), {{"", 1}}, "a number per second");
    if (rate > 100) Fail("more than 100 per second");
    return rate;
  }

  double Scaled(const std::string& text, const std::map<std::string, double>& units,
                const char* expected) const {
    double value = 0;
    std::string unit;
    if (!ReadNumber(text, &value, &unit) || units.count(unit) == 0) {
      Fail(std::string("expected ") + expected);
    }
    return value * units.at(unit);
  }

  void ReadPiece() {
    const std::string key = piece_.substr(0, piece_.find('='));
    if (key == piece_) Fail("expected key=value");
    if (key == "delay") {
      profile_.delay_us = Time(0, 1);
    } else if (key == "jitter") {
      profile_.jitter_mean_us = Time(0, 1);
    } else if (key == "loss") {
      profile_.loss_in_good = Share(0, 1);
    } else if (key == "burst") {
      profile_.loss_good_to_bad = Share(0, 2);
      profile_.loss_bad_to_good = Share(1, 2);
    } else if (key == "reorder") {
      profile_.reorder = Share(0, 2);
      profile_.reorder_us = Time(1, 2);
    } else if (key == "duplicate") {
      profile_.duplicate = Share(0, 1);
    } else if (key == "corrupt") {
      profile_.corrupt = Share(0, 1);
    } else if (key == "rate") {
      profile_.rate_bits_per_s = Rate();
    } else if (key == "spikes") {
      profile_.spikes_per_s = PerSecond(0, 3);
      profile_.spike_min_us = Time(1, 3);
      profile_.spike_max_us = Time(2, 3);
      if (profile_.spike_min_us > profile_.spike_max_us) Fail("the shortest is above the longest");
    } else {
      Fail("known are delay, jitter, loss, burst, reorder, duplicate, corrupt, rate and spikes");
    }
  }

  ImpairProfile profile_;
  std::string piece_;
};

}  // namespace

const std::vector<ImpairProfile>& Profiles() {
  static const std::vector<ImpairProfile> kProfiles = [] {
    std::vector<ImpairProfile> all = Tame();
    for (const auto& group : {Mobile(), Harsh()}) all.insert(all.end(), group.begin(), group.end());
    return all;
  }();
  return kProfiles;
}

std::vector<std::string> ProfileNames() {
  std::vector<std::string> names;
  for (const ImpairProfile& profile : Profiles()) names.push_back(profile.name);
  return names;
}

ImpairProfile FindProfile(const std::string& name_or_spec) {
  std::string list;
  for (const ImpairProfile& profile : Profiles()) {
    if (profile.name == name_or_spec) return profile;
    list += (list.empty() ? "" : ", ") + profile.name;
  }
  if (name_or_spec.find('=') != std::string::npos) return SpecReader().Read(name_or_spec);
  throw OperatorError("no network profile \"" + name_or_spec + "\"" +
                      DidYouMean(name_or_spec, ProfileNames()) + ": known are " + list +
                      ", or delay=50ms,loss=1%,... spelled out");
}

}  // namespace seam
