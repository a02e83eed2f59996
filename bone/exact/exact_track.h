// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bone/exact/exact_tools.h"
#include "bone/remesh/local_cutting.h"
#include "core/field/cut/cut_history.h"

namespace kerf::bone {

/// The exact surface of a body, which follows the body's records. The same history gives the same surface, regardless
/// of intermediate requests and undone cuts.   [worker]
class ExactTrack {
public:
    /// @param mesh   the surface after the records of `done`
    /// @param apart  [m] between the sample points that decide whether a stretch removes anything: a voxel
    ExactTrack(const TaggedMesh& mesh, CutHistory done, const ExactTools& tools, double apart);

    /// Cuts along the additional records of a history. The records of the last stretch wait until it ends. Pre:
    /// `history.continues(done())`.
    void follow(const CutHistory& history);
    /// Cuts along waiting records, and checks the whole surface.
    void finish();

    /// Marks a box as stale if a part of the surface lies in it.
    void mark_stale(const Box& box, std::string why) { cutting_.mark_stale(box, std::move(why)); }

    [[nodiscard]] const CutHistory& done() const noexcept { return done_; }
    [[nodiscard]] TaggedMesh mesh() const { return cutting_.surface().mesh(); }
    /// Returns the boxes in which the surface lacks a cut, and the reasons.
    [[nodiscard]] const std::vector<LocalCutting::Stale>& stale() const noexcept { return cutting_.stale(); }
    [[nodiscard]] std::size_t records() const noexcept { return records_; }
    [[nodiscard]] std::size_t stretches() const noexcept { return stretches_; }
    [[nodiscard]] int refusals() const noexcept { return refusals_ + cutting_.refusals(); }
    [[nodiscard]] int handed_over() const noexcept { return handed_over_ + cutting_.handed_over(); }
    /// Returns the refused results by strategy, for people.
    [[nodiscard]] std::vector<std::string> notes() const;

    /// A snapshot of committed and waiting work. Costs a pointer for each page of the surface.
    struct Moment {
        LocalCutting::Moment cutting;
        CutHistory done;
        StretchJoiner joiner;
        std::vector<CutRecord> waiting;
        std::vector<CutStretch> left_over;
        SweptBefore swept;
        std::size_t records = 0, stretches = 0;
    };
    [[nodiscard]] Moment moment();
    void restore(const Moment& moment);
    /// Returns the surface with the waiting stretch cut into it, without changing this object.
    [[nodiscard]] LocalCutting::Moment shown();

private:
    void commit(const std::optional<CutStretch>& stretch);
    void commit_waiting();
    void commit_left_over();
    /// Cuts along all stretches of a request with the first strategy for whole meshes that succeeds. Returns whether
    /// one did.
    [[nodiscard]] bool cut_whole(RemeshRequest request, std::size_t solid, std::string& why);
    [[nodiscard]] std::optional<TaggedMesh> cut_whole(const RemeshRequest& request, const ExactStrategy& strategy,
                                                      std::string& why);
    [[nodiscard]] RemeshRequest whole_request() const;
    /// Marks a stretch that no strategy has cut as stale.
    void mark_stale(const CutStretch& stretch, const std::string& why);

    const ExactTools* tools_;
    double apart_;
    CutHistory done_;
    LocalCutting cutting_;
    StretchJoiner joiner_;               ///< next work of strategies for patches
    std::vector<CutRecord> waiting_;     ///< next work of strategies for whole meshes
    std::vector<CutStretch> left_over_;  ///< left by strategies for patches, for whole meshes
    SweptBefore swept_;
    std::size_t records_ = 0, stretches_ = 0;
    int refusals_ = 0, handed_over_ = 0;
    bool is_checked_ = true;                 ///< the whole surface, since the last patch
    FailuresByStrategy refused_, declined_;  ///< by strategies for whole meshes
};

}  // namespace kerf::bone
