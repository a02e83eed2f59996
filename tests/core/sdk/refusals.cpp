// SPDX-License-Identifier: Apache-2.0
// A plugin with one mistake, chosen by MISTAKE: the compiler must refuse it in the words beside it. Read by
// check_refusals.cmake.
#include "kerf/plugin.hpp"

#ifndef MISTAKE
#define MISTAKE 0
#endif

using namespace kerf;
using namespace kerf::literals;

// clang-format off
struct Awl {
    double diameter, length;
    static constexpr auto about() {
        return describe("awl", "A round awl.",
            param(&Awl::diameter, {.id = "diameter", .help = "Across.", .unit = unit::mm,
#if MISTAKE == 1  // a default lies outside its range
                .min = 1_mm, .max = 10_mm, .def = 40_mm,
#elif MISTAKE == 2
                .min = 1_mm, .max = 10_mm, .def = 4_deg,
#elif MISTAKE == 3
                .min = 1.0, .max = 10_mm, .def = 4_mm,
#else
                .min = 1_mm, .max = 10_mm, .def = 4_mm,
#endif
                .source = "assumed"}),
            param(&Awl::length, {
#if MISTAKE == 4  // two ids are equal
                .id = "diameter",
#elif MISTAKE == 5
                .id = "the length",
#else
                .id = "length",
#endif
                .help = "Along.", .unit = unit::mm, .min = 10_mm, .max = 300_mm, .def = 90_mm,
#if MISTAKE == 6  // a source is missing
                .source = ""}));
#else
                .source = "assumed"}));
#endif
    }
    Outline outline() const { return revolution({{0, 0}, {-diameter, diameter / 2}}); }
};
#if MISTAKE == 2  // another dimension than its unit
#endif
#if MISTAKE == 3  // another dimension than its unit
#endif
#if MISTAKE == 5  // other characters than a-z
#endif

struct Needle : Awl {};

struct Press {
    double stiffness;
    enum class Happened { touched, left };
    static constexpr auto about() {
        return describe("press", "Elastic contact.",
            param(&Press::stiffness, {.id = "stiffness", .help = "Of bone.", .unit = unit::N_per_mm, .min = 1_N_per_mm,
                                      .max = 900_N_per_mm, .def = 500_N_per_mm, .source = "assumed"}),
#if MISTAKE == 7  // an event does not begin with the name of its plugin
            event(Happened::touched, {.id = "drilling.touched", .help = "It touched."}),
#elif MISTAKE == 8
            event(Happened::left, {.id = "awl.left", .help = "It left."}),
#else
            event(Happened::touched, {.id = "awl.touched", .help = "It touched."}),
#endif
#if MISTAKE == 9  // `off` of a feature lies outside the range
            effect(&Press::stiffness, {.id = "contact", .help = "It touches.", .off = 0.0}));
#elif MISTAKE == 10
            effect(&Press::stiffness, {.id = "contact", .help = "It touches.", .off = 5_mm}));
#else
            effect(&Press::stiffness, {.id = "contact", .help = "It touches.", .off = 1_N_per_mm}));
#endif
    }
#if MISTAKE == 8  // events are missing or not in the order of their enumeration
#endif
#if MISTAKE == 10  // `off` of a feature has another dimension
#endif
#if MISTAKE == 11  // write `void resist(
    void resist(const Held<Awl>&, const BoneQuery& bone, Channels& channels) const {
#elif MISTAKE == 12
    void resist(const Held<Needle>&, const BoneQuery& bone, Channels& channels) const noexcept {
#else
    void resist(const Held<Awl>& tool, const BoneQuery& bone, Channels& channels) const noexcept {
        static_cast<void>(tool);
#endif
        const SurfacePoint tip = bone.nearest({0, 0, 0});
        if (tip.is_within(0.3_mm)) channels.contact({.id = 1, .along = -tip.normal, .stiffness = stiffness, .depth = -tip.distance});
#if MISTAKE == 13  // width
        channels.push({tool.width, 0, 0}, {});
#endif
    }
#if MISTAKE == 12  // a tool that this KERF_PLUGIN does not list
#endif
#if MISTAKE == 14  // commit must be noexcept
    void commit(const Held<Awl>&, const BoneQuery&, const Advance&, detail::NoState&, Actions&) const {}
#endif
};
// clang-format on

KERF_PLUGIN("example.awl", "0.1.0", "Apache-2.0", Awl, Press)
