// SPDX-License-Identifier: Apache-2.0
#include "core/field/pieces/present_bone.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/field/cut/piece_mask.h"
#include "core/field/fnv1a.h"

namespace kerf {

std::vector<std::size_t> BrickList::take() {
    std::vector<std::size_t> bricks = std::exchange(bricks_, {});
    std::sort(bricks.begin(), bricks.end());
    for (const std::size_t b : bricks) is_listed_[b] = 0;
    return bricks;
}

PresentPiece::PresentPiece(const Body& whole, CutField field)
    : bone(&whole),
      cut(std::move(field)),
      removed(whole),
      uncounted(whole.grid().brick_count()),
      changed(whole.grid().brick_count()) {}

PresentBone::PresentBone(const Body& body, std::size_t reserve_bricks) {
    pieces_.reserve(max_bodies);
    pieces_.push_back(std::make_unique<PresentPiece>(body, CutField(body, reserve_bricks)));
}

void PresentBone::find_pieces(double crumb) {
    finds_pieces_ = true;
    crumb_ = crumb;
    for (auto& piece : pieces_)
        if (!piece->finder) piece->finder.emplace(*piece->bone, piece->cut);
}

std::vector<NewSeparation> PresentBone::apply(const CutRecord& record, const ToolSolid& solid) {
    std::vector<NewSeparation> separations;
    for (std::size_t body = 0, count = pieces_.size(); body < count; ++body)
        if (is_recorded_as(body, record.body))
            if (auto separation = apply_to(static_cast<std::uint16_t>(body), record, solid))
                separations.push_back(std::move(*separation));
    return separations;
}

void PresentBone::mark_adopted(const Separation& separation) {
    for (std::size_t n = 1; n < separation.parts.size(); ++n) {
        PresentPiece& part = *pieces_[separation.parts[n].body];
        part.recorded_as.reset();
        part.image.reset();
    }
    for (auto& piece : pieces_) {  // a parent is before its parts
        if (!piece->recorded_as) continue;
        const std::uint16_t named = pieces_[piece->separated_from]->recorded_as.value_or(piece->separated_from);
        if (std::exchange(piece->recorded_as, named) != named) piece->image.reset();
    }
}

std::uint16_t PresentBone::add(const Body& body) {
    const auto id = static_cast<std::uint16_t>(pieces_.size());
    pieces_.push_back(std::make_unique<PresentPiece>(body, CutField(body, 0)));
    PresentPiece& piece = *pieces_.back();
    if (finds_pieces_) piece.finder.emplace(body, piece.cut);
    piece.separated_from = id;
    added_ += bone_volume(body, piece.cut);
    for (std::size_t b = 0; b < body.grid().brick_count(); ++b) piece.changed.add(b);
    return id;
}

BoneImage PresentBone::image() {
    count_removed();
    BoneImage all{{}, crumbs_, refused_, crumb_volume_, added_};
    for (auto& piece : pieces_) {
        if (piece->image == nullptr)
            piece->image = std::make_shared<const PieceImage>(PieceImage{
                piece->bone, piece->cut, piece->removed, piece->recorded_as, piece->separated_from, piece->history});
        all.pieces.push_back(piece->image);
    }
    return all;
}

void PresentBone::restore(const BoneImage& image) {
    crumbs_ = image.crumbs;
    refused_ = image.refused;
    crumb_volume_ = image.crumb_volume;
    added_ = image.added;
    pieces_.resize(std::min(pieces_.size(), image.pieces.size()));
    for (std::size_t body = 0; body < image.pieces.size(); ++body) {
        const PieceImage& was = *image.pieces[body];
        const bool is_new = body == pieces_.size();
        if (is_new) pieces_.push_back(std::make_unique<PresentPiece>(*was.bone, was.cut));
        PresentPiece& piece = *pieces_[body];
        if (piece.image == image.pieces[body]) continue;
        for (const std::size_t b :
             is_new ? CutField(*was.bone, 0).differing_bricks(was.cut) : piece.cut.differing_bricks(was.cut))
            piece.changed.add(b);
        piece.cut = was.cut;
        piece.removed = was.removed;
        (void)piece.uncounted.take();
        if (finds_pieces_) piece.finder.emplace(*piece.bone, piece.cut);
        piece.recorded_as = was.recorded_as;
        piece.separated_from = was.separated_from;
        piece.history = was.history;
        piece.image = image.pieces[body];
    }
}

std::optional<NewSeparation> PresentBone::apply_to(std::uint16_t body, const CutRecord& record,
                                                   const ToolSolid& solid) {
    PresentPiece& piece = *pieces_[body];
    piece.cut.stamp(record, solid);
    const std::vector<std::size_t> changed = piece.cut.take_changed();
    if (!changed.empty()) {
        piece.image.reset();
        piece.history.push(record);
    }
    for (const std::size_t b : changed) {
        piece.uncounted.add(b);
        piece.changed.add(b);
    }
    if (!piece.finder) return {};
    const std::vector<LoosePart> loose = piece.finder->update(piece.cut, changed);
    if (loose.empty()) return {};
    return part(body, record, loose);
}

NewSeparation PresentBone::part(std::uint16_t body, const CutRecord& record, const std::vector<LoosePart>& loose) {
    PresentPiece& parent = *pieces_[body];
    const Grid& g = parent.bone->grid();
    const double voxel = g.spacing * g.spacing * g.spacing;
    Separation separation;
    separation.sequence = record.sequence;
    separation.tick = record.tick;
    separation.parent = body;

    // All bone of the parent just before the separation.
    SampleSet stays = parent.finder->bone();
    SampleSet all = stays;
    for (const LoosePart& part : loose) all.add(part.bone);

    const auto volume_of = [&](std::size_t samples) { return static_cast<double>(samples) * voxel; };
    std::vector<const LoosePart*> kept;
    for (const LoosePart& part : loose) {
        if (volume_of(part.samples) < crumb_) {
            ++separation.crumbs;
            separation.crumb_volume += volume_of(part.samples);
        } else if (pieces_.size() + kept.size() < max_bodies) {
            kept.push_back(&part);
        } else {
            ++refused_;
            stays.add(part.bone);
        }
    }
    crumbs_ += separation.crumbs;
    crumb_volume_ += separation.crumb_volume;

    const auto mask_of = [&](const SampleSet& bone) { return std::make_shared<const PieceMask>(g, all, bone); };
    separation.parts.push_back({body, volume_of(parent.finder->samples()), mask_of(stays)});
    count_removed();
    CutField whole = std::move(parent.cut);
    for (const LoosePart* part : kept) {
        const auto id = static_cast<std::uint16_t>(pieces_.size());
        separation.parts.push_back({id, volume_of(part->samples), mask_of(part->bone)});
        auto piece = std::make_unique<PresentPiece>(*parent.bone, CutField(whole, *separation.parts.back().mask, 0));
        piece->removed.reset_baseline(piece->cut);
        piece->finder.emplace(*piece->bone, piece->cut);
        piece->recorded_as = parent.recorded_as.value_or(body);
        piece->separated_from = body;
        piece->history = parent.history;
        pieces_.push_back(std::move(piece));
    }
    parent.cut = CutField(whole, *separation.parts.front().mask, 0);
    parent.removed.reset_baseline(parent.cut);
    for (std::size_t b = 0; b < g.brick_count(); ++b)  // where parts separated, its surface has changed
        if (separation.parts.front().mask->removed_extent(b) != PieceMask::RemovedExtent::nothing)
            parent.changed.add(b);
    return {std::move(separation), std::move(whole)};
}

void PresentBone::reserve(std::size_t bricks) {
    for (auto& piece : pieces_) piece->cut.reserve(bricks);
}

void PresentBone::count_removed() {
    for (auto& piece : pieces_) piece->removed.update(piece->cut, piece->uncounted.take());
}

double PresentBone::removed_of_material(std::size_t m) {
    count_removed();
    double sum = 0.0;
    for (const auto& piece : pieces_) sum += piece->removed.of_material(m);
    return sum;
}

double PresentBone::removed() {
    count_removed();
    double sum = 0.0;
    for (const auto& piece : pieces_) sum += piece->removed.total();
    return sum;
}

std::uint64_t PresentBone::hash() const noexcept {
    if (pieces_.size() == 1) return pieces_.front()->cut.hash();
    Fnv1a hash;
    for (const auto& piece : pieces_) hash.add_bytes(piece->cut.hash(), 8);
    return hash.value();
}

}  // namespace kerf
