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

/// The bone as it is now: every record stamped at once, in pieces where it has come apart.
namespace kerf {

inline constexpr std::size_t most_bodies = 16;

/// A record parted a body.
struct Separation {
    std::uint64_t sequence = 0, tick = 0;  ///< of the record, in the parent's count
    std::uint16_t parent = 0;
    struct Part {
        std::uint16_t body;  ///< the parent first, then what came off it: ids in the order of their first sample
        double volume;       ///< [m³]
        std::shared_ptr<const PieceMask> mask;
    };
    std::vector<Part> parts;
    std::size_t crumbs = 0;     ///< pieces too small to keep: their bone is gone in every body
    double crumb_volume = 0.0;  ///< [m³]
};

/// Bricks, each once.
class BrickList {
public:
    explicit BrickList(std::size_t brick_count) : is_listed_(brick_count, 0) {}
    void add(std::size_t brick) {
        if (std::exchange(is_listed_[brick], std::uint8_t{1}) == 0) bricks_.push_back(brick);
    }
    /// Ascending; empties the list.
    [[nodiscard]] std::vector<std::size_t> take();

private:
    std::vector<std::uint8_t> is_listed_;
    std::vector<std::size_t> bricks_;
};

/// A piece as it was at one time.
struct PieceImage {
    const Body* bone;
    CutField cut;
    RemovedVolume removed;
    std::optional<std::uint16_t> still_in;
    std::uint16_t came_off;
    CutHistory history;
};

/// All bone as it was at one time. Images share the pieces that did not change between them.
struct BoneImage {
    std::vector<std::shared_ptr<const PieceImage>> pieces;
    std::size_t crumbs = 0, refused = 0;
    double crumb_volume = 0.0, added = 0.0;
};

/// One body of several that share their bone's fields.
struct PresentPiece {
    PresentPiece(const Body& whole, CutField field);

    const Body* bone;
    CutField cut;                             ///< without lag
    RemovedVolume removed;                    ///< cut from it since it is a body of its own, but for the bricks
    BrickList uncounted;                      ///< in here
    std::optional<PieceFinder> finder;        ///< if pieces are looked for
    BrickList changed;                        ///< since `take_changed`
    std::optional<std::uint16_t> still_in;    ///< until it is adopted, records that cut it name this body
    std::uint16_t came_off = 0;               ///< the body that it was part of before
    CutHistory history;                       ///< the records that changed it, and what it was part of
    std::shared_ptr<const PieceImage> image;  ///< as it is, once somebody asked
};

class PresentBone {
public:
    /// All of `body` is body 0; `reserve` bricks are ready.   [main]
    PresentBone(const Body& body, std::size_t reserve);

    /// From now on bone that comes apart becomes bodies of its own, if it is larger than `crumb` [m³].   [main]
    void look_for_pieces(double crumb);

    /// Stamps a record into its body, and into what came off that body and has not been adopted. What that parts gets
    /// bodies; what happened is said.   [worker]
    std::vector<Separation> apply(const CutRecord& record, const ToolSolid& solid);
    /// From now on records name the parts of a separation themselves.   [worker]
    void adopted(const Separation& separation);

    /// Another body beside those that there are, which must outlive this; its id.   [worker] Pre: fewer than
    /// `most_bodies`.
    std::uint16_t add(const Body& body);

    /// As it is now, to be brought back.   [worker]
    [[nodiscard]] BoneImage image();
    /// Brings back all of what was, to the bit; bodies that there were not then are gone.   [worker]
    void restore(const BoneImage& image);

    [[nodiscard]] std::size_t count() const noexcept { return pieces_.size(); }
    [[nodiscard]] const PresentPiece& piece(std::size_t body) const noexcept { return *pieces_[body]; }
    [[nodiscard]] PresentPiece& piece(std::size_t body) noexcept { return *pieces_[body]; }
    [[nodiscard]] const CutField& cut(std::size_t body = 0) const noexcept { return pieces_[body]->cut; }
    /// Bricks of a body that changed since the last call, ascending.   [worker]
    [[nodiscard]] std::vector<std::size_t> take_changed(std::size_t body) { return pieces_[body]->changed.take(); }

    /// Makes room for the cuts of a tick.   [main, worker]
    void reserve(std::size_t bricks);

    /// [m³] cut from all bodies; of a material. Counts what has changed since it was asked last.   [worker]
    [[nodiscard]] double removed();
    [[nodiscard]] double removed_of_material(std::size_t m);
    [[nodiscard]] double crumb_volume() const noexcept { return crumb_volume_; }
    [[nodiscard]] std::size_t crumbs() const noexcept { return crumbs_; }
    [[nodiscard]] double added() const noexcept { return added_; }  ///< [m³] of bodies that came later
    /// Pieces that were left with their parent because there are sixteen bodies.
    [[nodiscard]] std::size_t refused() const noexcept { return refused_; }
    /// Over all bodies, in the order of their ids.
    [[nodiscard]] std::uint64_t hash() const noexcept;

private:
    [[nodiscard]] std::optional<Separation> apply_to(std::uint16_t body, const CutRecord& record,
                                                     const ToolSolid& solid);
    void count_removed();
    [[nodiscard]] Separation part(std::uint16_t body, const CutRecord& record, std::vector<LoosePart> loose);

    std::vector<std::unique_ptr<PresentPiece>> pieces_;
    bool looks_for_pieces_ = false;
    double crumb_ = 0.0, crumb_volume_ = 0.0, added_ = 0.0;
    std::size_t crumbs_ = 0, refused_ = 0;
};

}  // namespace kerf
