// SPDX-License-Identifier: Apache-2.0
// The sawing plugin: its tables, and nothing else.
#include <cmath>
#include <cstdint>
#include <iterator>

#include "kerf/refusal.hpp"
#include "kerf/units.hpp"
#include "saw_force.h"

namespace kerf::sawing {
namespace {

using namespace literals;

constexpr const char* single_tooth = "calibrated: resultant 8 to 11 N of a tooth, thrust 1.28 times as large at 10 um "
                                     "as at 2 um, cutting force constant "
                                     "[james-2012, james-2013]; that the tooth was 1 mm wide is assumed";

constexpr kerf_param tool_parameters[] = {
    {"radius", "From the axis of the swing to the tips of the teeth.", dimension::length, "mm", 20.0_mm, 90.0_mm,
     60.0_mm, "assumed: order of sagittal blades"},
    {"arc", "Angle of the swing, from one turning point to the other.", dimension::angle, "deg", 0.5_deg, 12.0_deg,
     5.0_deg, "3 to 5 deg [saw-thesis]"},
    {"tooth_pitch", "From tip to tip along the arc.", dimension::length, "mm", 0.3_mm, 5.0_mm, 1.4_mm,
     "18 teeth an inch [lannin-2011]"},
    {"tooth_count", "Teeth on the arc, a whole number.", dimension::none, "", 1.0, 64.0, 18.0,
     "assumed: a front 25 mm wide"},
    {"blade_thickness", "Thickness of the blade behind its teeth.", dimension::length, "mm", 0.2_mm, 3.0_mm, 0.8_mm,
     "assumed"},
    {"tooth_set", "How far teeth stand out of the blade on either side, by turns.", dimension::length, "mm", 0.0_mm,
     0.5_mm, 0.1_mm, "assumed: slots 0.05 to 0.2 mm wider than the blade on either side"},
    {"tooth_height", "From the tip of a tooth to its root.", dimension::length, "mm", 0.2_mm, 5.0_mm, 1.0_mm,
     "assumed"},
    {"motor_torque", "The most the motor turns or brakes with, at its own shaft: one turn an oscillation.",
     dimension::torque, "N m", 1.0_Nmm, 5000.0_Nmm, 300.0_Nmm, "assumed: order of battery-driven surgical saws"},
    {"run_up", "Time the unloaded motor takes to 12000 oscillations a minute.", dimension::time, "ms", 0.0_ms,
     5000.0_ms, 200.0_ms, "assumed: a controller's soft start; 0 makes the rate follow at once"},
    {"inertia", "Of all that moves, at the motor's shaft.", kerf_dimension{{2, 1, 0, 0, 0, 0, 0, 0}}, "kg mm2", 1e-8,
     0.01, 2e-6, "assumed: order of a small rotor"},
};
static_assert(std::size(tool_parameters) == tool_parameter_count);

constexpr kerf_drive drives[] = {
    {"stroke_rate", "Commanded oscillations: to and fro is one.", dimension::frequency, "1/min", 0.0_rpm, 25000.0_rpm,
     12000.0_rpm, slowest_cut},
};
static_assert(std::size(drives) == drive_count);

constexpr kerf_param force_parameters[] = {
    {"thrust_edge", "Tooth: edge force against the feed, per width of cut.", dimension::force_per_length, "N/mm",
     0.0_N_per_mm, 500.0_N_per_mm, 6.57_N_per_mm, single_tooth},
    {"thrust_chip", "Tooth: force against the feed, per chip area.", dimension::pressure, "N/mm2", 0.0_N_per_mm2,
     10000.0_N_per_mm2, 238.0_N_per_mm2, single_tooth},
    {"cutting_edge", "Tooth: edge force against its motion, per width of cut.", dimension::force_per_length, "N/mm",
     0.0_N_per_mm, 500.0_N_per_mm, 5.0_N_per_mm, single_tooth},
    {"cutting_chip", "Tooth: force against its motion, per chip area.", dimension::pressure, "N/mm2", 0.0_N_per_mm2,
     10000.0_N_per_mm2, 0.0_N_per_mm2, "cutting force does not change from 2 to 10 um [james-2013]"},
    {"edge_depth", "Chip thickness at which the edge force has built up.", dimension::length, "um", 0.01_um, 20.0_um,
     0.4_um, "assumed: the largest that leaves the published checks unchanged"},
    {"set_share", "Force of a tooth to the side it is set to, as a share of its thrust.", dimension::none, "", 0.0, 1.0,
     0.1, "assumed; neighbours cancel"},
    {"reference_density", "Density of the bone the coefficients were fitted to.", dimension::density, "g/cm3",
     0.5_g_per_cm3, 2.5_g_per_cm3, 1.85_g_per_cm3, "assumed: middle of the cortical range"},
    {"contact_stiffness", "Stiffness of bone at each place where a side or the still teeth touch.",
     dimension::force_per_length, "N/mm", 1.0_N_per_mm, 10000.0_N_per_mm, 500.0_N_per_mm, "assumed"},
    {"friction", "Friction of steel on wet bone.", dimension::none, "", 0.0, 1.5, 0.3, "assumed"},
};
static_assert(std::size(force_parameters) == force_parameter_count);

constexpr kerf_feature force_features[] = {
    {"edge_term", "Teeth resist also where they hardly feed.", KERF_FEATURE_EFFECT, force_thrust_edge, 0.0},
    {"edge_term", "Teeth resist also where they hardly feed.", KERF_FEATURE_EFFECT, force_cutting_edge, 0.0},
    {"set_force", "A tooth without a neighbour pushes the blade aside.", KERF_FEATURE_EFFECT, force_set_share, 0.0},
    {"friction", "The sides rub where the blade binds.", KERF_FEATURE_EFFECT, force_friction, 0.0},
};

constexpr kerf_signal signals[] = {
    {"chip_thickness", "Uncut chip thickness at the teeth, in the mean over the oscillation.", dimension::length, "um"},
    {"engaged_teeth", "Teeth in bone.", dimension::none, ""},
    {"tooth_force", "Thrust of one tooth in bone.", dimension::force, "N"},
    {"vibration", "Size of the force that swings with the teeth and is not in the force: for sound and rumble.",
     dimension::force, "N"},
    {"binding", "What presses on the blade's sides.", dimension::force, "N"},
    {"drive_power", "Power the motor puts into cutting and rubbing.", kerf_dimension{{2, 1, -3, 0, 0, 0, 0, 0}}, "W"},
    {"stroke_rate", "Oscillations as they are.", dimension::frequency, "1/min"},
};
static_assert(std::size(signals) == signal_count);

constexpr kerf_event events[] = {
    {"sawing.off", "The blade stands, and its motor is off."},
    {"sawing.speeding_up", "The motor brings the blade up to the commanded rate."},
    {"sawing.running", "The blade swings as it is commanded."},
    {"sawing.bogging", "The blade is slower than 0.7 of what is commanded: the bone asks for more than the motor has."},
    {"sawing.stalled", "The blade was held fast; it starts again once it has been commanded off."},
    {"sawing.running_down", "The blade runs down with its motor off."},
};
static_assert(std::size(events) == event_count);

/// All that the teeth sweep while they swing removes bone, as deep as they are high; the blade behind it does not.
kerf_status shape(const double* params, kerf_tool_shape* out) {
    constexpr std::uint32_t pieces =
        8;  // of the half front: an arc of 60 mm is met within 8 µm; stamps cost less for each left out
    if (out->profile_capacity < pieces + 3) return KERF_CAPACITY;
    const SawBlade blade = blade_of({params, tool_parameter_count});
    const bool is_whole = std::floor(blade.tooth_count) == blade.tooth_count;
    constexpr double widest = 60.0_deg;
    if (!is_whole) return refuse(out, "`tooth_count` is ", Figure(blade.tooth_count), "; it needs a whole number.");
    if (!(blade.half_sweep() < widest))
        return refuse(out, "front and swing reach ", Figure(blade.half_sweep() / 1.0_deg, " deg"),
                      " to either side; less than ", Figure(widest / 1.0_deg, " deg"),
                      " is needed: fewer teeth, a smaller `tooth_pitch` or `arc`, or a larger `radius`.");
    kerf_profile_point* at = out->profile;
    for (std::uint32_t i = 0; i <= pieces; ++i) {
        const Vec3 front = blade.on_front(sin_cos_exact(blade.half_sweep() * i / pieces));
        *at++ = {front.z, front.x};
    }
    const kerf_profile_point end = *(at - 1);
    const double deepest = 0.9 * blade.radius + end.z;
    if (!(blade.tooth_height < deepest))
        return refuse(out, "`tooth_height` is ", in_mm(blade.tooth_height), "; with this front it needs less than ",
                      in_mm(deepest), ".");
    *at++ = {end.z - blade.tooth_height, end.radius};
    out->cutting_count = static_cast<std::uint32_t>(at - out->profile);
    *at++ = {-blade.radius, end.radius};
    out->profile_count = static_cast<std::uint32_t>(at - out->profile);
    out->grip_z = -blade.radius - 80.0_mm;  // the hand holds the handpiece behind the axis of the swing
    out->kind = KERF_SOLID_PRISM;
    out->kerf = blade.kerf();
    out->thickness = blade.thickness;
    return KERF_OK;
}

constexpr kerf_tool oscillating_blade{sizeof(kerf_tool), drives, drive_count, &shape};

constexpr kerf_force cutting{sizeof(kerf_force),
                             sizeof(SawCutting::State),
                             alignof(SawCutting::State),
                             signals,
                             signal_count,
                             events,
                             event_count,
                             20000,
                             &ForceTable<SawCutting>::begin,
                             &ForceTable<SawCutting>::resist,
                             &ForceTable<SawCutting>::commit};

constexpr kerf_component components[] = {
    {sizeof(kerf_component), KERF_KIND_TOOL, "oscillating_blade",
     "Blade of an oscillating saw: an arc of teeth that swings about an axis behind it.", tool_parameters,
     tool_parameter_count, 0, &oscillating_blade, nullptr, nullptr},
    {sizeof(kerf_component), KERF_KIND_FORCE, "saw_cutting",
     "Edge and chip forces on each tooth, averaged over the oscillation, binding in the blade's own slot, contact and "
     "friction.",
     force_parameters, force_parameter_count, std::size(force_features), nullptr, &cutting, force_features},
};

}  // namespace
}  // namespace kerf::sawing

extern "C" __attribute__((visibility("default"))) const kerf_entry kerf_plugin_entry;
extern "C" const kerf_entry kerf_plugin_entry{KERF_MAGIC,
                                              KERF_ABI_VERSION,
                                              sizeof(kerf_entry),
                                              static_cast<uint32_t>(std::size(kerf::sawing::components)),
                                              KERF_LAYOUT_INIT,
                                              "kerf.sawing",
                                              "0.1.0",
                                              "Apache-2.0",
                                              __VERSION__,
                                              kerf::sawing::components};
