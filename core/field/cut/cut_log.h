// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/field/cut/cut_field.h"

/// Converts tool poses to cut records, and records to the committed cut that edges read.
namespace kerf {

/// Closes records as the tool moves, and delays the commit of records that are still near the cutting edge.
///
/// A cutting edge lies on the border of the volume that it just removed. An edge that read this border would find only
/// half of its engagement, at any spacing. So a record reaches the committed field only when the tool has moved on by
/// about one voxel.
class CutTracker {
public:
    static constexpr std::size_t pending_capacity = 128;
    static constexpr std::size_t recent_capacity = 16;
    static constexpr std::size_t pending_limit = 64;  ///< if more wait, the oldest are committed early and counted
    static constexpr int bricks_per_record = 16;      ///< that a tick may stamp for one waiting record
    static constexpr int bricks_per_tick = 32;        ///< for two to four waiting records; each further one adds eight
    static constexpr int max_bricks = 128;  ///< that a tick may stamp in all, over all bodies and parts of the tick

    CutTracker(const Body& body, const ToolSolid& solid, CutField& committed)
        : body_(&body), solid_(&solid), committed_(&committed) {}

    /// Starts a stretch at a pose. The path to this pose is no cut.   [haptic, nonblocking]
    void restart(const Pose& body_from_tool) noexcept;

    /// Takes over tool and open stretch of `other`, the tracker of the body from which this one separated. Pre: this
    /// tracker's field contains all closed records of `other`. The next record gets the number `next`.
    /// [haptic, nonblocking]
    void continue_from(const CutTracker& other, std::uint64_t next) noexcept;
    /// Returns the number of the next record.
    [[nodiscard]] std::uint64_t next_sequence() const noexcept { return sequence_; }

    /// Moves the cutting tool. Returns the number of records that it closed, 0 … 2; read them with `closed(i)`.
    /// [haptic, nonblocking]
    int advance(const Pose& body_from_tool, std::uint64_t tick) noexcept;
    [[nodiscard]] const CutRecord& closed(int i) const noexcept { return closed_[static_cast<std::size_t>(i)]; }

    /// Closes the open stretch. Returns the number of records that it closed, 0 or 1.   [haptic, nonblocking]
    int close(std::uint64_t tick) noexcept;

    /// Stamps pending records whose end the tool has passed by a voxel, and records beyond `pending_limit`: about
    /// `maximum` bricks at most. `is_at_front`: an edge met uncut bone; without it, no record counts as passed. Nor
    /// does a tool pass a record by moving straight back.   [haptic, nonblocking]
    void commit_passed(const Pose& body_from_tool, bool is_at_front, int maximum = max_bricks);
    /// Returns whether too many records are pending: the tool should slow down.
    [[nodiscard]] bool is_behind() const noexcept { return pending_count_ > pending_limit; }
    /// Stamps all pending records. Called when the tool changes, when the body splits and at the end of a run.
    /// [haptic, nonblocking]
    void flush();

    /// Returns the number of pending solids, numbered from the oldest. Each is the tool's solid at the end of a pending
    /// record; the last one is at the farthest pose of the open stretch, if that removes bone. Stamping depends on
    /// closed records alone.
    [[nodiscard]] std::size_t solid_count() const noexcept { return pending_count_ + (is_open_solid_ ? 1 : 0); }
    /// Returns the distance [m] that a point travels along the unit direction until it has left all pending solids that
    /// contain it; 0 if none does.
    [[nodiscard]] double gap(Vec3 point_in_body, Vec3 direction_in_body) const noexcept;
    /// Returns the largest depth of a point in any pending solid [m]; negative outside all of them, down to −clamp.
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
    /// Changes the cutting tool; records store `number` as their `solid`. Pre: nothing is pending.
    /// [haptic, nonblocking]
    void take_tool(const ToolSolid& solid, std::uint16_t number) noexcept;
    /// Sets the number of the next record.   [haptic, nonblocking]
    void set_next_sequence(std::uint64_t next) noexcept { sequence_ = last_reversal_ = next; }
    /// Returns the depth of a point in pending solid `i` [m]; negative outside.
    [[nodiscard]] double depth_in_pending(std::size_t i, Vec3 point_in_body) const noexcept {
        return -solid_->distance(tool_from_body(i) * point_in_body);
    }

    /// Writes the gaps [m] of `count` ≤ `block_capacity` points. Points and directions are in the tool frame, at the
    /// pose.   [haptic, nonblocking]
    void gap(const Pose& body_from_tool, const Vec3* points, std::size_t count, Directions directions,
             BlockValues& gaps) const noexcept;
    /// Returns the transform from the tool frame, at a pose, to the frame of pending solid `i`.
    [[nodiscard]] Frame solid_from_tool(std::size_t i, const Pose& body_from_tool) const noexcept {
        return frame_of(tool_from_body(i) * body_from_tool);
    }
    [[nodiscard]] const Body& body() const noexcept { return *body_; }
    [[nodiscard]] const ToolSolid& solid() const noexcept { return *solid_; }
    /// Returns the index of the first pending solid that can cause a gap. Without a reversal of the path this is the
    /// newest: all older ones lie behind it.
    [[nodiscard]] std::size_t first_with_gap() const noexcept;

    /// Bounds on the change of a point's coordinates from the frame of the newest pending solid to that of any older
    /// one.
    struct Spread {
        Vec3 low{}, high{};  ///< [m] change of the origin
        double turn = 0.0;   ///< [–] maximum further change per distance from the origin, by rotation
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
    /// Returns whether the solid at this pose removes bone that still exists. Errs towards true before the first cut,
    /// and ahead of the last pose that removed bone. The record stores the decision for all fields.
    [[nodiscard]] bool removes_bone(const Pose& body_from_tool) const noexcept;

    const Body* body_;
    const ToolSolid* solid_;
    CutField* committed_;
    Pose open_from_ = identity_pose();  ///< end of the last record
    Pose farthest_ = identity_pose();   ///< farthest pose of the open stretch
    double farthest_motion_ = 0.0;      ///< [m] from open_from_
    Pose corner_ = identity_pose();     ///< pose up to which `path_aside_` is measured
    double path_aside_ = 0.0;           ///< [m] length of the path apart from slides, up to `corner_`
    double last_tested_motion_ = 0.0;   ///< [m] farthest_motion_ at the last test whether the stretch removes bone
    bool is_open_solid_ = false;        ///< true if the open stretch removes bone
    Pose last_removing_ = identity_pose();
    bool has_removed_ = false;
    bool is_started_ = false;
    std::uint64_t sequence_ = 0, removing_ever_ = 0;
    std::array<CutRecord, recent_capacity> recent_{};
    std::uint16_t body_id_ = 0, solid_number_ = 0;  ///< written into the records
    std::uint64_t last_reversal_ = 0;               ///< sequence of the first record after the last turn
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
