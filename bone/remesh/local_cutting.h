// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bone/remesh/growing_surface.h"
#include "bone/remesh/remesh_request.h"
#include "bone/remesh/swept_before.h"

namespace kerf::bone {

/// Requests one result from a strategy, in this process or in another.
using StrategyCall = std::function<RemeshResult(const RemeshRequest&)>;

struct NamedStrategy {
    std::string id;
    StrategyCall call;
    double tolerance = 0.0;  ///< [m] of the strategy; 0: that of the request
};

/// Failures of one strategy: their number, and the reason of the first.
struct StrategyFailures {
    int count = 0;
    std::string first;

    void add(const std::string& why) {
        if (count++ == 0) first = why;
    }
};
using FailuresByStrategy = std::map<std::string, StrategyFailures>;  ///< by the strategy's id

/// Cuts a surface one stretch after the other, each in the patch that it meets. If a strategy declines a stretch, or
/// its first result is refused, the next strategy cuts this stretch. The last strategy gets a refused request again
/// with another nudge, `max_refusals` times.   [worker]
class LocalCutting {
public:
    static constexpr int max_refusals = 6;

    /// @param strategies  for each solid, in order of use
    LocalCutting(const TaggedMesh& mesh, std::vector<const ToolSolid*> solids, double tolerance,
                 std::vector<std::vector<NamedStrategy>> strategies)
        : surface_(mesh), solids_(std::move(solids)), tolerance_(tolerance), strategies_(std::move(strategies)) {}
    /// Uses one strategy for all solids, and optionally a second one after it.
    LocalCutting(const TaggedMesh& mesh, std::vector<const ToolSolid*> solids, double tolerance, StrategyCall call,
                 StrategyCall otherwise = {});

    /// Removes the sweep of a tool on a stretch. Returns whether the surface is correct there; `why` has the reason if
    /// not.
    [[nodiscard]] bool cut(const CutStretch& stretch, std::string& why);
    /// Removes the sweep of a tool on a stretch. If this fails, marks the box of the stretch as stale.
    bool cut(const CutStretch& stretch);
    /// Replaces the surface by a mesh from a strategy of another kind.
    void replace(const TaggedMesh& mesh) { surface_ = GrowingSurface(mesh); }
    /// Marks a box as stale if a part of the surface lies in it.
    void mark_stale(const Box& box, std::string why);

    [[nodiscard]] const GrowingSurface& surface() const noexcept { return surface_; }
    [[nodiscard]] double removed() const noexcept { return removed_; }  ///< [m³]
    [[nodiscard]] int refusals() const noexcept { return refusals_; }
    /// Returns the failures and refused results of each strategy.
    [[nodiscard]] const FailuresByStrategy& refused() const noexcept { return refused_; }
    [[nodiscard]] const FailuresByStrategy& declined() const noexcept { return declined_; }
    /// Returns the number of stretches that a strategy did not cut and a later one received.
    [[nodiscard]] int handed_over() const noexcept { return handed_over_; }
    /// Returns the reason of the last one.
    [[nodiscard]] const std::string& hand_over_reason() const noexcept { return hand_over_reason_; }
    /// A box in which the surface lacks a cut, and the reason.
    struct Stale {
        Box box{};
        std::string why;
    };
    [[nodiscard]] const std::vector<Stale>& stale() const noexcept { return stale_; }

    /// A snapshot of surface and stale boxes.
    struct Moment {
        GrowingSurface::Moment surface;
        double removed = 0.0;  ///< [m³]
        int refusals = 0, handed_over = 0;
        FailuresByStrategy refused, declined;
        std::vector<Stale> stale;
    };
    [[nodiscard]] Moment moment() {
        return {surface_.moment(), removed_, refusals_, handed_over_, refused_, declined_, stale_};
    }
    /// Restores a snapshot.
    void restore(const Moment& moment);

private:
    enum class Attempt { done, refused, ended };
    /// Requests one result, and replaces the patch by it if it passes all checks.
    Attempt attempt(const NamedStrategy& strategy, const RemeshRequest& request, const SurfacePatch& patch,
                    std::string& why);

    GrowingSurface surface_;
    std::vector<const ToolSolid*> solids_;
    double tolerance_;
    std::vector<std::vector<NamedStrategy>> strategies_;
    double removed_ = 0.0;
    int refusals_ = 0, handed_over_ = 0;
    std::string hand_over_reason_;
    FailuresByStrategy refused_, declined_;
    std::vector<Stale> stale_;
};

}  // namespace kerf::bone
