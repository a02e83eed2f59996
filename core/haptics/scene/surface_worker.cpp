// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/scene/surface_worker.h"

#include <chrono>
#include <cstddef>
#include <utility>

namespace kerf {

namespace {
constexpr std::size_t queue_records = 4096;                   // 4 s at 1 kHz
constexpr std::size_t queue_margin = 64;                      // with fewer free slots, no offer is taken over
constexpr auto poll_time = std::chrono::milliseconds(2);      // the loop wakes no thread: that is a system call
constexpr auto surface_time = std::chrono::milliseconds(16);  // no screen refreshes faster
}  // namespace

SurfaceWorker::SurfaceWorker(const Body& body, std::vector<const ToolSolid*> cutting, Options options,
                             BodyOwnership belongings)
    : owners_(options.finds_pieces ? belongings.owners : Owners{}),
      options_(options),
      scene_(body, std::move(cutting)),
      queue_(queue_records) {
    if (options_.finds_pieces) scene_.find_pieces(options_.crumb, std::move(belongings));
    if (options_.makes_surface) patches_.reserve(max_bodies);
    make_surface();
    thread_ = std::thread([this] { work(); });
}

SurfaceWorker::~SurfaceWorker() {
    {
        const std::lock_guard lock(mutex_);
        is_stopping_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

// ---- the loop's side ----------------------------------------------------------------------------------------------

bool SurfaceWorker::send(const Message& message) noexcept {
    if (!queue_.push(message)) {
        lost_.fetch_add(1, std::memory_order_relaxed);
        return false;
    }
    pushed_.fetch_add(1, std::memory_order_release);
    return true;
}

bool SurfaceWorker::push(const CutRecord& record) noexcept {
    is_clear_sent_ = false;
    return send({.kind = Message::Kind::cut, .record = record});
}

bool SurfaceWorker::request(HistoryChange turn) noexcept {
    if (requested_ || is_request_pending_) return false;
    requested_ = turn;
    return true;
}

SurfaceWorker::TakenOver SurfaceWorker::exchange(HapticLoop& loop, std::uint64_t delay) noexcept {
    TakenOver taken;
    sent_records_ = 0;
    send_cuts(loop);
    if (queue_.size() + queue_margin > queue_.capacity()) return taken;
    if (separation_.is_out(turns_) && separation_.offer.tick + delay <= loop.ticks()) {
        taken.separation = take(separation_, loop);
        separation_.set(taken.separation ? Slot::taken : Slot::refused, turns_);
        // Sent through the queue, so that the worker gets it after the records that came before the takeover.
        if (taken.separation) (void)send({.kind = Message::Kind::parted});
    }
    if (turn_.is_out(turns_)) take_turn(loop, taken);
    if (requested_) {  // sent after `clear_of_bone`, which ends the cut
        sent_turn_ = *requested_;
        is_request_pending_ =
            send({.kind = sent_turn_ == HistoryChange::undo ? Message::Kind::undo : Message::Kind::redo});
        requested_.reset();
    }
    return taken;
}

void SurfaceWorker::send_cuts(const HapticLoop& loop) noexcept {
    bool has_cut = false;
    for (; sent_records_ < loop.closed().size(); ++sent_records_) {
        const CutRecord& record = loop.closed()[sent_records_];
        if (!record.removes) continue;
        if (!std::exchange(has_cut, true)) send_body_states(loop);
        (void)push(record);
    }
    if (!has_cut && !is_clear_sent_ && loop.is_clear_of_bone())
        is_clear_sent_ = send({.kind = Message::Kind::clear_of_bone});
}

void SurfaceWorker::send_body_states(const HapticLoop& loop) noexcept {
    const BodyStates now = loop.body_states();
    for (std::size_t b = 0; b < now.count; ++b) {
        if (b < sent_states_.count && now.of[b].is_same_as(sent_states_.of[b])) continue;
        Message message{.kind = Message::Kind::body_changed,
                        .count = static_cast<std::uint16_t>(now.count),
                        .body_state = now.of[b]};
        message.record.body = static_cast<std::uint16_t>(b);
        (void)send(message);
    }
    sent_states_ = now;
}

bool SurfaceWorker::take(Slot& slot, HapticLoop& loop) noexcept {
    if (!loop.take(slot.offer)) return false;
    owners_ = slot.offer.owners;  // same sizes as before: no allocation
    return true;
}

void SurfaceWorker::take_turn(HapticLoop& loop, TakenOver& taken) noexcept {
    is_request_pending_ = false;
    send_body_states(loop);
    const bool has_been_taken = turn_.offer.is_any() && take(turn_, loop);
    send_cuts(loop);  // the records that the takeover closed
    turn_.set(Slot::taken, turns_);
    (has_been_taken ? taken.turn : taken.refused_change) = sent_turn_;
    Message message{.kind = has_been_taken ? Message::Kind::turned : Message::Kind::dropped};
    if (has_been_taken) {
        ++turns_;
        sent_states_ = loop.body_states();
        message.record.sequence = loop.next_sequence();
    }
    (void)send(message);
}

// ---- the side of other threads -----------------------------------------------------------------------------------

void SurfaceWorker::wait_for_all() {
    std::unique_lock lock(mutex_);
    ++waiting_for_all_;
    wake_.notify_all();
    idle_.wait(lock, [&] {
        return done_.load(std::memory_order_acquire) == pushed_.load(std::memory_order_acquire) && !is_surface_old_ &&
               !separation_.is(Slot::refused);
    });
    --waiting_for_all_;
}

std::shared_ptr<const SurfaceWorker::Surface> SurfaceWorker::surface() const {
    const std::lock_guard lock(mutex_);
    return surface_;
}

// ---- the worker's side --------------------------------------------------------------------------------------------

void SurfaceWorker::work() {
    using Clock = std::chrono::steady_clock;
    auto surface_made = Clock::now();
    bool is_waited_for = false;
    for (;;) {
        const std::uint64_t taken = take_all();
        if (separation_.is(Slot::refused)) offer_separation();
        const bool is_old = is_surface_old_ || taken > 0;
        const bool is_due = is_old && (is_waited_for || Clock::now() - surface_made >= surface_time);
        if (is_due) {
            make_surface();
            surface_made = Clock::now();
        }

        std::unique_lock lock(mutex_);
        done_.fetch_add(taken, std::memory_order_release);
        is_surface_old_ = is_old && !is_due;
        idle_.notify_all();
        if (is_stopping_) return;
        const bool has_more_to_do = taken > 0 || (is_surface_old_ && waiting_for_all_ > 0);
        if (!has_more_to_do) wake_.wait_for(lock, poll_time);
        is_waited_for = waiting_for_all_ > 0;
    }
}

/// Processes all messages in the queue. Returns their number.
std::uint64_t SurfaceWorker::take_all() {
    std::uint64_t taken = 0;
    for (; const Message* message = queue_.front(); ++taken) {
        take(*message);
        queue_.pop();
    }
    return taken;
}

void SurfaceWorker::take(const Message& message) {
    switch (message.kind) {
        case Message::Kind::cut: {
            const bool had_offer = scene_.waiting() != nullptr;
            scene_.apply({&message.record, 1}, body_states_);
            if (!had_offer) offer_separation();
            break;
        }
        case Message::Kind::body_changed:
            body_states_.of[message.record.body] = message.body_state;
            body_states_.count = message.count;
            break;
        case Message::Kind::clear_of_bone:
            scene_.end_cut();
            break;
        case Message::Kind::undo:
            offer_turn(HistoryChange::undo);
            break;
        case Message::Kind::redo:
            offer_turn(HistoryChange::redo);
            break;
        case Message::Kind::parted:
            scene_.taken(separation_.offer, body_states_, 0);
            withdraw_separation();
            break;
        case Message::Kind::turned:
            scene_.taken(turn_.offer, body_states_, message.record.sequence);
            body_states_ = turn_.offer.body_states;
            ++turned_;
            withdraw_turn();
            withdraw_separation();
            break;
        case Message::Kind::dropped:
            withdraw_turn();
            break;
    }
}

void SurfaceWorker::offer_separation() {
    if (scene_.waiting() == nullptr) return;
    separation_.offer = scene_.separation();
    separation_.set(Slot::out, turned_);
}

/// Destroys the replaced objects that the loop left in the offer, and makes the next offer.
void SurfaceWorker::withdraw_separation() {
    separation_.offer = {};
    separation_.set(Slot::none, turned_);
    offer_separation();
}

void SurfaceWorker::offer_turn(HistoryChange turn) {
    turn_.offer = !scene_.is_in_a_cut() && scene_.can(turn) ? scene_.turn(turn) : Offer{};
    turn_.set(Slot::out, turned_);
}

void SurfaceWorker::withdraw_turn() {
    turn_.offer = {};
    turn_.set(Slot::none, turned_);
}

void SurfaceWorker::make_surface() {
    if (!options_.makes_surface) return;
    auto surface = std::make_shared<Surface>();
    std::shared_ptr<const Surface> last;
    {
        const std::lock_guard lock(mutex_);
        last = surface_;
    }
    if (last != nullptr) *surface = *last;
    ++surface->version;
    PresentBone& bone = scene_.bone();
    bool has_changed = last == nullptr || surface->patches.size() > bone.count();
    if (surface->patches.size() > bone.count()) {  // after an undo
        patches_.erase(patches_.begin() + static_cast<std::ptrdiff_t>(bone.count()), patches_.end());
        surface->patches.erase(surface->patches.begin() + static_cast<std::ptrdiff_t>(bone.count()),
                               surface->patches.end());
    }
    for (std::size_t body = 0; body < bone.count(); ++body) {
        const std::vector<std::size_t> changed = bone.take_changed(body);
        const bool is_new = body >= patches_.size();
        if (is_new) {
            patches_.emplace_back(*bone.piece(body).bone);
            surface->patches.emplace_back(bone.piece(body).bone->grid().brick_count());
        }
        const auto published =
            is_new ? patches_[body].update_all(bone.cut(body)) : patches_[body].update(bone.cut(body), changed);
        if (!published.empty()) surface->patches[body] = surface->patches[body].with(published);
        has_changed = has_changed || is_new || !published.empty();
    }
    if (!has_changed) return;
    const std::lock_guard lock(mutex_);
    surface_ = std::move(surface);
}

}  // namespace kerf
