// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/field/cut/solid_bits.h"
#include "core/field/grid/sample_set.h"

/// Which bone hangs together, and when it comes apart.
namespace kerf {

/// A part of what was one piece.
struct LoosePart {
    std::size_t samples = 0;
    SampleSet bone;
};

/// Bone hangs together over faces of voxels, as our surface joins it: what touches across an edge or a corner only is
/// two pieces.
///
/// Labels are kept brick by brick. Where a cut has taken samples, the bricks around are looked at as they were and as
/// they are: unless something there has fallen apart within the box, nothing has anywhere, for the ways around it are
/// all left. Only then is the graph of all bricks asked. That is exact: it finds what a flood of the whole volume
/// would.
class PieceFinder {
public:
    /// Looks at all of it.   [worker]
    PieceFinder(const Body& body, const CutField& cut);

    /// Bricks `changed` since the last call, by cutting alone: samples only ever go. Returns the parts that a piece has
    /// fallen into, for each piece that has, but for its largest part (of equal ones the one with the first sample),
    /// which stays; empty: nothing came apart. What is returned no longer counts as this finder's bone.   [worker]
    [[nodiscard]] std::vector<LoosePart> update(const CutField& cut, std::span<const std::size_t> changed);

    /// All bone there is.
    [[nodiscard]] SampleSet bone() const;
    [[nodiscard]] BrickBits bits(std::size_t brick_index) const noexcept {
        return count_[brick_index] != 0 ? bits_[brick_index] : BrickBits{};
    }
    [[nodiscard]] std::size_t samples() const noexcept;
    /// Pieces that do not hang together. Looks at the whole graph.
    [[nodiscard]] std::size_t count_pieces();

    /// How often the box did not suffice.
    [[nodiscard]] std::uint64_t whole_searches() const noexcept { return whole_searches_; }

private:
    struct Box {
        std::array<int, 3> first, last;
    };
    /// Of a brick, towards the six around it: −x, +x, −y, +y, −z, +z, a bit each.
    struct Sides {
        std::uint8_t touches = 0;   ///< both are in one piece, and these touch
        std::uint8_t is_asked = 0;  ///< one of them is in several: their components say what touches
    };
    struct Dirty {
        std::size_t brick;
        BrickBits before;
        Sides sides;                        ///< before
        std::vector<BrickBits> components;  ///< before; empty: one
        [[nodiscard]] std::span<const BrickBits> before_components() const noexcept {
            return components.empty() ? std::span<const BrickBits>(&before, 1) : std::span<const BrickBits>(components);
        }
    };

    [[nodiscard]] std::span<const BrickBits> components(std::size_t brick) const noexcept {
        if (count_[brick] == 0) return {};
        if (count_[brick] == 1) return {&bits_[brick], 1};
        return many_[static_cast<std::size_t>(slot_[brick])];
    }
    void label(std::size_t brick, const BrickBits& bits);
    void look_at_sides(std::size_t brick) noexcept;
    void look_at_side(std::size_t axis, std::size_t low, std::size_t high) noexcept;
    [[nodiscard]] bool holds(const Dirty& dirty) const noexcept;
    [[nodiscard]] std::vector<Dirty> take_neighbours(std::vector<Dirty>& left);
    void look_at_the_box(const std::vector<Dirty>& dirty);
    void look_at_everything();
    [[nodiscard]] std::uint32_t node(std::size_t brick, std::size_t component) const noexcept {
        return first_node_[brick] + static_cast<std::uint32_t>(component);
    }
    void join_everything();
    void take_away(const SampleSet& bone);
    [[nodiscard]] std::vector<LoosePart> loose_parts_of(const std::vector<std::vector<std::uint32_t>>& pieces);

    Grid grid_;
    std::array<std::size_t, 3> step_;   ///< to the next brick along an axis
    std::vector<BrickBits> bits_;       ///< of bricks that have bone
    std::vector<std::uint16_t> count_;  ///< components of a brick
    std::vector<std::uint16_t> samples_;
    std::vector<Sides> sides_;
    std::vector<std::uint8_t> is_full_;
    std::vector<std::int32_t> slot_;  ///< of a brick that has several, in `many_`
    std::vector<std::vector<BrickBits>> many_;
    std::vector<std::int32_t> free_slots_;

    // Of the whole graph, in which a row of bricks that touch along x is one node: the first node of a brick, and under
    // which node each stands; looked at, its root.
    std::vector<std::uint32_t> first_node_, parent_;
    struct Size {
        std::uint32_t samples = 0, full_bricks = 0, others = 0, part = 0;
    };
    std::vector<Size> size_;  ///< of a root
    std::uint64_t whole_searches_ = 0;

    // Of the box. For each component that fell apart in it: one brick and component of each of its parts.
    std::vector<std::vector<std::pair<std::size_t, std::size_t>>> fallen_apart_;
    struct Scratch {
        std::vector<std::uint32_t> before, after, first_before, first_after, part_of;
    } box_;
};

}  // namespace kerf
