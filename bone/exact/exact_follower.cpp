// SPDX-License-Identifier: Apache-2.0
#include "bone/exact/exact_follower.h"

#include <algorithm>
#include <chrono>
#include <exception>

namespace kerf::bone {
namespace {

ExactTools with_reports(ExactTools tools, std::function<void(double, const std::string&)> report,
                        std::function<bool()> is_cancelled) {
    tools.progress = std::move(report);
    tools.is_cancelled = std::move(is_cancelled);
    return tools;
}

}  // namespace

ExactFollower::ExactFollower(ExactTools tools)
    : surfaces_(with_reports(
          std::move(tools),
          [this](double fraction, const std::string& what) {
              const std::lock_guard lock(mutex_);
              fraction_ = fraction;
              doing_ = what;
          },
          [this] { return is_cancelled_.load(); })),
      thread_([this] { work(); }) {}

ExactFollower::~ExactFollower() {
    is_cancelled_ = true;
    {
        const std::lock_guard lock(mutex_);
        is_unwanted_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void ExactFollower::follow(const Simulation& simulation) {
    ExactState state = exact_state(simulation, false);
    const bool are_the_same = std::equal(
        state.bodies.begin(), state.bodies.end(), last_.begin(), last_.end(),
        [](const ExactBody& now, const auto& last) { return now.body == last.first && now.history == last.second; });
    const bool left_bone = state.may_return && was_in_a_cut_;
    if (are_the_same && !left_bone) return;
    was_in_a_cut_ = !state.may_return;
    const bool went_on = std::equal(state.bodies.begin(), state.bodies.end(), last_.begin(), last_.end(),
                                    [](const ExactBody& now, const auto& last) {
                                        return now.body == last.first && now.history.continues(last.second);
                                    });
    last_.clear();
    for (const ExactBody& one : state.bodies) last_.emplace_back(one.body, one.history);
    if (!went_on) state = exact_state(simulation, true);
    {
        const std::lock_guard lock(mutex_);
        // A state that only continues is obsolete once there is a later one. States that bone may return to are kept.
        const bool is_between = [&] {
            if (states_.empty() || !went_on) return false;
            const ExactState& last = states_.back();
            return !last.may_return && !last.bodies.empty() && last.bodies.front().cut == nullptr;
        }();
        if (is_between) states_.pop_back();
        states_.push_back(std::move(state));
    }
    changed_.notify_all();
}

ExactSurface ExactFollower::finish(const Simulation& simulation,
                                   const std::function<void(double fraction, const std::string& what)>& report,
                                   const std::function<bool()>& is_cancelled) {
    follow(simulation);
    std::unique_lock lock(mutex_);
    states_.push_back(exact_state(simulation, true));
    has_end_ = true;
    changed_.notify_all();
    while (!changed_.wait_for(lock, std::chrono::milliseconds(100), [this] { return is_done_; })) {
        if (is_cancelled && is_cancelled()) is_cancelled_ = true;
        const double fraction = fraction_;
        const std::string doing = doing_;
        lock.unlock();
        if (report) report(fraction, doing);
        lock.lock();
    }
    return std::move(result_);
}

std::shared_ptr<const ExactView> ExactFollower::view() const {
    const std::lock_guard lock(mutex_);
    return view_;
}

void ExactFollower::work() {
    std::string error;
    try {
        for (;;) {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return !states_.empty() || is_unwanted_; });
            if (is_unwanted_) return;
            const ExactState state = std::move(states_.front());
            states_.pop_front();
            const bool is_the_end = has_end_ && states_.empty();
            lock.unlock();
            if (work_on(state, is_the_end)) return;
        }
    } catch (const std::exception& e) {  // most likely out of memory: the run continues without the surface
        error = e.what();
    }
    ExactSurface none;
    none.error = "the exact surface was given up: " + error + ".";
    finish_with(std::move(none));
}

/// Returns whether the surface is finished.
bool ExactFollower::work_on(const ExactState& state, bool is_the_end) {
    if (is_the_end) {
        finish_with(surfaces_.finish(state));
        return true;
    }
    surfaces_.follow(state);
    if (is_watched_) show();
    return false;
}

void ExactFollower::finish_with(ExactSurface made) {
    {
        const std::lock_guard lock(mutex_);
        result_ = std::move(made);
        is_done_ = true;
    }
    changed_.notify_all();
}

void ExactFollower::show() {
    {
        const std::lock_guard lock(mutex_);
        if (!states_.empty()) return;  // it would be outdated
    }
    auto view = std::make_shared<ExactView>();
    for (auto& [body, moment] : surfaces_.shown())
        view->pieces.push_back({body, std::move(moment.surface), std::move(moment.stale)});
    const std::lock_guard lock(mutex_);
    view->waiting = states_.size();
    view_ = std::move(view);
}

}  // namespace kerf::bone
