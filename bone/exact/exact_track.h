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

namespace kerf {

/// The exact surface of a body, which follows the body's records. The same history gives the same surface, however
/// often it was asked for between, and whatever was taken back.   [worker]
class ExactTrack {
public:
    /// @param mesh    the surface after the records of `done`
    /// @param apart   [m] between the points that decide whether a stretch cuts anything: a voxel
    ExactTrack(const TaggedMesh& mesh, CutHistory done, const ExactTools& tools, double apart);

    /// Cuts along the records that a history has more. Those of the last stretch wait until it ends. Pre:
    /// `history.continues(done())`.
    void follow(const CutHistory& history);
    /// Cuts along what waits, and checks the surface as a whole.
    void finish();

    /// Marks a box as stale if a part of the surface lies in it.
    void give_up(const Box& box, std::string why) { cutting_.give_up(box, std::move(why)); }

    [[nodiscard]] const CutHistory& done() const noexcept { return done_; }
    [[nodiscard]] TaggedMesh mesh() const { return cutting_.surface().mesh(); }
    /// Where the surface does not show what was cut, and why.
    [[nodiscard]] const std::vector<LocalCutting::Stale>& stale() const noexcept { return cutting_.stale(); }
    [[nodiscard]] std::size_t records() const noexcept { return records_; }
    [[nodiscard]] std::size_t stretches() const noexcept { return stretches_; }
    [[nodiscard]] int refusals() const noexcept { return refusals_ + cutting_.refusals(); }
    [[nodiscard]] int handed_over() const noexcept { return handed_over_ + cutting_.handed_over(); }
    /// Refused results by strategy, for people.
    [[nodiscard]] std::vector<std::string> notes() const;

    /// What is committed, and what waits, at one time. Costs a pointer for each page of the surface.
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
    void go_back(const Moment& moment);
    /// Returns the surface with the stretch that waits cut into it, and stays as it is.
    [[nodiscard]] LocalCutting::Moment shown();

private:
    void commit(const std::optional<CutStretch>& stretch);
    void commit_waiting();
    void commit_left_over();
    /// Cuts along all stretches of a request with the first strategy for whole meshes that can. Returns whether one
    /// did.
    [[nodiscard]] bool cut_whole(RemeshRequest request, std::size_t solid, std::string& why);
    [[nodiscard]] std::optional<TaggedMesh> cut_whole(const RemeshRequest& request, const ExactStrategy& strategy,
                                                      std::string& why);
    [[nodiscard]] RemeshRequest whole_request() const;
    /// Marks as stale what no strategy has cut.
    void give_up(const CutStretch& stretch, const std::string& why);

    const ExactTools* tools_;
    double apart_;
    CutHistory done_;
    LocalCutting cutting_;
    StretchJoiner joiner_;               ///< what a strategy for patches cuts next
    std::vector<CutRecord> waiting_;     ///< what a strategy for whole meshes cuts next
    std::vector<CutStretch> left_over_;  ///< what no strategy for patches cut, until one for whole meshes does
    SweptBefore swept_;
    std::size_t records_ = 0, stretches_ = 0;
    int refusals_ = 0, handed_over_ = 0;
    bool is_checked_ = true;       ///< as a whole, since the last patch
    NotCutBy refused_, declined_;  ///< by strategies for whole meshes
};

}  // namespace kerf
