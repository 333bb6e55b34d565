#pragma once
/// Bytes made small and then text, for a page that carries its data.

#include <string>

#include "render/page/column.h"

namespace seam {

/// A gzip stream (RFC 1952) without name and time: the same bytes give the same stream.
PageBytes Gzip(const PageBytes& bytes);

/// RFC 4648, with padding. Its letters mean nothing in HTML.
std::string Base64(const PageBytes& bytes);

}  // namespace seam
