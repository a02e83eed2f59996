// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "studies/stability/kerf_loop.h"
#include "studies/stability/port.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

/// Runs one tick of a port that Kerf's loop answers, while the hand pushes with `push` [N]. Returns the force [N] of
/// the loop.
inline double tick(Port& port, KerfLoop& loop, double push) {
    const std::uint32_t missed = port.wait_for_clock(push);
    const double force = loop.answer(port.reported(), missed);
    port.step(force, push);
    return force;
}

}  // namespace kerf::stability
