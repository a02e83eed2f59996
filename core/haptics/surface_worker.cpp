// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/surface_worker.h"

#include <chrono>

namespace kerf {

namespace {
constexpr std::size_t queue_records = 4096;  // 4 s at 1 kHz
constexpr std::size_t reserve_bricks = 512;
constexpr auto poll_time = std::chrono::milliseconds(2);  // the loop wakes nobody: that would be a system call
constexpr auto surface_time = std::chrono::milliseconds(16);  // no screen shows more
}  // namespace

SurfaceWorker::SurfaceWorker(const Body& body, std::vector<const ToolSolid*> cutting, Options options)
    : cutting_(std::move(cutting)), options_(options), bone_(body, reserve_bricks), next_(1, 0), queue_(queue_records) {
    if (options_.looks_for_pieces) bone_.look_for_pieces(options_.crumb);
    if (options_.makes_surface) patches_.reserve(most_bodies);
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

bool SurfaceWorker::push(const CutRecord& record) noexcept {
    if (!queue_.push({record, false})) {
        lost_.fetch_add(1, std::memory_order_relaxed);
        return false;
    }
    pushed_.fetch_add(1, std::memory_order_release);
    return true;
}

void SurfaceWorker::answer(bool is_adopted) noexcept {
    if (!is_adopted) {
        offer_state_.store(OfferState::refused, std::memory_order_release);
        return;
    }
    offer_state_.store(OfferState::taken, std::memory_order_release);
    // In the queue, so that the worker knows which records came before.
    if (!queue_.push({{}, true})) {
        lost_.fetch_add(1, std::memory_order_relaxed);
        return;
    }
    pushed_.fetch_add(1, std::memory_order_release);
}

void SurfaceWorker::wait_for_all() {
    std::unique_lock lock(mutex_);
    ++waiting_for_all_;
    wake_.notify_all();
    idle_.wait(lock, [&] {
        return done_.load(std::memory_order_acquire) == pushed_.load(std::memory_order_acquire) && !is_surface_old_ &&
               offer_state_.load(std::memory_order_acquire) != OfferState::refused;
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
        if (offer_state_.load(std::memory_order_acquire) == OfferState::refused) make_offer();
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

/// How many messages there were.
std::uint64_t SurfaceWorker::take_all() {
    std::uint64_t taken = 0;
    for (; const Message* message = queue_.front(); ++taken) {
        take(*message);
        queue_.pop();
    }
    return taken;
}

void SurfaceWorker::take(const Message& message) {
    if (message.is_adoption) {
        // What the loop had before came back in the offer, and ends here.
        bone_.adopted(waiting_.front());
        for (std::size_t n = 1; n < waiting_.front().parts.size(); ++n) {
            const std::size_t body = waiting_.front().parts[n].body;
            if (next_.size() <= body) next_.resize(body + 1, 0);
        }
        waiting_.erase(waiting_.begin());
        offer_ = {};
        offer_state_.store(OfferState::none, std::memory_order_release);
        if (!waiting_.empty()) make_offer();
        return;
    }
    const bool had_offer = !waiting_.empty();
    for (Separation& separation : bone_.apply(message.record, *cutting_[message.record.solid])) waiting_.push_back(std::move(separation));
    next_[message.record.body] = message.record.sequence + 1;
    if (!had_offer && !waiting_.empty()) make_offer();
}

void SurfaceWorker::make_offer() {
    const Separation& separation = waiting_.front();
    offer_ = adoption_of(separation, bone_, *cutting_.front(), next_[separation.parent]);
    offer_state_.store(OfferState::offered, std::memory_order_release);
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
    bool has_changed = last == nullptr;
    for (std::size_t body = 0; body < bone_.count(); ++body) {
        const std::vector<std::size_t> changed = bone_.take_changed(body);
        const bool is_new = body >= patches_.size();
        if (is_new) {
            patches_.emplace_back(*bone_.piece(body).bone);
            surface->patches.emplace_back(bone_.piece(body).bone->grid().brick_count());
        }
        const auto published = is_new ? patches_[body].update_all(bone_.cut(body)) : patches_[body].update(bone_.cut(body), changed);
        if (!published.empty()) surface->patches[body] = surface->patches[body].with(published);
        has_changed = has_changed || is_new || !published.empty();
    }
    if (!has_changed) return;
    const std::lock_guard lock(mutex_);
    surface_ = std::move(surface);
}

}  // namespace kerf
