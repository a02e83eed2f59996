// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/surfaces/burr_surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <sstream>
#include <string>

#include "bone/remesh/remesh_module.h"
#include "kerf/units.hpp"
#include "studies/times.h"

namespace kerf::chart {
namespace {

using namespace literals;

const Clock clock_of = [](const auto& work) { return processor_time_of(work); };

/// The strategies as kerf-remesh opens them.
struct Modules {
    std::unique_ptr<bone::RemeshModule> burring, cgal;

    Modules() {
        std::string error;
        burring = bone::RemeshModule::open(KERF_BUILD_DIR "/lib/kerf/kerf_burring.so", error);
        cgal = bone::RemeshModule::open(KERF_BUILD_DIR "/lib/kerf/kerf_remesh_cgal.so", error);
    }
    [[nodiscard]] bone::StrategyCall find(const std::string& full_id) const {
        const std::string id = full_id.substr(full_id.rfind('.') + 1);
        const kerf_component* found = burring->find(id) != nullptr ? burring->find(id) : cgal->find(id);
        return [found](const bone::RemeshRequest& request) { return bone::remesh_here(*found, request); };
    }
};

TEST(Grooves, HaveTheVolumesByHand) {  // C.1: slot area 2.457 mm², dimple 5π/3 mm³
    EXPECT_NEAR(1e9 * groove_within(1.0_mm).volume, 12.0 * 2.4567 + 5.0 * pi / 3.0, 2e-3);
    EXPECT_NEAR(1e9 * groove_from_the_end(1.0_mm).volume, 9.0 * 2.4567 + 2.5 * pi / 3.0, 2e-3);
}

TEST(GrooveSurface, OfTheFieldComesNearerAsTheSpacingFalls) {
    const Groove groove = groove_within(1.0_mm);
    const auto at = [&](double spacing) { return surface_by_field(groove, spacing, 0.25_mm, clock_of); };
    const GrooveSurface coarse = at(0.5_mm), fine = at(0.25_mm);
    EXPECT_LT(std::abs(fine.removed / groove.volume - 1.0), 0.01);
    EXPECT_LT(fine.rms, 0.5 * coarse.rms);
    EXPECT_GT(fine.walls, 2 * coarse.walls);
}

TEST(GrooveSurface, OfDisplaceIsClosedAndNearTheSweptBall) {
    const Modules modules;
    const Groove groove = groove_from_the_end(1.0_mm);
    const GrooveSurface made =
        surface_by_steps(groove, modules.find("displace"), modules.find("local"), 20e-6, 0.25_mm, clock_of);
    EXPECT_EQ(made.flaw, "");
    EXPECT_NEAR(made.removed / groove.volume, 1.0, 0.02);
    EXPECT_LT(made.rms, 20e-6);
    EXPECT_GT(made.mid_angle, 20.0_deg);
}

TEST(GrooveSurface, AtOnceIsExactToItsPolygons) {
    const Modules modules;
    const Groove groove = groove_within(1.0_mm);
    const GrooveSurface made = surface_at_once(groove, modules.find("exact"), clock_of);
    EXPECT_EQ(made.flaw, "");
    EXPECT_NEAR(made.removed / groove.volume, 1.0, 1e-3);
    EXPECT_LT(made.farthest, 1.5e-6);
}

TEST(BurrSurfaces, AreLeftOutWithoutTheirStrategies) {
    EXPECT_TRUE(burr_surfaces(
                    "burr-groove", [](const std::string&) { return bone::StrategyCall{}; }, true)
                    .empty());
    EXPECT_TRUE(burr_surfaces(
                    "femur", [](const std::string&) { return bone::StrategyCall{}; }, true)
                    .empty());
}

TEST(BurrSurfaces, AreWrittenWhole) {
    SurfaceRow row{"burr-groove", "1 mm deep", "field", "0.5 mm", 30e-9, {}};
    row.made.removed = 29e-9;
    row.made.step_ms = 2.0;
    std::istringstream csv(surfaces_csv({row}));
    std::string line, last;
    std::size_t commas = 0;
    for (int i = 0; std::getline(csv, line); ++i) {
        if (i == 2) commas = static_cast<std::size_t>(std::count(line.begin(), line.end(), ','));
        last = line;
    }
    EXPECT_EQ(static_cast<std::size_t>(std::count(last.begin(), last.end(), ',')), commas) << last;
    const std::string svg = surfaces_svg({row});
    EXPECT_EQ(svg.find("nan"), std::string::npos) << "a way without walls has no distance";
    EXPECT_NE(svg.find("not for diagnosis"), std::string::npos);
}

}  // namespace
}  // namespace kerf::chart
