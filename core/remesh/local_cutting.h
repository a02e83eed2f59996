// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/remesh/growing_surface.h"
#include "core/remesh/remesh_request.h"
#include "core/remesh/swept_before.h"

namespace kerf {

/// Requests one result from a strategy: in this process, or in another.
using AskStrategy = std::function<RemeshResult(const RemeshRequest&)>;

struct NamedStrategy {
    std::string id;
    AskStrategy ask;
    double tolerance = 0.0;  ///< [m] that it states; 0: that of the request
};

/// Results of one strategy that the host refused.
struct Refusals {
    int count = 0;
    std::string first;  ///< why the first one was refused
};

/// Cuts a surface one stretch after the other, each in the patch that it meets. A strategy that declines a stretch, or
/// whose first result is refused, is replaced by the next one for this stretch. Of the last one a refused result is
/// requested again with another nudge; after `most_refusals` the stretch is left out and its box is stale.   [worker]
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

    /// Removes what a tool sweeps on a stretch. Returns whether the surface is what it should be there.
    bool cut(const CutStretch& stretch);
    /// Takes another mesh, made by a strategy of another kind.
    void replace(const TaggedMesh& mesh) { surface_ = GrowingSurface(mesh); }
    /// Marks a box as stale if a part of the surface lies in it.
    void give_up(const Box& box, std::string why);

    [[nodiscard]] const GrowingSurface& surface() const noexcept { return surface_; }
    [[nodiscard]] double removed() const noexcept { return removed_; }  ///< [m³]
    [[nodiscard]] int refusals() const noexcept { return refusals_; }
    /// Of each strategy that had a result refused, by its id.
    [[nodiscard]] const std::map<std::string, Refusals>& refused() const noexcept { return refused_; }
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
        std::map<std::string, Refusals> refused;
        std::vector<Stale> stale;
    };
    [[nodiscard]] Moment moment() { return {surface_.moment(), removed_, refusals_, handed_over_, refused_, stale_}; }
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
    std::map<std::string, Refusals> refused_;
    std::vector<Stale> stale_;
};

}  // namespace kerf
