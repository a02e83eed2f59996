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
constexpr double min_upright = 0.2;        // cosine: a surface more parallel to the ray is not its far side [judgement]
constexpr double min_normal_z = -0.3;      // n̂·ẑ: below it, the surface faces the side of the tip [judgement]
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

Shells::Shells(std::span<const Ray> rays, double step, double friction, const BoneQuery& bone) noexcept {
    KERF_ASSERT(rays.size() <= max_rays, "ask about fewer ways at a time");

    Sections sections;
    Ended ended;
    follow(rays, step, bone, sections, ended);
    find_sides(rays, step, bone, sections, ended);
    find_loads(rays, step, friction, bone, sections, ended);
}

void Shells::follow(std::span<const Ray> rays, double step, const BoneQuery& bone, Sections& sections,
                    Ended& ended) noexcept {
    std::array<std::size_t, max_rays> followed;
    std::array<Vec3, max_rays> at, along;
    std::array<kerf_bone_sample, max_rays> here;
    std::size_t count = rays.size();
    for (std::size_t i = 0; i < count; ++i) followed[i] = i;
    for (std::size_t n = 0; n < max_steps && count > 0; ++n) {
        for (std::size_t i = 0; i < count; ++i) {
            along[i] = rays[followed[i]].along;
            at[i] = rays[followed[i]].from + (static_cast<double>(n) + 0.5) * step * along[i];
        }
        bone.sample({at.data(), count}, {along.data(), count}, {here.data(), count});
        std::size_t going_on = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t ray = followed[i];
            Section& section = sections[ray];
            section.add(n, strength_at(here[i], bone), here[i].engagement);
            if (section.ends > 0 && n + 1 == section.ends + free_steps)
                ended.ray[ended.count++] = ray;
            else
                followed[going_on++] = ray;
        }
        count = going_on;
    }
    for (std::size_t i = 0; i < count; ++i)
        if (const Section& section = sections[followed[i]]; section.ends > 0)
            shell_[followed[i]] = {.load = Shell::never, .air = static_cast<double>(section.begins) * step};
}

void Shells::find_sides(std::span<const Ray> rays, double step, const BoneQuery& bone, const Sections& sections,
                        Ended& ended) noexcept {
    std::array<double, 2 * max_rays> in, out;  // [m] inside and outside the shell: far sides first, then near sides
    std::array<Vec3, 2 * max_rays> at, along;
    std::array<kerf_bone_sample, 2 * max_rays> here;
    for (std::size_t i = 0; i < ended.count; ++i) {
        const auto [begin, end] = sections[ended.ray[i]].shell();
        const auto at_step = [&](std::size_t n) { return (static_cast<double>(n) + 0.5) * step; };
        in[i] = at_step(end - 1);
        out[i] = at_step(end);
        in[ended.count + i] = at_step(begin);
        out[ended.count + i] = begin > 0 ? at_step(begin - 1) : 0.0;
        along[i] = along[ended.count + i] = rays[ended.ray[i]].along;
    }
    for (int halving = 0; halving < halvings; ++halving) {
        for (std::size_t i = 0; i < 2 * ended.count; ++i)
            at[i] = rays[ended.ray[i % ended.count]].from + 0.5 * (in[i] + out[i]) * along[i];
        bone.sample({at.data(), 2 * ended.count}, {along.data(), 2 * ended.count}, {here.data(), 2 * ended.count});
        for (std::size_t i = 0; i < 2 * ended.count; ++i) {
            const bool is_in =
                strength_at(here[i], bone) >= of_strongest * sections[ended.ray[i % ended.count]].strongest;
            (is_in ? in : out)[i] = 0.5 * (in[i] + out[i]);
        }
    }
    for (std::size_t i = 0; i < ended.count; ++i) {
        ended.far[i] = 0.5 * (in[i] + out[i]);
        ended.near[i] = 0.5 * (in[ended.count + i] + out[ended.count + i]);
    }
}

void Shells::find_loads(std::span<const Ray> rays, double step, double friction, const BoneQuery& bone,
                        const Sections& sections, const Ended& ended) noexcept {
    std::array<Vec3, max_rays> at;
    std::array<kerf_surface_point, max_rays> near;
    for (std::size_t i = 0; i < ended.count; ++i)
        at[i] = rays[ended.ray[i]].from + ended.far[i] * rays[ended.ray[i]].along;
    bone.nearest({at.data(), ended.count}, {near.data(), ended.count});
    for (std::size_t i = 0; i < ended.count; ++i) {
        const Ray& ray = rays[ended.ray[i]];
        Shell& shell = shell_[ended.ray[i]];
        shell.air = static_cast<double>(sections[ended.ray[i]].begins) * step;
        const Vec3 n = near[i].normal;
        const double upright = dot(n, ray.along), c = std::clamp(n.z, ray.min_cosine, 1.0);
        if (upright < min_upright || n.z < min_normal_z) {
            shell.load = Shell::never;
            continue;
        }
        const double load = plate(sections[ended.ray[i]].mean(), (ended.far[i] - ended.near[i]) * upright);
        shell = {.load = load * (c + friction * std::sqrt(1.0 - c * c)),
                 .before = ended.near[i],
                 .air = shell.air,
                 .normal = n,
                 .far = at[i]};
    }
}

}  // namespace kerf::drilling
