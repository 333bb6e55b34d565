#pragma once
/// The values of a fleet's directory as text. Readers return false for any other text.

#include <string>

#include "common/fleet/directory.h"

namespace seam {

std::string ServerText(const FleetServer& server);
bool ReadServerText(const std::string& text, FleetServer* server);
/// The same text for the same holder, so that it can be compared.
std::string HolderTextOf(const FleetHolder& holder);
bool ReadHolderText(const std::string& text, FleetHolder* holder);
std::string StandbyTextOf(const FleetStandby& standby);
bool ReadStandbyText(const std::string& text, FleetStandby* standby);
/// Reads 1 to 2147483647 in decimal digits.
bool ReadEpochText(const std::string& text, std::int32_t* epoch);
/// True for a JSON object of at most kFleetValueBytesMax bytes.
bool IsFleetObject(const std::string& text);

}  // namespace seam
