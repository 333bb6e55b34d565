#pragma once
/// Compression and text encoding of the data in a review page.

#include <string>

#include "render/page/column.h"

namespace seam {

/// Returns a gzip stream (RFC 1952) without name and time: the same bytes give the same stream.
PageBytes Gzip(const PageBytes& bytes);

/// Encodes by RFC 4648, with padding. The result has no characters that are special in HTML.
std::string Base64(const PageBytes& bytes);

}  // namespace seam
