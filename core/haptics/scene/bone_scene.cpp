// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/scene/bone_scene.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>

#include "core/field/pieces/bridge.h"

namespace kerf {

bool BodyState::is_same_as(const BodyState& other) const noexcept {
    const Quat a = world_from_body.rotation, b = other.world_from_body.rotation;
    return world_from_body.position == other.world_from_body.position &&
           std::tie(a.w, a.x, a.y, a.z) == std::tie(b.w, b.x, b.y, b.z) && group == other.group &&
           is_cuttable == other.is_cuttable && is_present == other.is_present;
}

BoneScene::BoneScene(const Body& body, std::vector<const ToolSolid*> cutting)
    : cutting_(std::move(cutting)), bone_(body, live_reserve), next_(1, 0) {}

void BoneScene::find_pieces(double crumb, BodyOwnership belongings) {
    belongings_ = std::move(belongings);
    bone_.find_pieces(crumb);
}

// ---- cuts ---------------------------------------------------------------------------------------------------------

void BoneScene::apply(std::span<const CutRecord> records, const BodyStates& now) {
    if (!before_cut_) {
        before_cut_ = snapshot(now);
        before_cut_->body_states.threads = threads_;  // those of `now` may contain a thread of this cut
    }
    for (const CutRecord& record : records) {
        stamp_waiting(record);
        for (NewSeparation& found : bone_.apply(record, *cutting_[record.solid])) wait_for_the_loop(std::move(found));
        next_[record.body] = record.sequence + 1;
    }
    removing_ += records.size();
}

/// Stamps a record on the cuts that are kept for waiting separations.
void BoneScene::stamp_waiting(const CutRecord& record) {
    for (Waiting& waiting : waiting_)
        for (auto& [body, cut] : waiting.without_later)
            if (bone_.is_recorded_as(body, record.body)) static_cast<void>(cut.stamp(record, *cutting_[record.solid]));
}

void BoneScene::wait_for_the_loop(NewSeparation found) {
    Separation& separation = found.separation;
    const auto has_parent = [&](const auto& part) { return part.body == separation.parent; };
    for (auto waiting = waiting_.rbegin(); waiting != waiting_.rend(); ++waiting) {
        if (std::none_of(waiting->separation.parts.begin(), waiting->separation.parts.end(), has_parent)) continue;
        waiting->without_later.try_emplace(separation.parent, std::move(found.before));
        break;  // earlier ones have theirs since this one was found
    }
    Owners owners = waiting_.empty() ? belongings_.owners : waiting_.back().owners;
    std::vector<std::size_t> bodies;
    for (const auto& part : separation.parts) bodies.push_back(part.body);
    if (belongings_.inherit) belongings_.inherit(owners, separation.parent, bodies, bone_);
    waiting_.push_back({std::move(separation), std::move(owners)});
}

void BoneScene::end_cut() {
    if (!before_cut_) return;
    Snapshot before = std::move(*before_cut_);
    before_cut_.reset();
    // Records that changed only distances in air, next to the bone, are no cut.
    if (bone_.removed() != removed_in(before.bone)) keep(std::move(before));
}

double BoneScene::removed_in(const BoneImage& bone) noexcept {
    double sum = 0.0;
    for (const auto& piece : bone.pieces) sum += piece->removed.total();
    return sum;
}

void BoneScene::keep(Snapshot before) {
    if (undo_.size() == max_undo) undo_.erase(undo_.begin());
    undo_.push_back(std::move(before));
    redo_.clear();
}

void BoneScene::push_undo_of(const BodyStates& before) {
    end_cut();
    keep(snapshot(before));
}

// ---- offers -------------------------------------------------------------------------------------------------------

Offer BoneScene::separation() const {
    const auto& [first, owners, without_later] = waiting_.front();
    Offer offer;
    offer.change = Offer::Change::separation;
    offer.tick = first.tick;
    offer.separation = first;
    offer.owners = owners;
    for (const auto& part : first.parts) {
        const std::uint16_t id = part.body;
        const auto kept = without_later.find(id);
        const CutField& cut = kept != without_later.end() ? kept->second : bone_.cut(id);
        offer.made[id] = {live_body(id, *bone_.piece(id).bone, cut, *cutting_.front()), first.parent,
                          next_[first.parent]};
        offer.body_states.count = std::max<std::size_t>(offer.body_states.count, id + 1u);
    }
    return offer;
}

Offer BoneScene::turn(HistoryChange turn) const {
    const Snapshot& then = snapshots(turn).back();
    Offer offer;
    offer.change = turn == HistoryChange::undo ? Offer::Change::undo : Offer::Change::redo;
    offer.removing = removing_;
    offer.body_states = then.body_states;
    offer.owners = then.owners;
    for (std::size_t id = 0; id < then.body_states.count; ++id) {
        const PieceImage& piece = *then.bone.pieces[id];
        offer.made[id].body = live_body(static_cast<std::uint16_t>(id), *piece.bone, piece.cut, *cutting_.front());
    }
    return offer;
}

namespace {
std::string why_no_more_bodies(const BodyStates& now) {
    return now.count < max_bodies
               ? std::string{}
               : "there are " + std::to_string(max_bodies) + " bodies already, which is the most there may be";
}
}  // namespace

Offer BoneScene::addition(Offer::Change change, const Body& body, const BodyState& body_state, const BodyStates& now,
                          std::string& why_not) const {
    if (why_not = why_no_more_bodies(now); !why_not.empty()) return {};
    const std::size_t id = now.count;
    Offer offer;
    offer.change = change;
    offer.added = &body;
    offer.body_states = now;
    offer.body_states.of[offer.body_states.count++] = body_state;
    offer.owners = belongings_.owners;
    offer.made[id].body = std::make_unique<LiveBody>(static_cast<std::uint16_t>(id), body, CutField(body, live_reserve),
                                                     *cutting_.front());
    return offer;
}

Offer BoneScene::insertion(const Body& body, const Pose& world_from_body, bool is_cuttable, const BodyStates& now,
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

Offer BoneScene::fusion(std::size_t held, const BodyStates& now, std::string& why_not) {
    if (why_not = why_no_more_bodies(now); !why_not.empty()) return {};
    const BodyState& holding = now.of[held];
    const auto bone_of = [&](std::size_t id) { return CutBone{bone_.piece(id).bone, &bone_.cut(id)}; };
    std::optional<Bridge> nearest;
    std::uint16_t beyond = 0;  // group of the body at the far end of the bridge
    for (std::size_t other = 0; other < now.count; ++other) {
        const BodyState& there = now.of[other];
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
        if (offer.body_states.of[b].group == beyond) offer.body_states.of[b].group = holding.group;
    return offer;
}

Offer BoneScene::subtraction(std::uint16_t solid, const Pose& world_from_tool, const BodyStates& now) const {
    Offer offer;
    offer.change = Offer::Change::subtraction;
    offer.body_states.count = now.count;
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

Offer BoneScene::committed(const std::function<bool(std::size_t)>& needs) const {
    Offer offer;
    offer.body_states.count = bone_.count();
    for (std::size_t id = 0; id < bone_.count(); ++id) {
        if (!needs(id)) continue;
        const auto number = static_cast<std::uint16_t>(id);
        offer.change = Offer::Change::committed;
        offer.made[id] = {live_body(number, *bone_.piece(id).bone, bone_.cut(id), *cutting_.front()), number,
                          next_[id]};
    }
    return offer;
}

// ---- changes taken over by the loop --------------------------------------------------------------------------------

void BoneScene::taken(const Offer& offer, const BodyStates& before, std::uint64_t next_sequence) {
    switch (offer.change) {
        case Offer::Change::none:
        case Offer::Change::committed:
            return;
        case Offer::Change::separation:
            bone_.mark_adopted(waiting_.front().separation);
            waiting_.erase(waiting_.begin());
            next_.resize(std::max(next_.size(), offer.body_states.count), 0);
            break;
        case Offer::Change::undo:
        case Offer::Change::redo:
            go(offer.change == Offer::Change::undo ? HistoryChange::undo : HistoryChange::redo, before, next_sequence);
            break;
        case Offer::Change::insertion:
        case Offer::Change::fusion:
            push_undo_of(before);
            bone_.add(*offer.added);
            next_.resize(offer.body_states.count, 0);
            break;
        case Offer::Change::subtraction:
            end_cut();
            apply(offer.subtracted, before);
            end_cut();  // the subtraction is an undo step of its own
            break;
    }
    belongings_.owners = offer.owners;
}

void BoneScene::go(HistoryChange turn, const BodyStates& before, std::uint64_t next_sequence) {
    auto& from = turn == HistoryChange::undo ? undo_ : redo_;
    auto& to = turn == HistoryChange::undo ? redo_ : undo_;
    to.push_back(snapshot(before));
    Snapshot then = std::move(from.back());
    from.pop_back();
    bone_.restore(then.bone);
    waiting_ = std::move(then.waiting);
    next_.assign(then.body_states.count, next_sequence);
}

}  // namespace kerf
