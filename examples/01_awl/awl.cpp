// SPDX-License-Identifier: Apache-2.0
#include <kerf/plugin.hpp>

using namespace kerf;

struct Awl {  // a tool: its members are its parameters
    double diameter;
    static constexpr auto about() {
        return describe("awl", "A round awl.",
                        param(&Awl::diameter, {.id = "diameter",
                                               .help = "Diameter of the shaft.",
                                               .unit = unit::mm,
                                               .min = 1_mm,
                                               .max = 10_mm,
                                               .def = 4_mm,
                                               .source = "assumed"}));
    }
    Outline outline() const {
        return revolution({{0, 0}, {-diameter, diameter / 2}, {-90_mm, diameter / 2}}).gripped_at(-100_mm);
    }
};

struct Press {  // a law: what the hand feels through the tool
    double stiffness;
    static constexpr auto about() {
        return describe("press", "Elastic contact at the tip.", work({.channels = 1, .points = 1, .queries = 1}),
                        param(&Press::stiffness, {.id = "stiffness",
                                                  .help = "Stiffness of bone under the tip.",
                                                  .unit = unit::N_per_mm,
                                                  .min = 1_N_per_mm,
                                                  .max = 1e4_N_per_mm,
                                                  .def = 500_N_per_mm,
                                                  .source = "assumed"}));
    }
    void resist(const Held<Awl>&, const BoneQuery& bone, Channels& channels) const noexcept {
        if (const SurfacePoint tip = bone.nearest({0, 0, 0}); tip.is_within(0.3_mm))
            channels.contact({.id = 1, .along = -tip.normal, .stiffness = stiffness, .depth = -tip.distance});
    }
};
KERF_PLUGIN("example.awl", "0.1.0", "Apache-2.0", Awl, Press)
