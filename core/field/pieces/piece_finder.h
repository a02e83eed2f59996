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

/// Finds connected bone, and the moment at which it comes apart.
namespace kerf {

/// A part that has separated from a piece.
struct LoosePart {
    std::size_t samples = 0;
    SampleSet bone;
};

/// Bone is connected over faces of voxels, as in our surface mesh: parts that touch only across an edge or a corner are
/// two pieces.
///
/// Components are labelled brick by brick. Where a cut has removed samples, the finder compares the components of the
/// bricks around it before and after. If no component of this box has split, no piece has, because all paths around the
/// box still exist. Only otherwise it searches the graph of all bricks. This is exact: the result equals a flood fill
/// of the whole volume.
class PieceFinder {
public:
    /// Labels all bone.   [worker]
    PieceFinder(const Body& body, const CutField& cut);

    /// Processes the bricks `changed` since the last call. Pre: they changed by cutting alone, so samples were only
    /// removed. Returns the parts that separated from each piece, without its largest part (of equal parts, the one
    /// with the first sample), which stays. Empty: nothing came apart. Returned parts no longer belong to this finder's
    /// bone. [worker]
    [[nodiscard]] std::vector<LoosePart> update(const CutField& cut, std::span<const std::size_t> changed);

    /// Returns all bone.
    [[nodiscard]] SampleSet bone() const;
    [[nodiscard]] BrickBits bits(std::size_t brick_index) const noexcept {
        return count_[brick_index] != 0 ? bits_[brick_index] : BrickBits{};
    }
    [[nodiscard]] std::size_t samples() const noexcept;
    /// Returns the number of pieces. Searches the whole graph.
    [[nodiscard]] std::size_t count_pieces();

    /// Returns how often the whole graph was searched because the box did not suffice.
    [[nodiscard]] std::uint64_t whole_searches() const noexcept { return whole_searches_; }

private:
    struct Box {
        std::array<int, 3> first, last;
    };
    /// Contacts of a brick with its six neighbours: −x, +x, −y, +y, −z, +z, one bit each.
    struct Sides {
        std::uint8_t touches = 0;           ///< both have one component, and these touch
        std::uint8_t needs_components = 0;  ///< one of them has several components: compare these
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
    std::array<std::size_t, 3> step_;   ///< index distance to the next brick along an axis
    std::vector<BrickBits> bits_;       ///< of bricks that have bone
    std::vector<std::uint16_t> count_;  ///< components of a brick
    std::vector<std::uint16_t> samples_;
    std::vector<Sides> sides_;
    std::vector<std::uint8_t> is_full_;
    std::vector<std::int32_t> slot_;  ///< of a brick with several components: index into `many_`
    std::vector<std::vector<BrickBits>> many_;
    std::vector<std::int32_t> free_slots_;

    // The whole graph. A row of bricks that touch along x is one node. For each brick its first node; for each node its
    // parent, which is its root after a search.
    std::vector<std::uint32_t> first_node_, parent_;
    struct Size {
        std::uint32_t samples = 0, full_bricks = 0, others = 0, part = 0;
    };
    std::vector<Size> size_;  ///< by root
    std::uint64_t whole_searches_ = 0;

    // The box. For each component that split in it: one brick and component of each of its parts.
    std::vector<std::vector<std::pair<std::size_t, std::size_t>>> split_components_;
    struct Scratch {
        std::vector<std::uint32_t> before, after, first_before, first_after, part_of;
    } box_;
};

}  // namespace kerf
