#include "render/page/gzip.h"

#include <zlib.h>

#include "common/base/base64.h"
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
  return ToBase64({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace seam
