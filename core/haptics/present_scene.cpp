// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/present_scene.h"

#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>

namespace kerf {

bool Placing::is_same_as(const Placing& other) const noexcept {
    const Quat a = world_from_body.rotation, b = other.world_from_body.rotation;
    return world_from_body.position == other.world_from_body.position &&
           std::tie(a.w, a.x, a.y, a.z) == std::tie(b.w, b.x, b.y, b.z) && group == other.group &&
           is_cuttable == other.is_cuttable && is_present == other.is_present;
}

PresentScene::PresentScene(const Body& body, std::vector<const ToolSolid*> cutting)
    : cutting_(std::move(cutting)), bone_(body, live_reserve) {}

void PresentScene::apply(std::span<const CutRecord> records, const Placings& now) {
    if (!begun_) begun_ = moment(now);
    for (const CutRecord& record : records)
        for (Separation& separation : bone_.apply(record, *cutting_[record.solid]))
            waiting_.push_back(std::move(separation));
}

void PresentScene::leave_bone() {
    if (!begun_) return;
    Moment before = std::move(*begun_);
    begun_.reset();
    // Who passes by bone changes distances in the air, and that is no cut.
    if (bone_.removed() != removed_in(before.bone)) keep(std::move(before));
}

void PresentScene::keep_for_undo(const Placings& now) {
    leave_bone();
    keep(moment(now));
}

double PresentScene::removed_in(const BoneImage& bone) noexcept {
    double sum = 0.0;
    for (const auto& piece : bone.pieces) sum += piece->removed.total();
    return sum;
}

Separation PresentScene::take_adopted() {
    Separation first = std::move(waiting_.front());
    waiting_.erase(waiting_.begin());
    bone_.adopted(first);
    return first;
}

void PresentScene::keep(Moment before) {
    if (undo_.size() == most_undo) undo_.erase(undo_.begin());
    undo_.push_back(std::move(before));
    redo_.clear();
}

Restoration PresentScene::restoration(Turn turn) const {
    const Moment& then = moments(turn).back();
    Restoration restoration;
    restoration.turn = turn;
    restoration.placings = then.placings;
    restoration.bodies.reserve(most_bodies);
    for (std::size_t id = 0; id < then.placings.count; ++id) {
        const PieceImage& piece = *then.bone.pieces[id];
        restoration.bodies.push_back(
            live_body(static_cast<std::uint16_t>(id), *piece.bone, piece.cut, *cutting_.front()));
    }
    return restoration;
}

void PresentScene::go(Turn turn, const Placings& now) {
    auto& from = turn == Turn::undo ? undo_ : redo_;
    auto& to = turn == Turn::undo ? redo_ : undo_;
    to.push_back(moment(now));
    bone_.restore(from.back().bone);
    waiting_ = std::move(from.back().waiting);
    from.pop_back();
}

}  // namespace kerf
