#include "common/sync/method.h"

#include <gtest/gtest.h>

#include "common/base/check.h"

namespace seam {
namespace method_test {

SyncConfig Config(const std::string& method) { return MakeSyncConfig(SplitMethod(method)); }

TEST(Method, IsWrittenInOneWordOrTwo) {
  EXPECT_EQ(Config("strict").policy, &StrictPolicy());
  EXPECT_EQ(Config("buffer/fade").reconcile_name, "fade");
  EXPECT_EQ(Config("central/own").policy, &CentralPolicy(false));
  EXPECT_EQ(Config("central/all").policy, &CentralPolicy(true));
  EXPECT_EQ(Config("central").policy, &CentralPolicy(true)) << "the default";
}

TEST(Method, RecoversItsNamesFromItsConfiguration) {
  for (const char* method : {"central/own", "central/all", "buffer/fade", "strict", "oracle"}) {
    const MethodNames names = NamesOf(Config(method));
    const std::string variant = VariantOf(names);
    EXPECT_EQ(names.mode + (variant.empty() ? "" : "/" + variant), method);
  }
  EXPECT_EQ(NamesOf(Config("central")).predict, "all");
  EXPECT_EQ(NamesOf(Config("buffer/fade")).predict, "") << "it belongs to central alone";
}

TEST(Method, ARoomsVariantIsItsRuleOrItsPrediction) {
  Room room;
  room.mode = "central";
  room.predict = "own";
  EXPECT_EQ(VariantOf(room), "own");
  room = Room();
  room.mode = "buffer";
  room.reconcile = "fade";
  EXPECT_EQ(VariantOf(room), "fade");
}

TEST(Method, RefusesUnknownNamesAndThoseOfAnotherMode) {
  const auto complaint = [](const MethodNames& names) -> std::string {
    try {
      MakeSyncConfig(names);
    } catch (const OperatorError& e) {
      return e.what();
    }
    return "none";
  };
  EXPECT_EQ(complaint({"central", "", "some"}), "unknown prediction \"some\": use own or all");
  EXPECT_EQ(complaint({"buffer", "fade", "all"}),
            "--predict belongs to --mode central, not to --mode buffer");
  EXPECT_EQ(complaint({"oracle", "", "own"}),
            "--predict belongs to --mode central, not to --mode oracle");
  EXPECT_NE(complaint({"central", "fade", "own"}), "none");
  EXPECT_EQ(complaint({"central", "", "own"}), "none");
}

}  // namespace method_test
}  // namespace seam
