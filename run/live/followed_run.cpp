// SPDX-License-Identifier: Apache-2.0
#include "run/live/followed_run.h"

#include <chrono>
#include <thread>
#include <utility>

namespace kerf::run {

std::unique_ptr<FollowedRun> FollowedRun::create(const Scene& scene, const PluginRegistry& plugins,
                                                 const RunRequest& request, RunOutcome& refusal) {
    auto run = Run::create(scene, plugins, request, refusal);
    if (run == nullptr) return nullptr;
    return std::unique_ptr<FollowedRun>(new FollowedRun(scene, std::move(run)));
}

FollowedRun::FollowedRun(const Scene& scene, std::unique_ptr<Run> run)
    : scene_(&scene), run_(std::move(run)), second_loop_(run_->follow_loop(link_)) {}

void FollowedRun::begin(LiveHand& hand, bool is_alone, TickParts* parts) {
    std::optional<RecordedHand> recorded;
    if (run_->beginning() != nullptr) recorded.emplace(*run_->beginning());
    LiveHand& first = recorded ? static_cast<LiveHand&>(*recorded) : hand;
    loop_.emplace(std::move(second_loop_), *scene_, run_->plan(), run_->rehearsal(), link_, first,
                  is_alone || recorded ? std::function<void()>([this] { catch_up(); }) : std::function<void()>());
    if (recorded) {
        repeat_beginning(*recorded);
        hand.continue_at(run_->beginning()->run.replay[run_->beginning()->ticks - 1]);
        loop_->take_hand(hand);
        if (!is_alone) loop_->leave_run();
    }
    if (parts != nullptr) loop_->measure(*parts);
}

/// Repeats the ticks of the recorded run as fast as they run. The run may end meanwhile.
void FollowedRun::repeat_beginning(RecordedHand& hand) {
    for (std::uint64_t ticks = run_->beginning()->ticks; ticks > 0; --ticks)
        if (!tick(hand.missed())) return;
}

bool FollowedRun::tick(std::uint32_t missed) {
    const bool has_more = loop_->step(missed);
    if (!has_more) has_loop_ended_.store(true, std::memory_order_release);
    return has_more;
}

void FollowedRun::follow() {
    try {
        catch_up();
    } catch (...) {
        stop();
        throw;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(200));
}

/// Takes all messages that the loop has sent. Ends the loop when the run has ended.
void FollowedRun::catch_up() {
    while (const LoopMessage* message = link_.messages.front()) {
        if (!has_run_ended_ && !run_->take(*message)) stop();
        link_.messages.pop();
    }
}

void FollowedRun::stop() noexcept {
    has_run_ended_ = true;
    link_.should_stop.store(true, std::memory_order_release);
}

void FollowedRun::set_clock(session::ClockRow clock) {
    clock.fades_by_machine = loop_->fades().by_machine;
    clock.fades_by_device = loop_->fades().by_device;
    clock.fades_by_fault = loop_->fades().by_fault;
    run_->set_clock(std::move(clock));
}

RunOutcome FollowedRun::finish() {
    catch_up();
    if (!has_run_ended_ && link_.is_overrun)
        static_cast<void>(
            run_->take({.kind = LoopMessage::Kind::ended, .index = static_cast<std::size_t>(RunEnd::fell_behind)}));
    return run_->finish();
}

}  // namespace kerf::run
