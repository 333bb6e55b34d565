#include "common/fleet/key_store.h"

#include "common/base/check.h"

namespace seam {

std::unique_ptr<KeyStore> OpenKeyStore(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  const std::string where = colon == std::string::npos ? "" : text.substr(colon + 1);
  if (kind == "file" && !where.empty()) return OpenFileStore(where);
  if (kind == "etcd" && !where.empty()) return OpenEtcdStore(where);
  throw OperatorError("--directory takes file:FOLDER or etcd:HOST:PORT,HOST:PORT, not \"" + text +
                      "\"");
}

}  // namespace seam
