// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/field/cut/cut_field.h"

/// Converts tool poses to cut records, and records to the lagged cut that edges read.
namespace kerf {

/// Closes records as the tool moves, and delays the commit of records that are too near the edge.
///
/// A cutting edge lies on the border of the volume that it just removed. Reading that border halves its engagement at
/// every spacing. So a record reaches the committed field only when the tool is about one voxel farther.
class CutTracker {
public:
    static constexpr std::size_t pending_capacity = 128;
    static constexpr std::size_t recent_capacity = 16;
    static constexpr std::size_t pending_limit = 64;  ///< beyond this records are committed early, and counted
    static constexpr int bricks_per_record = 16;  ///< stamped at a time for each waiting record; the rest stays pending
    static constexpr int bricks_per_tick = 32;    ///< total for all waiting records, unless more than four wait
    static constexpr int max_bricks = 128;        ///< that a tick may stamp, over all bodies and parts of the tick

    CutTracker(const Body& body, const ToolSolid& solid, CutField& committed)
        : body_(&body), solid_(&solid), committed_(&committed) {}

    /// Starts at a pose, without a cut on the path to it.   [haptic, nonblocking]
    void restart(const Pose& body_from_tool) noexcept;

    /// Continues the open stretch of the tracker of a body that has come apart, whose field contains all closed
    /// records. The next record gets the number `next`.   [haptic, nonblocking]
    void continue_from(const CutTracker& other, std::uint64_t next) noexcept;
    /// Returns the number of the next record.
    [[nodiscard]] std::uint64_t next_sequence() const noexcept { return sequence_; }

    /// Moves the cutting tool. Returns the number of records that it closed, 0 … 2; read them with `closed(i)`.
    /// [haptic, nonblocking]
    int advance(const Pose& body_from_tool, std::uint64_t tick) noexcept;
    [[nodiscard]] const CutRecord& closed(int i) const noexcept { return closed_[static_cast<std::size_t>(i)]; }

    /// Closes the open stretch. Returns as `advance`.   [haptic, nonblocking]
    int close(std::uint64_t tick) noexcept;

    /// Stamps the records that the front has passed by a voxel, about `maximum` bricks of them. A tool that only
    /// retracts passes none.   [haptic, nonblocking]
    void commit_passed(const Pose& body_from_tool, bool is_at_front, int maximum = max_bricks);
    /// Returns whether too many records are pending: the tool should slow down.
    [[nodiscard]] bool is_behind() const noexcept { return pending_count_ > pending_limit; }
    /// Stamps all pending records: at a tool change, a split, the end.   [haptic, nonblocking]
    void flush();

    /// Returns the number of solids that are removed but not committed: one at the end of each pending record, the
    /// oldest first, and one at the open stretch if it removes bone. Stamping depends on closed records alone.
    [[nodiscard]] std::size_t solid_count() const noexcept { return pending_count_ + (is_open_solid_ ? 1 : 0); }
    /// Returns the distance [m] that a point travels along `direction` (body frame) until it has left all solids.
    [[nodiscard]] double gap(Vec3 point_in_body, Vec3 direction_in_body) const noexcept;
    /// Returns the largest depth of a point inside the solids [m]; negative outside all of them.
    [[nodiscard]] double depth_in_pending(Vec3 point_in_body) const noexcept;
    /// The last records that remove bone, oldest first.
    [[nodiscard]] std::size_t recent_count() const noexcept {
        return std::min(static_cast<std::size_t>(removing_ever_), recent_capacity);
    }
    [[nodiscard]] const CutRecord& recent(std::size_t i) const noexcept {
        return recent_[(static_cast<std::size_t>(removing_ever_) - recent_count() + i) % recent_capacity];
    }
    [[nodiscard]] std::uint16_t body_id() const noexcept { return body_id_; }
    void name(std::uint16_t body_id) noexcept { body_id_ = body_id; }
    /// Changes the cutting tool; records name it by `number`. Pre: nothing is pending.   [haptic, nonblocking]
    void take_tool(const ToolSolid& solid, std::uint16_t number) noexcept;
    /// Sets the number of the next record.   [haptic, nonblocking]
    void set_next_sequence(std::uint64_t next) noexcept { sequence_ = last_reversal_ = next; }
    /// Returns the depth of a point inside solid `i` [m]; negative outside.
    [[nodiscard]] double depth_in_pending(std::size_t i, Vec3 point_in_body) const noexcept {
        return -solid_->distance(tool_from_body(i) * point_in_body);
    }

    /// Writes the gap of `count` ≤ `block_capacity` points of the tool at a pose, with directions in its frame.
    /// [haptic, nonblocking]
    void gap(const Pose& body_from_tool, const Vec3* points, std::size_t count, Directions directions,
             BlockValues& gaps) const noexcept;
    /// Returns the transform from the tool at a pose to the frame of solid `i`.
    [[nodiscard]] Frame solid_from_tool(std::size_t i, const Pose& body_from_tool) const noexcept {
        return frame_of(tool_from_body(i) * body_from_tool);
    }
    [[nodiscard]] const Body& body() const noexcept { return *body_; }
    [[nodiscard]] const ToolSolid& solid() const noexcept { return *solid_; }
    /// Returns the first solid that can make a gap: the solids before it lie behind it.
    [[nodiscard]] std::size_t first_with_gap() const noexcept;

    /// Bounds on the motion of a point when it changes from the frame of the newest solid to another solid's.
    struct Spread {
        Vec3 low{}, high{};  ///< [m] motion of the origin
        double turn = 0.0;   ///< [–] rotation: additional motion divided by the distance from the origin, at most
    };
    [[nodiscard]] const Spread& spread() const noexcept { return spread_; }

    [[nodiscard]] std::size_t pending_count() const noexcept { return pending_count_; }
    /// Returns the number of bricks that the last `commit_passed` stamped.
    [[nodiscard]] int last_bricks() const noexcept { return last_bricks_; }
    [[nodiscard]] std::uint64_t early_commits() const noexcept { return early_commits_; }

private:
    [[nodiscard]] const CutRecord& pending(std::size_t i) const noexcept { return pending_[slot(i)]; }
    [[nodiscard]] std::size_t slot(std::size_t i) const noexcept { return (pending_first_ + i) % pending_capacity; }
    [[nodiscard]] const Pose& tool_from_body(std::size_t i) const noexcept { return tool_from_body_[slot(i)]; }
    /// Sets the pose of the newest solid and updates `spread_`.
    void set_newest_pose(const Pose& body_from_tool) noexcept;
    void begin_stretch(const Pose& body_from_tool) noexcept;
    void test_open_stretch() noexcept;
    int commit_oldest();
    void drop_oldest() noexcept;
    void close_at(const Pose& to, std::uint64_t tick) noexcept;
    /// Returns whether the solid at this pose removes bone that still exists. Decided once, here: a record that removes
    /// nothing is logged, and stamped on no field.
    [[nodiscard]] bool removes_bone(const Pose& body_from_tool) const noexcept;

    const Body* body_;
    const ToolSolid* solid_;
    CutField* committed_;
    Pose open_from_ = identity_pose();  ///< end of the last record
    Pose farthest_ = identity_pose();   ///< farthest pose of the open stretch
    double farthest_motion_ = 0.0;      ///< [m] from open_from_
    Pose corner_ = identity_pose();     ///< pose at which the sideways path was measured last
    double path_aside_ = 0.0;           ///< [m] length of the sideways path up to the corner
    double last_tested_motion_ = 0.0;   ///< [m] farthest_motion_ at the last test whether the stretch removes bone
    bool is_open_solid_ = false;        ///< true if the open stretch removes bone
    Pose last_removing_ = identity_pose();
    bool has_removed_ = false;
    bool is_started_ = false;
    std::uint64_t sequence_ = 0, removing_ever_ = 0;
    std::array<CutRecord, recent_capacity> recent_{};
    std::uint16_t body_id_ = 0, solid_number_ = 0;  ///< written into the records
    std::uint64_t last_reversal_ = 0;               ///< sequence of the first record after the path last turned back
    std::array<CutRecord, 2> closed_{};
    int closed_count_ = 0;

    std::array<CutRecord, pending_capacity> pending_{};
    std::array<Pose, pending_capacity> tool_from_body_{};  ///< of the solids; one slot stays free for the open stretch
    Spread spread_;
    std::size_t pending_first_ = 0, pending_count_ = 0;
    StampProgress progress_;  ///< of the oldest pending record
    int last_bricks_ = 0;
    std::uint64_t early_commits_ = 0;
};

}  // namespace kerf
