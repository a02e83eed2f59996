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

namespace kerf::bone {

/// A snapshot of a body's exact surface, for a viewer. It never changes.
struct ExactView {
    struct Piece {
        std::size_t body;
        GrowingSurface::Moment surface;          ///< pages of 1024 vertices and faces, in common with other views
        std::vector<LocalCutting::Stale> stale;  ///< where the viewer shows the field's surface instead
    };
    std::vector<Piece> pieces;
    std::size_t waiting = 0;  ///< states of the bone that are not in the view yet
};

/// Makes the exact surface during a run, on its own thread. It does not affect the run: the same cuts give the same
/// surface, however late it is.
class ExactFollower {
public:
    /// Pre: the objects that the tools point to outlive it.   [main]
    explicit ExactFollower(ExactTools tools);
    ~ExactFollower();
    ExactFollower(const ExactFollower&) = delete;
    ExactFollower& operator=(const ExactFollower&) = delete;

    /// Passes the bone on if it has changed since the last call. Copies one pointer for each body. If bodies were added
    /// or removed, and after an undo, also copies their cuts.   [main]
    void follow(const Simulation& simulation);
    /// Waits until all is cut and returns the surface. Pre: called once, after the last tick.   [main]
    /// @param report        receives progress, on this thread
    /// @param is_cancelled  called about ten times a second; after the running request, the remaining cuts are stale
    [[nodiscard]] ExactSurface finish(const Simulation& simulation,
                                      const std::function<void(double fraction, const std::string& what)>& report,
                                      const std::function<bool()>& is_cancelled);

    /// Starts making views, which include the unfinished stretch.   [any]
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

    mutable std::mutex mutex_;  // protects the following members
    std::condition_variable changed_;
    std::deque<ExactState> states_;
    std::shared_ptr<const ExactView> view_;
    double fraction_ = 0.0;
    std::string doing_;
    bool has_end_ = false;      ///< the last state is the end of the run
    bool is_unwanted_ = false;  ///< the surface is no longer needed
    bool is_done_ = false;
    ExactSurface result_;

    std::thread thread_;  // last member: it uses all of the above
};

}  // namespace kerf::bone
