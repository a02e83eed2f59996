// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bone/exact/exact_surface.h"

namespace kerf {

/// The exact surface of a body at one time, for a viewer. It never changes.
struct ExactView {
    struct Piece {
        std::size_t body;
        GrowingSurface::Moment surface;          ///< pages of 1024 vertices and faces, shared with other views
        std::vector<LocalCutting::Stale> stale;  ///< where the field's surface is to be shown instead
    };
    std::vector<Piece> pieces;
    std::size_t waiting = 0;  ///< states of the bone that are not in it yet
};

/// Makes the exact surface while a run goes on, on a thread of its own. It decides nothing in the run: the same cuts
/// give the same surface, however late it is.
class ExactFollower {
public:
    /// What the tools point to must outlive it.   [main]
    explicit ExactFollower(ExactTools tools);
    ~ExactFollower();
    ExactFollower(const ExactFollower&) = delete;
    ExactFollower& operator=(const ExactFollower&) = delete;

    /// Passes the bone on if it has changed since the last call. Copies a pointer a body; where bodies came or went,
    /// and after an undo, also their cuts.   [main]
    void follow(const Simulation& simulation);
    /// Waits until all is cut and returns the surface. Pre: called once, after the last tick.   [main]
    /// @param report   what it does, from this thread
    /// @param is_cancelled   asked about ten times a second; after the request that runs, what is not cut yet is stale
    [[nodiscard]] ExactSurface finish(const Simulation& simulation,
                                      const std::function<void(double fraction, const std::string& what)>& report,
                                      const std::function<bool()>& is_cancelled);

    /// From now on views are made, with the stretch that goes on cut into them.   [any]
    void watch() { is_watched_ = true; }
    /// Returns the last view; null before the first one.   [any]
    [[nodiscard]] std::shared_ptr<const ExactView> view() const;

private:
    void work();
    [[nodiscard]] bool work_on(const ExactState& state, bool is_the_end);
    void show();
    void finish_with(ExactSurface made);

    ExactSurfaces surfaces_;
    std::vector<std::pair<std::size_t, CutHistory>> last_;  ///< bodies that were passed on, by number
    bool was_in_a_cut_ = false;
    std::atomic<bool> is_watched_ = false, is_cancelled_ = false;

    mutable std::mutex mutex_;  // for what follows
    std::condition_variable changed_;
    std::deque<ExactState> states_;
    std::shared_ptr<const ExactView> view_;
    double fraction_ = 0.0;
    std::string doing_;
    bool has_end_ = false;      ///< the last state is the end of the run
    bool is_unwanted_ = false;  ///< nobody waits for the surface
    bool is_done_ = false;
    ExactSurface made_;

    std::thread thread_;  // last: it uses all of the above
};

}  // namespace kerf
