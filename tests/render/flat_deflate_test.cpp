/// The fast compressor against zlib: what it writes is read back by zlib's own inflate.

#include "render/canvas/flat_deflate.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>
#include <vector>

namespace seam {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes Inflated(const Bytes& stream, std::size_t bytes) {
  Bytes data(bytes + 1);
  uLongf got = static_cast<uLongf>(data.size());
  const int status =
      uncompress(data.data(), &got, stream.data(), static_cast<uLong>(stream.size()));
  EXPECT_EQ(status, Z_OK);
  data.resize(got);
  return data;
}

/// Whole rows of `data`, each after its filter byte.
Bytes Filtered(const Bytes& data, std::size_t row_bytes) {
  Bytes rows;
  for (std::size_t at = 0; at + row_bytes <= data.size(); at += row_bytes) {
    rows.push_back(0);
    for (std::size_t i = 0; i < row_bytes; ++i) rows.push_back(data[at + i]);
  }
  return rows;
}

std::size_t ExpectBack(const Bytes& data, std::size_t row_bytes) {
  Bytes stream;
  FlatDeflate(data.data(), row_bytes, data.size() / row_bytes, &stream);
  const Bytes rows = Filtered(data, row_bytes);
  EXPECT_EQ(Inflated(stream, rows.size()), rows) << row_bytes;
  return stream.size();
}

TEST(FlatDeflate, ZlibReadsBackPicturesOfAllKinds) {
  std::mt19937 random(5);
  for (const std::size_t row : {1u, 2u, 3u, 4u, 31u, 301u, 3840u, 32767u, 32768u, 40001u}) {
    for (const unsigned shades : {1u, 2u, 3u, 256u}) {
      Bytes data(row * 9);
      for (std::uint8_t& byte : data)
        byte = static_cast<std::uint8_t>(random() % 40 == 0 ? random() % shades : 7);
      ExpectBack(data, row);
      for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>(random() % shades);
      ExpectBack(data, row);
      for (std::size_t i = row; i < data.size(); ++i)  // rows like those above, but for some bytes
        data[i] = random() % 200 == 0 ? 1 : data[i - row];
      ExpectBack(data, row);
    }
  }
}

TEST(FlatDeflate, ZlibReadsBackRunsOfEveryLength) {
  for (std::size_t length = 0; length < 600; ++length) {
    Bytes data(length, 9);
    for (std::uint8_t i = 0; i < 5; ++i) data.push_back(i);
    ExpectBack(data, data.size());
  }
}

TEST(FlatDeflate, AnEvenPictureBecomesEightyTimesSmaller) {
  const Bytes data(3840 * 720, 200);
  EXPECT_LT(ExpectBack(data, 3840), data.size() / 80);
}

TEST(FlatDeflate, TheChecksumIsThatOfZlib) {
  std::mt19937 random(7);
  for (const std::size_t bytes : {0u, 1u, 31u, 32u, 33u, 511u, 512u, 513u, 100000u}) {
    Bytes data(bytes);
    for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>(random());
    EXPECT_EQ(Adler32(data.data(), bytes), adler32(1, data.data(), static_cast<uInt>(bytes)));
    std::fill(data.begin(), data.end(), std::uint8_t{255});
    EXPECT_EQ(Adler32(data.data(), bytes), adler32(1, data.data(), static_cast<uInt>(bytes)));
  }
}

}  // namespace
}  // namespace seam
