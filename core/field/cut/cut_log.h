// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/field/cut/cut_field.h"

/// From tool poses to cut records, and from records to the lagged cut that edges read (resolutions R2).
namespace kerf {

/// Closes records as the tool moves, and holds back those too near the edge to be committed.
///
/// A cutting edge lies on the border of what it just removed. Reading that border halves its engagement at every
/// spacing, so a record reaches the committed field only when the tool is about one voxel farther.
class CutTracker {
public:
    static constexpr std::size_t pending_capacity = 128;
    static constexpr std::size_t recent_capacity = 16;
    static constexpr std::size_t pending_limit = 64;  ///< beyond this records are committed early, and counted
    static constexpr int bricks_per_record =
        16;  ///< stamped at a time, for each record that waits; the rest stays pending
    static constexpr int bricks_per_tick = 32;  ///< so many for them together, unless more than four wait
    static constexpr int most_bricks = 128;     ///< that a tick may stamp, of all bodies and in all of its parts

    CutTracker(const Body& body, const ToolSolid& solid, CutField& committed)
        : body_(&body), solid_(&solid), committed_(&committed) {}

    /// Starts at a pose: nothing is cut on the way there.   [haptic, nonblocking]
    void restart(const Pose& body_from_tool) noexcept;

    /// Takes over from the tracker of a body that came apart, whose field holds all closed records: the open stretch
    /// goes on. Records are numbered on from `next`.   [haptic, nonblocking]
    void go_on_from(const CutTracker& other, std::uint64_t next) noexcept;
    /// The number of the next record.
    [[nodiscard]] std::uint64_t next_sequence() const noexcept { return sequence_; }

    /// The tool moved while cutting. Returns how many records were closed, 0 … 2; read them with `closed(i)`.
    /// [haptic, nonblocking]
    int advance(const Pose& body_from_tool, std::uint64_t tick) noexcept;
    [[nodiscard]] const CutRecord& closed(int i) const noexcept { return closed_[static_cast<std::size_t>(i)]; }

    /// Closes what is open. Returns as `advance`.   [haptic, nonblocking]
    int close(std::uint64_t tick) noexcept;

    /// Stamps records that the front has left a voxel behind, about `most` bricks of them. A tool that is only drawn
    /// back has left none.   [haptic, nonblocking]
    void commit_passed(const Pose& body_from_tool, bool is_at_front, int most = most_bricks);
    /// More wait than should: the tool had better not go on so fast.
    [[nodiscard]] bool is_behind() const noexcept { return pending_count_ > pending_limit; }
    /// Stamps everything pending: at a tool change, a split, the end.   [haptic, nonblocking]
    void flush();

    /// The solids that are gone and not committed: where pending records end, the oldest first, and where the open
    /// stretch stands, if it removes bone. What is stamped is decided by closed records alone.
    [[nodiscard]] std::size_t solid_count() const noexcept { return pending_count_ + (is_open_solid_ ? 1 : 0); }
    /// How far a point travels along `direction` (body frame) until it leaves every one of them [m].
    [[nodiscard]] double gap(Vec3 point_in_body, Vec3 direction_in_body) const noexcept;
    /// Largest depth of a point inside them [m]; negative outside all of them.
    [[nodiscard]] double depth_in_pending(Vec3 point_in_body) const noexcept;
    /// The last records that remove bone, the oldest first.
    [[nodiscard]] std::size_t recent_count() const noexcept {
        return std::min(static_cast<std::size_t>(removing_ever_), recent_capacity);
    }
    [[nodiscard]] const CutRecord& recent(std::size_t i) const noexcept {
        return recent_[(static_cast<std::size_t>(removing_ever_) - recent_count() + i) % recent_capacity];
    }
    [[nodiscard]] std::uint16_t body_id() const noexcept { return body_id_; }
    void name(std::uint16_t body_id) noexcept { body_id_ = body_id; }
    /// Another tool cuts from now on; `number` is how records call it. Pre: nothing is pending.   [haptic, nonblocking]
    void take_tool(const ToolSolid& solid, std::uint16_t number) noexcept;
    /// Records are numbered on from `next`.   [haptic, nonblocking]
    void number_from(std::uint64_t next) noexcept { sequence_ = last_reversal_ = next; }
    /// Of one of them.
    [[nodiscard]] double depth_in_pending(std::size_t i, Vec3 point_in_body) const noexcept {
        return -solid_->distance(tool_from_body(i) * point_in_body);
    }

    /// The same for `count` ≤ `block_capacity` points of the tool at a pose, and directions in its frame.   [haptic,
    /// nonblocking]
    void gap(const Pose& body_from_tool, const Vec3* points, std::size_t count, Directions directions,
             BlockValues& gaps) const noexcept;
    /// From the tool at a pose to the frame of one of the solids.
    [[nodiscard]] Frame solid_from_tool(std::size_t i, const Pose& body_from_tool) const noexcept {
        return frame_of(tool_from_body(i) * body_from_tool);
    }
    [[nodiscard]] const Body& body() const noexcept { return *body_; }
    [[nodiscard]] const ToolSolid& solid() const noexcept { return *solid_; }
    /// Those before it lie behind it and make no gap.
    [[nodiscard]] std::size_t first_that_matters() const noexcept;

    /// How the frames of the solids differ: what a point moves by, on its way from the newest's to another's.
    struct Spread {
        Vec3 low{}, high{};  ///< [m] of the origin
        double turn = 0.0;   ///< [–] and no more than this of its distance from there
    };
    [[nodiscard]] const Spread& spread() const noexcept { return spread_; }

    [[nodiscard]] std::size_t pending_count() const noexcept { return pending_count_; }
    /// How many bricks the last `commit_passed` stamped.
    [[nodiscard]] int last_bricks() const noexcept { return last_bricks_; }
    [[nodiscard]] std::uint64_t early_commits() const noexcept { return early_commits_; }

private:
    [[nodiscard]] const CutRecord& pending(std::size_t i) const noexcept { return pending_[slot(i)]; }
    [[nodiscard]] std::size_t slot(std::size_t i) const noexcept { return (pending_first_ + i) % pending_capacity; }
    [[nodiscard]] const Pose& tool_from_body(std::size_t i) const noexcept { return tool_from_body_[slot(i)]; }
    /// The newest solid has come, or moved.
    void take_newest(const Pose& body_from_tool) noexcept;
    void begin_stretch(const Pose& body_from_tool) noexcept;
    void look_at_open_stretch() noexcept;
    int commit_oldest();
    void drop_oldest() noexcept;
    void close_at(const Pose& to, std::uint64_t tick) noexcept;
    /// Whether the solid at this pose takes bone that is still there. Decided once, here: a record that removes
    /// nothing is logged, and nobody stamps it.
    [[nodiscard]] bool removes_bone(const Pose& body_from_tool) const noexcept;

    const Body* body_;
    const ToolSolid* solid_;
    CutField* committed_;
    Pose open_from_ = identity_pose();  ///< the last record's end
    Pose farthest_ = identity_pose();   ///< of the open stretch
    double farthest_motion_ = 0.0;      ///< [m] from open_from_
    Pose corner_ = identity_pose();     ///< where the way aside was measured last
    double way_aside_ = 0.0;            ///< [m] until there
    double looked_at_ = 0.0;            ///< [m] of that motion, when it was last asked whether the stretch removes bone
    bool is_open_solid_ = false;        ///< it does
    Pose last_removing_ = identity_pose();
    bool has_removed_ = false;
    bool is_started_ = false;
    std::uint64_t sequence_ = 0, removing_ever_ = 0;
    std::array<CutRecord, recent_capacity> recent_{};
    std::uint16_t body_id_ = 0, solid_number_ = 0;  ///< records say them
    std::uint64_t last_reversal_ = 0;               ///< sequence of the first record after the path last turned back
    std::array<CutRecord, 2> closed_{};
    int closed_count_ = 0;

    std::array<CutRecord, pending_capacity> pending_{};
    std::array<Pose, pending_capacity>
        tool_from_body_{};  ///< of the solids: one place is always free for the open stretch
    Spread spread_;
    std::size_t pending_first_ = 0, pending_count_ = 0;
    StampProgress progress_;  ///< of the oldest
    int last_bricks_ = 0;
    std::uint64_t early_commits_ = 0;
};

}  // namespace kerf
