#include "common/record/events/event_text.h"

#include "common/base/check.h"
#include "common/base/json_text.h"
#include "common/codec/audit.h"

namespace seam {

const char* EventKindName(std::int8_t kind) {
  static const char* const names[] = {
      "line",     "started",       "resumed",    "ended",        "connected", "joined",
      "rejoined", "left",          "scored",     "destroyed",    "broke",     "trust",
      "speed",    "seat taken",    "seat freed", "seat refused", "script",    "trigger",
      "repaired", "out of bounds", "warning",    "control",      "parted"};
  static_assert(sizeof names / sizeof names[0] == kEventKindMax + 1);
  SEAM_ASSERT(kind >= 0 && kind <= kEventKindMax);
  return names[kind];
}

const char* TrustStepName(std::int8_t step) {
  static const char* const names[] = {"trusted",      "noted",       "watched",
                                      "server holds", "inputs only", "out"};
  static_assert(sizeof names / sizeof names[0] == kAuditStepMax + 1);
  SEAM_ASSERT(step >= 0 && step <= kAuditStepMax);
  return names[step];
}

std::string EventJson(const Event& event, double time_s) {
  std::string text = "{\"tick\":" + std::to_string(event.tick) +
                     ",\"time_s\":" + JsonNumber(time_s, 6) +
                     ",\"kind\":" + JsonText(EventKindName(event.kind));
  const auto add = [&](const char* name, std::int64_t value) {
    if (value >= 0) text += std::string(",\"") + name + "\":" + std::to_string(value);
  };
  add("client", event.client);
  add("player", event.player);
  add("body", event.body);
  add("other", event.other);
  add("index", event.index);
  if (event.value_milli != 0) {
    text += ",\"value\":" + JsonNumber(static_cast<double>(event.value_milli) * 1e-3, 3);
  }
  return text + ",\"text\":" + JsonText(event.text) + "}";
}

}  // namespace seam
