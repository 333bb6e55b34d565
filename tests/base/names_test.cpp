/// Checks which names players and rooms may have.

#include "common/base/names.h"

#include <gtest/gtest.h>

#include <clocale>

namespace seam {
namespace names_test {

TEST(Names, LettersDigitsUnderscoreAndHyphenMakeAName) {
  EXPECT_TRUE(IsName("Ann_2-x"));
  EXPECT_TRUE(IsName("a"));
  EXPECT_TRUE(IsName("-"));
  EXPECT_TRUE(IsName("AZaz09"));
}

TEST(Names, ANameHas1To32Characters) {
  EXPECT_FALSE(IsName(""));
  EXPECT_TRUE(IsName(std::string(kNameBytesMax, 'a')));
  EXPECT_FALSE(IsName(std::string(kNameBytesMax + 1, 'a')));
}

TEST(Names, OnlyThe64AllowedCharactersAreAccepted) {
  int taken = 0;
  for (int c = 0; c < 256; ++c) taken += IsName(std::string(1, static_cast<char>(c))) ? 1 : 0;
  EXPECT_EQ(taken, 26 + 26 + 10 + 2);
  for (const char* text : {"a.b", "a b", "a/b", "\xc3\xa4", "[", "@", "`", "{", "/", ":"}) {
    EXPECT_FALSE(IsName(text)) << text;
  }
  EXPECT_FALSE(IsName(std::string("a\0b", 3)));
}

TEST(Names, TheLocaleDoesNotAddLetters) {
  const std::string before = std::setlocale(LC_CTYPE, nullptr);
  for (const char* locale : {"C", "C.UTF-8", "de_DE.ISO-8859-1", "en_US.ISO-8859-1"}) {
    if (std::setlocale(LC_CTYPE, locale) == nullptr) continue;  // not installed
    EXPECT_FALSE(IsName("\xe4")) << locale;
  }
  std::setlocale(LC_CTYPE, before.c_str());
}

}  // namespace names_test
}  // namespace seam
