/// Checks the English of headers and test names: sentences name their subject instead of opening
/// a riddle with a relative clause.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/source_tree.h"

namespace seam {
namespace prose_test {

/// Percent of a room's comment sentences that may contain one of kPronouns. LevelDB has .7,
/// Box2D .1, mosh .3, rr 1.3; above 2 a stranger has to read twice.
constexpr std::size_t kPercentMax = 2;
/// Shorter pieces are labels, not sentences.
constexpr int kWordsMin = 3;
constexpr std::array<const char*, 4> kPronouns = {"what", "who", "whom", "whose"};

struct Sentence {
  std::size_t line = 0;  ///< of its first word, from 1
  std::string text;
};

/// Adds the sentences of a comment whose lines are `lines`, the first of which is line `first`.
/// A sentence ends at one of .;:?! before a space.
void AddSentences(const std::vector<std::string>& lines, std::size_t first,
                  std::vector<Sentence>* sentences) {
  Sentence now;
  const auto end = [&] {
    if (!now.text.empty()) sentences->push_back(now);
    now = Sentence();
  };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (const char c : lines[i] + ' ') {
      const bool space = c == ' ';
      if (space && !now.text.empty() &&
          std::string(".;:?!").find(now.text.back()) != std::string::npos) {
        end();
      } else if (!space || (!now.text.empty() && now.text.back() != ' ')) {
        if (now.text.empty()) now.line = first + i;
        now.text += c;
      }
    }
  }
  end();
}

/// The text of a comment without its slashes; `at` is where they begin.
std::string TextOf(const std::string& line, std::size_t at) {
  const std::size_t begin = line.find_first_not_of("/!<", at);
  return begin == std::string::npos ? "" : line.substr(begin);
}

/// The sentences of a file's comments. Consecutive lines that hold only a comment are one comment;
/// one behind code is another. Block comments hold only names of parameters and are skipped.
std::vector<Sentence> SentencesOf(const Source& source) {
  std::vector<Sentence> sentences;
  std::vector<std::string> block;
  for (std::size_t i = 0; i <= source.lines.size(); ++i) {
    const std::string line = i < source.lines.size() ? source.lines[i] : "";
    const std::size_t at = line.find("//");
    const bool whole = at != std::string::npos && line.find_first_not_of(' ') == at;
    if (whole) {
      block.push_back(TextOf(line, at));
      continue;
    }
    AddSentences(block, i + 1 - block.size(), &sentences);
    block.clear();
    if (at != std::string::npos && line.find("http") == std::string::npos) {
      AddSentences({TextOf(line, at)}, i + 1, &sentences);
    }
  }
  return sentences;
}

/// Words of a sentence in lower case.
std::vector<std::string> WordsOf(const std::string& text) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalpha(letter) != 0) {
      words.back() += static_cast<char>(std::tolower(letter));
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

struct Prose {
  std::size_t sentences = 0;
  std::size_t hits = 0;   ///< sentences with one of kPronouns
  std::string offenders;  ///< "PATH:LINE: SENTENCE" of each, a line each

  double percent() const {
    return 100.0 * static_cast<double>(hits) / static_cast<double>(sentences);
  }
  bool TooMany() const { return 100 * hits > kPercentMax * sentences; }
};

/// "common/ROOM", or the first folder of a path.
std::string RoomOf(const std::string& path) {
  std::size_t end = path.find('/');
  if (path.rfind("common/", 0) == 0) end = path.find('/', end + 1);
  return path.substr(0, end);
}

/// Counts the sentences of all files, by room.
std::map<std::string, Prose> ProseOf(const std::vector<Source>& sources) {
  std::map<std::string, Prose> rooms;
  for (const Source& source : sources) {
    Prose& room = rooms[RoomOf(source.path)];
    for (const Sentence& sentence : SentencesOf(source)) {
      const std::vector<std::string> words = WordsOf(sentence.text);
      if (words.size() < kWordsMin) continue;
      ++room.sentences;
      const auto is_pronoun = [](const std::string& word) {
        return std::count(kPronouns.begin(), kPronouns.end(), word) > 0;
      };
      if (std::none_of(words.begin(), words.end(), is_pronoun)) continue;
      ++room.hits;
      room.offenders +=
          source.path + ":" + std::to_string(sentence.line) + ": " + sentence.text + "\n";
    }
  }
  return rooms;
}

/// "PATH:LINE: NAME" of each test whose name opens with a relative clause or with "Of".
std::string RiddlesIn(const Source& source) {
  const Regex test(R"(TEST(_F|_P)?\(.*)");
  const Regex riddle("(What|Who|Whom|Whose|Whatever|Whoever|Of)([A-Z0-9].*)?");
  std::string riddles;
  for (std::size_t i = 0; i < source.lines.size(); ++i) {
    if (!test.Matches(source.lines[i])) continue;
    std::string text = source.lines[i];
    if (text.find(')') == std::string::npos && i + 1 < source.lines.size()) {
      text += source.lines[i + 1];  // a long name stands on its own line
    }
    const std::size_t begin = text.find_first_not_of(' ', text.find(',') + 1);
    const std::string name = text.substr(begin, text.find(')') - begin);
    if (riddle.Matches(name)) {
      riddles += source.path + ":" + std::to_string(i + 1) + ": " + name + "\n";
    }
  }
  return riddles;
}

TEST(Prose, HeaderCommentsNameTheirSubjects) {
  const std::map<std::string, Prose> rooms = ProseOf(Sources(kProduct, {".h"}));
  EXPECT_GE(rooms.size(), 13u);
  for (const auto& [room, prose] : rooms) {
    EXPECT_GT(prose.sentences, 50u) << room << ": the comments were not found";
    std::printf("[          ] %-16s %5zu sentences, %.1f %%\n", room.c_str(), prose.sentences,
                prose.percent());
    EXPECT_FALSE(prose.TooMany()) << room << ": " << prose.percent()
                                  << " % of the sentences contain what, who, whom or whose, of at "
                                     "most "
                                  << kPercentMax << " %; name the subject:\n"
                                  << prose.offenders;
  }
}

TEST(Prose, CountsSentencesOfComments) {
  Source header;
  header.path = "common/scene/a.h";
  header.lines = {"#pragma once",
                  "/// What everyone is told: numbered on the bus. A body",
                  "/// whose root moves; whatever it does.",
                  "",
                  "  int x = 0;  ///< who has it now",
                  "const char* at = \"http://what.who.is\";",
                  "// who is",
                  "/// Sends each state once, v1.5 included."};
  const std::vector<Sentence> sentences = SentencesOf(header);
  ASSERT_EQ(sentences.size(), 6u);
  EXPECT_EQ(sentences[2].text, "A body whose root moves;");
  EXPECT_EQ(sentences[2].line, 2u);
  EXPECT_EQ(sentences[5].line, 7u);
  const std::map<std::string, Prose> rooms = ProseOf({header});
  ASSERT_EQ(rooms.count("common/scene"), 1u);
  const Prose& prose = rooms.at("common/scene");
  EXPECT_EQ(prose.sentences, 6u);
  EXPECT_EQ(prose.hits, 4u);
  EXPECT_NE(prose.offenders.find("common/scene/a.h:5: who has it now"), std::string::npos)
      << prose.offenders;
}

TEST(Prose, FailsAboveTheLimit) {
  Source header;
  header.path = "server/interest/a.h";
  for (int i = 0; i < 98; ++i) header.lines.emplace_back("/// Returns the newest state.");
  header.lines.insert(header.lines.end(), 2, "/// Whom it is news to.");
  EXPECT_FALSE(ProseOf({header}).at("server").TooMany()) << "2 of 100";
  header.lines.emplace_back("/// The state of who sent it.");
  EXPECT_TRUE(ProseOf({header}).at("server").TooMany()) << "3 of 101";
}

TEST(Prose, TestNamesDoNotOpenWithARelativeClause) {
  std::string riddles;
  for (const Source& source : Sources({"tests"}, {".cpp", ".h"})) riddles += RiddlesIn(source);
  EXPECT_EQ(riddles, "") << "a name is a sentence with a subject and a verb";
  Source source;
  source.path = "a_test.cpp";
  source.lines = {"TEST(A, WhatRests) {",      "TEST_F(A, OfTwoNone) {",
                  "TEST(A, OffsetsAreKept) {", "TEST_P(A,",
                  "       WhoIsHere) {",       "TEST(A, WholeTurnsVanish) {",
                  "TEST(What, IsKnown) {",     "  TEST(A, WhatIsCode)"};
  EXPECT_EQ(RiddlesIn(source),
            "a_test.cpp:1: WhatRests\na_test.cpp:2: OfTwoNone\na_test.cpp:4: WhoIsHere\n");
}

}  // namespace prose_test
}  // namespace seam
