/// The fast compressor against zlib: zlib's inflate reads its output back.

#include "render/canvas/flat_deflate.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>
#include <vector>

#include "render/canvas/row_checksum.h"

namespace seam {
namespace flat_deflate_test {

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

/// Red, green and blue of whole rows of pixels, each row after its filter byte.
Bytes Filtered(const Bytes& rgba, std::size_t width) {
  Bytes rows;
  for (std::size_t pixel = 0; 4 * pixel < rgba.size(); ++pixel) {
    if (pixel % width == 0) rows.push_back(0);
    for (std::size_t i = 0; i < 3; ++i) rows.push_back(rgba[4 * pixel + i]);
  }
  return rows;
}

std::size_t ExpectBack(const Bytes& rgba, std::size_t width) {
  Bytes stream;
  FlatDeflate(rgba.data(), width, rgba.size() / (4 * width), &stream);
  const Bytes rows = Filtered(rgba, width);
  EXPECT_EQ(Inflated(stream, rows.size()), rows) << width;
  return stream.size();
}

TEST(FlatDeflate, ZlibReadsBackPicturesOfAllKinds) {
  std::mt19937 random(5);
  for (const std::size_t width : {1u, 2u, 3u, 4u, 31u, 301u, 1280u, 10922u, 10923u, 13001u}) {
    const std::size_t row = 4 * width;
    for (const unsigned shades : {1u, 2u, 3u, 256u}) {
      Bytes data(row * 9);
      for (std::uint8_t& byte : data)
        byte = static_cast<std::uint8_t>(random() % 40 == 0 ? random() % shades : 7);
      ExpectBack(data, width);
      for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>(random() % shades);
      ExpectBack(data, width);
      for (std::size_t i = row; i < data.size(); ++i)  // rows like those above, but for some bytes
        data[i] = random() % 200 == 0 ? 1 : data[i - row];
      ExpectBack(data, width);
    }
  }
}

TEST(FlatDeflate, ZlibReadsBackRunsOfEveryLength) {
  for (std::size_t length = 0; length < 300; ++length) {
    Bytes data(4 * length, 9);
    for (std::uint8_t i = 0; i < 20; ++i) data.push_back(i);
    ExpectBack(data, data.size() / 4);
  }
}

TEST(FlatDeflate, AnEvenPictureBecomesEightyTimesSmaller) {
  const Bytes data(4 * 1280 * 720, 200);
  EXPECT_LT(ExpectBack(data, 1280), std::size_t{3 * 1280 * 720 / 80});
}

TEST(FlatDeflate, TheFourthByteIsLeftOut) {
  std::mt19937 random(9);
  Bytes data(4 * 50 * 20, 77);
  for (std::size_t i = 3; i < data.size(); i += 4) data[i] = static_cast<std::uint8_t>(random());
  ExpectBack(data, 50);
}

TEST(RowChecksum, IsThatOfZlib) {
  std::mt19937 random(7);
  for (const std::size_t width : {1u, 7u, 8u, 9u, 127u, 128u, 129u, 1280u, 40000u}) {
    for (const bool white : {false, true}) {
      Bytes data(4 * width * 3);
      for (std::uint8_t& byte : data) byte = white ? 255 : static_cast<std::uint8_t>(random());
      Adler32 sum;
      for (std::size_t row = 0; row < 3; ++row) {
        sum.AddByte(0);
        sum.AddRow(SumOf(data.data() + 4 * width * row, width));
      }
      const Bytes rows = Filtered(data, width);
      EXPECT_EQ(sum.value(), adler32(1, rows.data(), static_cast<uInt>(rows.size()))) << width;
    }
  }
}

}  // namespace flat_deflate_test
}  // namespace seam
