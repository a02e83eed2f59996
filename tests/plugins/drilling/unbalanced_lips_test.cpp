// SPDX-License-Identifier: Apache-2.0
// How large the lateral force and the bending moment are where one lip has more to cut than the other, against the
// closed forms C.5 (a face that the drill meets askew) and C.6 (a tip that runs off): prescribed feed, chip terms
// alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "plugins/drilling/drill_force.h"
#include "tests/support/drill_rig.h"
#include "tests/support/rig.h"

namespace kerf {
namespace {

using namespace literals;

constexpr double diameter = 5.4_mm, p = 59.0_deg, web = 0.05, n = 1000.0_rpm, rate = 1.0_mm_per_s, f = rate / n,
                 k = 1000.0_N_per_mm2;
constexpr double R = 0.5 * diameter, b = 0.5 * web * diameter;
const double cot_p = std::cos(p) / std::sin(p);

/// A thin web, so that a lip's azimuth hardly changes along it, and edges without any force but that of chips.
ToolSetup drill_of_chips(double thrust_chip, double cutting_chip, double runout = 0.0) {
    return test::twist_drill({{"diameter", diameter},
                              {"web", web},
                              {"runout", runout},
                              {"element_pitch", 0.05_mm},
                              {"heel_stiffness", 0.0},
                              {"thrust_edge", 0.0},
                              {"cutting_edge", 0.0},
                              {"chisel_edge", 0.0},
                              {"chisel_chip", 0.0},
                              {"thrust_chip", thrust_chip},
                              {"cutting_chip", cutting_chip}});
}

/// Of a tick, tool frame.
struct Felt {
    double depth, angle;  ///< [m] of the tip along its own way below the face, [rad] of the first lip
    Vec3 force, moment;   ///< on the drill, about its tip [N], [N·m]
};

/// Straight along its shaft at a steady feed, the shaft tilted by `tilt` against the face's normal.
std::vector<Felt> feed(const ToolSetup& setup, double tilt, double depth, double spacing) {
    constexpr double air = 0.2_mm;
    test::Rig simulation(test::block({-9.0_mm, -6.0_mm, -9.0_mm}, {9.0_mm, 6.0_mm, 0}, spacing, {0.31, 0.17, 0.73}),
                         setup, test::at_depth(-R - air, tilt));
    std::vector<Felt> felt;
    for (int i = 0;; ++i) {
        const double at = -R - air + rate * Simulation::dt * i;
        if (at >= depth) return felt;
        const double angle = reinterpret_cast<const drilling::DrillCutting::State*>(simulation.state())->angle;
        const TickResult r = simulation.tick_direct({test::at_depth(at + rate * Simulation::dt, tilt)});
        const Quat world_from_tool = test::at_depth(at, tilt).rotation;
        felt.push_back({at, angle, rotate(conjugate(world_from_tool), linear(r.bone_on_tool)),
                        rotate(conjugate(world_from_tool), angular(r.bone_on_tool))});
    }
}

/// What both lips give where each piece of them that is below the face takes f/2: the integrals of C.5 with the web
/// that they leave out, by the midpoint rule. `normal` and `cutting` [N/m²] are the two chip terms. Tool frame, on the
/// drill.
Felt exact(double depth, double tilt, double angle, double normal, double cutting) {
    constexpr int pieces = 1000;
    const Pose pose = test::at_depth(depth, tilt);
    const double r_c = b / std::sin(55.0_deg), first = std::sqrt(r_c * r_c - b * b),
                 ds = (std::sqrt(R * R - b * b) - first) / pieces;
    Felt sum{depth, angle, {0, 0, 0}, {0, 0, 0}};
    for (int i = 0; i < pieces; ++i) {
        const double s = first + (i + 0.5) * ds, r = std::hypot(s, b), cos_beta = s / r, dr = cos_beta * ds;
        const double cos_i = std::hypot(std::cos(p), std::sin(p) * cos_beta);
        for (const double lip : {1.0, -1.0}) {
            const double x = lip * (s * std::cos(angle) - b * std::sin(angle)),
                         y = lip * (s * std::sin(angle) + b * std::cos(angle));
            const Vec3 at{x, y, -r * cot_p};
            if ((pose * at).z >= 0.0) continue;
            const Vec3 n_hat{std::cos(p) / cos_i * x / r, std::cos(p) / cos_i * y / r, std::sin(p) * cos_beta / cos_i};
            const Vec3 on_drill = -0.5 * f * dr * (normal * n_hat + cutting * Vec3{-y / r, x / r, 0.0});
            sum.force = sum.force + on_drill;
            sum.moment = sum.moment + cross(at, on_drill);
        }
    }
    return sum;
}

double across(Vec3 v) { return std::hypot(v.x, v.y); }

/// Over a whole entry, until both lips are in with all of their length.
struct Compared {
    double peak = 0.0;      ///< [N] or [N·m] across the shaft
    double peak_off = 0.0;  ///< [–] of the exact peak
    double rms_off = 0.0;   ///< [–] RMS of the difference of the vectors, of the exact peak
};
template <class Of>
Compared compare(const std::vector<Felt>& felt, double tilt, double normal, double cutting, const Of& of) {
    Compared c;
    double exact_peak = 0.0, ticks = 0.0;
    for (const Felt& one : felt) {
        if (one.depth <= 0.0 || one.depth > R * (cot_p + std::tan(tilt))) continue;
        const Vec3 is = of(one), should = of(exact(one.depth, tilt, one.angle, normal, cutting));
        c.peak = std::max(c.peak, across(is));
        exact_peak = std::max(exact_peak, across(should));
        c.rms_off += across(is - should) * across(is - should);
        ticks += 1.0;
    }
    c.peak_off = c.peak / exact_peak - 1.0;
    c.rms_off = std::sqrt(c.rms_off / ticks) / exact_peak;
    return c;
}

constexpr double next_to_nothing = 1.0_N_per_mm2;
const auto force_of = [](const Felt& one) { return one.force; };
const auto moment_of = [](const Felt& one) { return one.moment; };

/// Off by a share of the spacing: the rim where face and cut meet is a corner, which a grid rounds, and a lip is in or
/// out by so much. Within a degree of the critical tilt (31°) lip and face are nearly parallel, and as much of a place
/// is far more of a lip.
void expect_exact(const Compared& c, double tilt, double spacing, const std::string& what) {
    const double halves = spacing / 0.5_mm;
    EXPECT_LT(c.rms_off, (tilt < 25.0_deg ? 0.006 : 0.02) * halves) << what;
    EXPECT_LT(std::abs(c.peak_off), 0.03 * halves) << what;
    ::testing::Test::RecordProperty(
        what, std::to_string(100.0 * c.rms_off) + " % RMS, peak " + std::to_string(100.0 * c.peak_off) + " %");
}

TEST(UnbalancedLips, EnteringAnInclinedFaceTheyGiveTheLateralForceAndTheMomentOfTheClosedForm) {
    struct {
        double tilt, imbalance;
    } faces[] = {{10.0_deg, 0.23}, {20.0_deg, 0.38}, {30.0_deg, 0.49}};  // C.5: (r1 − r2)/2R at its largest
    for (const auto& face : faces)
        for (const double spacing : {0.5_mm, 0.25_mm}) {
            const std::string where = std::to_string(static_cast<int>(face.tilt / 1.0_deg + 0.5)) + "_deg_at_" +
                                      std::to_string(static_cast<int>(spacing * 1e6 + 0.5)) + "_um";
            const auto cut = feed(drill_of_chips(next_to_nothing, k), face.tilt, 5.0_mm, spacing);
            const Compared lateral = compare(cut, face.tilt, next_to_nothing, k, force_of);
            expect_exact(lateral, face.tilt, spacing, "lateral_" + where);
            EXPECT_NEAR(lateral.peak / (k * f * R) / face.imbalance, 1.0, 0.06)
                << where << ": the web takes up to 5 % of it";
            const auto pressed = feed(drill_of_chips(k, next_to_nothing), face.tilt, 5.0_mm, spacing);
            expect_exact(compare(pressed, face.tilt, k, next_to_nothing, moment_of), face.tilt, spacing,
                         "moment_" + where);
            expect_exact(compare(pressed, face.tilt, k, next_to_nothing, force_of), face.tilt, spacing,
                         "radial_" + where);
        }
}

TEST(UnbalancedLips, ATipThatRunsOffGivesALateralForceOfConstantSizeThatTurnsWithIt) {
    for (const double spacing : {0.5_mm, 0.25_mm})
        for (const double e : {5.0_um, 20.0_um}) {
            const double delta = 2.0 * e * cot_p;
            ASSERT_LT(delta, 0.5 * f);
            double least = 1e300, most = 0.0, torque = 0.0, ticks = 0.0;
            Vec3 turned{0, 0, 0};  // beside the first lip
            for (const Felt& one : feed(drill_of_chips(next_to_nothing, k, e), 0.0, 4.0_mm, spacing)) {
                if (one.depth < 2.0_mm) continue;
                least = std::min(least, across(one.force));
                most = std::max(most, across(one.force));
                const double c = std::cos(one.angle), s = std::sin(one.angle);
                turned = turned + Vec3{c * one.force.x + s * one.force.y, c * one.force.y - s * one.force.x, 0.0};
                torque -= one.moment.z;
                ticks += 1.0;
            }
            // C.6: 2 k_t δ R, less what begins only at r_c and turns from t̂ along a lip with a web.
            const double r_c = b / std::sin(55.0_deg);
            const double along = std::sqrt(R * R - b * b) - std::sqrt(r_c * r_c - b * b) -
                                 b * (std::acos(b / R) - std::acos(b / r_c)),
                         aside = b * std::log(R / r_c);
            EXPECT_NEAR(across((1.0 / ticks) * turned) / (2.0 * k * delta * std::hypot(along, aside)), 1.0, 0.005)
                << spacing << ", " << e;
            EXPECT_LT(most - least, 1e-4 * most) << spacing << ", " << e << ": of no grid's making";
            EXPECT_NEAR(torque / ticks / (k * f * (R * R - r_c * r_c) / 2.0), 1.0, 0.005)
                << spacing << ", " << e << ": as without";
        }
}

}  // namespace
}  // namespace kerf
