// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/drill/replay.h"

#include <cstddef>
#include <vector>

#include "kerf/units.hpp"

namespace kerf::chart {

using namespace literals;

namespace {

Replayed replay_at(const Method& method, const Scene& scene, const std::vector<Felt>& felt, double spacing) {
    Replayed replayed;
    const auto run = method.replay(scene, {spacing, 62, {0.41, 0.77, 0.23}});
    for (std::size_t t = 0; t + 1 < felt.size(); ++t) replayed.axial.push_back(run->tick(felt[t + 1].from).wrench[2]);
    if (!felt.empty()) replayed.axial.push_back(felt.back().wrench[2]);  // where it went in the last tick is not known
    replayed.volume = run->removed_volume();
    return replayed;
}

}  // namespace

Replayed replay(const Method& method, const Scene& scene, const std::vector<Felt>& felt) {
    const double coarse = replay_at(method, scene, felt, 0.2_mm).volume;
    Replayed fine = replay_at(method, scene, felt, 0.1_mm);
    fine.volume += (fine.volume - coarse) / 3.0;
    return fine;
}

}  // namespace kerf::chart
