// SPDX-License-Identifier: Apache-2.0
#include "bone/import/fit_tube.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "bone/import/fit_sphere.h"
#include "bone/import/least_squares.h"

namespace kerf::bone {
namespace {

constexpr int sections = 41;
constexpr int max_rounds = 60;
constexpr double widest_band = 0.10;        // [–] of the radius: a point farther off belongs to another surface
constexpr double narrowest_band = 0.02e-3;  // [m]
constexpr double met_around = 0.75;         // [–] of a section's rays; with fewer hits, it is part of something wider
constexpr double at_rest = 1e-7;            // [m]

struct Axis {
    Vec3 from{}, to{};
    [[nodiscard]] Vec3 along() const noexcept { return normalized(to - from); }
    [[nodiscard]] Vec3 at(double fraction) const noexcept { return from + fraction * (to - from); }
    [[nodiscard]] Vec3 foot(Vec3 p) const noexcept { return from + dot(p - from, along()) * along(); }
};

/// A point of a section, relative to the axis.
struct WallPoint {
    Vec3 out{};             ///< unit
    double distance = 0.0;  ///< [m] from the axis
};

struct Section {
    double fraction = 0.0;  ///< [–] position along the axis
    std::vector<WallPoint> points;
    double radius = 0.0;  ///< [m] median distance
};

Section section_at(const BoneShape& bone, Vec3 centre, const std::vector<Vec3>& directions, double fraction,
                   double far) {
    Section section{fraction, {}, 0.0};
    std::vector<double> distances;
    for (const Vec3 out : directions) {
        const RayHit hit = surface_inwards(bone, centre, out, far);
        if (hit.kind != RayHit::Kind::surface) continue;
        section.points.push_back({out, hit.radius});
        distances.push_back(hit.radius);
    }
    if (distances.empty()) return section;
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    section.radius = *middle;
    return section;
}

bool is_met_around(const Section& section, std::size_t rays, double radius) {
    return static_cast<double>(section.points.size()) >= met_around * static_cast<double>(rays) &&
           std::abs(section.radius / radius - 1.0) <= max_size_deviation;
}

/// Returns the middle of the section near `at`. The search is repeated from each new middle, because the points lie
/// evenly around the middle only as seen from there.
std::optional<Vec3> middle_near(const BoneShape& bone, Vec3 at, const std::vector<Vec3>& directions,
                                const TubeGuess& guess) {
    Vec3 middle = at;
    double far = (1.0 + max_size_deviation) * guess.radius + 2.0 * guess.within;
    for (int round = 0; round < 12; ++round) {
        const Section section = section_at(bone, middle, directions, 0.0, far);
        if (section.points.empty()) return std::nullopt;
        Vec3 sum{};
        for (const WallPoint& p : section.points) sum = sum + p.distance * p.out;
        const Vec3 move = sum / static_cast<double>(section.points.size());
        middle = middle + move;
        if (length(middle - at) > 2.0 * guess.within) return std::nullopt;
        far = std::max((1.0 + max_size_deviation) * guess.radius + length(move), 0.7 * far);
    }
    if (!is_met_around(section_at(bone, middle, directions, 0.0, 1.5 * guess.radius), directions.size(), guess.radius))
        return std::nullopt;
    return middle;
}

/// Returns a line through the middles of the sections. Middles farther off than 2.5 times the residual do not count.
std::optional<Axis> first_axis(const BoneShape& bone, const TubeGuess& guess) {
    const Axis guessed{guess.from, guess.to};
    const std::vector<Vec3> directions = directions_across(guessed.along());
    struct Middle {
        double fraction;
        Vec3 off;
    };
    std::vector<Middle> middles;
    for (int i = 0; i < sections; ++i) {
        const double fraction = static_cast<double>(i) / (sections - 1);
        if (const auto middle = middle_near(bone, guessed.at(fraction), directions, guess))
            middles.push_back({fraction, *middle - guessed.at(fraction)});
    }
    double band = HUGE_VAL;
    Vec3 at_from{}, at_to{};
    for (int round = 0; round < 8; ++round) {
        double ff = 0.0, ft = 0.0, tt = 0.0, sum = 0.0;
        Vec3 f{}, t{};
        int used = 0;
        for (const Middle& m : middles) {
            const double to = m.fraction, from = 1.0 - m.fraction;
            const double off = length(m.off - from * at_from - to * at_to);
            if (off > band) continue;
            ff += from * from, ft += from * to, tt += to * to;
            f = f + from * m.off, t = t + to * m.off;
            sum += off * off;
            ++used;
        }
        const double determinant = ff * tt - ft * ft;
        if (used < sections / 4 || !(determinant > 1e-9)) return std::nullopt;
        at_from = (tt * f - ft * t) / determinant;
        at_to = (ff * t - ft * f) / determinant;
        if (round > 0) band = std::max(2.5 * std::sqrt(sum / used), 10.0 * narrowest_band);
    }
    return Axis{guess.from + at_from, guess.to + at_to};
}

struct Round {
    double moved = 0.0;  ///< [m]
    double residual = 0.0, radius = 0.0, fraction = 0.0;
};

/// Samples the tube around `axis` and moves the axis by one Gauss–Newton step. The radius of a section is its mean
/// distance, so the mean equation is subtracted from all equations of the section.
std::optional<Round> improve(Axis& axis, const BoneShape& bone, double radius, double band) {
    const std::vector<Vec3> directions = directions_across(axis.along());
    const Vec3 right = directions.front(), up = cross(axis.along(), right);
    LeastSquares<4> equations;
    Round round;
    double sum = 0.0, radii = 0.0;
    int used = 0, met = 0;
    for (int i = 0; i < sections; ++i) {
        const double to = static_cast<double>(i) / (sections - 1), from = 1.0 - to;
        Section section = section_at(bone, axis.at(to), directions, to, 1.5 * radius);
        if (!is_met_around(section, directions.size(), radius)) continue;
        std::erase_if(section.points, [&](const WallPoint& p) { return std::abs(p.distance - section.radius) > band; });
        const double count = static_cast<double>(section.points.size());
        if (count < 3.0) continue;
        double mean = 0.0;
        Vec3 out{};
        for (const WallPoint& p : section.points) {
            mean += p.distance / count;
            out = out + p.out / count;
        }
        for (const WallPoint& p : section.points) {
            const double off = p.distance - mean;
            const double x = dot(p.out - out, right), y = dot(p.out - out, up);
            equations.add({from * x, from * y, to * x, to * y}, off);
            sum += off * off;
            ++used;
        }
        radii += mean;
        ++met;
    }
    const auto change = equations.solve();
    if (used == 0 || !change) return std::nullopt;
    const Vec3 at_from = (*change)[0] * right + (*change)[1] * up, at_to = (*change)[2] * right + (*change)[3] * up;
    axis = {axis.from + at_from, axis.to + at_to};
    round.moved = std::max(length(at_from), length(at_to));
    round.residual = std::sqrt(sum / used);
    round.radius = radii / met;
    round.fraction = used / (static_cast<double>(sections) * static_cast<double>(directions.size()));
    return round;
}

}  // namespace

std::optional<FittedTube> fit_tube(const BoneShape& bone, const TubeGuess& guess) {
    auto axis = first_axis(bone, guess);
    if (!axis) return std::nullopt;
    double band = widest_band * guess.radius;
    FittedTube fitted;
    for (int n = 0; n < max_rounds; ++n) {
        const auto round = improve(*axis, bone, guess.radius, band);
        if (!round) return std::nullopt;
        // The ends stay next to those of the guess, so that the same stretch of bone is sampled for any guess.
        *axis = {axis->foot(guess.from), axis->foot(guess.to)};
        fitted = {axis->from, axis->to, round->radius, round->residual, round->fraction};
        band = std::clamp(2.5 * round->residual, narrowest_band, widest_band * guess.radius);
        if (n > 2 && round->moved < at_rest) break;
    }
    return fitted;
}

}  // namespace kerf::bone
