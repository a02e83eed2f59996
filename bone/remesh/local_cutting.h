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

namespace kerf {

/// Requests one result from a strategy: in this process, or in another.
using AskStrategy = std::function<RemeshResult(const RemeshRequest&)>;

struct NamedStrategy {
    std::string id;
    AskStrategy ask;
    double tolerance = 0.0;  ///< [m] that it states; 0: that of the request
};

/// What one strategy did not cut: how often, and why the first time.
struct NotCut {
    int count = 0;
    std::string first;

    void add(const std::string& why) {
        if (count++ == 0) first = why;
    }
};
using NotCutBy = std::map<std::string, NotCut>;  ///< by the strategy's id

/// Cuts a surface one stretch after the other, each in the patch that it meets. A strategy that declines a stretch, or
/// whose first result is refused, is replaced by the next one for this stretch. Of the last one a refused result is
/// requested again with another nudge, `most_refusals` times.   [worker]
class LocalCutting {
public:
    static constexpr int most_refusals = 6;

    /// @param strategies   of each solid, each to replace those before it
    LocalCutting(const TaggedMesh& mesh, std::vector<const ToolSolid*> solids, double tolerance,
                 std::vector<std::vector<NamedStrategy>> strategies)
        : surface_(mesh), solids_(std::move(solids)), tolerance_(tolerance), strategies_(std::move(strategies)) {}
    /// The same with one strategy for all solids, and perhaps one to replace it.
    LocalCutting(const TaggedMesh& mesh, std::vector<const ToolSolid*> solids, double tolerance, AskStrategy ask,
                 AskStrategy otherwise = {});

    /// Removes what a tool sweeps on a stretch. Returns whether the surface is what it should be there; `why` if not.
    [[nodiscard]] bool cut(const CutStretch& stretch, std::string& why);
    /// The same. Where it fails, the box of the stretch is stale.
    bool cut(const CutStretch& stretch);
    /// Takes another mesh, made by a strategy of another kind.
    void replace(const TaggedMesh& mesh) { surface_ = GrowingSurface(mesh); }
    /// Marks a box as stale if a part of the surface lies in it.
    void give_up(const Box& box, std::string why);

    [[nodiscard]] const GrowingSurface& surface() const noexcept { return surface_; }
    [[nodiscard]] double removed() const noexcept { return removed_; }  ///< [m³]
    [[nodiscard]] int refusals() const noexcept { return refusals_; }
    /// Of each strategy that failed or had a result refused.
    [[nodiscard]] const NotCutBy& refused() const noexcept { return refused_; }
    [[nodiscard]] const NotCutBy& declined() const noexcept { return declined_; }
    /// Stretches that a strategy did not cut and a later one got.
    [[nodiscard]] int handed_over() const noexcept { return handed_over_; }
    [[nodiscard]] const std::string& why_handed_over() const noexcept { return why_handed_over_; }  ///< the last one
    /// Where the surface does not show what was cut, and why.
    struct Stale {
        Box box{};
        std::string why;
    };
    [[nodiscard]] const std::vector<Stale>& stale() const noexcept { return stale_; }

    /// Surface and stale boxes at one time.
    struct Moment {
        GrowingSurface::Moment surface;
        double removed = 0.0;  ///< [m³]
        int refusals = 0, handed_over = 0;
        NotCutBy refused, declined;
        std::vector<Stale> stale;
    };
    [[nodiscard]] Moment moment() {
        return {surface_.moment(), removed_, refusals_, handed_over_, refused_, declined_, stale_};
    }
    /// Makes everything what it was.
    void go_back(const Moment& moment);

private:
    enum class Attempt { done, refused, ended };
    /// Requests one result and puts it in the place of the patch, if it passes all checks.
    Attempt attempt(const NamedStrategy& strategy, const RemeshRequest& request, const SurfacePatch& patch,
                    std::string& why);

    GrowingSurface surface_;
    std::vector<const ToolSolid*> solids_;
    double tolerance_;
    std::vector<std::vector<NamedStrategy>> strategies_;
    double removed_ = 0.0;
    int refusals_ = 0, handed_over_ = 0;
    std::string why_handed_over_;
    NotCutBy refused_, declined_;
    std::vector<Stale> stale_;
};

}  // namespace kerf
