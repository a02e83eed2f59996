// SPDX-License-Identifier: Apache-2.0
#include "bone/import/fit_neck.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace kerf::bone {
namespace {

constexpr int sections = 61;
constexpr double nearest = 0.5, farthest = 2.0;  // [–] radii of the head from its centre
constexpr double widest = 1.1;                   // [–] of the smallest area
constexpr int max_rounds = 60;
constexpr double at_rest = 1e-8;  // [–] change of the direction

struct Section {
    double depth = 0.0;  ///< [m] from the head's centre
    Vec3 centroid{};
    double area = 0.0;  ///< [m²]; 0: open, or no bone
};

/// Sums sectors of a circle between the rays: each has the area ρ² dθ / 2, and its centroid at 2/3 ρ.
Section section_at(const BoneShape& bone, const NeckGuess& guess, const std::vector<Vec3>& directions, Vec3 to_base,
                   double depth) {
    constexpr double pi = 3.14159265358979323846;
    Section section{depth, guess.head + depth * to_base, 0.0};
    double squares = 0.0;
    Vec3 cubes{};
    for (const Vec3 out : directions) {
        const RayHit hit = surface_inwards(bone, section.centroid, out, guess.head_radius);
        if (hit.kind == RayHit::Kind::starts_in_bone) return section;
        squares += hit.radius * hit.radius;
        cubes = cubes + hit.radius * hit.radius * hit.radius * out;
    }
    if (squares == 0.0) return section;
    section.area = squares * pi / static_cast<double>(directions.size());
    section.centroid = section.centroid + (2.0 / 3.0 / squares) * cubes;
    return section;
}

/// Returns the narrowest section if it lies between wider ones. A section without an area counts as wider.
std::optional<std::size_t> narrowest(const std::vector<Section>& all) {
    const auto area = [&](std::size_t i) { return all[i].area > 0.0 ? all[i].area : HUGE_VAL; };
    std::size_t smallest = 0;
    for (std::size_t i = 1; i < all.size(); ++i)
        if (area(i) < area(smallest)) smallest = i;
    const bool is_between = smallest > 0 && smallest + 1 < all.size() && area(smallest) < HUGE_VAL;
    return is_between ? std::optional(smallest) : std::nullopt;
}

}  // namespace

std::optional<FittedNeck> fit_neck(const BoneShape& bone, const NeckGuess& guess) {
    FittedNeck fitted;
    Vec3 to_base = normalized(guess.to_base);
    for (int round = 0; round < max_rounds; ++round) {
        const std::vector<Vec3> directions = directions_across(to_base);
        std::vector<Section> all;
        for (int i = 0; i < sections; ++i)
            all.push_back(section_at(bone, guess, directions, to_base,
                                     guess.head_radius * (nearest + (farthest - nearest) * i / (sections - 1))));
        const auto smallest = narrowest(all);
        if (!smallest) return std::nullopt;
        const double limit = widest * all[*smallest].area;
        const auto counts = [&](const Section& s) { return s.area > 0.0 && s.area < limit; };
        std::size_t first = *smallest, last = *smallest;
        while (first > 0 && counts(all[first - 1])) --first;
        while (last + 1 < all.size() && counts(all[last + 1])) ++last;

        Vec3 sum{};
        double weights = 0.0, squares = 0.0;
        for (std::size_t i = first; i <= last; ++i) {
            const double weight = limit - all[i].area;
            sum = sum + weight * all[i].depth * (all[i].centroid - guess.head);
        }
        const Vec3 before = to_base;
        to_base = normalized(sum);
        for (std::size_t i = first; i <= last; ++i) {
            const double weight = limit - all[i].area, off = length(cross(all[i].centroid - guess.head, to_base));
            squares += weight * off * off;
            weights += weight;
        }
        fitted = {to_base, all[*smallest].centroid, all[*smallest].area, std::sqrt(squares / weights),
                  static_cast<int>(last - first + 1)};
        if (length(to_base - before) < at_rest) break;
    }
    return fitted;
}

}  // namespace kerf::bone
