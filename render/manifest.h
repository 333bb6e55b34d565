#pragma once
/// Where pictures come from: told in each PNG file, and in manifest.json beside a sequence.

#include <string>
#include <utility>
#include <vector>

#include "render/frame.h"
#include "render/options.h"
#include "render/output.h"

namespace seam {

/// Keys and values for a PNG's text chunks: Software, Title, Source (each log's name and hash),
/// Description (how it was run and whose view it is). No time of day: the same log gives the same
/// bytes.
std::vector<std::pair<std::string, std::string>> AboutPictures(const RenderOptions& options,
                                                               const Page& page);

/// manifest.json in the folder: version, logs with their hashes, flags that matter, and for each
/// frame its moment, tick and the box of the world that its panels show (m). Throws OperatorError
/// when it cannot be written.
void WriteManifest(const RenderOptions& options, const Page& page,
                   const std::vector<double>& times_s, const OutputFolder& folder);

}  // namespace seam
