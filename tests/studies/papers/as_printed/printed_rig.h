// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>

#include "kerf/units.hpp"
#include "studies/chart/drill/measure.h"
#include "studies/chart/drill/methods.h"

/// The papers' laws as the host loads them, in a cortical block.
namespace kerf::test {

inline const PluginRegistry& printed_plugins() {
    static const PluginRegistry registry = [] {
        PluginRegistry r;
        r.scan({KERF_BUILD_DIR "/lib/kerf-papers"});
        return r;
    }();
    return registry;
}
inline const PluginRegistry& own_plugins() {
    static const PluginRegistry registry = [] {
        PluginRegistry r;
        r.scan({KERF_BUILD_DIR "/lib/kerf"});
        return r;
    }();
    return registry;
}
inline const chart::CuttingLaw& shared_law() {
    static const chart::CuttingLaw law = [] {
        std::string error;
        const auto found = chart::shared_law({&own_plugins(), &printed_plugins()}, error);
        if (!found) throw std::runtime_error(error);
        return *found;
    }();
    return law;
}
/// A method by its id, with all steps of its knob.
inline chart::Method method(const std::string& id) {
    for (const chart::Method& one : chart::all_methods({&own_plugins(), &printed_plugins()}, shared_law(), false))
        if (one.id == id) return one;
    throw std::runtime_error("no method " + id);
}

/// Two millimetres below the point's depth of a 5.4 mm drill in cortical bone, fed at 8 mm/s, 1000 rpm.
struct InTheBlock {
    chart::Scene scene = chart::block_scene(chart::slab_scene(0.0), 3.6e-3);
    std::unique_ptr<chart::Run> run;

    explicit InTheBlock(const std::string& id, double spacing = 0.5e-3) {
        run = method(id).start(scene, {spacing, 31, {0.31, 0.17, 0.73}}, 1.0);
        for (std::size_t t = 0; t < scene.ticks(); ++t) (void)run->tick(scene.pose_at(scene.depth[t + 1]));
    }
    [[nodiscard]] double depth() const { return scene.depth.back(); }
    /// Goes on from `depth` to `to` in one tick.
    chart::Felt go(double to) { return run->tick(scene.pose_at(to)); }
};

}  // namespace kerf::test
