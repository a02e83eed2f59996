// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "core/field/spsc_ring.h"
#include "core/plugin/own_files.h"
#include "session/block_writer.h"
#include "session/recorder.h"
#include "session/session_tables.h"
#include "session/sqlite_database.h"
#include "session/summary.h"
#include "text/write_file.h"

/// The inside of a recorder: recorder.cpp has its face, recorder_file.cpp begins and ends the file, recorder_writer.cpp
/// has the threads that write it.
namespace kerf::session {

/// An event without heap memory.
struct EventSlot {
    std::uint64_t tick = 0;
    double time = 0.0;
    char id[64]{};
    char detail[256]{};
};

[[nodiscard]] inline std::int64_t integer(std::uint64_t value) noexcept { return static_cast<std::int64_t>(value); }
inline SqliteStatement& operator<<(SqliteStatement& row, std::int32_t value) { return row << std::int64_t{value}; }

struct Recorder::Impl {
    static constexpr std::size_t ring_rows = 8192;  ///< 8 s at 1 kHz
    static constexpr std::size_t event_rows = 1024;
    static constexpr std::size_t batch_rows = 250;  ///< of each kind in one transaction

    Impl() : ticks(ring_rows), cuts(ring_rows), events(event_rows) {}

    // From the loop to the writer.
    SpscRing<TickRow> ticks;
    SpscRing<CutRow> cuts;
    SpscRing<EventSlot> events;
    std::atomic<std::uint64_t> lost_ticks{0}, lost_cuts{0}, lost_events{0};
    std::uint64_t pushed_ticks = 0;               ///< of the pushing thread
    std::atomic<std::uint64_t> written_ticks{0};  ///< in the file, or given up after a disk error

    // The file. The writer uses it while it runs, the caller before and after.
    std::string path;
    std::vector<Table> tables;
    std::size_t signal_count = 0;
    SqliteDatabase database;
    OwnFiles own_files;  ///< those of `database`
    SqliteStatement begin, commit, insert_tick, insert_cut, insert_event;
    std::optional<BlockWriter> tick_blocks, cut_blocks;

    std::thread writer, checkpointer;
    std::mutex mutex;  ///< of `wake` alone; a loop on the clock never locks it
    std::condition_variable wake;
    std::atomic<bool> is_stopping{false};
    std::atomic<bool> is_failed{false};
    std::atomic<bool> has_writer_ended{false};               ///< before it was stopped
    std::atomic<bool> is_fold_due{false}, is_folded{false};  ///< from the writer to the checkpointer, and back

    // For a program that cannot continue (save_what_is_open).
    static inline std::atomic<Impl*> open{nullptr};  ///< the record that is being written
    std::atomic<bool> is_abandoned{false}, is_saved{false};
    const char *last_event = "", *last_detail = "";
    std::uint64_t last_tick = 0;  ///< last written
    double last_time = 0.0;
    text::FileIdentity file;
    bool is_closed = false, was_removed = false;
    std::string error;        ///< the first error, once closed
    std::string plain_error;  ///< the reason for plain rows in a complete session
    std::string fold_error;   ///< the reason why the -wal file remains next to a complete session

    // recorder_file.cpp
    void create(const SessionHeader& header);
    void open_to_write();
    void write_results(const RunSummary& summary, const DrawnSurface& bone_after);
    void write_zones(const RunSummary& summary);
    void write_verdict(const RunSummary& summary);
    void finalize();
    [[nodiscard]] bool is_removed() const noexcept { return text::identity_of(path) != file; }
    void close(const char* state, const RunSummary* summary = nullptr);

    // recorder_writer.cpp
    void start();
    void stop();
    /// Never returns once another thread ends the program: the record is closed, or about to be.
    void wait_if_abandoned() const noexcept;

private:
    void set(const char* table, std::string_view key, std::string_view value);
    void compress_rest();
    void fold();
    bool write_state(const char* state, const RunSummary* summary);

    void write_until_stopped();
    void close_abandoned();
    void checkpoint_until_stopped();
    bool write_batch();
    void write_tick(const TickRow& row);
    void fold_when_long();
};

}  // namespace kerf::session
