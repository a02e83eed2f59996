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

/// The split of a body into parts by the cut of one record.
struct Separation {
    std::uint64_t sequence = 0, tick = 0;  ///< of the record
    std::uint16_t parent = 0;
    struct Part {
        std::uint16_t body;  ///< the parent first, then the parts that separated, with new ids
        double volume;       ///< [m³]
        std::shared_ptr<const PieceMask> mask;
    };
    std::vector<Part> parts;
    std::size_t crumbs = 0;     ///< parts too small to keep: deleted from all bodies
    double crumb_volume = 0.0;  ///< [m³]
};

/// A list of brick indices without duplicates.
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

/// A snapshot of a `PresentPiece`.
struct PieceImage {
    const Body* bone;
    CutField cut;
    RemovedVolume removed;
    std::optional<std::uint16_t> recorded_as;
    std::uint16_t separated_from;
    CutHistory history;
};

/// A snapshot of all bone. A piece that did not change between snapshots is stored once for all of them.
struct BoneImage {
    std::vector<std::shared_ptr<const PieceImage>> pieces;
    std::size_t crumbs = 0, refused = 0;
    double crumb_volume = 0.0, added = 0.0;
};

/// A body: a `Body` with its own cut. Bodies that separated from each other use the same `Body`.
struct PresentPiece {
    PresentPiece(const Body& whole, CutField field);

    const Body* bone;
    CutField cut;                              ///< with all records, without lag
    RemovedVolume removed;                     ///< volume cut from it since it became a body, except in `uncounted`
    BrickList uncounted;                       ///< changed bricks that `removed` does not yet include
    std::optional<PieceFinder> finder;         ///< set after `find_pieces`
    BrickList changed;                         ///< since `take_changed`
    std::optional<std::uint16_t> recorded_as;  ///< body that records of its cuts name, until it is adopted
    std::uint16_t separated_from = 0;          ///< the body from which it separated; else its own id
    CutHistory history;                        ///< records that changed it, also as a part of former bodies
    std::shared_ptr<const PieceImage> image;   ///< snapshot of its present state; null: none yet
};

/// A separation that a record has made.
struct NewSeparation {
    Separation separation;
    CutField before;  ///< cut of the parent with the record, when it still had all parts
};

class PresentBone {
public:
    /// Makes body 0 from all of `body`, and allocates `reserve` bricks for its cut.   [main]
    PresentBone(const Body& body, std::size_t reserve);

    /// Starts the search for pieces. From now on, a part that separates becomes a body. If its volume is below `crumb`
    /// [m³], it is deleted and counted. Beyond `max_bodies`, it stays with its parent and is counted.   [main]
    void find_pieces(double crumb);

    /// Stamps a record on the body that it names, and on parts of that body that are not yet adopted. Makes bodies of
    /// parts that this separates. Returns the separations.   [worker]
    std::vector<NewSeparation> apply(const CutRecord& record, const ToolSolid& solid);
    /// Returns whether records of cuts of `body` name `named`.   [worker]
    [[nodiscard]] bool is_recorded_as(std::size_t body, std::size_t named) const noexcept {
        return body == named || pieces_[body]->recorded_as == named;
    }
    /// Marks the parts of a separation as adopted: later records of their cuts, and of parts that separated from them
    /// since, name these parts.   [worker]
    void mark_adopted(const Separation& separation);

    /// Adds another body, which must outlive this object. Returns its id. Pre: fewer than `max_bodies`.   [worker]
    std::uint16_t add(const Body& body);

    /// Returns a snapshot for `restore`.   [worker]
    [[nodiscard]] BoneImage image();
    /// Restores a snapshot bit for bit. Removes bodies that it does not contain.   [worker]
    void restore(const BoneImage& image);

    [[nodiscard]] std::size_t count() const noexcept { return pieces_.size(); }
    [[nodiscard]] const PresentPiece& piece(std::size_t body) const noexcept { return *pieces_[body]; }
    [[nodiscard]] PresentPiece& piece(std::size_t body) noexcept { return *pieces_[body]; }
    [[nodiscard]] const CutField& cut(std::size_t body = 0) const noexcept { return pieces_[body]->cut; }
    /// Returns the indices of the bricks of a body that changed since the last call, ascending.   [worker]
    [[nodiscard]] std::vector<std::size_t> take_changed(std::size_t body) { return pieces_[body]->changed.take(); }

    /// Makes at least `bricks` bricks free in the cut of every body.   [main, worker]
    void reserve(std::size_t bricks);

    /// Returns the volume cut from all bodies so far [m³], in total or of material `m`. First counts bricks that
    /// changed since the last call. [worker]
    [[nodiscard]] double removed();
    [[nodiscard]] double removed_of_material(std::size_t m);
    [[nodiscard]] double crumb_volume() const noexcept { return crumb_volume_; }
    [[nodiscard]] std::size_t crumbs() const noexcept { return crumbs_; }
    [[nodiscard]] double added() const noexcept { return added_; }  ///< [m³] of bodies added later
    /// Returns the number of parts that stayed with their parent because there were already `max_bodies` bodies.
    [[nodiscard]] std::size_t refused() const noexcept { return refused_; }
    /// Returns the hash of the cut of a single body, or of the hashes of all bodies' cuts in the order of their ids.
    [[nodiscard]] std::uint64_t hash() const noexcept;

private:
    [[nodiscard]] std::optional<NewSeparation> apply_to(std::uint16_t body, const CutRecord& record,
                                                        const ToolSolid& solid);
    void count_removed();
    [[nodiscard]] NewSeparation part(std::uint16_t body, const CutRecord& record, const std::vector<LoosePart>& loose);

    std::vector<std::unique_ptr<PresentPiece>> pieces_;
    bool finds_pieces_ = false;
    double crumb_ = 0.0, crumb_volume_ = 0.0, added_ = 0.0;
    std::size_t crumbs_ = 0, refused_ = 0;
};

}  // namespace kerf
