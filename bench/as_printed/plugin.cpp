// SPDX-License-Identifier: Apache-2.0
// The papers' laws as printed, as a plugin: its tables, and nothing else.
#include <cstddef>
#include <iterator>

#include "dental_implant.h"
#include "hsieh_2006.h"
#include "kerf/refusal.hpp"
#include "kerf/units.hpp"
#include "touch_count.h"
#include "tsai_2007.h"
#include "volumetric_drilling.h"

namespace kerf::as_printed {
namespace {

using namespace literals;

constexpr kerf_dimension pressure_per_length{{-2, 1, -2, 0, 0, 0, 0, 0}};
constexpr kerf_dimension damping{{0, 1, -1, 0, 0, 0, 0, 0}};
constexpr kerf_dimension force_per_density{{4, 0, -2, 0, 0, 0, 0, 0}};

constexpr const char* femur_point =
    "no paper reports a coefficient; calibrated: thrust 198.4 N and torque 186.3 N mm of a 3.2 mm drill at 2 mm/s and "
    "1000 rpm [macavelia-2012], 45 % of the thrust on the chisel edge [saha-1982]";
constexpr const char* not_stated = "not stated in the paper: assumed";

constexpr kerf_param tool_parameters[] = {
    {"diameter", "Diameter over the lips.", dimension::length, "mm", 0.5_mm, 20.0_mm, 5.4_mm,
     "the largest drill of [tsai-2007]"},
    {"point_angle", "Full angle of the point.", dimension::angle, "deg", 60.0_deg, 160.0_deg, 118.0_deg, not_stated},
    {"web", "Web thickness at the point, as a share of the diameter.", dimension::none, "", 0.05, 0.4, 0.15,
     not_stated},
    {"length", "From the tip to the chuck.", dimension::length, "mm", 10.0_mm, 300.0_mm, 100.0_mm,
     "[tsai-2007]: points as far as 10 cm"},
};
static_assert(std::size(tool_parameters) == tool_parameter_count);

constexpr kerf_drive drives[] = {
    {"spindle_speed", "Speed of the spindle; no motor is modelled.", dimension::frequency, "rpm", 0.0_rpm, 50000.0_rpm,
     1000.0_rpm, 0.0},
};
static_assert(std::size(drives) == drive_count);

kerf_status shape(const double* params, kerf_tool_shape* out) {
    const PaperDrill drill = paper_drill({params, tool_parameter_count});
    if (out->profile_capacity < 4) return KERF_CAPACITY;
    const double land = 0.5 * drill.radius, end = drill.point_depth() + land;
    if (!(end < drill.length))
        return refuse(out, "`length` is ", in_mm(drill.length), "; it needs more than ", in_mm(end),
                      ", where the land behind the point ends.");
    out->profile[0] = {0.0, 0.0};
    out->profile[1] = {-drill.point_depth(), drill.radius};
    out->profile[2] = {-drill.point_depth() - land, drill.radius};
    out->profile[3] = {-drill.length, drill.radius};
    out->cutting_count = 3;
    out->profile_count = 4;
    out->grip_z = -drill.length - 40.0_mm;
    return KERF_OK;
}
constexpr kerf_tool paper_drill_tool{sizeof(kerf_tool), drives, drive_count, &shape};

constexpr kerf_param saw_parameters[] = {
    {"length", "l: from the saw's origin, which it swings about, to its tip.", dimension::length, "mm", 20.0_mm,
     90.0_mm, 60.0_mm, not_stated},
    {"tooth_pitch", "p: from tooth to tooth.", dimension::length, "mm", 0.3_mm, 5.0_mm, 1.4_mm, not_stated},
    {"tooth_count", "Teeth.", dimension::none, "", 1.0, 64.0, 10.0, "[hsieh-2006] section 3: ten"},
    {"bend", "c: how the tips leave a straight line.", kerf_dimension{{-1, 0, 0, 0, 0, 0, 0, 0}}, "1/m", 0.0, 30.0, 0.0,
     "[hsieh-2006] section 2.2: 0 where tips form a line"},
    {"swing", "Angle from one turning point to the other.", dimension::angle, "deg", 0.0, 12.0_deg, 5.0_deg,
     not_stated},
    {"kerf", "Thickness of the blade.", dimension::length, "mm", 0.2_mm, 4.0_mm, 1.0_mm, not_stated},
};
static_assert(std::size(saw_parameters) == saw_parameter_count);

constexpr kerf_drive saw_drives[] = {
    {"oscillation", "u: oscillations; no motor is modelled.", dimension::frequency, "1/min", 0.0, 25000.0_rpm,
     12000.0_rpm, 0.0},
};
static_assert(std::size(saw_drives) == saw_drive_count);

kerf_status saw_shape(const double* params, kerf_tool_shape* out) {
    if (out->profile_capacity < 3) return KERF_CAPACITY;
    const double half = 0.5 * params[saw_teeth] * params[saw_pitch];
    out->profile[0] = {0.0, half};
    out->profile[1] = {-1.0_mm, half};
    out->profile[2] = {-params[saw_length], half};
    out->cutting_count = 2;
    out->profile_count = 3;
    out->grip_z = -params[saw_length] - 80.0_mm;
    out->kind = KERF_SOLID_PRISM;
    out->kerf = out->thickness = params[saw_kerf];
    return KERF_OK;
}
constexpr kerf_tool paper_saw_tool{sizeof(kerf_tool), saw_drives, saw_drive_count, &saw_shape};

constexpr const char* saw_point = "determined empirically, figures not stated; 8, 5 and 0.8 N of a tooth at 1 mm/s and "
                                  "12000 a minute: the order of [james-2012]";
constexpr kerf_param hsieh_parameters[] = {
    {"k_normal", "K_normal, against the feed.", pressure_per_length, "N/mm3", 0.0, 1e15, 8.0 / 0.007e-9, saw_point},
    {"k_lateral", "K_lateral, along the oscillation.", pressure_per_length, "N/mm3", 0.0, 1e15, 5.0 / 0.007e-9,
     saw_point},
    {"k_radial", "K_radial, across the blade.", pressure_per_length, "N/mm3", 0.0, 1e15, 0.8 / 0.007e-9, saw_point},
    {"tooth_width", "w: width of a tooth's blade.", dimension::length, "mm", 0.1_mm, 4.0_mm, 1.0_mm, not_stated},
    {"per_point", "Force of one immersed point of a still saw.", dimension::force, "N", 0.0, 1000.0, 0.1_N,
     "not stated: that of [tsai-2007]"},
    {"point_interval", "Distance of sample points on the blade: one voxel.", dimension::length, "mm", 0.1_mm, 5.0_mm,
     1.0_mm, "[hsieh-2006] section 2.3"},
};
static_assert(std::size(hsieh_parameters) == Hsieh2006::force_parameter_count);

#define KERF_INTERVAL                                                                                               \
    {                                                                                                               \
        "element_interval", "Distance of sample points along the edges.", dimension::length, "mm", 0.01_mm, 5.0_mm, \
            0.1_mm, "[tsai-2007] section 5: 0.1 mm"                                                                 \
    }
#define KERF_VOXEL                                                                                              \
    {                                                                                                           \
        "voxel_width", "Distance of sample points on the drill's surface: one voxel.", dimension::length, "mm", \
            0.05_mm, 2.0_mm, 1.0_mm, "[tsai-2007] section 4, [volumetric-drilling] section III.A"               \
    }
#define KERF_SHANK                                                                                            \
    {                                                                                                         \
        "shank", "How far behind the tip the surface has points.", dimension::length, "mm", 1.0_mm, 200.0_mm, \
            100.0_mm, "[tsai-2007] section 4: 10 cm"                                                          \
    }
#define KERF_SOFTER                                                                                                  \
    {                                                                                                                \
        "softer", "Coefficients of a less dense tissue, as a share of the densest one's.", dimension::none, "", 0.0, \
            1.0, 0.1, "determined empirically by type of bone, figures not stated; 1:10 for the layered slab"        \
    }

constexpr kerf_param tsai_parameters[] = {
    {"k_h", "K_H at the axis: tangential.", dimension::pressure, "N/mm2", 0.0, 1e11, 1026.38_N_per_mm2, femur_point},
    {"k_h_slope", "K_H per radius.", pressure_per_length, "N/mm3", -1e15, 1e15, 0.0, not_stated},
    {"k_t", "K_T at the axis: in the lip's plane, across the normal.", dimension::pressure, "N/mm2", 0.0, 1e11, 0.0,
     not_stated},
    {"k_t_slope", "K_T per radius.", pressure_per_length, "N/mm3", -1e15, 1e15, 0.0, not_stated},
    {"k_v", "K_V at the axis: normal to the cut.", dimension::pressure, "N/mm2", 0.0, 1e11, 695.74_N_per_mm2,
     femur_point},
    {"k_v_slope", "K_V per radius.", pressure_per_length, "N/mm3", -1e15, 1e15, 0.0, not_stated},
    {"k_c", "K_C of the chisel edge.", dimension::pressure, "N/mm2", 0.0, 1e11, 1269.67_N_per_mm2, femur_point},
    {"sideways", "Force of a surface point per speed into bone.", damping, "N s/m", 0.0, 1e6, 1.0, not_stated},
    KERF_INTERVAL,
    KERF_VOXEL,
    KERF_SHANK,
    KERF_SOFTER,
    {"torque_arm", "T_thrust over this length is added to the thrust, as a force; 0: it is not.", dimension::length,
     "mm", 0.0, 300.0_mm, 0.0, "[tsai-2007] section 5.2 adds it and states no length: off"},
};
static_assert(std::size(tsai_parameters) == Tsai2007::force_parameter_count);

constexpr kerf_param touch_parameters[] = {
    {"per_point", "Force of one immersed point.", dimension::force, "N", 0.0, 1000.0, 0.1_N,
     "[tsai-2007] section 6: one point is 0.1 N"},
    KERF_VOXEL,
    KERF_SHANK,
};
static_assert(std::size(touch_parameters) == TouchCount::force_parameter_count);

constexpr const char* mill_fit =
    "no coefficient is reported: 1213 and 1033 N/mm2 of chip area from [macavelia-2012], times 2 pi for t as printed";
constexpr kerf_param volumetric_parameters[] = {
    {"k_n", "K_n of the densest tissue.", dimension::pressure, "N/mm2", 0.0, 1e11, 7621.0_N_per_mm2, mill_fit},
    {"k_f", "K_f of the densest tissue.", dimension::pressure, "N/mm2", 0.0, 1e11, 6491.0_N_per_mm2, mill_fit},
    KERF_SOFTER,
    {"rake", "Rake angle.", dimension::angle, "deg", -30.0_deg, 45.0_deg, 0.0_deg, not_stated},
    KERF_INTERVAL,
    KERF_VOXEL,
    KERF_SHANK,
};
static_assert(std::size(volumetric_parameters) == VolumetricDrilling::force_parameter_count);

constexpr kerf_param dental_parameters[] = {
    {"k_n", "k^n of each element: normal force per density.", force_per_density, "N/(g/cm3)", 0.0, 1.0, 3.68e-3,
     femur_point},
    {"k_t", "k^t of each element: tangential force per density.", force_per_density, "N/(g/cm3)", 0.0, 1.0, 3.13e-3,
     femur_point},
    KERF_INTERVAL,
};
static_assert(std::size(dental_parameters) == DentalImplant::force_parameter_count);

#undef KERF_INTERVAL
#undef KERF_VOXEL
#undef KERF_SHANK
#undef KERF_SOFTER

constexpr kerf_signal tsai_signals[] = {
    {"f_tang", "F_tang: a sum without directions.", dimension::force, "N"},
    {"f_radius", "F_radius: a sum without directions.", dimension::force, "N"},
    {"t_tang", "T_tang: against the spin.", dimension::torque, "N mm"},
    {"t_radius", "T_radius.", dimension::torque, "N mm"},
    {"t_thrust", "T_thrust.", dimension::torque, "N mm"},
};
static_assert(std::size(tsai_signals) == Tsai2007::signal_count);
constexpr kerf_signal touch_signals[] = {{"immersed", "Not kept.", dimension::none, ""}};
constexpr kerf_signal volumetric_signals[] = {{"thrust", "Not kept.", dimension::force, "N"}};
constexpr kerf_signal hsieh_signals[] = {
    {"teeth_in_bone", "Teeth whose tip is in bone.", dimension::none, ""},
    {"f_x", "Against the oscillation.", dimension::force, "N"},
    {"f_y", "Across the blade.", dimension::force, "N"},
    {"f_z", "Against the feed.", dimension::force, "N"},
};
static_assert(std::size(hsieh_signals) == Hsieh2006::signal_count);
constexpr kerf_signal dental_signals[] = {{"elements", "Cutting elements.", dimension::none, ""}};

template <class Law, std::size_t N>
constexpr kerf_force table_of(const kerf_signal (&signals)[N]) {
    static_assert(N == Law::signal_count);
    return {sizeof(kerf_force),
            sizeof(typename Law::State),
            alignof(typename Law::State),
            signals,
            N,
            nullptr,
            0,
            1000000,
            &ForceTable<Law>::begin,
            &ForceTable<Law>::resist,
            &ForceTable<Law>::commit};
}
constexpr kerf_force tsai = table_of<Tsai2007>(tsai_signals);
constexpr kerf_force touch = table_of<TouchCount>(touch_signals);
constexpr kerf_force volumetric = table_of<VolumetricDrilling>(volumetric_signals);
constexpr kerf_force hsieh = table_of<Hsieh2006>(hsieh_signals);
constexpr kerf_force dental = table_of<DentalImplant>(dental_signals);

constexpr kerf_component components[] = {
    {sizeof(kerf_component), KERF_KIND_TOOL, "paper_drill", "A twist drill as the papers have it.", tool_parameters,
     tool_parameter_count, 0, &paper_drill_tool, nullptr, nullptr},
    {sizeof(kerf_component), KERF_KIND_FORCE, "tsai_2007", "[tsai-2007] sections 5.1 to 5.3, as printed.",
     tsai_parameters, Tsai2007::force_parameter_count, 0, nullptr, &tsai, nullptr},
    {sizeof(kerf_component), KERF_KIND_FORCE, "touch_count", "[tsai-2007] section 4, as printed.", touch_parameters,
     TouchCount::force_parameter_count, 0, nullptr, &touch, nullptr},
    {sizeof(kerf_component), KERF_KIND_FORCE, "volumetric_drilling",
     "[volumetric-drilling] equations 1 and 2, as printed.", volumetric_parameters,
     VolumetricDrilling::force_parameter_count, 0, nullptr, &volumetric, nullptr},
    {sizeof(kerf_component), KERF_KIND_TOOL, "paper_saw", "An oscillating saw as [hsieh-2006] has it.", saw_parameters,
     saw_parameter_count, 0, &paper_saw_tool, nullptr, nullptr},
    {sizeof(kerf_component), KERF_KIND_FORCE, "hsieh_2006", "[hsieh-2006] sections 2.3 and 2.4, as printed.",
     hsieh_parameters, Hsieh2006::force_parameter_count, 0, nullptr, &hsieh, nullptr},
    {sizeof(kerf_component), KERF_KIND_FORCE, "dental_implant", "[dental-implant-2013] equations 4 to 13, as printed.",
     dental_parameters, DentalImplant::force_parameter_count, 0, nullptr, &dental, nullptr},
};

}  // namespace
}  // namespace kerf::as_printed

extern "C" __attribute__((visibility("default"))) const kerf_entry kerf_plugin_entry;
extern "C" const kerf_entry kerf_plugin_entry{KERF_MAGIC,
                                              KERF_ABI_VERSION,
                                              sizeof(kerf_entry),
                                              static_cast<uint32_t>(std::size(kerf::as_printed::components)),
                                              KERF_LAYOUT_INIT,
                                              "bench.as_printed",
                                              "0.1.0",
                                              "Apache-2.0",
                                              __VERSION__,
                                              kerf::as_printed::components};
