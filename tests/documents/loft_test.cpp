// SPDX-License-Identifier: Apache-2.0
// Lofts against solids whose distances and volumes are known.
#include "documents/loft.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "documents/solid_mesh.h"
#include "documents/solids.h"
#include "kerf/units.hpp"

namespace kerf::documents {
namespace {

using namespace literals;

constexpr double pi = 3.14159265358979323846;

LoftSolid loft_of(std::vector<LoftSection> sections, Vec3 up, double rim = 0.0) {
    LoftSolid loft{.sections = std::move(sections), .up = up, .rim = rim};
    lay_path(loft);
    return loft;
}

/// Numbers in 0 … 1, the same on every machine.
class Random {
public:
    double next() {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        return static_cast<double>(state_ >> 11) * 0x1p-53;
    }
    double between(double low, double high) { return low + (high - low) * next(); }
    Vec3 in(const Box& box) {
        const double x = between(box.low.x, box.high.x), y = between(box.low.y, box.high.y);
        return {x, y, between(box.low.z, box.high.z)};
    }

private:
    std::uint64_t state_ = 1;
};

/// Compares a loft with exact distances at random points: close to the surface, and farther away.
void expect_distances(const LoftSolid& loft, const std::function<double(Vec3)>& exact, double slack) {
    Random random;
    const Vec3 margin{8.0_mm, 8.0_mm, 8.0_mm};
    const Box around{loft.bounds.low - margin, loft.bounds.high + margin};
    int close = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Vec3 p = random.in(around);
        const double right = exact(p), found = distance_to(loft, p);
        ASSERT_LE(found, right + 0.03 * std::abs(right) + slack) << p.x << ' ' << p.y << ' ' << p.z;
        if (right > 3.0_mm) continue;
        ++close;
        ASSERT_NEAR(found, right, 0.03 * std::abs(right) + slack) << p.x << ' ' << p.y << ' ' << p.z;
    }
    EXPECT_GT(close, 1000);
}

double volume_of(const LoftSolid& loft, double step) {
    double volume = 0.0;
    const Box& box = loft.bounds;
    for (double x = box.low.x + 0.5 * step; x < box.high.x; x += step)
        for (double y = box.low.y + 0.5 * step; y < box.high.y; y += step)
            for (double z = box.low.z + 0.5 * step; z < box.high.z; z += step)
                volume += distance_to(loft, {x, y, z}) < 0.0 ? step * step * step : 0.0;
    return volume;
}

TEST(Loft, OfEqualCirclesIsATube) {
    const LoftSolid loft =
        loft_of({{{0, 0, 0}, 10.0_mm, 10.0_mm}, {{0, 12.0_mm, 16.0_mm}, 10.0_mm, 10.0_mm}}, {1, 0, 0});
    const TubeSolid tube{{0, 0, 0}, {0, 12.0_mm, 16.0_mm}, 5.0_mm};
    expect_distances(
        loft, [&](Vec3 p) { return distance_to(Solid(tube), p); }, 1e-9);
}

/// The distance to a curve of points in a plane, with the sign of a function that is negative inside.
double distance_to_curve(const std::vector<Vec3>& curve, Vec3 p, bool is_inside) {
    double nearest = HUGE_VAL;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        const Vec3 a = curve[i], along = curve[(i + 1) % curve.size()] - a;
        const double t = std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0);
        nearest = std::min(nearest, length(p - a - t * along));
    }
    return is_inside ? -nearest : nearest;
}

// A section far from both ends, so that they are not the nearest.
TEST(Loft, KeepsItsDistanceToEllipsesAndSquarerSections) {
    struct Case {
        double width, height, exponent;
    };
    for (const auto [width, height, exponent] :
         {Case{24.0_mm, 24.0_mm, 2.0}, Case{48.0_mm, 35.0_mm, 2.0}, Case{48.0_mm, 35.0_mm, 2.2},
          Case{30.0_mm, 10.0_mm, 2.0}, Case{10.0_mm, 15.0_mm, 2.5}}) {
        const LoftSolid loft = loft_of(
            {{{0, 0, -(60.0_mm)}, width, height, exponent}, {{0, 0, 60.0_mm}, width, height, exponent}}, {0, 1, 0});
        std::vector<Vec3> curve;
        for (int i = 0; i < 4000; ++i) {
            const double angle = 2.0 * pi * i / 4000.0, c = std::cos(angle), s = std::sin(angle);
            curve.push_back({0.5 * width * std::copysign(std::pow(std::abs(c), 2.0 / exponent), c),
                             0.5 * height * std::copysign(std::pow(std::abs(s), 2.0 / exponent), s), 0});
        }
        Random random;
        const Box around{{-0.5 * width - 8.0_mm, -0.5 * height - 8.0_mm, 0},
                         {0.5 * width + 8.0_mm, 0.5 * height + 8.0_mm, 0}};
        for (int i = 0; i < 2000; ++i) {
            const Vec3 p = random.in(around);
            const bool is_inside =
                std::pow(std::abs(2.0 * p.x / width), exponent) + std::pow(std::abs(2.0 * p.y / height), exponent) <
                1.0;
            const double right = distance_to_curve(curve, p, is_inside), found = distance_to(loft, p);
            ASSERT_LE(found, right + 0.05 * std::abs(right) + 0.02_mm)
                << width << ' ' << exponent << " at " << p.x << ' ' << p.y;
            if (right <= 3.0_mm) {
                ASSERT_NEAR(found, right, 0.03 * std::abs(right) + 0.02_mm)
                    << width << ' ' << height << ' ' << exponent << " at " << p.x << ' ' << p.y;
            }
        }
    }
}

TEST(Loft, OfTwoCirclesIsACone) {
    constexpr double low = 10.0_mm, high = 4.0_mm, tall = 30.0_mm;  // radii and height: a slope of 0.2
    const LoftSolid loft =
        loft_of({{{0, 0, 0}, 2.0 * low, 2.0 * low}, {{0, 0, tall}, 2.0 * high, 2.0 * high}}, {0, 1, 0});
    const std::vector<Vec3> outline{{0, 0, 0}, {low, 0, 0}, {high, 0, tall}, {0, 0, tall}};
    expect_distances(
        loft,
        [&](Vec3 p) {
            const Vec3 q{std::hypot(p.x, p.y), 0, p.z};
            const bool is_inside = p.z > 0.0 && p.z < tall && q.x < low + (high - low) * p.z / tall;
            double nearest = HUGE_VAL;
            for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
                const Vec3 along = outline[i + 1] - outline[i];
                const double t = std::clamp(dot(q - outline[i], along) / dot(along, along), 0.0, 1.0);
                nearest = std::min(nearest, length(q - outline[i] - t * along));
            }
            return is_inside ? -nearest : nearest;
        },
        0.1_mm /* at the edges of the ends the wall is taken as parallel to the path */);
}

TEST(Loft, AlongAQuarterOfACircleIsAPartOfATorus) {
    constexpr double bend = 30.0_mm, radius = 6.0_mm;
    std::vector<LoftSection> sections;
    for (int i = 0; i <= 6; ++i) {
        const double angle = 0.5 * pi * i / 6.0;
        sections.push_back({{bend * std::cos(angle), bend * std::sin(angle), 0}, 2.0 * radius, 2.0 * radius});
    }
    const LoftSolid loft = loft_of(sections, {0, 0, 1});
    Random random;
    for (int i = 0; i < 5000; ++i) {  // away from the ends
        const double angle = random.between(0.2, 0.5 * pi - 0.2), around = random.between(0.0, 2.0 * pi),
                     from = random.between(3.0_mm, 9.0_mm);
        const double out = bend + from * std::cos(around);
        const Vec3 p{out * std::cos(angle), out * std::sin(angle), from * std::sin(around)};
        ASSERT_NEAR(distance_to(loft, p), from - radius, 0.06_mm) << angle << ' ' << around << ' ' << from;
    }
    EXPECT_NEAR(volume_of(loft, 0.5_mm) / (0.5 * pi * bend * pi * radius * radius), 1.0, 0.01);
}

TEST(Loft, OfSuperellipsesHasTheirVolume) {
    for (const double e : {2.0, 2.2, 4.0}) {
        const LoftSolid loft =
            loft_of({{{0, 0, 0}, 40.0_mm, 30.0_mm, e}, {{0, 0, 20.0_mm}, 40.0_mm, 30.0_mm, e}}, {0, 1, 0});
        // The area of a superellipse: 4 a b Γ(1 + 1/e)²/Γ(1 + 2/e).
        const double area =
            4.0 * 20.0_mm * 15.0_mm * std::pow(std::tgamma(1.0 + 1.0 / e), 2) / std::tgamma(1.0 + 2.0 / e);
        EXPECT_NEAR(volume_of(loft, 0.5_mm) / (area * 20.0_mm), 1.0, 0.005) << e;
    }
}

// A trapezium: an almost square section whose width falls from 30 to 10 mm.
TEST(Loft, TapersItsSection) {
    const LoftSolid loft =
        loft_of({{{0, 0, 0}, 20.0_mm, 24.0_mm, 10.0, 0.5}, {{0, 0, 80.0_mm}, 20.0_mm, 24.0_mm, 10.0, 0.5}}, {0, 1, 0});
    const auto half_width_at = [&](double y) {
        double inside = 0.0, outside = 20.0_mm;
        for (int i = 0; i < 50; ++i) {
            const double x = 0.5 * (inside + outside);
            (distance_to(loft, {x, y, 40.0_mm}) < 0.0 ? inside : outside) = x;
        }
        return inside;
    };
    EXPECT_NEAR(half_width_at(0.0), 10.0_mm, 0.01_mm);
    EXPECT_NEAR(half_width_at(6.0_mm), 7.5_mm, 0.01_mm);
    EXPECT_NEAR(half_width_at(-(6.0_mm)), 12.5_mm, 0.01_mm);
    // The wall leans by 10 mm in 24 mm: 1 mm next to it across y, the distance is 1 mm times cos 22.6 degrees.
    EXPECT_NEAR(distance_to(loft, {11.0_mm, 0, 40.0_mm}), 1.0_mm * 12.0 / 13.0, 0.01_mm);
    // The area of a superellipse does not change with its taper.
    const double area = 20.0_mm * 24.0_mm * std::pow(std::tgamma(1.1), 2) / std::tgamma(1.2);
    EXPECT_NEAR(volume_of(loft, 0.5_mm) / (area * 80.0_mm), 1.0, 0.005);
}

TEST(Loft, TurnsItsSectionAboutThePath) {
    constexpr double turn = 0.5 * pi;
    LoftSection end{{0, 0, 90.0_mm}, 20.0_mm, 8.0_mm};
    end.turn = turn;
    const LoftSolid loft = loft_of({{{0, 0, 0}, 20.0_mm, 8.0_mm}, end}, {0, 1, 0});
    EXPECT_LT(distance_to(loft, {9.0_mm, 0, 1.0_mm}), 0.0);
    EXPECT_GT(distance_to(loft, {0, 9.0_mm, 1.0_mm}), 0.0);
    EXPECT_GT(distance_to(loft, {9.0_mm, 0, 89.0_mm}), 0.0);
    EXPECT_LT(distance_to(loft, {0, 9.0_mm, 89.0_mm}), 0.0);
    // Halfway by half the angle: from y towards −x.
    EXPECT_LT(distance_to(loft, {9.0_mm * std::cos(0.25 * pi), 9.0_mm * std::sin(0.25 * pi), 45.0_mm}), 0.0);
    EXPECT_GT(distance_to(loft, {9.0_mm * std::cos(0.25 * pi), -9.0_mm * std::sin(0.25 * pi), 45.0_mm}), 0.0);
    EXPECT_NEAR(volume_of(loft, 0.5_mm) / (pi * 10.0_mm * 4.0_mm * 90.0_mm), 1.0, 0.01);
}

TEST(Loft, BetweenSectionsIsNeitherWiderNorNarrowerThanThey) {
    const LoftSolid loft = loft_of({{{0, 0, 0}, 40.0_mm, 30.0_mm},
                                    {{0, 0, 8.0_mm}, 20.0_mm, 30.0_mm},
                                    {{0, 0, 16.0_mm}, 20.0_mm, 30.0_mm},
                                    {{0, 0, 20.0_mm}, 44.0_mm, 30.0_mm}},
                                   {0, 1, 0});
    for (const LoftFrame& frame : loft.path) {
        EXPECT_GE(frame.half_width, 10.0_mm - 1e-12);
        EXPECT_LE(frame.half_width, 22.0_mm + 1e-12);
        EXPECT_NEAR(frame.half_height, 15.0_mm, 1e-12);
    }
}

TEST(Loft, RoundsItsRim) {
    constexpr double r = 2.0_mm;
    const LoftSolid loft = loft_of({{{0, 0, 0}, 20.0_mm, 20.0_mm}, {{0, 0, 15.0_mm}, 20.0_mm, 20.0_mm}}, {0, 1, 0}, r);
    for (const double angle : {0.0, 0.3, 0.8, 1.2, 0.5 * pi}) {  // on the round edge
        const Vec3 p{10.0_mm - r + r * std::cos(angle), 0, 15.0_mm - r + r * std::sin(angle)};
        EXPECT_NEAR(distance_to(loft, p), 0.0, 1e-9) << angle;
    }
}

TEST(Loft, KnowsWhereItsSectionsCross) {
    const auto bent = [](double width) {
        std::vector<LoftSection> sections;
        for (int i = 0; i <= 6; ++i) {
            const double angle = 0.5 * pi * i / 6.0;
            sections.push_back({{20.0_mm * std::cos(angle), 20.0_mm * std::sin(angle), 0}, width, 5.0_mm});
        }
        return crossing(loft_of(sections, {0, 0, 1}));
    };
    EXPECT_NEAR(bent(20.0_mm), 0.5, 0.05);
    EXPECT_GT(bent(44.0_mm), 1.0);
}

/// Points of a circle, anticlockwise.
Outline circle(double radius) {
    Outline points;
    for (int i = 0; i < 16; ++i)
        points.push_back({radius * std::cos(pi * i / 8.0), radius * std::sin(pi * i / 8.0), 0});
    return points;
}

LoftSection outlined(double z, Outline outline) { return {.at = {0, 0, z}, .outline = std::move(outline)}; }

TEST(Loft, ThroughCirclesOfPointsIsATube) {
    const LoftSolid loft = loft_of({outlined(0, circle(5.0_mm)), outlined(20.0_mm, circle(5.0_mm))}, {0, 1, 0});
    const TubeSolid tube{{0, 0, 0}, {0, 0, 20.0_mm}, 5.0_mm};
    expect_distances(
        loft, [&](Vec3 p) { return distance_to(Solid(tube), p); }, 0.02_mm);
}

TEST(Loft, ThroughTwoCirclesOfPointsLeansAsItsWall) {
    const LoftSolid loft = loft_of({outlined(0, circle(10.0_mm)), outlined(30.0_mm, circle(4.0_mm))}, {0, 1, 0});
    // The wall is the line x = 10 - 0.2 z.
    for (const double x : {5.0_mm, 6.5_mm, 7.5_mm, 9.0_mm})
        EXPECT_NEAR(distance_to(loft, {x, 0, 15.0_mm}), (x - 7.0_mm) / std::sqrt(1.04), 0.03_mm) << x;
}

TEST(Loft, ThroughPointsMayBeHollowOnASide) {
    // A kidney: the point at x = 0 lies inwards of its neighbours.
    const Outline kidney{
        {-8.0_mm, -6.0_mm, 0}, {8.0_mm, -6.0_mm, 0}, {8.0_mm, 6.0_mm, 0}, {0, 0, 0}, {-8.0_mm, 6.0_mm, 0}};
    const LoftSolid loft = loft_of({outlined(0, kidney), outlined(10.0_mm, kidney)}, {0, 1, 0});
    EXPECT_GT(distance_to(loft, {0, 3.0_mm, 5.0_mm}), 1.0_mm) << "in the hollow";
    EXPECT_LT(distance_to(loft, {0, -3.0_mm, 5.0_mm}), -1.0_mm);
    EXPECT_LT(distance_to(loft, {6.0_mm, 4.0_mm, 5.0_mm}), -0.5_mm);
    EXPECT_NEAR(distance_to(loft, {0, 0, 5.0_mm}), 0.0, 0.01_mm) << "the curve leads through its points";
    const double volume = area_of(loft.outlines.front()) * 10.0_mm;
    EXPECT_NEAR(volume_of(loft, 0.25_mm) / volume, 1.0, 0.01);
    double volume_of_mesh = 0.0;
    const Mesh mesh = mesh_of({loft});
    for (const auto& triangle : mesh.triangles)
        volume_of_mesh +=
            dot(mesh.vertices[triangle[0]], cross(mesh.vertices[triangle[1]], mesh.vertices[triangle[2]])) / 6.0;
    EXPECT_NEAR(volume_of_mesh / volume, 1.0, 0.02);
}

TEST(Outline, HasItsAreaRadiusAndCrossing) {
    const Outline square{{0, 0, 0}, {4.0_mm, 0, 0}, {4.0_mm, 4.0_mm, 0}, {0, 4.0_mm, 0}};
    EXPECT_NEAR(area_of(square), 16e-6, 1e-12);
    EXPECT_NEAR(area_of({square.rbegin(), square.rend()}), -16e-6, 1e-12);
    EXPECT_NEAR(area_of(smoothed(circle(5.0_mm))), pi * 25e-6, 0.2e-6);
    EXPECT_NEAR(sharpest_radius(smoothed(circle(5.0_mm))), 5.0_mm, 0.5_mm);
    EXPECT_FALSE(crosses_itself(square));
    EXPECT_TRUE(crosses_itself({square[0], square[1], square[3], square[2]}));
}

TEST(Loft, HasAClosedMeshOnItsSurface) {
    const LoftSolid loft = loft_of({{{0, 0, 0}, 48.0_mm, 35.0_mm, 2.2},
                                    {{0, 0, 10.0_mm}, 40.0_mm, 32.0_mm, 2.2},
                                    {{0, 0, 27.0_mm}, 45.0_mm, 35.0_mm, 2.2}},
                                   {0, -1, 0}, 1.5_mm);
    const Mesh mesh = mesh_of({loft});
    double volume = 0.0;
    for (const auto& triangle : mesh.triangles)
        volume += dot(mesh.vertices[triangle[0]], cross(mesh.vertices[triangle[1]], mesh.vertices[triangle[2]])) / 6.0;
    EXPECT_NEAR(volume / volume_of(loft, 0.5_mm), 1.0, 0.02);
    for (std::size_t v = 0; v + 2 < mesh.vertices.size(); ++v) {
        EXPECT_NEAR(distance_to(loft, mesh.vertices[v]), 0.0, 0.3_mm) << v;
    }
}

/// The distance to a superellipsoid, from the closest of many points of its surface, refined around it.
double distance_by_search(const Vec3 half, double e, Vec3 p) {
    const auto at = [&](double u, double v) {  // angles of a direction
        const Vec3 d{half.x * std::cos(u) * std::cos(v), half.y * std::cos(u) * std::sin(v), half.z * std::sin(u)};
        const double level = std::pow(std::pow(std::abs(d.x / half.x), e) + std::pow(std::abs(d.y / half.y), e) +
                                          std::pow(std::abs(d.z / half.z), e),
                                      1.0 / e);
        return (1.0 / level) * d;
    };
    double best_u = 0.0, best_v = 0.0, nearest = HUGE_VAL, range_u = 0.5 * pi, range_v = pi;
    for (int round = 0; round < 12; ++round) {
        const double middle_u = best_u, middle_v = best_v;
        for (int i = -20; i <= 20; ++i)
            for (int j = -20; j <= 20; ++j) {
                const double u = middle_u + range_u * i / 20.0, v = middle_v + range_v * j / 20.0;
                if (const double d = length(p - at(u, v)); d < nearest) nearest = d, best_u = u, best_v = v;
            }
        range_u *= 0.3, range_v *= 0.3;
    }
    return nearest;
}

TEST(Superellipsoid, KeepsItsDistance) {
    struct Case {
        Vec3 half;
        double exponent;
    };
    for (const auto& [half, exponent] : {Case{{12.0_mm, 12.0_mm, 12.0_mm}, 2.0}, Case{{22.0_mm, 17.0_mm, 14.0_mm}, 2.2},
                                         Case{{15.0_mm, 6.0_mm, 9.0_mm}, 2.0}, Case{{6.0_mm, 5.0_mm, 8.0_mm}, 3.0}}) {
        const Solid solid = SuperellipsoidSolid{
            .centre = {}, .length = 2.0 * half.z, .width = 2.0 * half.x, .height = 2.0 * half.y, .exponent = exponent};
        Random random;
        const Vec3 reach = half + Vec3{5.0_mm, 5.0_mm, 5.0_mm};
        for (int i = 0; i < 150; ++i) {
            const Vec3 p = random.in(Box{-1.0 * reach, reach});
            const bool is_inside = std::pow(std::abs(p.x / half.x), exponent) +
                                       std::pow(std::abs(p.y / half.y), exponent) +
                                       std::pow(std::abs(p.z / half.z), exponent) <
                                   1.0;
            const double right = (is_inside ? -1.0 : 1.0) * distance_by_search(half, exponent, p),
                         found = distance_to(solid, p);
            ASSERT_NEAR(found, right, 0.05 * std::abs(right) + 0.02_mm) << half.x << ' ' << exponent << ' ' << i;
            if (right <= 3.0_mm) {
                ASSERT_NEAR(found, right, 0.02 * std::abs(right) + 0.02_mm) << half.x << ' ' << exponent << ' ' << i;
            }
        }
    }
}

TEST(Superellipsoid, LiesInItsDirections) {
    const SuperellipsoidSolid solid{.centre = {1.0_mm, 2.0_mm, 3.0_mm},
                                    .length = 20.0_mm,
                                    .width = 6.0_mm,
                                    .height = 10.0_mm,
                                    .exponent = 2.5,
                                    .along = {1, 1, 0},
                                    .up = {0, 0, 1}};
    const double diagonal = std::sqrt(0.5);
    for (const double sign : {-1.0, 1.0}) {
        EXPECT_NEAR(distance_to(Solid(solid), solid.centre + (sign * 10.0_mm) * Vec3{diagonal, diagonal, 0}), 0.0,
                    1e-9);
        EXPECT_NEAR(distance_to(Solid(solid), solid.centre + (sign * 5.0_mm) * Vec3{0, 0, 1}), 0.0, 1e-9);
        EXPECT_NEAR(distance_to(Solid(solid), solid.centre + (sign * 3.0_mm) * Vec3{diagonal, -diagonal, 0}), 0.0,
                    1e-9);
    }
    const Box bounds = bounds_of(Solid(solid));
    const Mesh mesh = mesh_of({solid});
    for (const Vec3 vertex : mesh.vertices) {
        EXPECT_NEAR(distance_to(Solid(solid), vertex), 0.0, 0.001_mm);
        EXPECT_GE(vertex.x, bounds.low.x);
        EXPECT_LE(vertex.x, bounds.high.x);
    }
}

// x and y are the distances to two planes at a right angle.
TEST(United, HasAFilletOfItsRadiusAtARightAngle) {
    constexpr double r = 3.0_mm;
    for (const double angle : {0.0, 0.2, 0.7, 1.3, 0.5 * pi})
        EXPECT_NEAR(united(r - r * std::cos(angle), r - r * std::sin(angle), r), 0.0, 1e-15) << angle;
    EXPECT_EQ(united(4.0_mm, -(1.0_mm), r), -(1.0_mm)) << "away from the edge";
    EXPECT_EQ(united(1.0_mm, 2.0_mm, 0.0), 1.0_mm);
    EXPECT_GE(united(-(5.0_mm), -(5.0_mm), r), -(5.0_mm) - 0.4143 * r) << "deep inside both";
}

}  // namespace
}  // namespace kerf::documents
