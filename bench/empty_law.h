// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <kerf/plugin.hpp>

/// A tool and a law that do nothing: what is left of their time is the crossing into a plugin.
namespace kerf::bench {

struct Pin {
    static constexpr auto about() { return describe("pin", "A pin."); }
    Outline outline() const { return revolution({{0, 0}, {-0.09, 0.001}}); }
};

struct EmptyLaw {
    static constexpr auto about() {
        return describe("empty", "Resists nothing.", work({.channels = 1, .points = 1, .queries = 1}));
    }
    void resist(const Held<Pin>&, const BoneQuery&, Channels&) const noexcept {}
};

}  // namespace kerf::bench
