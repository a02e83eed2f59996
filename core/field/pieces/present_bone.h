// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/field/cut/cut_history.h"
#include "core/field/cut/removed_volume.h"
#include "core/field/pieces/piece_finder.h"

/// The present bone: every record is stamped at once, and separated parts are pieces.
namespace kerf {

inline constexpr std::size_t max_bodies = 16;

/// The separation of a body, at the record of the last cut before it.
struct Separation {
    std::uint64_t sequence = 0, tick = 0;  ///< of the record, in the parent's count
    std::uint16_t parent = 0;
    struct Part {
        std::uint16_t body;  ///< the parent first, then the separated parts: ids in the order of their first sample
        double volume;       ///< [m³]
        std::shared_ptr<const PieceMask> mask;
    };
    std::vector<Part> parts;
    std::size_t crumbs = 0;     ///< pieces too small to keep: removed from every body
    double crumb_volume = 0.0;  ///< [m³]
};

/// A list of bricks without duplicates.
class BrickList {
public:
    explicit BrickList(std::size_t brick_count) : is_listed_(brick_count, 0) {}
    void add(std::size_t brick) {
        if (std::exchange(is_listed_[brick], std::uint8_t{1}) == 0) bricks_.push_back(brick);
    }
    /// Returns the bricks in ascending order, and empties the list.
    [[nodiscard]] std::vector<std::size_t> take();

private:
    std::vector<std::uint8_t> is_listed_;
    std::vector<std::size_t> bricks_;
};

/// A snapshot of a piece.
struct PieceImage {
    const Body* bone;
    CutField cut;
    RemovedVolume removed;
    std::optional<std::uint16_t> recorded_as;
    std::uint16_t separated_from;
    CutHistory history;
};

/// A snapshot of all bone. Snapshots use common copies of pieces that did not change between them.
struct BoneImage {
    std::vector<std::shared_ptr<const PieceImage>> pieces;
    std::size_t crumbs = 0, refused = 0;
    double crumb_volume = 0.0, added = 0.0;
};

/// One of several bodies that use the same fields of bone.
struct PresentPiece {
    PresentPiece(const Body& whole, CutField field);

    const Body* bone;
    CutField cut;                              ///< without lag
    RemovedVolume removed;                     ///< cut from it since it became a body, except in
    BrickList uncounted;                       ///< these changed bricks
    std::optional<PieceFinder> finder;         ///< only if pieces are searched for
    BrickList changed;                         ///< since `take_changed`
    std::optional<std::uint16_t> recorded_as;  ///< until adoption, records of its cuts name this body
    std::uint16_t separated_from = 0;          ///< the body from which it separated
    CutHistory history;                        ///< the records that changed it and its former bodies
    std::shared_ptr<const PieceImage> image;   ///< its present state, once a snapshot was taken
};

class PresentBone {
public:
    /// Makes body 0 from all of `body`; `reserve` bricks are allocated.   [main]
    PresentBone(const Body& body, std::size_t reserve);

    /// Starts the search for pieces: bone that separates becomes a body, if it is larger than `crumb` [m³].   [main]
    void find_pieces(double crumb);

    /// Stamps a record into its body, and into separated parts of that body that have not been adopted. Makes bodies of
    /// parts that it separates, and returns the separations.   [worker]
    std::vector<Separation> apply(const CutRecord& record, const ToolSolid& solid);
    /// Marks a separation as adopted: later records name its parts themselves.   [worker]
    void mark_adopted(const Separation& separation);

    /// Adds another body, which must outlive this object. Returns its id. Pre: fewer than `max_bodies`.   [worker]
    std::uint16_t add(const Body& body);

    /// Returns a snapshot for `restore`.   [worker]
    [[nodiscard]] BoneImage image();
    /// Restores a snapshot bit for bit; bodies that are newer than it are removed.   [worker]
    void restore(const BoneImage& image);

    [[nodiscard]] std::size_t count() const noexcept { return pieces_.size(); }
    [[nodiscard]] const PresentPiece& piece(std::size_t body) const noexcept { return *pieces_[body]; }
    [[nodiscard]] PresentPiece& piece(std::size_t body) noexcept { return *pieces_[body]; }
    [[nodiscard]] const CutField& cut(std::size_t body = 0) const noexcept { return pieces_[body]->cut; }
    /// Returns the bricks of a body that changed since the last call, ascending.   [worker]
    [[nodiscard]] std::vector<std::size_t> take_changed(std::size_t body) { return pieces_[body]->changed.take(); }

    /// Allocates memory for the cuts of a tick.   [main, worker]
    void reserve(std::size_t bricks);

    /// Returns the volume cut from all bodies [m³]; in total or of one material. Counts the changes since the last
    /// call. [worker]
    [[nodiscard]] double removed();
    [[nodiscard]] double removed_of_material(std::size_t m);
    [[nodiscard]] double crumb_volume() const noexcept { return crumb_volume_; }
    [[nodiscard]] std::size_t crumbs() const noexcept { return crumbs_; }
    [[nodiscard]] double added() const noexcept { return added_; }  ///< [m³] of bodies added later
    /// Returns the number of pieces that stayed with their parent because there are sixteen bodies already.
    [[nodiscard]] std::size_t refused() const noexcept { return refused_; }
    /// Returns the hash over all bodies, in the order of their ids.
    [[nodiscard]] std::uint64_t hash() const noexcept;

private:
    [[nodiscard]] std::optional<Separation> apply_to(std::uint16_t body, const CutRecord& record,
                                                     const ToolSolid& solid);
    void count_removed();
    [[nodiscard]] Separation part(std::uint16_t body, const CutRecord& record, const std::vector<LoosePart>& loose);

    std::vector<std::unique_ptr<PresentPiece>> pieces_;
    bool finds_pieces_ = false;
    double crumb_ = 0.0, crumb_volume_ = 0.0, added_ = 0.0;
    std::size_t crumbs_ = 0, refused_ = 0;
};

}  // namespace kerf
