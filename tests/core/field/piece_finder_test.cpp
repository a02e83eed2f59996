// SPDX-License-Identifier: Apache-2.0
#include "core/field/pieces/piece_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "core/field/cut/piece_mask.h"
#include "tests/support/block.h"
#include "tests/support/whole_volume.h"

namespace kerf {
namespace {

using namespace literals;

// ---- one brick ----------------------------------------------------------------------------------------------------

TEST(BrickBits, ComponentsOfABrickAreThoseOfAFlood) {
    std::mt19937 random(7);
    for (int round = 0; round < 2000; ++round) {
        // Given a brick from nearly empty to nearly full
        BrickBits bits;
        test::SolidVolume volume{{8, 8, 8}, std::vector<std::uint8_t>(512, 0)};
        for (int s = 0; s < 512; ++s)
            if (static_cast<int>(random() % 100) < round % 100) {
                bits.add(s % 8, s / 8 % 8, s / 64);
                volume.solid[static_cast<std::size_t>(s)] = 1;
            }

        ASSERT_EQ(bits.count(), static_cast<int>(std::count(volume.solid.begin(), volume.solid.end(), 1)));

        // When its components are taken out one by one
        std::size_t found = 0;
        std::vector<std::uint32_t> label(512, 0);
        for (BrickBits left = bits; !left.is_empty(); ++found) {
            const BrickBits one = take_component(left);
            for (int s = 0; s < 512; ++s)
                if (one.has(s % 8, s / 8 % 8, s / 64))
                    label[static_cast<std::size_t>(s)] = static_cast<std::uint32_t>(found + 1);
        }

        // Then they are the flood's, and in its order
        ASSERT_EQ(label, test::flooded(volume)) << "round " << round;
    }
}

TEST(BrickBits, AFullOneHasAllItsSamples) { EXPECT_EQ(BrickBits::full().count(), 512); }

TEST(BrickBits, NeighboursTouchOverTheFaceTheyShare) {
    BrickBits last, first;
    last.add(7, 3, 5);
    first.add(0, 3, 5);
    EXPECT_TRUE(touch_along(0, last, first));
    EXPECT_FALSE(touch_along(0, first, last));
    EXPECT_FALSE(touch_along(1, last, first));
    BrickBits above;
    above.add(0, 4, 5);
    EXPECT_FALSE(touch_along(0, last, above)) << "over an edge only";
    BrickBits back, front, low, high;
    back.add(2, 7, 1);
    front.add(2, 0, 1);
    EXPECT_TRUE(touch_along(1, back, front));
    low.add(4, 6, 7);
    high.add(4, 6, 0);
    EXPECT_TRUE(touch_along(2, low, high));
}

// ---- a body -------------------------------------------------------------------------------------------------------

CutRecord stretch(const Pose& from, const Pose& to) {
    CutRecord record;
    record.from = from;
    record.to = to;
    return record;
}

Body bone(double spacing, const std::function<double(Vec3)>& distance, Vec3 low, Vec3 high) {
    Body body;
    const Grid grid = Grid::covering(low - Vec3{1e-3, 1e-3, 1e-3}, high + Vec3{1e-3, 1e-3, 1e-3}, spacing);
    body.surface = LevelSet::build(grid, distance);
    body.materials.push_back({"cortical", 1850.0, {}});
    return body;
}

/// A disc that saws like a blade: 12 mm across the cut, 0.8 mm thick.
ToolSolid disc() { return ToolSolid({{0.4_mm, 12.0_mm}, {-0.4_mm, 12.0_mm}}); }

/// A tube along x. Its walls are sawn through from +z to −z.
Body tube(double spacing) {
    return bone(spacing,
                [](Vec3 p) {
                    const double r = std::hypot(p.y, p.z);
                    return std::max({r - 6.0_mm, 3.0_mm - r, std::abs(p.x) - 9.0_mm});
                },
                {-9.0_mm, -6.0_mm, -6.0_mm}, {9.0_mm, 6.0_mm, 6.0_mm});
}

/// The disc across x, its rim at height z.
Pose blade_at(double x, double rim) { return {{x, 0, rim + 12.0_mm}, {std::sqrt(0.5), 0, std::sqrt(0.5), 0}}; }

TEST(PieceFinder, AgreesWithAFloodOfTheWholeVolumeRecordByRecord) {
    // Given a tube, and a saw cut through it at a third of its length
    const Body body = tube(0.4_mm);
    CutField cut(body, 256);
    PieceFinder finder(body, cut);
    const ToolSolid blade = disc();
    ASSERT_EQ(finder.count_pieces(), 1u);
    const std::size_t whole = finder.samples();

    // When it is sawn, a tenth of a voxel a record
    std::vector<LoosePart> parts;
    int splits = 0;
    for (double rim = 6.5_mm; rim > -6.5_mm; rim -= 0.04_mm) {
        cut.stamp(stretch(blade_at(2.5_mm, rim), blade_at(2.5_mm, rim - 0.04_mm)), blade);
        auto loose = finder.update(cut, cut.take_changed());
        // Then at every record the flood finds as many pieces as have come off and are left
        std::vector<std::size_t> sizes;
        (void)test::flooded(test::solid_volume(body, cut), &sizes);
        splits += !loose.empty();
        for (auto& part : loose) parts.push_back(std::move(part));
        ASSERT_EQ(sizes.size(), parts.size() + 1) << "rim at " << rim * 1e3 << " mm";
    }
    EXPECT_EQ(splits, 1);
    ASSERT_EQ(parts.size(), 1u);

    // and the sizes add up to what it has left, the smaller end being the one that came off
    std::vector<std::size_t> sizes = test::pieces_by_runs(test::solid_volume(body, cut));
    ASSERT_EQ(sizes.size(), 2u);
    EXPECT_EQ(finder.samples(), sizes[0]);
    EXPECT_EQ(parts[0].samples, sizes[1]);
    EXPECT_LT(sizes[0] + sizes[1], whole);
    EXPECT_EQ(finder.count_pieces(), 1u);
    EXPECT_LE(finder.whole_searches(), 6u) << "most records are settled in the box";
}

TEST(PieceFinder, AgreesWithAFloodInBoneThatFallsIntoManyCrumbs) {
    // Given a lattice of thin struts, and a ball of 3 mm that scribbles through it
    const double h = 0.25_mm;
    const Body body = bone(h,
                           [](Vec3 p) {
                               const double k = 2.0 * pi / 2.2_mm;
                               const double gyroid = std::sin(k * p.x) * std::cos(k * p.y) +
                                                     std::sin(k * p.y) * std::cos(k * p.z) +
                                                     std::sin(k * p.z) * std::cos(k * p.x);
                               return std::max({(std::abs(gyroid) - 0.28) / (2.0 * k), std::abs(p.x) - 6.0_mm,
                                                std::abs(p.y) - 6.0_mm, std::abs(p.z) - 6.0_mm});
                           },
                           {-6.0_mm, -6.0_mm, -6.0_mm}, {6.0_mm, 6.0_mm, 6.0_mm});
    CutField cut(body, 1024);
    PieceFinder finder(body, cut);
    const ToolSolid ball({{0.8_mm, 0.9_mm}, {-0.8_mm, 0.9_mm}});
    std::vector<std::size_t> at_first;
    (void)test::flooded(test::solid_volume(body, cut), &at_first);
    ASSERT_EQ(finder.count_pieces(), at_first.size());

    std::mt19937 random(11);
    std::uniform_real_distribution<double> anywhere(-6.0_mm, 6.0_mm);
    std::size_t separated_from = 0, samples_off = 0;
    Vec3 at{anywhere(random), anywhere(random), anywhere(random)};
    for (int n = 0; n < 120; ++n) {
        const Vec3 next{anywhere(random), anywhere(random), anywhere(random)};
        cut.stamp(stretch({at, {1, 0, 0, 0}}, {next, {1, 0, 0, 0}}), ball);
        at = next;
        for (const LoosePart& part : finder.update(cut, cut.take_changed())) {
            ++separated_from;
            samples_off += part.samples;
            std::size_t counted = 0;
            part.bone.for_each(
                [&](std::size_t, const BrickBits& bits) { counted += static_cast<std::size_t>(bits.count()); });
            EXPECT_EQ(counted, part.samples);
        }
        // What came off is no longer the finder's, and the volume still holds it unless a later stroke took it: so
        // compare what is left with the flood's piece of the same samples.
        test::SolidVolume left = test::solid_volume(body, cut);
        for (std::size_t b = 0; b < body.grid().brick_count(); ++b) {
            const auto [i, j, k] = body.grid().brick_coordinates(b);
            for (int s = 0; s < 512; ++s) {
                const std::size_t v = left.at(8 * i + s % 8, 8 * j + s / 8 % 8, 8 * k + s / 64);
                const bool is_left = finder.bits(b).has(s % 8, s / 8 % 8, s / 64);
                ASSERT_LE(is_left, left.solid[v]) << "stroke " << n;
                left.solid[v] = is_left;
            }
        }
        const auto pieces = test::pieces_by_runs(left);
        ASSERT_EQ(finder.count_pieces(), pieces.size()) << "stroke " << n;
        ASSERT_LE(pieces.size(), at_first.size()) << "what came apart in stroke " << n << " was not said";
    }
    EXPECT_GT(separated_from, 20u) << "the scene is to make crumbs";
    EXPECT_GT(samples_off, 0u);
}

TEST(PieceFinder, PiecesThatWereApartFromTheBeginningAreNoSplit) {
    const Body body = bone(0.5_mm,
                           [](Vec3 p) {
                               return std::max({std::abs(std::abs(p.x) - 4.0_mm) - 2.0_mm, std::abs(p.y) - 3.0_mm,
                                                std::abs(p.z) - 3.0_mm});
                           },
                           {-6.0_mm, -3.0_mm, -3.0_mm}, {6.0_mm, 3.0_mm, 3.0_mm});
    CutField cut(body, 64);
    PieceFinder finder(body, cut);
    EXPECT_EQ(finder.count_pieces(), 2u);
    cut.stamp(stretch(blade_at(0.0, 5.0_mm), blade_at(0.0, -5.0_mm)), disc());
    EXPECT_TRUE(finder.update(cut, cut.take_changed()).empty());
    EXPECT_EQ(finder.count_pieces(), 2u);
}

TEST(PieceFinder, BoneBeyondTheRegionHoldsNothingTogether) {
    // Given a bar that reaches out of the region at both ends
    Body body = bone(0.5_mm, [](Vec3 p) { return std::max(std::abs(p.y) - 3.0_mm, std::abs(p.z) - 3.0_mm); },
                     {-8.0_mm, -3.0_mm, -3.0_mm}, {8.0_mm, 3.0_mm, 3.0_mm});
    const Grid& g = body.grid();
    body.region = {g.sample_position(4, 1, 1), g.sample_position(g.samples(0) - 4, g.samples(1) - 2, g.samples(2) - 2)};
    CutField cut(body, 64);
    PieceFinder finder(body, cut);
    const test::SolidVolume volume = test::solid_volume(body, cut);
    EXPECT_EQ(finder.samples(), test::pieces_by_runs(volume).at(0));
    cut.stamp(stretch(blade_at(1.0_mm, 5.0_mm), blade_at(1.0_mm, -5.0_mm)), disc());
    EXPECT_EQ(finder.update(cut, cut.take_changed()).size(), 1u);
}

// ---- what a piece keeps -------------------------------------------------------------------------------------------

struct SawnTube {
    Body body = tube(0.4_mm);
    CutField cut{body, 256};
    PieceFinder finder{body, cut};
    SampleSet all;
    std::vector<LoosePart> parts;

    SawnTube() {
        cut.stamp(stretch(blade_at(2.5_mm, 6.5_mm), blade_at(2.5_mm, -6.5_mm)), disc());
        parts = finder.update(cut, cut.take_changed());
        all = PieceFinder(body, cut).bone();
    }
    double at(const CutField& field, Vec3 p) const {
        const LocatedPoint place = locate(body, p);
        return std::max(body.surface.at(place), field.at(place));
    }
};

TEST(PieceMask, EachPieceHoldsItsOwnSamplesAndTogetherTheyHoldAll) {
    SawnTube sawn;
    ASSERT_EQ(sawn.parts.size(), 1u);
    const CutField stump(sawn.cut, PieceMask(sawn.body.grid(), sawn.all, sawn.finder.bone()), 16);
    const CutField end(sawn.cut, PieceMask(sawn.body.grid(), sawn.all, sawn.parts[0].bone), 16);
    const auto all = test::solid_volume(sawn.body, sawn.cut), first = test::solid_volume(sawn.body, stump),
               second = test::solid_volume(sawn.body, end);
    std::size_t in_first = 0, in_second = 0;
    for (std::size_t s = 0; s < all.solid.size(); ++s) {
        ASSERT_EQ(all.solid[s], first.solid[s] | second.solid[s]);
        ASSERT_EQ(first.solid[s] & second.solid[s], 0);
        in_first += first.solid[s];
        in_second += second.solid[s];
    }
    EXPECT_EQ(in_first, sawn.finder.samples());
    EXPECT_EQ(in_second, sawn.parts[0].samples);
}

TEST(PieceMask, APieceKnowsItsOwnDistancesAndNoWallOfTheOther) {
    SawnTube sawn;
    const CutField stump(sawn.cut, PieceMask(sawn.body.grid(), sawn.all, sawn.finder.bone()), 16);
    const double h = sawn.body.grid().spacing;
    for (double x = -8.0_mm; x < 8.5_mm; x += 0.07_mm)
        for (double turn = 0.0; turn < 2.0 * pi; turn += 0.1) {
            const Vec3 p{x, 4.5_mm * std::cos(turn), 4.5_mm * std::sin(turn)};  // in the middle of the wall
            const double here = sawn.at(stump, p);
            if (x < 2.0_mm) {
                EXPECT_NEAR(here, sawn.at(sawn.cut, p), 1e-12) << "its own bone and the cut in it are as they were";
            } else if (x > 2.6_mm) {
                EXPECT_GT(here, 0.9 * std::min(x - 2.1_mm, sawn.body.grid().clamp()) - h)
                    << "x = " << x * 1e3 << " mm: nothing is left of the other";
            }
        }
}

TEST(PieceMask, CuttingAPieceGivesTheBitsOfCuttingTheWhole) {
    // Given a stump, and the same cut made before and after the end came off
    SawnTube sawn;
    const ToolSolid ball({{1.0_mm, 1.0_mm}, {-1.0_mm, 1.0_mm}});
    const CutRecord later = stretch({{-4.0_mm, 0, 7.0_mm}, {1, 0, 0, 0}}, {{-3.0_mm, 0, 3.0_mm}, {1, 0, 0, 0}});
    const PieceMask mask(sawn.body.grid(), sawn.all, sawn.finder.bone());
    CutField stump(sawn.cut, mask, 16);
    stump.stamp(later, ball);
    sawn.cut.stamp(later, ball);
    // Then away from the cut between them both hold the same
    int compared = 0;
    for (std::size_t b = 0; b < sawn.body.grid().brick_count(); ++b) {
        if (mask.removed_extent(b) != PieceMask::RemovedExtent::nothing || sawn.body.surface.is_all_air(b)) continue;
        const auto [i, j, k] = sawn.body.grid().brick_coordinates(b);
        for (int s = 0; s < 512; ++s)
            ASSERT_EQ(stump.sample(8 * i + s % 8, 8 * j + s / 8 % 8, 8 * k + s / 64),
                      sawn.cut.sample(8 * i + s % 8, 8 * j + s / 8 % 8, 8 * k + s / 64));
        ++compared;
    }
    EXPECT_GT(compared, 50);
}

TEST(PieceMask, StoredSamplesOnAFaceThatTwoBricksShareAgree) {
    SawnTube sawn;
    const CutField stump(sawn.cut, PieceMask(sawn.body.grid(), sawn.all, sawn.finder.bone()), 16);
    const Grid& g = sawn.body.grid();
    for (std::size_t b = 0; b < g.brick_count(); ++b) {
        if (sawn.body.surface.is_all_air(b) || stump.stored(b) == nullptr) continue;
        const auto [i, j, k] = g.brick_coordinates(b);
        for (int z = 0; z < stored_edge; ++z)
            for (int y = 0; y < stored_edge; ++y)
                for (int x = 0; x < stored_edge; ++x) {
                    const int at[3] = {8 * i + x, 8 * j + y, 8 * k + z};
                    if (at[0] >= g.samples(0) || at[1] >= g.samples(1) || at[2] >= g.samples(2)) continue;
                    if (sawn.body.surface.is_all_air(g.brick_index(at[0] / 8, at[1] / 8, at[2] / 8))) continue;
                    ASSERT_EQ(stump.stored(b)[(z * stored_edge + y) * stored_edge + x],
                              stump.sample(at[0], at[1], at[2]));
                }
    }
}

}  // namespace
}  // namespace kerf
