// SPDX-License-Identifier: Apache-2.0
#include "bone_shell.h"

#include <algorithm>
#include <cmath>

#include "drill_edges.h"
#include "kerf/assert.hpp"
#include "kerf/units.hpp"

namespace kerf::drilling {

namespace {

constexpr double tension = 133.0 / 193.0;  // [–] of strength in compression; cortex, lengthwise [reilly-burstein-1975]
constexpr double of_strongest = 0.5;       // [–] weaker bone is not part of the shell [judgement]
constexpr std::size_t free_steps = 2;      // this many steps of air in a row are the far side [judgement]
constexpr double most_askew = 0.2;         // cosine: a surface more parallel to the ray is not its far side [judgement]
constexpr double most_backwards = -0.3;    // n̂·ẑ: below it, the surface faces the side of the tip [judgement]
constexpr int halvings = 3;                // bisections of the step that contains a side of the shell

double strength_at(const kerf_bone_sample& here, const BoneQuery& bone) noexcept {
    return tension * here.engagement * crushing_pressure(here, bone.tissue_count());
}

/// Returns 4π m [N] of an upright shell of thickness `thick` [m] and strength `sigma` [Pa].
double plate(double sigma, double thick) noexcept { return 4.0 * pi * sigma * thick * thick / 6.0; }

}  // namespace

void Shells::Section::add(std::size_t step, double sigma, double engagement) noexcept {
    strength[step] = sigma;
    bone[step] = engagement;
    strongest = std::max(strongest, sigma);
    if (sigma <= 0.0) return;
    if (ends == 0) begins = step;
    ends = step + 1;
}

std::pair<std::size_t, std::size_t> Shells::Section::shell() const noexcept {
    const auto is_strong = [&](std::size_t step) { return strength[step] >= of_strongest * strongest; };
    std::size_t end = ends;
    while (end > 0 && !is_strong(end - 1)) --end;
    std::size_t begin = end;
    while (begin > 0 && is_strong(begin - 1)) --begin;
    return {begin, end};
}

double Shells::Section::mean() const noexcept {
    const auto [begin, end] = shell();
    double sum = 0.0, of_bone = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
        sum += strength[i];
        of_bone += bone[i];
    }
    return sum / of_bone;
}

Shells::Shells(std::span<const WayOut> ways, double step, double friction, const BoneQuery& bone) noexcept {
    KERF_ASSERT(ways.size() <= most, "ask about fewer ways at a time");

    Sections sections;
    Ended ended;
    follow(ways, step, bone, sections, ended);
    find_sides(ways, step, bone, sections, ended);
    tell(ways, step, friction, bone, sections, ended);
}

void Shells::follow(std::span<const WayOut> ways, double step, const BoneQuery& bone, Sections& sections,
                    Ended& ended) noexcept {
    std::array<std::size_t, most> followed;
    std::array<Vec3, most> at, along;
    std::array<kerf_bone_sample, most> here;
    std::size_t count = ways.size();
    for (std::size_t i = 0; i < count; ++i) followed[i] = i;
    for (std::size_t n = 0; n < most_steps && count > 0; ++n) {
        for (std::size_t i = 0; i < count; ++i) {
            along[i] = ways[followed[i]].along;
            at[i] = ways[followed[i]].from + (static_cast<double>(n) + 0.5) * step * along[i];
        }
        bone.sample({at.data(), count}, {along.data(), count}, {here.data(), count});
        std::size_t going_on = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t way = followed[i];
            Section& section = sections[way];
            section.add(n, strength_at(here[i], bone), here[i].engagement);
            if (section.ends > 0 && n + 1 == section.ends + free_steps)
                ended.way[ended.count++] = way;
            else
                followed[going_on++] = way;
        }
        count = going_on;
    }
    for (std::size_t i = 0; i < count; ++i)
        if (const Section& section = sections[followed[i]]; section.ends > 0)
            shell_[followed[i]] = {.load = Shell::never, .air = static_cast<double>(section.begins) * step};
}

void Shells::find_sides(std::span<const WayOut> ways, double step, const BoneQuery& bone, const Sections& sections,
                        Ended& ended) noexcept {
    std::array<double, 2 * most> in, out;  // [m] inside and outside the shell: far sides first, then near sides
    std::array<Vec3, 2 * most> at, along;
    std::array<kerf_bone_sample, 2 * most> here;
    for (std::size_t i = 0; i < ended.count; ++i) {
        const auto [begin, end] = sections[ended.way[i]].shell();
        const auto at_step = [&](std::size_t n) { return (static_cast<double>(n) + 0.5) * step; };
        in[i] = at_step(end - 1);
        out[i] = at_step(end);
        in[ended.count + i] = at_step(begin);
        out[ended.count + i] = begin > 0 ? at_step(begin - 1) : 0.0;
        along[i] = along[ended.count + i] = ways[ended.way[i]].along;
    }
    for (int halving = 0; halving < halvings; ++halving) {
        for (std::size_t i = 0; i < 2 * ended.count; ++i)
            at[i] = ways[ended.way[i % ended.count]].from + 0.5 * (in[i] + out[i]) * along[i];
        bone.sample({at.data(), 2 * ended.count}, {along.data(), 2 * ended.count}, {here.data(), 2 * ended.count});
        for (std::size_t i = 0; i < 2 * ended.count; ++i) {
            const bool is_in =
                strength_at(here[i], bone) >= of_strongest * sections[ended.way[i % ended.count]].strongest;
            (is_in ? in : out)[i] = 0.5 * (in[i] + out[i]);
        }
    }
    for (std::size_t i = 0; i < ended.count; ++i) {
        ended.far[i] = 0.5 * (in[i] + out[i]);
        ended.near[i] = 0.5 * (in[ended.count + i] + out[ended.count + i]);
    }
}

void Shells::tell(std::span<const WayOut> ways, double step, double friction, const BoneQuery& bone,
                  const Sections& sections, const Ended& ended) noexcept {
    std::array<Vec3, most> at;
    std::array<kerf_surface_point, most> near;
    for (std::size_t i = 0; i < ended.count; ++i)
        at[i] = ways[ended.way[i]].from + ended.far[i] * ways[ended.way[i]].along;
    bone.nearest({at.data(), ended.count}, {near.data(), ended.count});
    for (std::size_t i = 0; i < ended.count; ++i) {
        const WayOut& way = ways[ended.way[i]];
        Shell& shell = shell_[ended.way[i]];
        shell.air = static_cast<double>(sections[ended.way[i]].begins) * step;
        const Vec3 n = near[i].normal;
        const double upright = dot(n, way.along), c = std::clamp(n.z, way.least, 1.0);
        if (upright < most_askew || n.z < most_backwards) {
            shell.load = Shell::never;
            continue;
        }
        const double load = plate(sections[ended.way[i]].mean(), (ended.far[i] - ended.near[i]) * upright);
        shell = {.load = load * (c + friction * std::sqrt(1.0 - c * c)),
                 .before = ended.near[i],
                 .air = shell.air,
                 .normal = n,
                 .far = at[i]};
    }
}

}  // namespace kerf::drilling
