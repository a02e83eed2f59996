// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/scene/bone_scene.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>

#include "core/field/pieces/bridge.h"

namespace kerf {

bool Placing::is_same_as(const Placing& other) const noexcept {
    const Quat a = world_from_body.rotation, b = other.world_from_body.rotation;
    return world_from_body.position == other.world_from_body.position &&
           std::tie(a.w, a.x, a.y, a.z) == std::tie(b.w, b.x, b.y, b.z) && group == other.group &&
           is_cuttable == other.is_cuttable && is_present == other.is_present;
}

BoneScene::BoneScene(const Body& body, std::vector<const ToolSolid*> cutting)
    : cutting_(std::move(cutting)), bone_(body, live_reserve), next_(1, 0) {}

void BoneScene::look_for_pieces(double crumb, Belongings belongings) {
    belongings_ = std::move(belongings);
    bone_.look_for_pieces(crumb);
}

// ---- cuts ---------------------------------------------------------------------------------------------------------

void BoneScene::apply(std::span<const CutRecord> records, const Placings& now) {
    if (!begun_) {
        begun_ = moment(now);
        begun_->placings.threads = threads_;  // a thread may have begun before the first record was closed
    }
    for (const CutRecord& record : records) {
        for (Separation& separation : bone_.apply(record, *cutting_[record.solid]))
            wait_for_the_loop(std::move(separation));
        next_[record.body] = record.sequence + 1;
    }
    removing_ += records.size();
}

void BoneScene::wait_for_the_loop(Separation separation) {
    Owners owners = waiting_.empty() ? belongings_.owners : waiting_.back().owners;
    std::vector<std::size_t> bodies;
    for (const auto& part : separation.parts) bodies.push_back(part.body);
    if (belongings_.pass_on) belongings_.pass_on(owners, separation.parent, bodies, bone_);
    waiting_.push_back({std::move(separation), std::move(owners)});
}

void BoneScene::leave_bone() {
    if (!begun_) return;
    Moment before = std::move(*begun_);
    begun_.reset();
    // A tool that passes near the bone changes distances in air. This is no cut.
    if (bone_.removed() != removed_in(before.bone)) keep(std::move(before));
}

double BoneScene::removed_in(const BoneImage& bone) noexcept {
    double sum = 0.0;
    for (const auto& piece : bone.pieces) sum += piece->removed.total();
    return sum;
}

void BoneScene::keep(Moment before) {
    if (undo_.size() == most_undo) undo_.erase(undo_.begin());
    undo_.push_back(std::move(before));
    redo_.clear();
}

void BoneScene::keep_for_undo(const Placings& before) {
    leave_bone();
    keep(moment(before));
}

// ---- offers -------------------------------------------------------------------------------------------------------

Offer BoneScene::separation() const {
    const auto& [first, owners] = waiting_.front();
    Offer offer;
    offer.change = Offer::Change::separation;
    offer.tick = first.tick;
    offer.separation = first;
    offer.owners = owners;
    for (const auto& part : first.parts) {
        const std::uint16_t id = part.body;
        offer.made[id] = {live_body(id, *bone_.piece(id).bone, bone_.cut(id), *cutting_.front()), first.parent,
                          next_[first.parent]};
        offer.placings.count = std::max<std::size_t>(offer.placings.count, id + 1u);
    }
    return offer;
}

Offer BoneScene::turn(Turn turn) const {
    const Moment& then = moments(turn).back();
    Offer offer;
    offer.change = turn == Turn::undo ? Offer::Change::undo : Offer::Change::redo;
    offer.removing = removing_;
    offer.placings = then.placings;
    offer.owners = then.owners;
    for (std::size_t id = 0; id < then.placings.count; ++id) {
        const PieceImage& piece = *then.bone.pieces[id];
        offer.made[id].body = live_body(static_cast<std::uint16_t>(id), *piece.bone, piece.cut, *cutting_.front());
    }
    return offer;
}

namespace {
std::string why_no_more_bodies(const Placings& now) {
    return now.count < most_bodies
               ? std::string{}
               : "there are " + std::to_string(most_bodies) + " bodies already, which is the most there may be";
}
}  // namespace

Offer BoneScene::addition(Offer::Change change, const Body& body, const Placing& placing, const Placings& now,
                          std::string& why_not) const {
    if (why_not = why_no_more_bodies(now); !why_not.empty()) return {};
    const std::size_t id = now.count;
    Offer offer;
    offer.change = change;
    offer.added = &body;
    offer.placings = now;
    offer.placings.of[offer.placings.count++] = placing;
    offer.owners = belongings_.owners;
    offer.made[id].body = std::make_unique<LiveBody>(static_cast<std::uint16_t>(id), body, CutField(body, live_reserve),
                                                     *cutting_.front());
    return offer;
}

Offer BoneScene::insertion(const Body& body, const Pose& world_from_body, bool is_cuttable, const Placings& now,
                           std::string& why_not) const {
    const auto& tissues = bone_.piece(0).bone->materials;
    if (is_cuttable && !std::equal(tissues.begin(), tissues.end(), body.materials.begin(), body.materials.end(),
                                   [](const Material& a, const Material& b) { return a.id == b.id; })) {
        why_not = "the tissues of `" + body.id + "` are not those of the bone";
        return {};
    }
    const auto group = static_cast<std::uint16_t>(now.count);
    return addition(Offer::Change::insertion, body, {world_from_body, group, is_cuttable, true}, now, why_not);
}

Offer BoneScene::fusion(std::size_t held, const Placings& now, std::string& why_not) {
    if (why_not = why_no_more_bodies(now); !why_not.empty()) return {};
    const Placing& holding = now.of[held];
    const auto bone_of = [&](std::size_t id) { return CutBone{bone_.piece(id).bone, &bone_.cut(id)}; };
    std::optional<Bridge> nearest;
    std::uint16_t beyond = 0;  // group of the piece at the far end
    for (std::size_t other = 0; other < now.count; ++other) {
        const Placing& there = now.of[other];
        if (there.group == holding.group || !there.is_present || !there.is_cuttable) continue;
        auto bridge =
            bridge_between(bone_of(held), bone_of(other), inverse(there.world_from_body) * holding.world_from_body);
        if (!bridge || (nearest && nearest->span <= bridge->span)) continue;
        nearest = std::move(bridge);
        beyond = there.group;
    }
    if (!nearest) {
        const double reach = clamp_voxels * bone_.piece(0).bone->grid().spacing;
        why_not = "no other piece is near enough to what is held: within about " +
                  std::to_string(static_cast<int>(2e3 * reach)) + " mm";
        return {};
    }
    grown_.push_back(std::make_unique<Body>(std::move(nearest->bone)));
    Offer offer = addition(Offer::Change::fusion, *grown_.back(), {holding.world_from_body, holding.group, true, true},
                           now, why_not);
    for (std::size_t b = 0; b < now.count; ++b)
        if (offer.placings.of[b].group == beyond) offer.placings.of[b].group = holding.group;
    return offer;
}

Offer BoneScene::subtraction(std::uint16_t solid, const Pose& world_from_tool, const Placings& now) const {
    Offer offer;
    offer.change = Offer::Change::subtraction;
    offer.placings.count = now.count;
    offer.owners = belongings_.owners;
    for (std::size_t id = 0; id < now.count; ++id) {
        if (!now.of[id].is_present || !now.of[id].is_cuttable) continue;
        CutRecord record;
        record.body = static_cast<std::uint16_t>(id);
        record.solid = solid;
        record.from = record.to = inverse(now.of[id].world_from_body) * world_from_tool;
        auto body = live_body(record.body, *bone_.piece(id).bone, bone_.cut(id), *cutting_.front());
        body->committed.stamp(record, *cutting_[solid]);
        offer.made[id] = {std::move(body), record.body, next_[id]};
        offer.subtracted.push_back(record);
    }
    return offer;
}

// ---- changes taken over by the loop --------------------------------------------------------------------------------

void BoneScene::taken(const Offer& offer, const Placings& before, std::uint64_t next_sequence) {
    switch (offer.change) {
        case Offer::Change::none:
            return;
        case Offer::Change::separation:
            bone_.adopted(waiting_.front().separation);
            waiting_.erase(waiting_.begin());
            next_.resize(std::max(next_.size(), offer.placings.count), 0);
            break;
        case Offer::Change::undo:
        case Offer::Change::redo:
            go(offer.change == Offer::Change::undo ? Turn::undo : Turn::redo, before, next_sequence);
            break;
        case Offer::Change::insertion:
        case Offer::Change::fusion:
            keep_for_undo(before);
            bone_.add(*offer.added);
            next_.resize(offer.placings.count, 0);
            break;
        case Offer::Change::subtraction:
            leave_bone();
            apply(offer.subtracted, before);
            leave_bone();  // the subtraction is an undo step of its own
            break;
    }
    belongings_.owners = offer.owners;
}

void BoneScene::go(Turn turn, const Placings& before, std::uint64_t next_sequence) {
    auto& from = turn == Turn::undo ? undo_ : redo_;
    auto& to = turn == Turn::undo ? redo_ : undo_;
    to.push_back(moment(before));
    Moment then = std::move(from.back());
    from.pop_back();
    bone_.restore(then.bone);
    waiting_ = std::move(then.waiting);
    next_.assign(then.placings.count, next_sequence);
}

}  // namespace kerf
