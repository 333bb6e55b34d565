#include "common/net/connect_token.h"

#include <sodium.h>

#include <algorithm>
#include <cstring>

#include "common/base/check.h"
#include "common/base/hex.h"

namespace seam {
namespace {

/// With its final 0 it takes 13 bytes.
constexpr char kVersionInfo[] = "SEAM TOKEN 1";
static_assert(sizeof kVersionInfo == 13);
/// What versions have in common.
constexpr std::size_t kFamilyBytes = 11;
constexpr std::size_t kKnownBytes = 13 + 3 * 8, kNonceBytes = 24, kInnerBytes = 160;
constexpr std::size_t kNameBytes = 33;
constexpr std::uint32_t kMayPlay = 1;

static_assert(crypto_aead_xchacha20poly1305_ietf_KEYBYTES == Secret::kSecretBytes);
static_assert(crypto_aead_xchacha20poly1305_ietf_NPUBBYTES == kNonceBytes);
static_assert(crypto_aead_xchacha20poly1305_ietf_ABYTES == Seal::kTagBytes);
static_assert(4 + 2 * kNameBytes + 2 * Secret::kSecretBytes <= kInnerBytes);

void Append(Bytes* to, std::uint64_t number, int bytes) {
  for (int i = bytes - 1; i >= 0; --i) to->push_back(static_cast<std::uint8_t>(number >> (8 * i)));
}

void AppendName(Bytes* to, const std::string& name) {
  SEAM_ASSERT(!name.empty() && name.size() < kNameBytes);
  to->push_back(static_cast<std::uint8_t>(name.size()));
  to->insert(to->end(), name.begin(), name.end());
  to->insert(to->end(), kNameBytes - 1 - name.size(), 0);
}

void AppendKeys(Bytes* to, const TokenKeys& keys) {
  for (const Secret* key : {&keys.to_server, &keys.to_client}) {
    to->insert(to->end(), key->data(), key->data() + Secret::kSecretBytes);
  }
}

/// Takes fields from bytes that are long enough.
class Fields {
 public:
  explicit Fields(const std::uint8_t* at) : at_(at) {}
  std::uint64_t Number(int bytes) {
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) value = value << 8 | *at_++;
    return value;
  }
  /// Empty if the length is wrong.
  std::string Name() {
    const std::size_t size = *at_;
    const bool good = size >= 1 && size < kNameBytes;
    const std::string name = good ? std::string(at_ + 1, at_ + 1 + size) : std::string();
    at_ += kNameBytes;
    return name;
  }
  void Keys(TokenKeys* keys) {
    for (Secret* key : {&keys->to_server, &keys->to_client}) {
      std::copy(at_, at_ + Secret::kSecretBytes, key->data());
      at_ += Secret::kSecretBytes;
    }
  }

 private:
  const std::uint8_t* at_;
};

/// Says what is wrong with the version info with which `bytes` begins.
Status CheckVersion(ByteView bytes, const std::string& subject) {
  const std::size_t same = std::min(bytes.size, kFamilyBytes);
  if (bytes.size == 0 || std::memcmp(bytes.data, kVersionInfo, same) != 0) {
    return Status::Error(subject + "is no connect token");
  }
  if (bytes.size < sizeof kVersionInfo) return Status::Error(subject + "is cut off");
  if (std::memcmp(bytes.data, kVersionInfo, sizeof kVersionInfo) == 0) return Status::Ok();
  return Status::Error(subject + "is of another version than this program reads (1)");
}

int ValueOf(char digit) {
  if (digit >= '0' && digit <= '9') return digit - '0';
  return digit >= 'a' && digit <= 'f' ? digit - 'a' + 10 : -1;
}

}  // namespace

std::string MakeToken(const TokenGrant& grant, const Secret& operator_key, Entropy& entropy) {
  const TokenKeys keys{Secret(entropy), Secret(entropy)};
  // Memory that is given back on the way would not be wiped.
  Bytes token(kVersionInfo, kVersionInfo + sizeof kVersionInfo);
  token.reserve(kTokenBytes);
  Append(&token, grant.protocol, 8);
  Append(&token, static_cast<std::uint64_t>(grant.created_s), 8);
  Append(&token, static_cast<std::uint64_t>(grant.expires_s), 8);
  for (int i = 0; i < 3; ++i) Append(&token, entropy.Next(), 8);
  Bytes inner;
  inner.reserve(kInnerBytes);
  Append(&inner, grant.may_play ? kMayPlay : 0, 4);
  AppendName(&inner, grant.name);
  AppendName(&inner, grant.room);
  AppendKeys(&inner, keys);
  inner.resize(kInnerBytes);
  token.resize(kTokenPassBytes);
  (void)crypto_aead_xchacha20poly1305_ietf_encrypt(
      token.data() + kKnownBytes + kNonceBytes, nullptr, inner.data(), inner.size(), token.data(),
      kKnownBytes, nullptr, token.data() + kKnownBytes, operator_key.data());
  AppendName(&token, grant.name);
  AppendName(&token, grant.room);
  AppendKeys(&token, keys);
  const std::string text = ToHex(token.data(), token.size());
  Wipe(inner.data(), inner.size());
  Wipe(token.data(), token.size());
  return text;
}

Status ReadToken(const std::string& text, ConnectToken* token) {
  std::size_t digits = text.size();
  while (digits > 0 && (text[digits - 1] == '\n' || text[digits - 1] == '\r')) --digits;
  Bytes bytes;
  bytes.reserve(digits / 2);
  for (std::size_t i = 0; i + 1 < digits; i += 2) {
    const int high = ValueOf(text[i]), low = ValueOf(text[i + 1]);
    if (high < 0 || low < 0) return Status::Error("is no connect token");
    bytes.push_back(static_cast<std::uint8_t>(16 * high + low));
  }
  const Status version = CheckVersion(bytes, "");
  if (!version.ok()) return version;
  if (digits < 2 * kTokenBytes) return Status::Error("is cut off");
  if (digits > 2 * kTokenBytes) return Status::Error("has more behind its end");
  token->pass.assign(bytes.begin(), bytes.begin() + kTokenPassBytes);
  Fields fields(bytes.data() + kTokenPassBytes);
  token->name = fields.Name();
  token->room = fields.Name();
  fields.Keys(&token->keys);
  Wipe(bytes.data(), bytes.size());
  if (token->name.empty() || token->room.empty()) return Status::Error("is no connect token");
  return Status::Ok();
}

Status OpenPass(ByteView pass, const Secret& operator_key, const TokenNeed& need,
                TokenGrant* grant) {
  const Status version = CheckVersion(pass, "the token ");
  if (!version.ok()) return version;
  if (pass.size < kTokenPassBytes) return Status::Error("the token is cut off");
  if (pass.size > kTokenPassBytes) return Status::Error("the token has more behind its end");
  Fields known(pass.data + sizeof kVersionInfo);
  const std::uint64_t protocol = known.Number(8);
  if (protocol != need.protocol) {
    return Status::Error("the token is for protocol " + std::to_string(protocol) + ", " +
                         std::to_string(need.protocol) + " is spoken here");
  }
  grant->protocol = need.protocol;
  grant->created_s = static_cast<std::int64_t>(known.Number(8));
  grant->expires_s = static_cast<std::int64_t>(known.Number(8));
  if (grant->expires_s <= need.now_s) return Status::Error("the token has expired");
  Bytes inner(kInnerBytes);
  if (crypto_aead_xchacha20poly1305_ietf_decrypt(
          inner.data(), nullptr, nullptr, pass.data + kKnownBytes + kNonceBytes,
          kInnerBytes + Seal::kTagBytes, pass.data, kKnownBytes, pass.data + kKnownBytes,
          operator_key.data()) != 0) {
    return Status::Error("the token was made with another key, or was changed");
  }
  Fields fields(inner.data());
  grant->may_play = (fields.Number(4) & kMayPlay) != 0;
  grant->name = fields.Name();
  grant->room = fields.Name();
  fields.Keys(&grant->keys);
  Wipe(inner.data(), inner.size());
  if (!need.room.empty() && grant->room != need.room) {
    return Status::Error("the token is for room " + grant->room + ", this is " + need.room);
  }
  if (grant->name != need.name) {
    return Status::Error("the token is for " + grant->name + ", not for " + need.name);
  }
  return Status::Ok();
}

}  // namespace seam
