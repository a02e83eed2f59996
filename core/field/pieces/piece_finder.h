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

/// Finds connected pieces of bone, and detects when a cut separates one.
namespace kerf {

/// A part that a cut has separated from a piece.
struct LoosePart {
    std::size_t samples = 0;
    SampleSet bone;
};

/// Bone is connected over faces of voxels, as in the surface mesh: parts that touch only across an edge or a corner are
/// two pieces.
///
/// Components are labelled brick by brick. Where a cut has removed samples, the finder compares the components in the
/// box of bricks around it before and after. If none of them has split, no piece has, because all paths outside the box
/// still exist. Otherwise it searches the graph of all bricks. This is exact: the result equals a flood fill of the
/// whole volume.
class PieceFinder {
public:
    /// Labels all bone.   [worker]
    PieceFinder(const Body& body, const CutField& cut);

    /// Processes the bricks `changed` since the last call. Pre: they changed by cutting alone, so samples were only
    /// removed. Returns the parts into which pieces have split, without the largest part of each piece, which stays. Of
    /// equally large parts, the one with the first sample stays. Empty: no piece has split. Returned parts no longer
    /// belong to this finder's bone. [worker]
    [[nodiscard]] std::vector<LoosePart> update(const CutField& cut, std::span<const std::size_t> changed);

    /// Returns all bone that this finder has left.
    [[nodiscard]] SampleSet bone() const;
    [[nodiscard]] BrickBits bits(std::size_t brick_index) const noexcept {
        return count_[brick_index] != 0 ? bits_[brick_index] : BrickBits{};
    }
    [[nodiscard]] std::size_t samples() const noexcept;
    /// Returns the number of connected pieces. Searches the whole graph.
    [[nodiscard]] std::size_t count_pieces();

    /// Returns how often the whole graph was searched: by `update`, if a component in the box had split, and by
    /// `count_pieces`.
    [[nodiscard]] std::uint64_t whole_searches() const noexcept { return whole_searches_; }

private:
    struct Box {
        std::array<int, 3> first, last;
    };
    /// Contacts of a brick with its six neighbours: −x, +x, −y, +y, −z, +z, one bit each.
    struct Sides {
        std::uint8_t touches = 0;           ///< both bricks have one component, and these touch
        std::uint8_t needs_components = 0;  ///< both have bone, and one has several components: compare these
    };
    struct Dirty {
        std::size_t brick;
        BrickBits before;
        Sides sides;                        ///< contacts before the cut
        std::vector<BrickBits> components;  ///< before the cut; empty: one
        [[nodiscard]] std::span<const BrickBits> before_components() const noexcept {
            return components.empty() ? std::span<const BrickBits>(&before, 1) : std::span<const BrickBits>(components);
        }
    };

    [[nodiscard]] std::span<const BrickBits> components(std::size_t brick) const noexcept {
        if (count_[brick] == 0) return {};
        if (count_[brick] == 1) return {&bits_[brick], 1};
        return many_[static_cast<std::size_t>(slot_[brick])];
    }
    void set_components(std::size_t brick, const BrickBits& bits);
    void update_contacts(std::size_t brick) noexcept;
    void update_contact(std::size_t axis, std::size_t low, std::size_t high) noexcept;
    [[nodiscard]] bool is_unsplit(const Dirty& dirty) const noexcept;
    [[nodiscard]] std::vector<Dirty> take_neighbours(std::vector<Dirty>& left);
    void search_box(const std::vector<Dirty>& dirty);
    void search_graph();
    [[nodiscard]] std::uint32_t node(std::size_t brick, std::size_t component) const noexcept {
        return first_node_[brick] + static_cast<std::uint32_t>(component);
    }
    void join_everything();
    void remove_bone(const SampleSet& bone);
    [[nodiscard]] std::vector<LoosePart> loose_parts_of(const std::vector<std::vector<std::uint32_t>>& pieces);

    Grid grid_;
    std::array<std::size_t, 3> step_;   ///< difference of index to the next brick along an axis
    std::vector<BrickBits> bits_;       ///< of each brick; valid if it has bone
    std::vector<std::uint16_t> count_;  ///< components of a brick
    std::vector<std::uint16_t> samples_;
    std::vector<Sides> sides_;
    std::vector<std::uint8_t> is_full_;
    std::vector<std::int32_t> slot_;  ///< index into `many_` of a brick with several components; else −1
    std::vector<std::vector<BrickBits>> many_;
    std::vector<std::int32_t> free_slots_;

    // The whole graph. A node is a component of a brick; a row of bricks with one component that touch along x is a
    // single node. Stored: for each brick its first node; for each node its parent, which is its root after a search.
    std::vector<std::uint32_t> first_node_, parent_;
    struct Size {
        std::uint32_t samples = 0, full_bricks = 0, others = 0, part = 0;
    };
    std::vector<Size> size_;  ///< by root
    std::uint64_t whole_searches_ = 0;

    // Results of `search_box`. For each component of a box that has split: a brick and the number of a component in
    // each part.
    std::vector<std::vector<std::pair<std::size_t, std::size_t>>> split_components_;
    struct Scratch {
        std::vector<std::uint32_t> before, after, first_before, first_after, part_of;
    } box_;
};

}  // namespace kerf
