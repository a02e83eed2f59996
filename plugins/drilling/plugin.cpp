// SPDX-License-Identifier: Apache-2.0
// The drilling plugin: its tables, and nothing else.
#include <algorithm>
#include <cstddef>
#include <iterator>

#include "drill_force.h"
#include "kerf/refusal.hpp"
#include "kerf/units.hpp"

namespace kerf::drilling {
namespace {

using namespace literals;

constexpr const char* femur_fit = "calibrated: human femur cortex, 3.2 mm, 2 mm/s, least squares over 1000, 1250 and "
                                  "1500 rpm [macavelia-2012]; docs/models/drilling.md";

// What every drill has.
#define KERF_DRILL_PARAMETERS                                                                                  \
    {"diameter", "Diameter over the lips.",      dimension::length, "mm", 0.5_mm, 20.0_mm,                     \
     3.2_mm,     "the drill of [macavelia-2012]"},                                                             \
        {"point_angle",   "Full angle of the point.", dimension::angle, "deg", 60.0_deg, 160.0_deg, 118.0_deg, \
         "standard grind"},                                                                                    \
        {"web",                                                                                                \
         "Web thickness at the point, as a share of the diameter.",                                            \
         dimension::none,                                                                                      \
         "",                                                                                                   \
         0.05,                                                                                                 \
         0.4,                                                                                                  \
         0.15,                                                                                                 \
         "assumed: common for surgical twist drills"},                                                         \
        {"length",          "From the tip to the chuck, which bone does not stop.",                            \
         dimension::length, "mm",                                                                              \
         10.0_mm,           300.0_mm,                                                                          \
         80.0_mm,           "assumed"},                                                                        \
        {"corner",                                                                                             \
         "Length behind the corner that still cuts sideways, as a share of the diameter.",                     \
         dimension::none,                                                                                      \
         "",                                                                                                   \
         0.05,                                                                                                 \
         1.0,                                                                                                  \
         0.25,                                                                                                 \
         "assumed"},                                                                                           \
        {"motor_torque",    "The most the motor turns or brakes with.",                                        \
         dimension::torque, "N m",                                                                             \
         10.0_Nmm,          20000.0_Nmm,                                                                       \
         2000.0_Nmm,        "assumed: order of battery-driven surgical drills"},                               \
        {"runout",                                                                                             \
         "How far the tip runs off the axis it turns about.",                                                  \
         dimension::length,                                                                                    \
         "mm",                                                                                                 \
         0.0_mm,                                                                                               \
         0.5_mm,                                                                                               \
         0.0_mm,                                                                                               \
         "a true bit; 0.05 mm is common"},                                                                     \
        {"helix_angle",    "Helix of the flutes at the diameter: the rake of the lips.",                       \
         dimension::angle, "deg",                                                                              \
         0.0_deg,          45.0_deg,                                                                           \
         28.0_deg,         "assumed: that of the drill the coefficients were fitted with"},                    \
        {"run_up",        "Time the unloaded motor takes to 1000 rpm.",                                        \
         dimension::time, "ms",                                                                                \
         0.0_ms,          5000.0_ms,                                                                           \
         200.0_ms,        "assumed: a controller's soft start; 0 makes the speed follow at once"},             \
        {"inertia",                                                                                            \
         "Of all that turns, at the chuck.",                                                                   \
         kerf_dimension{{2, 1, 0, 0, 0, 0, 0, 0}},                                                             \
         "kg mm2",                                                                                             \
         1e-7,                                                                                                 \
         0.01,                                                                                                 \
         5e-5,                                                                                                 \
         "assumed: order of a small rotor behind its gear"},                                                   \
        {"mass",          "Of drill and handpiece, centred where the hand holds them; felt across the shaft.", \
         dimension::mass, "kg",                                                                                \
         0.0_kg,          5.0_kg,                                                                              \
         0.5_kg,          "assumed: order of a small surgical drill"},                                         \
        {"yield_strength",    "Bending stress beyond which the bit stays bent, or breaks.",                    \
         dimension::pressure, "N/mm2",                                                                         \
         100.0_N_per_mm2,     5000.0_N_per_mm2,                                                                \
         1000.0_N_per_mm2,    "assumed: order of hardened stainless steel"},

constexpr kerf_param tool_parameters[] = {KERF_DRILL_PARAMETERS};
static_assert(std::size(tool_parameters) == tool_parameter_count);

constexpr kerf_param step_drill_parameters[] = {
    KERF_DRILL_PARAMETERS{"shoulder_diameter", "Diameter of the wider part behind the point: wider than `diameter`.",
                          dimension::length, "mm", 0.5_mm, 30.0_mm, 5.0_mm, "assumed"},
    {"shoulder_angle", "Full angle of the cone up to it: 90 deg a countersink, a few degrees a taper.",
     dimension::angle, "deg", 2.0_deg, 160.0_deg, 90.0_deg, "common for countersinks"},
    {"shoulder_depth",
     "From the tip to where that cone begins: no less than the point is deep, half of `diameter` over "
     "tan(`point_angle`/2).",
     dimension::length, "mm", 0.0_mm, 200.0_mm, 10.0_mm, "assumed"},
};
static_assert(std::size(step_drill_parameters) == step_drill_parameter_count);

#define KERF_CORNER(N)                                                                                                 \
    {"depth_" #N,                                                                                                      \
     "From the tip to corner " #N                                                                                      \
     " of the outline behind the point, 0.01 mm and more behind the one before; 0: there is none, nor a further one.", \
     dimension::length,                                                                                                \
     "mm",                                                                                                             \
     0.0_mm,                                                                                                           \
     200.0_mm,                                                                                                         \
     0.0_mm,                                                                                                           \
     "as the tool is"},                                                                                                \
        {"diameter_" #N,                                                                                               \
         "Diameter at corner " #N ": that of the one before, or wider by a degree of half angle and more.",            \
         dimension::length,                                                                                            \
         "mm",                                                                                                         \
         0.0_mm,                                                                                                       \
         30.0_mm,                                                                                                      \
         0.0_mm,                                                                                                       \
         "as the tool is"},

constexpr kerf_param profile_drill_parameters[] = {
    KERF_DRILL_PARAMETERS{"shank_diameter",
                          "Diameter behind the corners and the land, where it is thinner than they are; 0: as wide.",
                          dimension::length, "mm", 0.0_mm, 30.0_mm, 0.0_mm, "as the tool is"},
    KERF_CORNER(1) KERF_CORNER(2) KERF_CORNER(3) KERF_CORNER(4) KERF_CORNER(5) KERF_CORNER(6) KERF_CORNER(7)
        KERF_CORNER(8)};
static_assert(std::size(profile_drill_parameters) == profile_drill_parameter_count);
#undef KERF_CORNER
#undef KERF_DRILL_PARAMETERS

constexpr kerf_drive drives[] = {
    {"spindle_speed", "Commanded speed of the spindle; negative in reverse.", dimension::frequency, "rpm", -3000.0_rpm,
     3000.0_rpm, 1000.0_rpm, slowest_cut},
};
static_assert(std::size(drives) == drive_count);

constexpr kerf_param force_parameters[] = {
    {"thrust_edge", "Lip: edge force normal to the cut, per width of cut.", dimension::force_per_length, "N/mm",
     0.0_N_per_mm, 500.0_N_per_mm, 27.1630_N_per_mm, femur_fit},
    {"thrust_chip", "Lip: force normal to the cut, per chip area.", dimension::pressure, "N/mm2", 0.0_N_per_mm2,
     10000.0_N_per_mm2, 284.767_N_per_mm2, femur_fit},
    {"cutting_edge", "Lip: edge force along the cut, per width of cut.", dimension::force_per_length, "N/mm",
     0.0_N_per_mm, 500.0_N_per_mm, 16.2032_N_per_mm, femur_fit},
    {"cutting_chip", "Lip: force along the cut, per chip area.", dimension::pressure, "N/mm2", 0.0_N_per_mm2,
     10000.0_N_per_mm2, 933.650_N_per_mm2, femur_fit},
    {"chisel_edge", "Chisel edge: thrust per length.", dimension::force_per_length, "N/mm", 0.0_N_per_mm,
     1000.0_N_per_mm, 99.1430_N_per_mm, "45 % of the thrust [saha-1982, assumed to hold for edge and chip alike]"},
    {"chisel_chip", "Chisel edge: thrust per length and feed per lip.", dimension::pressure, "N/mm2", 0.0_N_per_mm2,
     10000.0_N_per_mm2, 871.475_N_per_mm2, "45 % of the thrust [saha-1982, assumed to hold for edge and chip alike]"},
    {"edge_depth", "Chip thickness at which the edge force has built up.", dimension::length, "um", 0.01_um, 20.0_um,
     4.0_um, "assumed: the largest that leaves the published checks unchanged"},
    {"reference_density", "Density of the bone the coefficients were fitted to.", dimension::density, "g/cm3",
     0.5_g_per_cm3, 2.5_g_per_cm3, 1.85_g_per_cm3, "assumed: middle of the cortical range"},
    {"element_pitch", "Length of one piece of lip.", dimension::length, "mm", 0.02_mm, 1.0_mm, 0.1_mm,
     "measured: finer changes thrust by under 0.3 % at 0.2 mm"},
    {"rake_effect", "How much less the lips' forces are for each degree more of rake.", dimension::none, "", 0.0, 0.05,
     0.01, "assumed: order known from metal; best rake of bone is not settled [krause-1987]"},
    {"relief_angle", "Relief behind the lip: faster feeds ride on the heel.", dimension::angle, "deg", 1.0_deg,
     30.0_deg, 10.0_deg, "standard grind"},
    {"heel_stiffness",
     "Stiffness of the heels on bone of the reference density, for what each lip feeds beyond the relief.",
     dimension::force_per_length, "N/mm", 0.0_N_per_mm, 10000.0_N_per_mm, 1000.0_N_per_mm, "assumed"},
    {"contact_stiffness", "Stiffness of bone at each place where the shank or the still tip touches.",
     dimension::force_per_length, "N/mm", 1.0_N_per_mm, 10000.0_N_per_mm, 500.0_N_per_mm, "assumed"},
    {"clearance", "How far the shank is thinner than the hole, on the radius.", dimension::length, "mm", 0.0_mm, 1.0_mm,
     0.05_mm, "assumed"},
    {"friction", "Friction of steel on wet bone.", dimension::none, "", 0.0, 1.5, 0.3, "assumed"},
};
static_assert(std::size(force_parameters) == force_parameter_count);

constexpr kerf_feature tool_features[] = {
    {"runout", "A tip that runs off its axis cuts wide and swings.", KERF_FEATURE_EFFECT, tool_runout, 0.0},
};

constexpr kerf_feature force_features[] = {
    {"element_pitch", "How many elements a lip has.", KERF_FEATURE_RESOLUTION, force_element_pitch, 1.0_mm},
    {"edge_term", "Edges resist also where they hardly feed.", KERF_FEATURE_EFFECT, force_thrust_edge, 0.0},
    {"edge_term", "Edges resist also where they hardly feed.", KERF_FEATURE_EFFECT, force_cutting_edge, 0.0},
    {"edge_term", "Edges resist also where they hardly feed.", KERF_FEATURE_EFFECT, force_chisel_edge, 0.0},
    {"chisel", "The chisel edge's thrust.", KERF_FEATURE_EFFECT, force_chisel_edge, 0.0},
    {"chisel", "The chisel edge's thrust.", KERF_FEATURE_EFFECT, force_chisel_chip, 0.0},
    {"rake", "Lips cut easier where their rake is larger.", KERF_FEATURE_EFFECT, force_rake_effect, 0.0},
    {"heel", "Faster feeds than the relief allows ride on the heel.", KERF_FEATURE_EFFECT, force_heel_stiffness, 0.0},
    {"friction", "The shank rubs in its hole.", KERF_FEATURE_EFFECT, force_friction, 0.0},
};

constexpr kerf_signal signals[] = {
    {"chip_thickness", "Uncut chip thickness at the lips.", dimension::length, "um"},
    {"feed_per_revolution", "Feed per revolution through bone.", dimension::length, "mm"},
    {"engagement", "Share of the cutting edges in bone.", dimension::none, ""},
    {"drive_power", "Power the motor puts into cutting and rubbing.", kerf_dimension{{2, 1, -3, 0, 0, 0, 0, 0}}, "W"},
    {"spindle_speed", "Speed of the spindle as it is.", dimension::frequency, "rpm"},
    {"bending_stress", "Largest bending stress in the bit, in the mean over 5 ms.", dimension::pressure, "N/mm2"},
};
static_assert(std::size(signals) == signal_count);

constexpr kerf_event events[] = {
    {"drilling.spindle_off", "The spindle stands, and its motor is off."},
    {"drilling.spinning_up", "The motor brings the spindle up to the commanded speed."},
    {"drilling.running", "The spindle turns as it is commanded."},
    {"drilling.bogging",
     "The spindle is slower than 0.7 of what is commanded: the bone asks for more than the motor has."},
    {"drilling.stalled", "The spindle was held fast; it starts again once it has been commanded off."},
    {"drilling.running_down", "The spindle runs down with its motor off."},
    {"drilling.reversing", "The spindle turns in reverse, and the edges rub."},
    {"drilling.bit_overbent",
     "The bit was bent beyond its `yield_strength`: one of steel would have stayed bent, or broken."},
    {"drilling.crushing",
     "The tip does not turn, and is pushed harder than the bone before it bears: it crushes its way."},
    {"drilling.wall_broken", "A thin wall with free space behind it broke out before a tip that does not turn."},
};
static_assert(std::size(events) == event_count);

/// The cones and the land behind the last of them cut; what is behind does not.
kerf_status outline(const TwistDrill& drill, double mass, kerf_tool_shape* out) {
    const double tip = drill.point_depth(), widest = drill.widest_radius(), shank = drill.shank_radius(),
                 e = drill.runout;
    const double cone_end = drill.cones().last().end(), land_end = drill.land() - cone_end, head = drill.head(),
                 neck = head + (widest - shank);
    if (out->profile_capacity < TwistDrill::most_corners + 6) return KERF_CAPACITY;
    if (!(neck < drill.length))
        return refuse(out, "`length` is ", in_mm(drill.length),
                      "; it needs more than what is cut with and the land behind it, ", in_mm(neck), ".");
    kerf_profile_point* at = out->profile;
    *at++ = {0.0, e};
    *at++ = {-tip, drill.radius() + e};
    for (std::size_t i = 0; i < drill.corner_count; ++i) {
        const OutlineCorner& corner = drill.corners[i];
        if (-corner.depth < (at - 1)->z && corner.depth < land_end) *at++ = {-corner.depth, corner.radius + e};
    }
    *at++ = {-land_end, widest + e};
    out->cutting_count = static_cast<uint32_t>(at - out->profile);
    if (shank < widest) {
        if (head > land_end) *at++ = {-head, widest + e};
        *at++ = {-neck, shank + e};
    }
    *at++ = {-drill.length, shank + e};
    out->profile_count = static_cast<uint32_t>(at - out->profile);
    out->grip_z = -drill.length - 40.0_mm;  // the hand holds the body of the drill behind the chuck
    out->mass = mass;
    out->centre_z = out->grip_z;
    out->gyration = 50.0_mm;  // [assumed]
    return KERF_OK;
}

kerf_status shape(const double* params, kerf_tool_shape* out) {
    return outline(drill_of({params, tool_parameter_count}), params[tool_mass], out);
}

kerf_status step_shape(const double* params, kerf_tool_shape* out) {
    const TwistDrill drill = drill_of({params, step_drill_parameter_count});
    if (!(drill.widest_radius() > drill.radius()))
        return refuse(out, "`shoulder_diameter` is ", in_mm(params[tool_shoulder_diameter]),
                      "; it needs more than `diameter`, ", in_mm(drill.diameter), ".");
    if (params[tool_shoulder_depth] < drill.point_depth())
        return refuse(out, "`shoulder_depth` is ", in_mm(params[tool_shoulder_depth]),
                      "; it needs the depth of the point or more, ", in_mm(drill.point_depth()), ".");
    return outline(drill, params[tool_mass], out);
}

/// Corners go backwards from the point, and from one to the next the outline is straight or widens by a degree of half
/// angle or more.
kerf_status profile_shape(const double* params, kerf_tool_shape* out) {
    constexpr double slightest = 0.0174550649282176, nearest = 0.01_mm - 1e-9;  // tan 1°; [m], less what rounding takes
    const TwistDrill drill = drill_of({params, profile_drill_parameter_count});
    OutlineCorner last{drill.point_depth(), drill.radius()};
    for (std::size_t i = 0; i < drill.corner_count; ++i) {
        const double longer = drill.corners[i].depth - last.depth, wider = drill.corners[i].radius - last.radius;
        const char nth[] = {static_cast<char>('1' + i), '\0'};
        if (!(longer >= nearest))
            return refuse(out, "`depth_", nth, "` is ", in_mm(drill.corners[i].depth), "; it needs ", in_mm(nearest),
                          " or more beyond the depth of ", i == 0 ? "the point" : "the corner before", ", ",
                          in_mm(last.depth), ".");
        if (wider != 0.0 && wider < slightest * longer)
            return refuse(out, "`diameter_", nth, "` is ", in_mm(2.0 * drill.corners[i].radius), "; it needs that of ",
                          i == 0 ? "the point" : "the corner before", ", ", in_mm(2.0 * last.radius),
                          ", or a degree of half angle more: ", in_mm(2.0 * (last.radius + slightest * longer)), ".");
        last = drill.corners[i];
    }
    const auto depth_of = [&](std::size_t i) { return params[tool_first_depth + 2 * i]; };
    const auto diameter_of = [&](std::size_t i) { return params[tool_first_depth + 2 * i + 1]; };
    for (std::size_t i = drill.corner_count; i < TwistDrill::most_corners; ++i) {
        const char nth[] = {static_cast<char>('1' + i), '\0'},
                   missing[] = {static_cast<char>('1' + drill.corner_count), '\0'};
        if (depth_of(i) > 0.0 || diameter_of(i) > 0.0)
            return refuse(out, "corner ", nth, " is given, but `depth_", missing,
                          "` is 0 mm; corners need numbers from 1 on without a gap, each a depth and a diameter.");
    }
    return outline(drill, params[tool_mass], out);
}

constexpr kerf_tool twist_drill{sizeof(kerf_tool), drives, drive_count, &shape};
constexpr kerf_tool step_drill{sizeof(kerf_tool), drives, drive_count, &step_shape};
constexpr kerf_tool profile_drill{sizeof(kerf_tool), drives, drive_count, &profile_shape};

constexpr kerf_force cutting{sizeof(kerf_force),
                             sizeof(DrillCutting::State),
                             alignof(DrillCutting::State),
                             signals,
                             signal_count,
                             events,
                             event_count,
                             20000,
                             &ForceTable<DrillCutting>::begin,
                             &ForceTable<DrillCutting>::resist,
                             &ForceTable<DrillCutting>::commit};

constexpr kerf_component components[] = {
    {sizeof(kerf_component), KERF_KIND_TOOL, "twist_drill", "Twist drill with two lips and a chisel edge.",
     tool_parameters, tool_parameter_count, std::size(tool_features), &twist_drill, nullptr, tool_features},
    {sizeof(kerf_component), KERF_KIND_TOOL, "step_drill",
     "Twist drill with a wider part behind the point: countersink, taper, step.", step_drill_parameters,
     step_drill_parameter_count, std::size(tool_features), &step_drill, nullptr, tool_features},
    {sizeof(kerf_component), KERF_KIND_TOOL, "profile_drill",
     "Drill of any outline, with two lips all along what widens: several steps, an acorn, a ball on a thin shank; an "
     "awl with its spindle off.",
     profile_drill_parameters, profile_drill_parameter_count, std::size(tool_features), &profile_drill, nullptr,
     tool_features},
    {sizeof(kerf_component), KERF_KIND_FORCE, "drill_cutting",
     "Edge and chip forces on lips and chisel edge, mixed tissue, contact and friction of the shank.", force_parameters,
     force_parameter_count, std::size(force_features), nullptr, &cutting, force_features},
};

}  // namespace
}  // namespace kerf::drilling

extern "C" __attribute__((visibility("default"))) const kerf_entry kerf_plugin_entry;
extern "C" const kerf_entry kerf_plugin_entry{KERF_MAGIC,
                                              KERF_ABI_VERSION,
                                              sizeof(kerf_entry),
                                              static_cast<uint32_t>(std::size(kerf::drilling::components)),
                                              KERF_LAYOUT_INIT,
                                              "kerf.drilling",
                                              "0.1.0",
                                              "Apache-2.0",
                                              __VERSION__,
                                              kerf::drilling::components};
