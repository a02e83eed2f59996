// SPDX-License-Identifier: Apache-2.0
// Both kernels give the same bits, stage by stage. That their answers are right, the batch query's tests say for each.
#include "core/field/grid/kernel/block_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <random>
#include <vector>

#include "core/field/cut/cut_log.h"
#include "core/field/cut/pose_stamp.h"
#include "tests/support/drilled_block.h"
#include "tests/support/with_kernel.h"

namespace kerf {
namespace {

using namespace literals;

constexpr int blocks = 800;  // of 1 … `block_capacity` points

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
    static std::vector<Vec3> listed(const PointBlock& block) {
        std::vector<Vec3> list;
        for (std::size_t i = 0; i < block.count; ++i) list.push_back(block[i]);
        return list;
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

TEST_F(BothKernels, MovePointsOfAFrameAlike) {
    for (int n = 0; n < blocks; ++n) {
        const std::vector<Vec3> in = listed(points(0.05));
        const Quat turn = normalized(Quat{numbers.sound(), numbers.sound(), numbers.sound(), numbers.sound()});
        const Frame frame = frame_of({{numbers.sound(), numbers.sound(), numbers.sound()}, turn});
        PointBlock a, b;
        plain.move(frame, in.size(), in.data(), a.writable());
        fast->move(frame, in.size(), in.data(), b.writable());
        expect_same(a.x, b.x, in.size(), "x");
        expect_same(a.y, b.y, in.size(), "y");
        expect_same(a.z, b.z, in.size(), "z");
    }
}

TEST_F(BothKernels, FindTheSamePlacesAndThoseOfOnePoint) {
    const Grid grid{{7, 8, 9}, 0.4e-3, {-0.011, -0.012, -0.013}};
    std::size_t inside = 0, outside = 0;
    for (int n = 0; n < blocks; ++n) {
        std::vector<Vec3> in = listed(points(0.016));
        for (std::size_t i = 0; i < in.size(); i += 3)  // right on a sample, the grid's first and its end among them
            in[i].x = grid.origin.x + grid.spacing * static_cast<double>(numbers.below(57));
        Region region;
        if (n % 2 == 0) region = {grid.sample_position(5, 6, 7), grid.sample_position(40, 41, 42)};
        const Quat turn = normalized(Quat{numbers.sound(), numbers.sound(), numbers.sound(), numbers.sound()});
        const GridFrame frame(grid, region, frame_of({{0, 0, 0}, n % 3 == 0 ? Quat{1, 0, 0, 0} : turn}));
        LocatedBlock a, b;
        PointBox box[2];
        for (auto* places : {&a, &b}) {
            const test::WithKernel with(places == &a ? plain : *fast);
            box[places == &b] = frame.locate_box(in.data(), in.size(), *places);
        }
        LocatedBlock without_box;
        frame.locate(in.data(), in.size(), without_box);
        expect_same(a.brick, b.brick, in.size(), "brick");
        expect_same(a.brick, without_box.brick, in.size(), "brick");
        for (std::size_t axis = 0; axis < 3; ++axis) {
            ASSERT_EQ(box[0].low[axis], box[1].low[axis]);
            ASSERT_EQ(box[0].high[axis], box[1].high[axis]);
        }
        for (std::size_t i = 0; i < in.size(); ++i) {
            const bool is_outside = a.brick[i] == static_cast<std::int32_t>(grid.brick_count());
            ++(is_outside ? outside : inside);
            for (const LocatedBlock* other : {&b, &without_box}) {
                if (is_outside) continue;
                ASSERT_EQ(a.offset[i], other->offset[i]);
                ASSERT_TRUE(a.fx[i] == other->fx[i] && a.fy[i] == other->fy[i] && a.fz[i] == other->fz[i]);
            }
            if (n % 2 == 0) continue;
            const Vec3 g = frame * in[i];
            const LocatedPoint one = locate_fixed(grid, frame.lattice().bits, g.x, g.y, g.z);
            ASSERT_EQ(one.is_inside, !is_outside);
            if (is_outside) continue;
            ASSERT_EQ(static_cast<std::int32_t>(one.brick), a.brick[i]);
            ASSERT_EQ(one.offset, a.offset[i]);
            ASSERT_TRUE(one.fx == a.fx[i] && one.fy == a.fy[i] && one.fz == a.fz[i]);
        }
    }
    EXPECT_GT(inside, 5000u);
    EXPECT_GT(outside, 1000u);
}

/// Places at random in so many bricks and, now and then, outside; behind the last the last again, as `place` leaves
/// them.
LocatedBlock random_places(Numbers& numbers, std::size_t bricks) {
    LocatedBlock places;
    places.count = 1 + numbers.below(block_capacity);
    for (std::size_t i = 0; i < block_capacity; ++i) {
        if (i >= places.count) {
            places.brick[i] = places.brick[i - 1];
            places.offset[i] = places.offset[i - 1];
            for (auto* f : {&places.fx, &places.fy, &places.fz}) (*f)[i] = (*f)[i - 1];
            continue;
        }
        const std::size_t x = numbers.below(8), y = numbers.below(8), z = numbers.below(8);
        places.brick[i] = static_cast<std::int32_t>(numbers.below(bricks + 1));
        places.offset[i] = static_cast<std::int32_t>((z * stored_edge + y) * stored_edge + x);
        for (auto* f : {&places.fx, &places.fy, &places.fz})
            (*f)[i] = numbers.below(8) == 0 ? 0.0f : static_cast<float>(std::abs(numbers.sound()));
    }
    return places;
}

TEST_F(BothKernels, InterpolateAlike) {
    // Two uniform bricks, as every field has them, and others; `start` has one entry more for what is outside
    constexpr std::size_t bricks = 20;
    constexpr double quantum = 6.1e-8, clamp = 0.002;
    BrickSamples<std::int16_t> samples[2];
    BrickSamples<float> densities(bricks * stored_samples);
    for (float& density : densities) density = static_cast<float>(1000.0 + 1000.0 * numbers.sound());
    for (auto& field : samples) {
        field.assign(stored_samples, 32767);
        field.resize(2 * stored_samples, -32767);
        while (field.size() < bricks * stored_samples)
            field.push_back(numbers.below(4) == 0 ? std::int16_t{-32767}
                                                  : static_cast<std::int16_t>(32767.9 * numbers.sound()));
    }
    int uniform = 0;
    for (int n = 0; n < blocks; ++n) {
        std::vector<std::int32_t> start[2], stored;
        for (auto& of_field : start)
            for (std::size_t b = 0; b <= bricks; ++b) {
                if (n % 4 == 1 && &of_field == start) {  // deep in bone, whatever is cut
                    of_field.push_back(stored_samples);
                    continue;
                }
                of_field.push_back(stored_samples * static_cast<std::int32_t>(numbers.below(n % 4 == 0 ? 2 : bricks)));
            }
        for (std::size_t b = 0; b <= bricks; ++b)
            stored.push_back(numbers.below(3) == 0 ? -1
                                                   : stored_samples * static_cast<std::int32_t>(numbers.below(bricks)));
        const LocatedBlock at = random_places(numbers, bricks);
        const FieldShape bone{start[0].data(), samples[0].data(), 2 * stored_samples, stored_samples};
        const FieldShape cut{start[1].data(), samples[1].data(), 2 * stored_samples, stored_samples};
        uniform += n % 4 == 0;

        FloatBlock value[2], density[2];
        BlockValues distance[2];
        SlopeBlock slopes[2];
        float least[2];
        kerf_surface_point answers[2][block_capacity] = {};
        for (const std::size_t k : {0u, 1u}) {
            const BlockKernel& kernel = k == 0 ? plain : *fast;
            kernel.values(bone, at.count, at.places(), value[k].data());
            kernel.metres(bone, at.count, at.places(), quantum, clamp, distance[k].data());
            kernel.densities(stored.data(), densities.data(), at.count, at.places(), 77.0f, density[k].data());
            least[k] = kernel.slopes(bone, cut, at.count, at.places(), slopes[k].writable());
            kernel.answer({quantum, clamp, {{0.6f, 0.8f, 0.0f}, {-0.8f, 0.6f, 0.0f}, {0.0f, 0.0f, 1.0f}}}, at.count,
                          slopes[k].slopes(), answers[k]);
        }
        expect_same(value[0], value[1], at.count, "value");
        expect_same(distance[0], distance[1], at.count, "distance");
        expect_same(density[0], density[1], at.count, "density");
        expect_same(slopes[0].value, slopes[1].value, at.count, "value beside its gradient");
        expect_same(slopes[0].x, slopes[1].x, at.count, "slope along x");
        expect_same(slopes[0].y, slopes[1].y, at.count, "slope along y");
        expect_same(slopes[0].z, slopes[1].z, at.count, "slope along z");
        ASSERT_EQ(std::memcmp(answers[0], answers[1], at.count * sizeof answers[0][0]), 0);
        ASSERT_EQ(least[0], least[1]);
        ASSERT_EQ(least[0], *std::min_element(slopes[0].value.begin(), slopes[0].value.begin() + at.count));
    }
    EXPECT_GT(uniform, 100);
}

TEST_F(BothKernels, TellEdgesTheSameAndNothingBehindTheLast) {
    for (int n = 0; n < blocks; ++n) {
        const std::size_t count = 1 + numbers.below(block_capacity);
        FloatBlock engagement;
        BlockValues gap;
        std::array<FloatBlock, KERF_MAX_TISSUES> weight, density;
        for (std::size_t i = 0; i < block_capacity; ++i) {
            engagement[i] = static_cast<float>(numbers.sound());
            gap[i] = numbers.sound();
            for (std::size_t m = 0; m < KERF_MAX_TISSUES; ++m) {
                weight[m][i] = static_cast<float>(numbers.sound());
                density[m][i] = static_cast<float>(numbers.sound());
            }
        }
        const std::size_t tissues = 1 + numbers.below(KERF_MAX_TISSUES);
        const SampleColumns columns{engagement.data(), gap.data(), weight[0].data(), density[0].data(), block_capacity,
                                    tissues,           3};
        std::vector<kerf_bone_sample> samples[2];
        for (const std::size_t k : {0u, 1u}) {
            samples[k].resize(block_capacity + 1);
            for (kerf_bone_sample& s : samples[k]) s.gap = 77.0;
            (k == 0 ? plain : *fast).rows(columns, count, samples[k].data());
            EXPECT_EQ(samples[k][count].gap, 77.0);
        }
        ASSERT_EQ(std::memcmp(samples[0].data(), samples[1].data(), samples[0].size() * sizeof samples[0][0]), 0);
        const kerf_bone_sample& last = samples[1][count - 1];
        EXPECT_EQ(last.gap, gap[count - 1]);
        EXPECT_EQ(last.density[tissues - 1], static_cast<double>(density[tissues - 1][count - 1]));
        EXPECT_EQ(last.body, 3);
        if (tissues < KERF_MAX_TISSUES) {
            EXPECT_EQ(last.weight[tissues], 0.0);
        }
    }
}

TEST_F(BothKernels, MeasureTheSameDepths) {
    const std::vector<std::vector<kerf_profile_point>> outlines = {
        {{0.0, 0.0}, {-0.96_mm, 1.6_mm}, {-30.0_mm, 1.6_mm}},
        {{0.0, 0.0}, {-1.0_mm, 1.5_mm}, {-6.0_mm, 1.5_mm}, {-7.0_mm, 4.0_mm}, {-30.0_mm, 4.0_mm}},  // a step drill
        {{0.5_mm, 2.0_mm}, {-5.0_mm, 2.0_mm}},                                                      // a flat face
        {{0.0, 1.0_mm}, {-2.0_mm, 3.0_mm}, {-4.0_mm, 0.5_mm}},                                      // a waist
    };
    std::vector<ToolSolid> solids;
    for (const auto& outline : outlines) solids.emplace_back(outline);
    solids.push_back(test::blade_outline(20.0_mm, 5.0_mm, 4.0_mm, 2.0_mm));
    solids.push_back(ToolSolid::parts({{0.0, 0.0}, {-1.0_mm, 3.0_mm}, {-9.0_mm, 3.0_mm}}, 0.0,
                                      {{-2.0_mm, -3.0_mm}, {-5.0_mm, -7.0_mm}}));
    solids.push_back(ToolSolid::hollow({{0.0, 3.0_mm}, {-1.0_mm, 4.0_mm}, {-9.0_mm, 4.0_mm}}, 2.0_mm));
    std::size_t inside = 0;
    for (const ToolSolid& solid : solids) {
        const auto& outline = solid.outline();
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
    for (const auto& solid : {ToolSolid({{0.0, 0.0}, {-0.96_mm, 1.6_mm}, {-3.0_mm, 1.6_mm}}),
                              ToolSolid({{0.5_mm, 2.0_mm}, {-2.0_mm, 2.5_mm}, {-5.0_mm, 1.0_mm}}),
                              test::blade_outline(10.0_mm, 3.0_mm, 2.0_mm, 1.0_mm)}) {
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
    const ToolSolid solids[] = {
        test::drill_outline(1.6_mm, 59.0_deg, 30.0_mm),
        ToolSolid(
            {{0.0, 0.0}, {-1.0_mm, 1.5_mm}, {-3.0_mm, 1.5_mm}, {-3.5_mm, 2.5_mm}, {-9.0_mm, 2.5_mm}}),  // a step drill
        ToolSolid({{0.3_mm, 1.0_mm}, {-1.0_mm, 1.5_mm}}),                                               // a flat face
        test::blade_outline(10.0_mm, 3.0_mm, 1.0_mm, 1.0_mm),
        ToolSolid::hollow({{0.0, 2.0_mm}, {-6.0_mm, 2.0_mm}}, 1.0_mm),
        ToolSolid::parts({{0.0, 2.0_mm}, {-6.0_mm, 2.0_mm}}, 0.5_mm, {{-1.0_mm, -2.0_mm}}),
    };
    constexpr double h = 0.25_mm, quantum = 4.0 * h / 32767.0, band = 2.0 * h;
    constexpr std::size_t layers = 3 * stored_edge * stored_edge;
    std::size_t raised = 0, kept = 0, outside = 0;
    for (int n = 0; n < 12 * blocks; ++n) {
        // Three layers of samples somewhere about the tip, and a cell of them
        const ToolSolid& solid = solids[static_cast<std::size_t>(n) % std::size(solids)];
        const Quat turn = normalized(Quat{numbers.sound(), numbers.sound(), numbers.sound(), numbers.sound()});
        const Vec3 corner{3e-3 * numbers.sound(), 3e-3 * numbers.sound(), -1e-3 + 3e-3 * numbers.sound()};
        const int first_y = CellPosition::of(numbers.below(3)).first_y;
        SampleCell cell{};
        cell.has_edges = true;
        const Vec3 origin = corner + rotate(turn, {4.0 * h, 0.0, 0.0});  // counted from another sample
        const Vec3 axes[] = {rotate(turn, {h, 0, 0}), rotate(turn, {0, h, 0}), rotate(turn, {0, 0, h})};
        const auto put = [](Vec3 v, float(&to)[3]) {
            to[0] = static_cast<float>(v.x);
            to[1] = static_cast<float>(v.y);
            to[2] = static_cast<float>(v.z);
        };
        put(origin, cell.origin);
        for (std::size_t axis = 0; axis < 3; ++axis) put(axes[axis], cell.along[axis]);
        cell.first[0] = -4.0f;
        cell.first[1] = static_cast<float>(first_y);

        std::array<std::int16_t, layers> before, expected, after[2];
        std::array<bool, layers> is_of_cell;
        for (std::size_t s = 0; s < layers; ++s) {
            // What is there already, or a quantum beside it, or anything
            const double x = static_cast<double>(s % 9), y = static_cast<double>(s / 9 % 9),
                         z = static_cast<double>(s / 81);
            const double d = solid.distance(corner + x * axes[0] + y * axes[1] + z * axes[2]);
            const int near = quantised(-d, quantum), beside = near + static_cast<int>(numbers.below(3)) - 1;
            before[s] = static_cast<std::int16_t>(std::clamp(
                numbers.below(3) == 0 ? static_cast<int>(numbers.below(65535)) - 32767 : beside, -32767, 32767));
            is_of_cell[s] = static_cast<int>(y) >= first_y && static_cast<int>(y) < first_y + 3;
            const bool reaches = is_of_cell[s] && d <= band;
            expected[s] = reaches ? std::max(before[s], static_cast<std::int16_t>(near)) : before[s];
            ++(expected[s] > before[s] ? raised : kept);
            outside += reaches && d > 0.0;
        }
        for (const std::size_t k : {0u, 1u}) {
            after[k] = before;
            std::int16_t lowest = 0, highest = 0, least = 32767, most = -32767;
            const bool is_raised =
                (k == 0 ? plain : *fast)
                    .raise(solid.single(), cell, static_cast<float>(band), static_cast<float>(1.0 / quantum),
                           after[k].data() + first_y * stored_edge, lowest, highest, nullptr);
            ASSERT_EQ(is_raised, after[k] != before);
            for (std::size_t s = 0; s < layers; ++s) {
                // Single precision: coordinates of 5 mm are known to 0.5 nm, a fifteenth of a quantum, so it is one off
                // at most; and at the band's end a sample may count or not.
                const bool is_at_end = std::abs(expected[s] - -16384) < 3 || std::abs(after[k][s] - -16384) < 3;
                ASSERT_TRUE(is_at_end || std::abs(after[k][s] - expected[s]) <= 1)
                    << s << ": " << after[k][s] << ", " << expected[s];
                if (!is_of_cell[s]) {
                    ASSERT_EQ(after[k][s], before[s]);
                    continue;
                }
                least = std::min(least, after[k][s]);
                most = std::max(most, after[k][s]);
            }
            if (!is_raised) continue;
            ASSERT_EQ(lowest, least);
            ASSERT_EQ(highest, most);
        }
        ASSERT_EQ(after[0], after[1]);
    }
    EXPECT_GT(raised, 5000u);
    EXPECT_GT(kept, 5000u);
    EXPECT_GT(outside, 5000u);
}

TEST_F(BothKernels, FindTheSameSamples) {
    std::array<std::int16_t, 3 * stored_edge * stored_edge> samples;
    for (int n = 0; n < blocks; ++n) {
        for (auto& s : samples) s = static_cast<std::int16_t>(static_cast<int>(numbers.below(65535)) - 32767);
        const auto low = static_cast<std::int16_t>(-static_cast<int>(numbers.below(32767)));
        samples[numbers.below(27)] = low;
        samples[numbers.below(27)] = 0;
        std::uint32_t a[3], b[3];
        plain.find(samples.data(), low, 0, a);
        fast->find(samples.data(), low, 0, b);
        for (std::size_t layer = 0; layer < 3; ++layer) {
            ASSERT_EQ(a[layer], b[layer]);
            for (std::size_t s = 0; s < 27; ++s) {
                const std::int16_t v = samples[layer * 81 + s];
                ASSERT_EQ((a[layer] >> s & 1u) != 0, v >= low && v <= 0);
            }
        }
    }
}

TEST_F(BothKernels, FindTheSameDeepestSolid) {
    const ToolSolid solids[] = {test::drill_outline(1.6_mm, 59.0_deg, 3.0_mm),
                                ToolSolid({{0.0, 0.0}, {-1.0_mm, 1.5_mm}, {-2.0_mm, 0.5_mm}, {-3.0_mm, 1.0_mm}}),
                                test::blade_outline(10.0_mm, 2.0_mm, 2.0_mm, 1.5_mm),
                                ToolSolid::hollow({{0.0, 2.0_mm}, {-3.0_mm, 2.0_mm}}, 1.0_mm),
                                ToolSolid::parts({{0.0, 2.0_mm}, {-3.0_mm, 2.0_mm}}, 0.0, {{-1.0_mm, -1.5_mm}})};
    std::size_t found = 0, outside = 0;
    for (int n = 0; n < blocks; ++n) {
        const ToolSolid& solid = solids[static_cast<std::size_t>(n) % std::size(solids)];
        std::vector<Frame> frames;
        std::vector<SingleFrame> single_frames;
        for (int i = 0; i < 9; ++i) {
            frames.push_back(frame_of({1e-4 * Vec3{numbers.sound(), numbers.sound(), numbers.sound()},
                                       normalized(Quat{1.0, 0.02 * numbers.sound(), 0.02 * numbers.sound(), 0.0})}));
            single_frames.push_back(single(frames.back()));
        }
        std::vector<Vec3> in;
        for (std::size_t i = 1 + numbers.below(block_capacity); i > 0; --i)
            in.push_back({2.5e-3 * numbers.sound(), 2.5e-3 * numbers.sound(), -1.5e-3 + 2.5e-3 * numbers.sound()});
        FloatBlock start, depth[2], x[2], y[2], z[2];
        std::array<std::int32_t, block_capacity> which[2];
        for (float& d : start) d = static_cast<float>(1e-3 * numbers.sound());
        for (const std::size_t k : {0u, 1u}) {
            depth[k] = start;
            which[k].fill(-1);
            for (auto* v : {&x[k], &y[k], &z[k]}) v->fill(0.0f);
            (k == 0 ? plain : *fast)
                .deepest(solid.single(), single_frames.data(), frames.size(), in.size(), in.data(),
                         {depth[k].data(), which[k].data(), x[k].data(), y[k].data(), z[k].data()});
        }
        expect_same(depth[0], depth[1], in.size(), "depth");
        expect_same(which[0], which[1], in.size(), "which");
        for (std::size_t i = 0; i < in.size(); ++i) {
            double exact = static_cast<double>(start[i]);
            for (const Frame& f : frames) exact = std::max(exact, -solid.distance(f * in[i]));
            ASSERT_NEAR(static_cast<double>(depth[0][i]), exact, 2e-9 /* single precision at 5 mm */);
            if (which[0][i] < 0) continue;
            ++(depth[0][i] >= 0.0f ? found : outside);
            if (depth[0][i] < 0.0f || !solid.is_convex()) continue;
            ASSERT_TRUE(x[0][i] == x[1][i] && y[0][i] == y[1][i] && z[0][i] == z[1][i]) << i;
            // Along the way in the depth grows as far as it goes
            const Frame& f = frames[static_cast<std::size_t>(which[0][i])];
            const Vec3 way{static_cast<double>(x[0][i]), static_cast<double>(y[0][i]), static_cast<double>(z[0][i])};
            const double back = -solid.distance(f * (in[i] - 1e-5 * way));
            ASSERT_NEAR(-solid.distance(f * in[i]) - back, 1e-5, 1e-9) << i;
        }
    }
    EXPECT_GT(found, 1500u);
    EXPECT_GT(outside, 300u);
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
