#pragma once
/// Keys with values, leases and transactions, as etcd has them: all that a fleet's Directory needs
/// of a store. Calls to hosts block for at most kStoreWaitS; those to a folder as long as another
/// process has its lock, a few ms. Not thread-safe; each failure is one line.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/base/status.h"

namespace seam {

/// Longest time that a call may take, s: less than half of a lease (kFleetLeaseS).
constexpr int kStoreWaitS = 2;
/// Most bytes of an answer or of the store's file, normal 100 kB; more is an error.
constexpr std::size_t kStoreBytesMax = std::size_t{1} << 24;

struct KeyValue {
  std::string key, value;
  std::int64_t changed = 0;  ///< revision of the store that wrote it, 1 or more
  std::int64_t lease = 0;    ///< goes with this lease; 0: stays
};

/// A condition of a transaction.
struct KeyCondition {
  enum class Is { kAbsent, kPresent, kValue, kChangedAt };
  std::string key;
  Is is = Is::kAbsent;
  std::string value;         ///< kValue
  std::int64_t changed = 0;  ///< kChangedAt: KeyValue::changed; 0: absent
};

struct KeyWrite {
  std::string key;
  std::optional<std::string> value;  ///< nullopt: delete it
  std::int64_t lease = 0;
};

class KeyStore {
 public:
  virtual ~KeyStore() = default;
  /// Lists the keys that begin with `prefix`, in their order.
  virtual Status List(const std::string& prefix, std::vector<KeyValue>* found) = 0;
  /// Makes all writes if all conditions hold, else none (`done` false).
  virtual Status Commit(const std::vector<KeyCondition>& conditions,
                        const std::vector<KeyWrite>& writes, bool* done) = 0;
  /// Returns how many writes, and how many conditions, a Commit may have.
  virtual std::size_t writes_most() const = 0;
  /// Begins a lease of `ttl_s` seconds; its keys go when it is not kept alive for so long.
  virtual Status Grant(int ttl_s, std::int64_t* lease) = 0;
  /// `alive` false: the lease has ended, and its keys are gone.
  virtual Status KeepAlive(std::int64_t lease, bool* alive) = 0;
  /// Ends a lease at once.
  virtual Status Revoke(std::int64_t lease) = 0;
};

/// Opens "file:FOLDER" (for one machine, or several with a shared folder and equal clocks) or
/// "etcd:HOST:PORT,HOST:PORT" (etcd 3.4 or later). Throws OperatorError for other texts.
std::unique_ptr<KeyStore> OpenKeyStore(const std::string& text);
std::unique_ptr<KeyStore> OpenFileStore(const std::string& folder);
std::unique_ptr<KeyStore> OpenEtcdStore(const std::string& hosts);

}  // namespace seam
