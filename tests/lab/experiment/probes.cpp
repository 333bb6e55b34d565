#include "tests/lab/experiment/probes.h"

namespace seam {

const std::vector<Probe>& Probes() {
  static const std::vector<Probe> probes = {FairnessProbe(), TitlesProbe(), LoadProbe(),
                                            HandOverProbe(), DamageProbe(), AgreementProbe(),
                                            AttackProbe(),   HonestProbe(), RivalsProbe()};
  return probes;
}

}  // namespace seam
