#pragma once
/// Access to the entries of a fixture in the engine's tree of boxes.

#include "common/physics/reveal.h"

namespace seam {
namespace {

SEAM_REVEAL(Proxies, b2FixtureProxy*, b2Fixture, m_proxies);

}  // namespace
}  // namespace seam
