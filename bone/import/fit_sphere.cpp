// SPDX-License-Identifier: Apache-2.0
#include "bone/import/fit_sphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bone/import/least_squares.h"

namespace kerf::bone {
namespace {

constexpr int rays = 1000;
constexpr int draws = 2000;  // of four points: with a third of the points on the sphere, 24 draws are good
constexpr int max_rounds = 40;
constexpr double widest_band = 0.04;        // [–] of the radius: a point farther off belongs to another surface
constexpr double narrowest_band = 0.02e-3;  // [m]
constexpr double at_rest = 1e-7;            // [m]

std::vector<Vec3> points_around(const BoneShape& bone, Vec3 centre, double far) {
    std::vector<Vec3> points;
    for (const Vec3 direction : even_directions(rays))
        if (const RayHit hit = surface_inwards(bone, centre, direction, far); hit.kind == RayHit::Kind::surface)
            points.push_back(centre + hit.radius * direction);
    return points;
}

struct Sphere {
    Vec3 centre{};
    double radius = 0.0;
    [[nodiscard]] double off(Vec3 p) const noexcept { return length(p - centre) - radius; }
};

/// Returns the sphere through four points: 2 (p_i − p_0) · c = |p_i|² − |p_0|², relative to p_0.
std::optional<Sphere> sphere_through(const std::array<Vec3, 4>& p) {
    const Vec3 a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
    const double volume = 2.0 * dot(a, cross(b, c));
    if (!(std::abs(volume) > 1e-12)) return std::nullopt;  // [m³] nearly coplanar
    const Vec3 centre = (dot(a, a) * cross(b, c) + dot(b, b) * cross(c, a) + dot(c, c) * cross(a, b)) / volume;
    return Sphere{p[0] + centre, length(centre)};
}

/// A fixed sequence of numbers: PCG's multiplier, the upper bits.
class Sequence {
public:
    std::size_t below(std::size_t end) noexcept {
        state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
        return static_cast<std::size_t>((state_ >> 33) % end);
    }

private:
    std::uint64_t state_ = 1;
};

bool is_near(const Sphere& sphere, const SphereGuess& guess) {
    return std::abs(sphere.radius / guess.radius - 1.0) <= max_size_deviation &&
           length(sphere.centre - guess.centre) <= 2.0 * guess.within;
}

std::optional<Sphere> best_drawn(const std::vector<Vec3>& points, const SphereGuess& guess) {
    if (points.size() < 4) return std::nullopt;
    std::optional<Sphere> best;
    std::ptrdiff_t most = 0;
    Sequence sequence;
    for (int i = 0; i < draws; ++i) {
        std::array<Vec3, 4> four;
        for (Vec3& p : four) p = points[sequence.below(points.size())];
        const std::optional<Sphere> sphere = sphere_through(four);
        if (!sphere || !is_near(*sphere, guess)) continue;
        const auto count = std::count_if(points.begin(), points.end(), [&](Vec3 p) {
            return std::abs(sphere->off(p)) <= widest_band * sphere->radius;
        });
        if (count <= most) continue;
        most = count;
        best = sphere;
    }
    return best;
}

/// Takes one Gauss–Newton step of the least-squares distances. Returns false if the points determine no sphere.
bool improve(Sphere& sphere, const std::vector<Vec3>& points, double band) {
    LeastSquares<4> equations;
    for (const Vec3 p : points) {
        const double off = sphere.off(p);
        if (std::abs(off) > band) continue;
        const Vec3 out = normalized(p - sphere.centre);
        equations.add({out.x, out.y, out.z, 1.0}, off);
    }
    const auto change = equations.solve();
    if (!change) return false;
    sphere.centre = sphere.centre + Vec3{(*change)[0], (*change)[1], (*change)[2]};
    sphere.radius += (*change)[3];
    return true;
}

}  // namespace

std::optional<FittedSphere> fit_sphere(const BoneShape& bone, const SphereGuess& guess) {
    const double largest = (1.0 + max_size_deviation) * guess.radius;
    auto sphere = best_drawn(points_around(bone, guess.centre, largest + 2.0 * guess.within), guess);
    if (!sphere) return std::nullopt;
    double band = widest_band * sphere->radius;
    FittedSphere fitted;
    for (int round = 0; round < max_rounds; ++round) {
        const Sphere before = *sphere;
        const std::vector<Vec3> points = points_around(bone, sphere->centre, 1.5 * sphere->radius);
        if (!improve(*sphere, points, band) || !is_near(*sphere, guess)) return std::nullopt;
        double sum = 0.0;
        int used = 0;
        for (const Vec3 p : points) {
            const double off = sphere->off(p);
            if (std::abs(off) > band) continue;
            sum += off * off;
            ++used;
        }
        if (used == 0) return std::nullopt;
        fitted = {sphere->centre, sphere->radius, std::sqrt(sum / used), static_cast<double>(used) / rays};
        band = std::clamp(2.5 * fitted.residual, narrowest_band, widest_band * sphere->radius);
        if (round > 2 && length(sphere->centre - before.centre) < at_rest) break;
    }
    return fitted;
}

}  // namespace kerf::bone
