#include "render/page/gzip.h"

#include <zlib.h>

#include "common/base/check.h"

namespace seam {

PageBytes Gzip(const PageBytes& bytes) {
  z_stream stream{};
  constexpr int kWindowBits = 15 + 16;  // the largest window, plus 16 for gzip's header
  SEAM_ASSERT(deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kWindowBits, 9,
                           Z_DEFAULT_STRATEGY) == Z_OK);
  PageBytes packed(deflateBound(&stream, bytes.size()));
  stream.next_in = const_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = packed.data();
  stream.avail_out = static_cast<uInt>(packed.size());
  SEAM_ASSERT(deflate(&stream, Z_FINISH) == Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

std::string Base64(const PageBytes& bytes) {
  static const char kBase64Digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = bytes.size() - i;
    const unsigned a = bytes[i], b = count > 1 ? bytes[i + 1] : 0, c = count > 2 ? bytes[i + 2] : 0;
    const unsigned group = a << 16 | b << 8 | c;
    text += kBase64Digits[group >> 18];
    text += kBase64Digits[group >> 12 & 63];
    text += count > 1 ? kBase64Digits[group >> 6 & 63] : '=';
    text += count > 2 ? kBase64Digits[group & 63] : '=';
  }
  return text;
}

}  // namespace seam
