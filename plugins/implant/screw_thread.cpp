// SPDX-License-Identifier: Apache-2.0
#include "screw_thread.h"

#include <cmath>

namespace kerf::implant {

int make_pieces(const ScrewThread& thread, ThreadPiece (&pieces)[max_pieces]) noexcept {
    constexpr double in_a_turn = 11.0;  // not a divisor of it, so that neighbouring turns do not line up
    const double threaded = thread.length - thread.cone(), wanted = in_a_turn * threaded / thread.lead();
    const int count = static_cast<int>(std::clamp(std::ceil(wanted), 8.0, static_cast<double>(max_pieces)));
    const double piece = threaded / count;
    for (int i = 0; i < count; ++i) {
        const double z = -thread.cone() - (i + 0.5) * piece, radius = thread.mean_radius(z);
        const SinCos angle = sin_cos_exact(z / thread.advance());
        pieces[i] = {{radius * angle.cos, radius * angle.sin, z}, piece};
    }
    return count;
}

}  // namespace kerf::implant
