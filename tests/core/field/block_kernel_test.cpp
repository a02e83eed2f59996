// SPDX-License-Identifier: Apache-2.0
// Both kernels give the same bits, stage by stage. That their answers are right, the batch query's tests say for each.
#include "core/field/block_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "core/field/cut_log.h"
#include "core/field/pose_stamp.h"
#include "tests/support/drilled_block.h"
#include "tests/support/with_kernel.h"

namespace kerf {
namespace {

using namespace literals;

constexpr int blocks = 800;  // of 1 … 64 points

/// Within ±1, and now and then something that no point should be.
class Numbers {
public:
    double operator()() {
        constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
        constexpr double odd[] = {nan, inf, -inf, 1e300, -1e300, 1e-310, 0.0, -0.0, 3e9, -3e9};
        return random_() % 50 == 0 ? odd[random_() % std::size(odd)] : unit_(random_);
    }
    double sound() { return unit_(random_); }
    std::size_t below(std::size_t n) { return random_() % n; }

private:
    std::mt19937 random_{5};
    std::uniform_real_distribution<double> unit_{-1.0, 1.0};
};

class BothKernels : public testing::Test {
protected:
    void SetUp() override {
        if (avx2_kernel() == nullptr) GTEST_SKIP() << "this machine has no AVX2: there is only the portable kernel";
        fast = avx2_kernel();
    }
    PointBlock points(double size) {
        PointBlock block;
        for (std::size_t n = 1 + numbers.below(block_capacity); n > 0; --n)
            block.add({size * numbers(), size * numbers(), size * numbers()});
        return block;
    }
    const BlockKernel& plain = portable_kernel();
    const BlockKernel* fast = nullptr;
    Numbers numbers;
};

/// Which of several NaNs comes out of a sum is the compiler's choice; nothing downstream tells them apart.
template <class Values>
void expect_same(const Values& a, const Values& b, std::size_t count, const char* what) {
    for (std::size_t i = 0; i < count; ++i) {
        if (a[i] != a[i] && b[i] != b[i]) continue;
        ASSERT_EQ(std::memcmp(&a[i], &b[i], sizeof a[i]), 0) << what << ' ' << i << ": " << a[i] << ", " << b[i];
    }
}

TEST_F(BothKernels, MovePointsAlike) {
    for (int n = 0; n < blocks; ++n) {
        const PointBlock in = points(0.05);
        const Quat turn = normalized(Quat{numbers.sound(), numbers.sound(), numbers.sound(), numbers.sound()});
        const Pose pose{{numbers.sound(), numbers.sound(), numbers.sound()}, turn};
        PointBlock a, b;
        plain.transform(pose, in.count, in.coordinates(), a.writable());
        fast->transform(pose, in.count, in.coordinates(), b.writable());
        expect_same(a.x, b.x, in.count, "x");
        expect_same(a.y, b.y, in.count, "y");
        expect_same(a.z, b.z, in.count, "z");
    }
}

TEST_F(BothKernels, MakeTheSameNormals) {
    for (int n = 0; n < blocks; ++n) {
        PointBlock in = points(3e4);
        in.x[0] = in.y[0] = in.z[0] = 0.0;
        const Quat turn = normalized(Quat{numbers.sound(), numbers.sound(), numbers.sound(), numbers.sound()});
        PointBlock a, b;
        plain.unit(turn, in.count, in.coordinates(), a.writable());
        fast->unit(turn, in.count, in.coordinates(), b.writable());
        expect_same(a.x, b.x, in.count, "x");
        expect_same(a.y, b.y, in.count, "y");
        expect_same(a.z, b.z, in.count, "z");
        for (std::size_t i = 0; i < in.count; ++i) {
            if (!is_finite(in[i]) || !(dot(in[i], in[i]) < 1e300)) continue;
            ASSERT_TRUE(a[i] == rotate(turn, normalized(in[i]))) << i;
        }
    }
}

TEST_F(BothKernels, FindTheSamePlaces) {
    const LatticeShape grid{{-0.011, -0.012, -0.013}, 0.4e-3, {56, 64, 72}, 7, 8};
    std::size_t inside = 0, outside = 0;
    for (int n = 0; n < blocks; ++n) {
        PointBlock in = points(0.016);
        for (std::size_t i = 0; i < in.count; i += 3)  // right on a sample, the grid's first and its end among them
            in.x[i] = grid.origin[0] + grid.spacing * static_cast<double>(numbers.below(57));
        PlaceBlock a, b;
        for (auto* places : {&a, &b})
            (places == &a ? plain : *fast)
                .locate(grid, in.count, in.coordinates(),
                        {places->brick.data(),
                         places->offset.data(),
                         {places->fx.data(), places->fy.data(), places->fz.data()}});
        expect_same(a.brick, b.brick, in.count, "brick");
        expect_same(a.offset, b.offset, in.count, "offset");
        expect_same(a.fx, b.fx, in.count, "fx");
        expect_same(a.fy, b.fy, in.count, "fy");
        expect_same(a.fz, b.fz, in.count, "fz");
        for (std::size_t i = 0; i < in.count; ++i) ++(a.brick[i] == PlaceBlock::outside ? outside : inside);
    }
    EXPECT_GT(inside, 5000u);
    EXPECT_GT(outside, 1000u);
}

template <class Sample>
void interpolate_alike(Numbers& numbers, const BlockKernel& plain, const BlockKernel& fast, double size) {
    constexpr std::size_t bricks = 20;
    std::vector<Sample> pool(bricks * stored_samples);
    for (Sample& s : pool) s = static_cast<Sample>(size * numbers.sound());
    for (int n = 0; n < blocks; ++n) {
        const std::size_t count = 1 + numbers.below(block_capacity);
        std::array<const Sample*, block_capacity> corner;
        BlockValues fx, fy, fz, a, b;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t x = numbers.below(8), y = numbers.below(8), z = numbers.below(8);
            corner[i] = &pool[numbers.below(bricks) * stored_samples + (z * stored_edge + y) * stored_edge + x];
            for (auto* f : {&fx, &fy, &fz}) (*f)[i] = numbers.below(8) == 0 ? 0.0 : std::abs(numbers.sound());
        }
        const ConstCoordinates fraction{fx.data(), fy.data(), fz.data()};
        for (auto* values : {&a, &b}) {
            const BlockKernel& kernel = values == &a ? plain : fast;
            if constexpr (std::is_same_v<Sample, float>)
                kernel.trilinear_float(corner.data(), count, fraction, 1.0, values->data());
            else
                kernel.trilinear_int16(corner.data(), count, fraction, 6.1e-8, values->data());
        }
        expect_same(a, b, count, "value");
        if constexpr (std::is_same_v<Sample, std::int16_t>) {
            SlopeBlock s, t;
            for (auto* slopes : {&s, &t})
                (slopes == &s ? plain : fast)
                    .gradient_int16(corner.data(), count, fraction, 6.1e-8, slopes->value.data(),
                                    {slopes->x.data(), slopes->y.data(), slopes->z.data()});
            expect_same(s.value, a, count, "value beside its gradient");
            expect_same(s.value, t.value, count, "value beside its gradient");
            expect_same(s.x, t.x, count, "slope along x");
            expect_same(s.y, t.y, count, "slope along y");
            expect_same(s.z, t.z, count, "slope along z");
        }
    }
}

TEST_F(BothKernels, InterpolateAlike) {
    interpolate_alike<std::int16_t>(numbers, plain, *fast, 32767.9);
    interpolate_alike<float>(numbers, plain, *fast, 2000.0);
}

TEST_F(BothKernels, MeasureTheSameDepths) {
    const std::vector<std::vector<kerf_profile_point>> outlines = {
        {{0.0, 0.0}, {-0.96_mm, 1.6_mm}, {-30.0_mm, 1.6_mm}},
        {{0.0, 0.0}, {-1.0_mm, 1.5_mm}, {-6.0_mm, 1.5_mm}, {-7.0_mm, 4.0_mm}, {-30.0_mm, 4.0_mm}},  // a step drill
        {{0.5_mm, 2.0_mm}, {-5.0_mm, 2.0_mm}},                                                      // a flat face
        {{0.0, 1.0_mm}, {-2.0_mm, 3.0_mm}, {-4.0_mm, 0.5_mm}},                                      // a waist
    };
    std::size_t inside = 0;
    for (const auto& outline : outlines) {
        const RevolutionSolid solid(outline);
        for (int n = 0; n < blocks; ++n) {
            PointBlock in = points(8e-3);
            for (std::size_t i = 0; i < in.count; i += 5) in.z[i] = outline[numbers.below(outline.size())].z;
            for (std::size_t i = 0; i < in.count; i += 7) in.x[i] = in.y[i] = 0.0;
            BlockValues a, b;
            for (auto* depths : {&a, &b}) {
                const test::WithKernel with(depths == &a ? plain : *fast);
                solid.depths(in, *depths);
            }
            expect_same(a, b, in.count, "depth");
            for (std::size_t i = 0; i < in.count; ++i) {
                if (std::isfinite(in.x[i] + in.y[i] + in.z[i])) {
                    ASSERT_EQ(a[i], -solid.distance(in[i])) << i;
                }
                inside += a[i] > 0.0;
            }
        }
    }
    EXPECT_GT(inside, 3000u);
}

TEST_F(BothKernels, FindTheSameTangentsAndNoneCrossesTheSolid) {
    for (const auto& outline : {std::vector<kerf_profile_point>{{0.0, 0.0}, {-0.96_mm, 1.6_mm}, {-3.0_mm, 1.6_mm}},
                                std::vector<kerf_profile_point>{{0.5_mm, 2.0_mm}, {-2.0_mm, 2.5_mm}, {-5.0_mm, 1.0_mm}}}) {
        const RevolutionSolid solid(outline);
        ASSERT_TRUE(solid.is_convex());
        for (int n = 0; n < blocks; ++n) {
            PointBlock in;
            for (std::size_t i = 0; i < 18; ++i)
                in.add({4e-3 * numbers.sound(), 4e-3 * numbers.sound(), -2e-3 + 4e-3 * numbers.sound()});
            in.x[3] = in.y[3] = 0.0;
            BlockValues a, b;
            PointBlock to, other;
            for (auto* depths : {&a, &b}) {
                const test::WithKernel with(depths == &a ? plain : *fast);
                solid.tangents(in, *depths, depths == &a ? to : other);
            }
            expect_same(a, b, in.count, "depth");
            expect_same(to.x, other.x, in.count, "x");
            expect_same(to.y, other.y, in.count, "y");
            expect_same(to.z, other.z, in.count, "z");
            for (std::size_t i = 0; i < in.count; ++i) {
                const Vec3 by{1e-3 * numbers.sound(), 1e-3 * numbers.sound(), 1e-3 * numbers.sound()};
                ASSERT_LE(-solid.distance(in[i] + by), a[i] + dot(to[i], by) + 1e-15) << i;
            }
        }
    }
}

TEST_F(BothKernels, RaiseTheSameValues) {
    const RevolutionSolid solid = test::drill_outline(1.6_mm, 59.0_deg, 30.0_mm);
    constexpr double h = 0.25_mm, quantum = 4.0 * h / 32767.0, band = 2.0 * h;
    constexpr std::size_t layers = 3 * stored_edge * stored_edge;
    std::size_t raised = 0, kept = 0;
    for (int n = 0; n < 10 * blocks; ++n) {
        // Three layers of samples somewhere about the tip, and a cell of them
        const Quat turn = normalized(Quat{numbers.sound(), numbers.sound(), numbers.sound(), numbers.sound()});
        const Vec3 corner{3e-3 * numbers.sound(), 3e-3 * numbers.sound(), 3e-3 * numbers.sound()};
        PointBlock rows, along;
        for (int row = 0; row < 27; ++row)
            rows.add(corner + rotate(turn, {0.0, h * static_cast<double>(row % 9), h * static_cast<double>(row / 9)}));
        for (int x = 0; x < 9; ++x) along.add(rotate(turn, {h * static_cast<double>(x), 0.0, 0.0}));
        const CellPlace at = CellPlace::of(numbers.below(6));
        const SampleCell cell{rows.coordinates(), along.coordinates(), at.first_x, at.last_x, at.first_y,
                              1e5f, 0.0f, 0.0f, 0.0f};
        std::array<std::int16_t, layers> before, expected;
        for (std::size_t s = 0; s < layers; ++s) {
            // What is there already, or a quantum beside it, or anything
            const Vec3 row = rows[s / 9], p = row + along[s % 9];
            const double d = solid.distance(p);
            const int near = quantised(-d, quantum), beside = near + static_cast<int>(numbers.below(3)) - 1;
            before[s] = static_cast<std::int16_t>(
                std::clamp(numbers.below(3) == 0 ? static_cast<int>(numbers.below(65535)) - 32767 : beside, -32767, 32767));
            const int x = static_cast<int>(s % 9), y = static_cast<int>(s / 9 % 9);
            const bool is_of_cell = x >= at.first_x && x <= at.last_x && y >= at.first_y && y < at.first_y + 3;
            expected[s] = is_of_cell && d <= band ? std::max(before[s], static_cast<std::int16_t>(near)) : before[s];
            ++(expected[s] > before[s] ? raised : kept);
        }

        for (const BlockKernel* kernel : {&plain, fast}) {
            const test::WithKernel with(*kernel);
            auto samples = before;
            std::int16_t lowest = 0, highest = 0, least = 32767, most = -32767;
            ASSERT_EQ(solid.raise(cell, band, quantum, samples.data(), lowest, highest), expected != before);
            expect_same(samples, expected, layers, kernel->name);
            for (std::size_t s = 0; s < layers; ++s) {
                const int x = static_cast<int>(s % 9), y = static_cast<int>(s / 9 % 9);
                if (x < at.first_x || x > at.last_x || y < at.first_y || y >= at.first_y + 3) continue;
                least = std::min(least, expected[s]);
                most = std::max(most, expected[s]);
            }
            ASSERT_EQ(lowest, least);
            ASSERT_EQ(highest, most);
        }
    }
    EXPECT_GT(raised, 5000u);
    EXPECT_GT(kept, 5000u);
}

TEST_F(BothKernels, CutTheSameBone) {
    std::uint64_t hash[2];
    for (int n = 0; n < 2; ++n) {
        const test::WithKernel with(n == 0 ? plain : *fast);
        test::DrilledBlock hole(0.25_mm,
                                test::nearest_samples(0.25_mm, {-3.0_mm, -9.0_mm, -5.0_mm}, {3.0_mm, 9.0_mm, 9.0_mm}));
        hole.move(4.0_mm, 0.03, 2000, true);
        hole.move(3.0_mm, 0.05, 200, false);
        hole.move(5.0_mm, -0.02, 2000, true);
        hole.tracker.flush();
        hash[n] = hole.committed.hash();
    }
    EXPECT_EQ(hash[0], hash[1]);
    EXPECT_NE(hash[0], test::DrilledBlock(0.25_mm).committed.hash()) << "nothing was cut";
}

}  // namespace
}  // namespace kerf
