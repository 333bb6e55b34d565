#pragma once
/// The register of probes: seam-lab has a subcommand for each.

#include <vector>

#include "tests/lab/experiment/probe.h"

namespace seam {

/// Returns all probes in the order of seam-lab's help.
const std::vector<Probe>& Probes();

// Each in its own file, and named in probes.cpp.
Probe FairnessProbe();
Probe TitlesProbe();
Probe LoadProbe();
Probe HandOverProbe();
Probe DamageProbe();
Probe AgreementProbe();
Probe AttackProbe();
Probe HonestProbe();
Probe RivalsProbe();

}  // namespace seam
