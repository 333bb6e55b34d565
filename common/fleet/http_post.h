#pragma once
/// POST over HTTP by libcurl, on a connection that stays open.

#include <memory>
#include <string>

#include "common/base/status.h"

namespace seam {

class HttpPost {
 public:
  HttpPost();
  ~HttpPost();
  HttpPost(const HttpPost&) = delete;
  HttpPost& operator=(const HttpPost&) = delete;

  /// Sends `body` (JSON) and returns the answer's body, at most `bytes_max`. Blocks for at most
  /// `wait_s`. Returns one line unless an answer with status 200 comes.
  Status Send(const std::string& url, const std::string& body, int wait_s, std::size_t bytes_max,
              std::string* answer);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seam
