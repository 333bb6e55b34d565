#include "common/base/base64.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace seam {
namespace base64_test {

TEST(Base64, IsThatOfTheRfcAndNothingElse) {
  const std::pair<const char*, const char*> rfc[] = {{"", ""},
                                                     {"f", "Zg=="},
                                                     {"fo", "Zm8="},
                                                     {"foo", "Zm9v"},
                                                     {"foob", "Zm9vYg=="},
                                                     {"fooba", "Zm9vYmE="},
                                                     {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : rfc) {
    std::string back;
    EXPECT_EQ(ToBase64(bytes), text);
    EXPECT_TRUE(FromBase64(text, &back));
    EXPECT_EQ(back, bytes);
  }
  std::string back;
  for (const char* text : {"Z", "Zg=", "Zg==Zg==", "Zh==", "Z===", "Zm9v\n", "Zm=v", "===="}) {
    EXPECT_FALSE(FromBase64(text, &back)) << text;
  }
}

}  // namespace base64_test
}  // namespace seam
