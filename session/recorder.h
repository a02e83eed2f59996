// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "session/drawn_surface.h"
#include "session/recording.h"

namespace kerf {

/// `PRAGMA application_id` of a session: "KERF".
inline constexpr std::int32_t session_application_id = 0x4b455246;
/// docs/design/session.md lists what each version has. Every one from the oldest readable on is read.
inline constexpr std::int32_t session_schema_version = 4, oldest_readable_schema_version = 2;
inline constexpr std::int32_t first_schema_with_checksum = 3, first_schema_with_blocks = 4;
/// Bone came apart, and the loop took over its parts after this tick: an input, which a replay gives back.
/// `came_apart`: there are further bodies; `crumbled`: crumbs alone.
inline constexpr const char *came_apart_event = "bone.came_apart", *crumbled_event = "bone.crumbled";
/// What a hand asked for besides moving the handle, before this tick.
inline constexpr const char* hand_input_event = "hand.input";
/// Ticks that were due and did not run before this one, as many as its detail says: an input too.
inline constexpr const char* missed_event = "device.missed";
/// A plugin ended the run; its detail says which, in which call and how.
inline constexpr const char* plugin_failed_event = "run.plugin_failed";
/// Stands in every file a run writes.
inline constexpr const char* notice_line =
    "For training and research; not for diagnosis, planning or deciding treatment";

/// Who and where, outside the content hash. Codes, never names.
struct SessionEnvelope {
    std::string uuid;
    std::string learner, cohort;    ///< codes the teacher gave
    std::string mode = "practice";  ///< practice | exam | demo
    std::string station;
    std::string start;  ///< UTC, ISO 8601; may be empty
    std::string consent;
};

/// What the hand felt through, inside the content hash.
struct SessionConditions {
    std::string device;
    double force_scale = 1.0;         ///< [–] device newton per bone newton
    std::string assist;               ///< ids of what helped, comma-separated; empty for none
    double coupling_stiffness = 0.0;  ///< [N/m] device side
    std::string variant{};            ///< of the procedure; empty for none
};

/// Everything known before the first tick.
struct SessionHeader {
    std::string procedure, procedure_version, anatomy, rehearsal, hand;  ///< as in RunSummary
    std::string variant_title{};  ///< the text of a variant no longer has it; empty for none
    std::string procedure_text;
    std::uint64_t anatomy_hash = 0;          ///< of the anatomy's text and data files
    std::vector<std::string> anatomy_notes;  ///< what import did, for people
    std::vector<std::pair<std::string, std::string>> versions;
    SessionEnvelope envelope;
    SessionConditions conditions;
    std::vector<SignalColumn> signals;  ///< in the order of TickRow::signals; at most most_signal_columns
    std::vector<std::string> tissues;
};

/// Rows that did not fit into the queues. Not zero means: incomplete, cannot be replayed.
struct RecorderLosses {
    std::uint64_t ticks = 0, events = 0, cuts = 0;
    [[nodiscard]] bool any() const noexcept { return ticks + events + cuts > 0; }
};

/// The record that `Recorder::save_what_is_open` found.
struct SavedRecord {
    const char* path = nullptr;  ///< null: none was open
    bool is_closed = false;      ///< all of it is in the file; else what was committed before
};

/// Writes a run into one SQLite file while it happens.
///
/// The loop pushes rows into queues of 8192 rows; a thread of the recorder takes them out and commits at least every
/// 100 ms. `kill -9` loses at most a quarter of a second by the clock, and the file still opens; a run in lock-step
/// goes faster than the clock, and loses at most half a queue, 4096 ticks. A power cut loses what came after the last
/// checkpoint: 5 s by the clock, or 8 MB.
///
/// The writer compresses the rows of ticks and cuts in blocks (session/block_writer.h), and `finish` those that
/// are left. Where the disk has no room for a block, its rows stay as they are.
///
/// The file is made under another name, `PATH.part`, and renamed when it is known as a session: whatever happens,
/// `PATH` is a session or is not there. While it is open it has a -wal beside it, which begins anew at 8 MB, so that it
/// stays bounded; `finish` (or the destructor, as "incomplete") folds it in. Disk errors are kept and returned by
/// `finish`; what a full disk did not take counts as lost, and the session says that it is incomplete if there is room
/// for that word.
class Recorder {
public:
    struct Created;
    /// Makes a new file at `path`, replacing what was there.   [main]
    static Created create(const std::string& path, const SessionHeader& header);

    ~Recorder();
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// Wait-free. A row that finds the queue full is counted and lost.   [haptic, nonblocking] one thread only
    void push(const TickRow& row) noexcept;
    void push_cut(const CutRow& cut) noexcept;
    /// Ids over 63 bytes and details over 255 are cut short.   [haptic, nonblocking] the same thread
    void push_event(const EventRow& event) noexcept;
    /// The event with the texts that push_event would keep.   [any]
    [[nodiscard]] static EventRow as_kept(EventRow event);

    /// Lock-step: waits until the queues can take the next few thousand rows. Returns at once while they are less
    /// than half full. False when the file cannot be written any more.   [the pushing thread, may block]
    bool wait_for_room();

    [[nodiscard]] RecorderLosses losses() const noexcept;

    /// Where the program cannot go on: has the writer write what was pushed, add an event of this id, and close the
    /// record as "incomplete"; waits for that, at most 2 s. No run may push any more.   [any] async-signal-safe
    [[nodiscard]] static SavedRecord save_what_is_open(const char* event_id, const char* detail) noexcept;

    /// Writes what is left, the result, the bone as it is drawn, the hash and the checksum of all rows, and closes to a
    /// single file. The session's state becomes "finished", or "incomplete" when rows were lost. Returns what went
    /// wrong, empty if nothing did; once only.   [main, after the last push]
    [[nodiscard]] std::string finish(const RunSummary& summary, const DrawnSurface& bone_after = {});

private:
    struct Impl;
    explicit Recorder(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

/// A recorder, or why there is none.
struct Recorder::Created {
    std::unique_ptr<Recorder> recorder;
    std::string error;  ///< for people; empty when there is a recorder
};

}  // namespace kerf
