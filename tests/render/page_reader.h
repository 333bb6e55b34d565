#pragma once
/// Reads what a review page carries, by the layout that its headers describe and without the
/// encoder's code.

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace seam {

/// A body of a page's tracks, by tick.
struct PageBody {
  struct Sample {
    std::int64_t x = 0, y = 0, angle = 0;  ///< mm, mrad
    std::int64_t owner = 0, error = -1;    ///< 3 * authority + role; units
    std::int64_t age = 0;                  ///< units
  };
  std::map<std::int64_t, Sample> samples;
};

struct PageTracks {
  std::int64_t first = 0, count = 0;
  std::vector<std::int64_t> world;  ///< by tick since the first
  std::map<int, PageBody> bodies;
};

class PageReader {
 public:
  explicit PageReader(std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)) {}

  std::uint64_t Unsigned() {
    std::uint64_t value = 0;
    for (int shift = 0;; shift += 7) {
      const std::uint8_t byte = bytes_.at(at_++);
      value |= std::uint64_t{byte & 0x7fu} << shift;
      if (byte < 0x80) return value;
    }
  }
  std::int64_t Signed() {
    const std::uint64_t value = Unsigned();
    const auto half = static_cast<std::int64_t>(value >> 1);
    return value % 2 == 0 ? half : -half - 1;
  }
  std::vector<std::int64_t> Runs() {
    std::vector<std::int64_t> values;
    for (std::uint64_t runs = Unsigned(); runs > 0; --runs) {
      const std::uint64_t length = Unsigned();
      values.insert(values.end(), length, Signed());
    }
    return values;
  }
  std::vector<std::int64_t> SecondDifferences(std::int64_t count) {
    std::vector<std::int64_t> values;
    for (std::int64_t i = 0; i < count; ++i) {
      const std::int64_t more = Signed();
      if (i == 0) {
        values.push_back(more);
      } else if (i == 1) {
        values.push_back(values[0] + more);
      } else {
        values.push_back(2 * values.back() - values[values.size() - 2] + more);
      }
    }
    return values;
  }
  PageTracks Tracks(bool views) {
    PageTracks tracks;
    tracks.first = Signed();
    tracks.count = static_cast<std::int64_t>(Unsigned());
    tracks.world = Runs();
    for (std::uint64_t bodies = Unsigned(); bodies > 0; --bodies) {
      const int id = static_cast<int>(Signed());
      tracks.bodies[id] = Body(tracks.first, views);
    }
    return tracks;
  }
  bool AtEnd() const { return at_ == bytes_.size(); }

 private:
  PageBody Body(std::int64_t first, bool views) {
    PageBody body;
    std::vector<std::int64_t> ticks;
    std::vector<std::int64_t> lengths;
    std::int64_t end = first;
    for (std::uint64_t spans = Unsigned(); spans > 0; --spans) {
      const std::int64_t begin = end + Signed();
      lengths.push_back(static_cast<std::int64_t>(Unsigned()));
      end = begin + lengths.back();
      for (std::int64_t tick = begin; tick < end; ++tick) ticks.push_back(tick);
    }
    using Sample = PageBody::Sample;
    for (const auto field : {&Sample::x, &Sample::y, &Sample::angle}) {
      std::size_t i = 0;
      for (const std::int64_t length : lengths)
        for (const std::int64_t value : SecondDifferences(length))
          body.samples[ticks[i++]].*field = value;
    }
    if (!views) return body;
    const std::vector<std::int64_t> owners = Runs();
    EXPECT_EQ(owners.size(), ticks.size());
    std::int64_t error = 0;
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      error += Signed();
      body.samples[ticks[i]].owner = owners[i];
      body.samples[ticks[i]].error = error - 1;
    }
    std::int64_t age = 0;
    for (const std::int64_t tick : ticks) body.samples[tick].age = age += Signed();
    return body;
  }

  std::vector<std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

/// The bytes of a gzip stream.
inline std::vector<std::uint8_t> Gunzip(const std::vector<std::uint8_t>& packed) {
  std::vector<std::uint8_t> bytes(std::size_t{1} << 26);
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
  stream.next_in = const_cast<Bytef*>(packed.data());
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = bytes.data();
  stream.avail_out = static_cast<uInt>(bytes.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  bytes.resize(stream.total_out);
  inflateEnd(&stream);
  return bytes;
}

/// What stands between the tags of a page's data.
inline std::vector<std::uint8_t> FromBase64(const std::string& text) {
  static const std::string kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  unsigned bits = 0, count = 0;
  for (const char c : text) {
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string::npos) break;
    bits = bits << 6 | static_cast<unsigned>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> count & 0xff));
  }
  return bytes;
}

}  // namespace seam
