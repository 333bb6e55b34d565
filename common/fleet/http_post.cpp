#include "common/fleet/http_post.h"

#include <curl/curl.h>

#include "common/base/check.h"

namespace seam {
namespace {

struct PostAnswer {
  std::string* text = nullptr;
  std::size_t bytes_max = 0;
};

/// Takes a part of the answer; fewer bytes taken than given end the transfer.
std::size_t TakePart(char* data, std::size_t size, std::size_t count, void* user) {
  auto* const answer = static_cast<PostAnswer*>(user);
  const std::size_t bytes = size * count;
  if (answer->text->size() + bytes > answer->bytes_max) return 0;
  answer->text->append(data, bytes);
  return bytes;
}

}  // namespace

struct HttpPost::Impl {
  CURL* curl = nullptr;
  curl_slist* headers = nullptr;
};

HttpPost::HttpPost() : impl_(std::make_unique<Impl>()) {
  static const CURLcode ready = curl_global_init(CURL_GLOBAL_DEFAULT);
  impl_->curl = ready == CURLE_OK ? curl_easy_init() : nullptr;
  SEAM_ASSERT(impl_->curl != nullptr);
  impl_->headers = curl_slist_append(nullptr, "Content-Type: application/json");
}

HttpPost::~HttpPost() {
  curl_slist_free_all(impl_->headers);
  curl_easy_cleanup(impl_->curl);
}

Status HttpPost::Send(const std::string& url, const std::string& body, int wait_s,
                      std::size_t bytes_max, std::string* answer) {
  CURL* const curl = impl_->curl;
  answer->clear();
  PostAnswer part{answer, bytes_max};
  curl_easy_reset(curl);
  curl_easy_setopt(curl, CURLOPT_URL, url.c_str());
  curl_easy_setopt(curl, CURLOPT_PROTOCOLS_STR, "http,https");
  curl_easy_setopt(curl, CURLOPT_NOPROXY, "*");
  curl_easy_setopt(curl, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(curl, CURLOPT_TIMEOUT, static_cast<long>(wait_s));
  curl_easy_setopt(curl, CURLOPT_HTTPHEADER, impl_->headers);
  curl_easy_setopt(curl, CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(body.size()));
  curl_easy_setopt(curl, CURLOPT_POSTFIELDS, body.c_str());
  curl_easy_setopt(curl, CURLOPT_WRITEFUNCTION, TakePart);
  curl_easy_setopt(curl, CURLOPT_WRITEDATA, &part);
  const CURLcode code = curl_easy_perform(curl);
  if (code == CURLE_WRITE_ERROR) return Status::Error(url + ": the answer is too long");
  if (code != CURLE_OK) return Status::Error(url + ": " + curl_easy_strerror(code));
  long status = 0;
  curl_easy_getinfo(curl, CURLINFO_RESPONSE_CODE, &status);
  if (status == 200) return Status::Ok();
  return Status::Error(url + ": status " + std::to_string(status));
}

}  // namespace seam
