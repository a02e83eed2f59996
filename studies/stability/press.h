// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

#include "studies/stability/criterion.h"
#include "studies/stability/port.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

/// What makes the force: from the depth that the encoder says [m] to the force against it [N], once a tick, after
/// `missed` ticks that did not run.
using Renderer = std::function<double(double depth, std::uint32_t missed)>;

/// The same without ticks that did not run.
using ForceOfDepth = std::function<double(double depth)>;

/// What may be given back at most [J], the port as deep as this [m].
using Stored = std::function<double(double depth)>;

/// The hand at the port pushes with `push` [N] for `ticks`. With `stored`, work is spent on bone: the port may give
/// back what is stored and no more.
[[nodiscard]] inline Trace press(Port& port, const Renderer& render, int ticks, double push,
                                 const Stored& stored = {}) {
    Trace trace;
    trace.period = port.settings().period;
    for (int i = 0; i < ticks; ++i) {
        const double before = port.work();
        const std::uint32_t missed = port.wait_for_clock(push);
        port.step(render(port.reported(), missed), push);
        trace.depth.push_back(port.depth());
        trace.force.push_back(port.held());
        trace.energy.add(port.work() - before, stored ? stored(port.depth()) : 1e300);
    }
    return trace;
}
/// Does the same with a force that does not depend on ticks that did not run.
[[nodiscard]] inline Trace press(Port& port, const ForceOfDepth& render, int ticks, double push,
                                 const Stored& stored = {}) {
    return press(
        port, [&](double depth, std::uint32_t) { return render(depth); }, ticks, push, stored);
}

}  // namespace kerf::stability
