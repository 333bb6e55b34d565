/// A KeyStore in etcd, by the JSON gateway of its API v3
/// (https://etcd.io/docs/v3.4/dev-guide/api_grpc_gateway/): bytes are in base 64, 64-bit numbers
/// are texts.

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "common/base/base64.h"
#include "common/base/check.h"
#include "common/fleet/http_post.h"
#include "common/fleet/key_store.h"

namespace seam {
namespace {

using Json = nlohmann::json;

/// Most writes of a transaction that etcd takes, unless --max-txn-ops says otherwise.
constexpr std::size_t kEtcdWritesMost = 128;

/// Reads a 64-bit number of an object: a text or a number; absent is 0, as the gateway omits it.
bool ReadWhole(const Json& object, const char* name, std::int64_t* value) {
  *value = 0;
  const auto found = object.find(name);
  if (found == object.end()) return true;
  if (found->is_number_integer()) {
    *value = found->get<std::int64_t>();
    return true;
  }
  if (!found->is_string()) return false;
  const std::string text = found->get<std::string>();
  char* end = nullptr;
  errno = 0;
  *value = std::strtoll(text.c_str(), &end, 10);
  return !text.empty() && *end == '\0' && errno == 0;
}

bool ReadBytes64(const Json& object, const char* name, std::string* bytes) {
  bytes->clear();
  const auto found = object.find(name);
  if (found == object.end()) return true;
  return found->is_string() && FromBase64(found->get<std::string>(), bytes);
}

/// Returns the first key behind those that begin with `prefix`.
std::string EndOfPrefix(std::string prefix) {
  while (!prefix.empty() && static_cast<unsigned char>(prefix.back()) == 0xff) prefix.pop_back();
  if (prefix.empty()) return std::string(1, '\0');
  prefix.back() = static_cast<char>(prefix.back() + 1);
  return prefix;
}

Json CompareOf(const KeyCondition& condition) {
  Json compare{{"key", ToBase64(condition.key)}, {"result", "EQUAL"}};
  switch (condition.is) {
    case KeyCondition::Is::kAbsent:
    case KeyCondition::Is::kPresent:
      compare["target"] = "CREATE";
      compare["create_revision"] = "0";
      if (condition.is == KeyCondition::Is::kPresent) compare["result"] = "GREATER";
      break;
    case KeyCondition::Is::kValue:
      compare["target"] = "VALUE";
      compare["value"] = ToBase64(condition.value);
      break;
    case KeyCondition::Is::kChangedAt:
      compare["target"] = "MOD";
      compare["mod_revision"] = std::to_string(condition.changed);
      break;
  }
  return compare;
}

class EtcdStore : public KeyStore {
 public:
  explicit EtcdStore(const std::string& hosts) {
    for (std::size_t at = 0; at <= hosts.size();) {
      const std::size_t comma = std::min(hosts.find(',', at), hosts.size());
      const std::string host = hosts.substr(at, comma - at);
      const bool whole = host.find("://") != std::string::npos;
      if (host.empty()) throw OperatorError("--directory etcd:" + hosts + ": a host is missing");
      urls_.push_back(whole ? host : "http://" + host);
      at = comma + 1;
    }
  }

  std::size_t writes_most() const override { return kEtcdWritesMost; }

  Status List(const std::string& prefix, std::vector<KeyValue>* found) override {
    Json answer;
    const Json request{{"key", ToBase64(prefix)}, {"range_end", ToBase64(EndOfPrefix(prefix))}};
    const Status status = Call("/v3/kv/range", request, &answer);
    if (!status.ok()) return status;
    const auto all = answer.find("kvs");
    if (all == answer.end()) return Status::Ok();
    if (!all->is_array()) return NotUnderstood("range");
    for (const Json& each : *all) {
      KeyValue entry;
      if (!each.is_object() || !ReadBytes64(each, "key", &entry.key) ||
          !ReadBytes64(each, "value", &entry.value) ||
          !ReadWhole(each, "mod_revision", &entry.changed) ||
          !ReadWhole(each, "lease", &entry.lease)) {
        return NotUnderstood("range");
      }
      found->push_back(std::move(entry));
    }
    return Status::Ok();
  }

  Status Commit(const std::vector<KeyCondition>& conditions, const std::vector<KeyWrite>& writes,
                bool* done) override {
    *done = false;
    Json request{{"compare", Json::array()}, {"success", Json::array()}};
    for (const KeyCondition& each : conditions) request["compare"].push_back(CompareOf(each));
    for (const KeyWrite& write : writes) {
      Json put{{"key", ToBase64(write.key)}};
      if (write.value) put["value"] = ToBase64(*write.value);
      if (write.value && write.lease != 0) put["lease"] = std::to_string(write.lease);
      request["success"].push_back(
          {{write.value ? "request_put" : "request_delete_range", std::move(put)}});
    }
    Json answer;
    const Status status = Call("/v3/kv/txn", request, &answer);
    if (!status.ok()) return status;
    const auto succeeded = answer.find("succeeded");
    *done = succeeded != answer.end() && succeeded->is_boolean() && succeeded->get<bool>();
    return Status::Ok();
  }

  Status Grant(int ttl_s, std::int64_t* lease) override {
    Json answer;
    const Status status = Call("/v3/lease/grant", {{"TTL", std::to_string(ttl_s)}}, &answer);
    if (!status.ok()) return status;
    return ReadWhole(answer, "ID", lease) && *lease != 0 ? Status::Ok() : NotUnderstood("grant");
  }

  Status KeepAlive(std::int64_t lease, bool* alive) override {
    *alive = false;
    Json answer;
    const Status status = Call("/v3/lease/keepalive", {{"ID", std::to_string(lease)}}, &answer);
    if (!status.ok()) return status;
    const auto result = answer.find("result");
    std::int64_t ttl_s = 0;
    if (result == answer.end() || !result->is_object() || !ReadWhole(*result, "TTL", &ttl_s)) {
      return NotUnderstood("keepalive");
    }
    *alive = ttl_s > 0;
    return Status::Ok();
  }

  Status Revoke(std::int64_t lease) override {
    Json answer;
    return Call("/v3/lease/revoke", {{"ID", std::to_string(lease)}}, &answer);
  }

 private:
  Status NotUnderstood(const char* call) const {
    return Status::Error(urls_[at_] + ": the answer to " + call + " makes no sense");
  }

  /// Asks the host that answered last, then the others once.
  Status Call(const std::string& path, const Json& request, Json* answer) {
    Status status = Status::Ok();
    const int wait_s = urls_.size() > 1 ? 1 : kStoreWaitS;
    for (std::size_t tries = 0; tries < urls_.size(); ++tries) {
      std::string text;
      status = post_.Send(urls_[at_] + path, request.dump(), wait_s, kStoreBytesMax, &text);
      if (status.ok()) {
        *answer = Json::parse(text, nullptr, false);
        if (answer->is_object()) return status;
        status = NotUnderstood(path.c_str());
      }
      at_ = (at_ + 1) % urls_.size();
    }
    return status;
  }

  std::vector<std::string> urls_;
  std::size_t at_ = 0;
  HttpPost post_;
};

}  // namespace

std::unique_ptr<KeyStore> OpenEtcdStore(const std::string& hosts) {
  return std::make_unique<EtcdStore>(hosts);
}

}  // namespace seam
