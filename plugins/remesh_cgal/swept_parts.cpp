// SPDX-License-Identifier: GPL-3.0-or-later
#include "swept_parts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "kerf/remesh_solids.hpp"

namespace kerf::remesh_cgal {
namespace {

/// Returns the next number of a fixed sequence.
std::uint64_t scrambled(std::uint64_t& state) noexcept {
    state += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/// Returns a random vector with components up to the nudge.
Vec3 nudged(const Nudge& nudge, std::uint64_t& state) noexcept {
    const auto next = [&] { return nudge.largest * (static_cast<double>(scrambled(state) >> 11) * 0x1p-52 - 1.0); };
    const double x = next(), y = next(), z = next();
    return {x, y, z};
}

using remeshing::convex_runs, remeshing::Profile;

void add_ring(const kerf_profile_point& point, std::size_t sides, ConvexPart& part) {
    if (point.radius <= 0.0) {
        part.push_back({0, 0, point.z});
        return;
    }
    const double turn = 2.0 * std::numbers::pi / static_cast<double>(sides);
    const double radius = point.radius * std::sqrt(turn / std::sin(turn));  // of the same area
    for (std::size_t i = 0; i < sides; ++i) {
        const double angle = turn * static_cast<double>(i);
        part.push_back({radius * std::cos(angle), radius * std::sin(angle), point.z});
    }
}

/// Returns the corners of the solid's convex parts, tool frame.
std::vector<ConvexPart> parts_of(const CutSolid& solid, double tolerance) {
    std::vector<ConvexPart> parts;
    if (solid.kerf > 0.0) {
        ConvexPart& part = parts.emplace_back();
        for (const kerf_profile_point& p : solid.profile)
            for (const double y : {-0.5 * solid.kerf, 0.5 * solid.kerf}) {
                part.push_back({p.radius, y, p.z});
                if (p.radius > 0.0) part.push_back({-p.radius, y, p.z});
            }
        return parts;
    }
    double widest = 0.0;
    for (const kerf_profile_point& p : solid.profile) widest = std::max(widest, p.radius);
    const double needed = std::numbers::pi * std::sqrt(widest / (2.0 * tolerance));
    const auto sides = static_cast<std::size_t>(std::clamp(std::ceil(needed), 16.0, 128.0));
    for (const Profile run : convex_runs(solid.profile)) {
        ConvexPart& part = parts.emplace_back();
        for (const kerf_profile_point& p : run) add_ring(p, sides, part);
    }
    return parts;
}

/// Returns the part made smaller on all sides by the components of `by` [m].
ConvexPart shrunk(ConvexPart part, Vec3 by) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Vec3 p : part) {
        low = std::min(low, p.z);
        high = std::max(high, p.z);
    }
    const auto inwards = [](double from_middle, double distance) {
        return from_middle > 0.0 ? -distance : from_middle < 0.0 ? distance : 0.0;
    };
    for (Vec3& p : part) p = p + Vec3{inwards(p.x, by.x), inwards(p.y, by.y), inwards(p.z - 0.5 * (low + high), by.z)};
    return part;
}

/// Returns a hash of a pose's bits.
std::uint64_t number_of(const Pose& pose) noexcept {
    std::uint64_t number = 0;
    for (const double x : {pose.position.x, pose.position.y, pose.position.z, pose.rotation.w, pose.rotation.x,
                           pose.rotation.y, pose.rotation.z}) {
        number ^= std::bit_cast<std::uint64_t>(x + 0.0 /* no −0 */);
        number = scrambled(number);
    }
    return number;
}

}  // namespace

std::vector<ConvexPart> swept_parts(const CutSolid& solid, const Pose& from, const Pose& to, double tolerance,
                                    const Nudge& nudge) {
    constexpr double max_shrinkage = 4e-8, taper = 6e-8;  // [m]
    Pose start = from, end = to;
    std::uint64_t number = number_of(to), state = number + nudge.seed;
    start.position = start.position + nudged(nudge, state);
    end.position = end.position + nudged(nudge, state);
    const auto apart = [&] { return max_shrinkage * (static_cast<double>(scrambled(number) >> 11) * 0x1p-53); };
    const double x = apart(), y = apart(), z = apart();
    const Vec3 at_end{x, y, z}, at_start = at_end + Vec3{taper, taper, taper};
    std::vector<ConvexPart> swept;
    for (const ConvexPart& part : parts_of(solid, tolerance)) {
        ConvexPart& both = swept.emplace_back();
        for (const Vec3 corner : shrunk(part, at_start)) both.push_back(start * corner);
        for (const Vec3 corner : shrunk(part, at_end)) both.push_back(end * corner);
    }
    return swept;
}

}  // namespace kerf::remesh_cgal
