// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "session/drawn_surface.h"
#include "session/recording.h"

namespace kerf::session {

/// `PRAGMA application_id` of a session: "KERF".
inline constexpr std::int32_t session_application_id = 0x4b455246;
/// docs/design/session.md lists the contents of each version. All versions from the oldest readable on can be read.
inline constexpr std::int32_t session_schema_version = 5, oldest_readable_schema_version = 2;
inline constexpr std::int32_t first_schema_with_checksum = 3, first_schema_with_blocks = 4, first_schema_with_zones = 5;
/// Events of adoption: after this tick the loop took over separated bone. An input, which a replay repeats.
/// `came_apart`: there are new bodies. `crumbled`: only crumbs.
inline constexpr const char *came_apart_event = "bone.came_apart", *crumbled_event = "bone.crumbled";
/// An input of the hand other than the handle's motion, before this tick.
inline constexpr const char* hand_input_event = "hand.input";
/// A radiograph of the bone before this tick, after the input that requested it. Its detail: "AP 2", the second one.
inline constexpr const char* image_taken_event = "image.taken";
/// The trainee got help that was requested; the detail has the step.
inline constexpr const char* assist_used_event = "assist.used";
/// A number of missed ticks before this one, in its detail. Also an input.
inline constexpr const char* missed_event = "device.missed";
/// The device was lost before this tick, or is back. Also inputs.
inline constexpr const char *lost_event = "device.lost", *back_event = "device.back";
/// A change of the loop on the clock, by its number, was taken over before this tick, later than in lock-step; or it
/// was refused. Also an input.
inline constexpr const char* late_change_event = "loop.late_change";
/// A plugin ended the run; the detail has the plugin, the call and the kind of failure.
inline constexpr const char* plugin_failed_event = "run.plugin_failed";
/// The program crashed outside of its plugins; the detail has the signal and the last call of a plugin.
inline constexpr const char* crashed_event = "run.crashed";
/// Part of every file that a run writes.
inline constexpr const char* notice_line =
    "For training and research; not for diagnosis, planning or deciding treatment";

/// Person and station of a run, outside the content hash. Codes, never names.
struct SessionEnvelope {
    std::string uuid;
    std::string learner, cohort;    ///< codes that the teacher assigned
    std::string mode = "practice";  ///< practice | exam | demo
    std::string station;
    std::string start;  ///< UTC, ISO 8601; may be empty
    std::string consent;
};

/// Conditions of the force feedback, inside the content hash.
struct SessionConditions {
    std::string device;
    double force_scale = 1.0;         ///< [–] device newton per bone newton
    std::string assist;               ///< "off", "on-request", "stepwise", "full"
    double coupling_stiffness = 0.0;  ///< [N/m] in device newtons
    std::string variant{};            ///< of the procedure; empty for none
    bool is_examination = false;      ///< without undo and help
};

/// The data of a session that are known before the first tick.
struct SessionHeader {
    std::string procedure, procedure_version, anatomy, rehearsal, hand;  ///< as in RunSummary
    std::string leader{}, leader_setup{};                                ///< as in RunSummary
    std::string parent{};            ///< uuid of the session that this one continues; empty: none
    std::uint64_t parent_ticks = 0;  ///< number of its ticks that this one repeats
    std::string variant_title{};     ///< not part of a variant's text; empty for none
    std::string procedure_text;
    std::uint64_t anatomy_hash = 0;          ///< of the anatomy's text and data files
    std::vector<std::string> anatomy_notes;  ///< messages of the import, for people
    std::vector<std::pair<std::string, std::string>> versions;
    SessionEnvelope envelope;
    SessionConditions conditions;
    std::vector<std::pair<std::string, double>> device_values{};  ///< of a connected device [SI]; empty: a known one
    std::vector<SignalColumn> signals;  ///< in the order of TickRow::signals; at most max_signal_columns
    std::vector<std::string> tissues;
};

/// Number of rows that did not fit into the queues. If not zero, the session is incomplete and cannot be replayed.
struct RecorderLosses {
    std::uint64_t ticks = 0, events = 0, cuts = 0;
    [[nodiscard]] bool any() const noexcept { return ticks + events + cuts > 0; }
};

/// The record closed by `Recorder::save_what_is_open`.
struct SavedRecord {
    const char* path = nullptr;  ///< null: no record was open
    bool is_closed = false;      ///< true: all rows are in the file; else only those committed before
};

/// Writes a run into one SQLite file during the run.
///
/// The loop pushes rows into queues of 8192 rows. A thread of the recorder takes them out and commits at least every
/// 100 ms. After `kill -9` the file still opens and lacks at most the last 0.25 s by the clock. A run in lock-step is
/// faster than the clock and loses at most 500 ticks, half a second of the operation. A power cut loses the rows after
/// the last checkpoint: 5 s by the clock, or 8 MB.
///
/// The writer compresses the rows of ticks and cuts in blocks (session/block_writer.h), and `finish` compresses the
/// rest. If the disk has no space for a block, its rows stay plain.
///
/// The file is made as `PATH.part` and renamed once it is a valid session: `PATH` is a session or does not exist. An
/// open session has a -wal file next to it, which restarts at 8 MB and so stays bounded. `finish` merges it into the
/// session; the destructor does so, too, with the state "incomplete". `finish` returns disk errors. Rows that did not
/// fit on a full disk count as lost, and the session becomes "incomplete" if that word still fits.
class Recorder {
public:
    struct Created;
    /// Makes a new file at `path` and replaces an existing one.   [main]
    static Created create(const std::string& path, const SessionHeader& header);

    ~Recorder();
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// Queues a row without waiting. If the queue is full, the row is lost and counted.   [haptic, nonblocking] one
    /// thread only
    void push(const TickRow& row) noexcept;
    void push_cut(const CutRow& cut) noexcept;
    /// Queues an event. Ids over 63 bytes and details over 255 bytes are cut.   [haptic, nonblocking] the same thread
    void push_event(const EventRow& event) noexcept;
    /// Returns the event with its texts cut as by push_event.   [any]
    [[nodiscard]] static EventRow as_kept(EventRow event);

    /// Waits in lock-step until less than 500 ticks are not written yet and the queues are less than half full. Call it
    /// after each tick. Returns false if the file cannot be written any more.   [the pushing thread, may block]
    bool wait_for_capacity();

    [[nodiscard]] RecorderLosses losses() const noexcept;

    /// Closes the open record of a program that cannot continue. The writer writes the queued rows, adds an event with
    /// this id and sets the state "incomplete". Waits at most 2 s for that. Pre: no run pushes any more.
    /// [any] async-signal-safe
    [[nodiscard]] static SavedRecord save_what_is_open(const char* event_id, const char* detail) noexcept;

    /// Writes the remaining rows, the result, the drawn bone, the hash and the checksum of all rows, and closes the
    /// session as a single file. Its state becomes "finished", or "incomplete" if rows were lost. If is_removed(), it
    /// changes no file of that name. Returns the error as text, empty on success. Call it once.   [main, after the last
    /// push]
    [[nodiscard]] std::string finish(const RunSummary& summary, const DrawnSurface& bone_after = {});

    /// Returns whether the session's name leads to another file or to none, because its file was removed, renamed or
    /// replaced since `create`.   [main]
    [[nodiscard]] bool is_removed() const noexcept;

private:
    struct Impl;
    explicit Recorder(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

/// A recorder, or the reason why it could not be made.
struct Recorder::Created {
    std::unique_ptr<Recorder> recorder;
    std::string error;  ///< for people; empty if there is a recorder
};

}  // namespace kerf::session
