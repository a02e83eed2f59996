// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "kerf/exact_math.hpp"
#include "kerf/plugin.hpp"
#include "paper_units.h"

/// The drill of the papers as sample points. Tool frame: origin at the tip, +z out of the tip.
namespace kerf::as_printed {

struct PaperDrill {
    double radius;    ///< [m]
    double half_web;  ///< b [m]
    double length;    ///< [m] tip to chuck
    SinCos p;         ///< of the point's half angle

    /// Where chisel edge and lips meet [m]: half web over sin 55°. The papers do not say; points with r < b would give
    /// the root of a negative number (E00-7).
    [[nodiscard]] double chisel_radius() const noexcept { return half_web / 0.81915204428899180; }
    [[nodiscard]] double point_depth() const noexcept { return radius * p.cos / p.sin; }
};

/// The tool of the papers: a twist drill without a motor.
struct PaperBit {
    double diameter, point_angle, web, length;
    double spindle_speed;

    static constexpr auto about() {
        using namespace literals;
        return describe("paper_drill", "A twist drill as the papers have it.",
                        param(&PaperBit::diameter, {.id = "diameter",
                                                    .help = "Diameter over the lips.",
                                                    .unit = unit::mm,
                                                    .min = 0.5_mm,
                                                    .max = 20.0_mm,
                                                    .def = 5.4_mm,
                                                    .source = "the largest drill of [tsai-2007]"}),
                        param(&PaperBit::point_angle, {.id = "point_angle",
                                                       .help = "Full angle of the point.",
                                                       .unit = unit::deg,
                                                       .min = 60.0_deg,
                                                       .max = 160.0_deg,
                                                       .def = 118.0_deg,
                                                       .source = not_stated}),
                        param(&PaperBit::web, {.id = "web",
                                               .help = "Web thickness at the point, as a fraction of the diameter.",
                                               .min = 0.05,
                                               .max = 0.4,
                                               .def = 0.15,
                                               .source = not_stated}),
                        param(&PaperBit::length, {.id = "length",
                                                  .help = "From the tip to the chuck.",
                                                  .unit = unit::mm,
                                                  .min = 10.0_mm,
                                                  .max = 300.0_mm,
                                                  .def = 100.0_mm,
                                                  .source = "[tsai-2007]: points as far as 10 cm"}),
                        drive(&PaperBit::spindle_speed, {.id = "spindle_speed",
                                                         .help = "Speed of the spindle; no motor is modelled.",
                                                         .unit = unit::rpm,
                                                         .min = 0.0,
                                                         .max = 50000.0_rpm,
                                                         .def = 1000.0_rpm}));
    }
    [[nodiscard]] PaperDrill drill() const noexcept;
    [[nodiscard]] Outline outline() const noexcept;
};

/// A sample point on a lip: an element of it.
struct LipPoint {
    Vec3 place;    ///< [m]
    double r;      ///< [m] from the shaft
    double width;  ///< dw [m] along the lip
    double side;   ///< +1 on the first lip, −1 on the other
};
inline constexpr int lip_count = 2;
inline constexpr std::size_t max_lip_points = 512;
struct LipPoints {
    std::array<LipPoint, max_lip_points> point;
    std::size_t count = 0;
};
/// Both lips at equal steps of at most `interval` [m] along them, the first at `angle` [rad].
[[nodiscard]] LipPoints lip_points(const PaperDrill& drill, double interval, double angle) noexcept;

inline constexpr std::size_t chunk = 128;  ///< points asked about at once

/// Calls `use(point, outward normal, is_in_bone)` for every point on the drill's surface: circles at `interval` from
/// the tip to `length` behind it, points at `interval` around each.
///
/// Source: [tsai-2007] section 4: from the end to 10 cm above, one voxel apart, some 2000 for 5.4 mm.
template <class Use>
void for_each_surface_point(const PaperDrill& drill, double interval, double length, const BoneQuery& bone,
                            const Use& use) noexcept {
    std::array<Vec3, chunk> point{}, normal{};
    std::array<kerf_bone_sample, chunk> sample;
    std::size_t held = 0;
    const auto ask = [&] {
        bone.sample({point.data(), held}, {0, 0, 1}, {sample.data(), held});
        for (std::size_t i = 0; i < held; ++i) use(point[i], normal[i], sample[i].engagement >= 0.5);
        held = 0;
    };
    const int rings = static_cast<int>(length / interval);
    for (int k = 1; k <= rings; ++k) {
        const double z = k * interval;
        const bool is_on_point = z < drill.point_depth();
        const double r = is_on_point ? z * drill.p.sin / drill.p.cos : drill.radius;
        const int around = static_cast<int>(2.0 * pi * r / interval) + 1;
        const SinCos step = sin_cos_exact(2.0 * pi / around);
        double c = 1.0, s = 0.0;
        for (int i = 0; i < around; ++i) {
            point[held] = {r * c, r * s, -z};
            normal[held] = is_on_point ? Vec3{drill.p.cos * c, drill.p.cos * s, drill.p.sin} : Vec3{c, s, 0.0};
            if (++held == chunk) ask();
            const double turned = c * step.cos - s * step.sin;
            s = s * step.cos + c * step.sin;
            c = turned;
        }
    }
    ask();
}

/// What every law of the papers keeps: how the drill turned and moved in the last interval. The papers difference two
/// device positions; so does the host, and tells it in `commit`.
struct LastInterval {
    double angle = 0.0;  ///< [rad] of the first lip
    Vec6 rate{};         ///< tool frame [m/s, rad/s]

    void advance(const Held<PaperBit>& tool, const Advance& moved) noexcept;
};

}  // namespace kerf::as_printed
