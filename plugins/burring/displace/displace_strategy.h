// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenMesh/Core/System/config.h>

#include <array>

#include "kerf/strategy.hpp"

namespace kerf::burring {

namespace displacement {

/// The library, its version and the flags that affect results.
inline constexpr auto kernel = [] {
    auto text = std::to_array("OpenMesh 0.0, no fused multiply-add");
    text[9] = static_cast<char>('0' + OM_GET_VER);
    text[11] = static_cast<char>('0' + OM_GET_MAJ);
    return text;
}();
static_assert(OM_GET_VER < 10 && OM_GET_MAJ < 10, "the version in `kernel` has one digit for each number");

}  // namespace displacement

/// Moves the faces inside a swept burr onto it. Declines a cut where another wall obstructs these moves.
struct Displace {
    double tolerance;

    static constexpr auto about() {
        return describe("displace",
                        "Moves the surface onto the swept burr, and declines where a wall would be pierced.",
                        remeshes_patches(displacement::kernel.data()),
                        remesh_tolerance(&Displace::tolerance, "Distance that the wall may be off the swept burr.",
                                         "chosen: below the play of a burr's bearing"));
    }
    [[nodiscard]] RemeshAnswer remesh(const RemeshJob& job) const;
};

}  // namespace kerf::burring
