// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/touch_probe.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "kerf/plugin.hpp"

namespace kerf::stability {

namespace {

using namespace literals;

constexpr std::size_t max_points = 1000;

struct Probe {
    double points;

    static constexpr auto about() {
        return describe("probe", "A thin rod.",
                        param(&Probe::points, {.id = "points",
                                               .help = "How many points it touches with.",
                                               .min = 1.0,
                                               .max = max_points,
                                               .def = 1.0,
                                               .source = "the study's"}));
    }
    [[nodiscard]] Outline outline() const {
        return revolution({{0.0, 0.0}, {-0.5e-3, 0.5e-3}})
            .cuts()  // nothing: `Touch` never cuts
            .to(-probe_length, 0.5e-3)
            .gripped_at(points > 1.0 ? -0.5 * probe_length : -probe_length);
    }
};

struct Touch {
    double stiffness;

    static constexpr auto about() {
        return describe("touch", "Contact of all points along the rod.",
                        param(&Touch::stiffness, {.id = "stiffness",
                                                  .help = "Stiffness of bone at each point.",
                                                  .unit = unit::N_per_mm,
                                                  .min = 0.0,
                                                  .max = 1e9_N_per_mm,
                                                  .def = 500.0_N_per_mm,
                                                  .source = "the study's"}),
                        budget_us(5));
    }
    void resist(const Held<Probe>& probe, const BoneQuery& bone, Channels& channels) const noexcept {
        std::array<Vec3, max_points> place{};
        std::array<kerf_surface_point, max_points> surface{};
        const auto count = static_cast<std::size_t>(probe.points);
        for (std::size_t i = 1; i < count; ++i)
            place[i].z = -probe_length * static_cast<double>(i) / static_cast<double>(count - 1);
        bone.nearest({place.data(), count}, {surface.data(), count});
        const std::size_t groups = std::min<std::size_t>(count, KERF_MAX_CHANNELS);
        for (std::size_t g = 0; g < groups; ++g) {
            Vec6 along{};
            double depth = 0.0, met = 0.0;
            for (std::size_t i = g * count / groups; i < (g + 1) * count / groups; ++i) {
                if (surface[i].body < 0) continue;
                const Vec6 d = rate_at(place[i], -surface[i].normal);
                for (std::size_t k = 0; k < 6; ++k) along[k] += d[k];
                depth -= surface[i].distance;
                met += 1.0;
            }
            if (met == 0.0) continue;
            kerf_channel* touch = channels.add(KERF_CONTACT, static_cast<std::uint32_t>(g + 1));
            for (std::size_t k = 0; k < 6; ++k) touch->d[k] = along[k] / met;
            touch->k = met * stiffness;
            touch->delta = depth / met;
        }
    }
};

using Components = PluginTables<Probe, Touch>;

}  // namespace

ToolSetup touch_probe(int points, double stiffness) {
    const double count = std::clamp(points, 1, static_cast<int>(max_points));
    return {.tool = &Components::components[0],
            .force = &Components::components[1],
            .tool_parameters = {count},
            .force_parameters = {stiffness},
            .drives = {},
            .bound = {}};
}

}  // namespace kerf::stability
