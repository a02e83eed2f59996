// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>

#include "session/recorder_impl.h"
#include "text/system_reason.h"

namespace kerf::session {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr auto batch_time = milliseconds(100);  // with the time of a commit, well below the promised 0.25 s
constexpr auto poll_time = milliseconds(10);
// Merging the -wal file into the session waits for the disk. It has its own thread, so that a commit never waits. The
// writer merges the few rows that arrive meanwhile itself: only then can the -wal file restart.
constexpr auto checkpoint_time = milliseconds(5000);
constexpr std::uintmax_t checkpoint_bytes = 8 << 20;

// `Row` is a statement or a block.
template <class Row>
Row& operator<<(Row& row, const Pose& pose) {
    return row << pose.position.x << pose.position.y << pose.position.z << pose.rotation.w << pose.rotation.x
               << pose.rotation.y << pose.rotation.z;
}

template <class Row>
Row& operator<<(Row& row, const Vec6& wrench) {
    for (const double component : wrench) row << component;
    return row;
}

/// Appends the columns of `ticks`, from left to right.
template <class Row>
void put(Row& row, const TickRow& tick, std::size_t signal_count) {
    row << integer(tick.tick) << tick.time << std::int64_t{tick.step} << tick.device_from_handle << tick.world_from_tool
        << tick.modelled << tick.coupled << tick.limited << tick.commanded << tick.thrust << tick.torque << tick.depth
        << tick.feed_rate << std::int64_t{tick.tissue} << std::int64_t{tick.iterations} << tick.power_hand
        << tick.power_drive << tick.removed;
    for (std::size_t i = 0; i < signal_count; ++i) row << tick.signals[i];
}

/// Appends the columns of `cuts`.
template <class Row>
void put(Row& row, const CutRow& cut) {
    row << integer(cut.sequence) << integer(cut.tick) << std::int64_t{cut.body} << std::int64_t{cut.solid} << cut.from
        << cut.to;
}

}  // namespace

void Recorder::Impl::write_tick(const TickRow& row) {
    put(insert_tick, row, signal_count);
    insert_tick.run();
    put(tick_blocks->next_rows(), row, signal_count);
    tick_blocks->next_rows().end_row();
    last_tick = row.tick;
    last_time = row.time;
}

/// Writes up to 250 rows of each kind in one transaction, none beyond a full block. After a disk error it only empties
/// the queues, because the loop continues.
bool Recorder::Impl::write_batch() {
    std::uint64_t tick_count = 0, cut_count = 0, event_count = 0;
    begin.run();
    for (std::size_t i = 0; i < batch_rows; ++i, ++tick_count) {
        const TickRow* row = ticks.front();
        if (row == nullptr || tick_blocks->is_full()) break;
        write_tick(*row);
        ticks.pop();
    }
    for (std::size_t i = 0; i < batch_rows; ++i, ++cut_count) {
        const CutRow* cut = cuts.front();
        if (cut == nullptr || cut_blocks->is_full()) break;
        put(insert_cut, *cut);
        insert_cut.run();
        put(cut_blocks->next_rows(), *cut);
        cut_blocks->next_rows().end_row();
        cuts.pop();
    }
    for (std::size_t i = 0; i < batch_rows; ++i, ++event_count) {
        const EventSlot* event = events.front();
        if (event == nullptr) break;
        insert_event << integer(event->tick) << event->time << std::string_view(event->id)
                     << std::string_view(event->detail);
        insert_event.run();
        events.pop();
    }
    commit.run();
    written_ticks.fetch_add(tick_count, std::memory_order_release);
    if (database.is_good()) {
        tick_blocks->work();
        cut_blocks->work();
        return true;
    }
    tick_blocks->give_up(database.error());
    cut_blocks->give_up(database.error());
    lost_ticks += tick_count;
    lost_cuts += cut_count;
    lost_events += event_count;
    return false;
}

void Recorder::Impl::write_until_stopped() {
    auto last_commit = Clock::now();
    while (true) {
        const bool was_stopping =
            is_stopping.load(std::memory_order_acquire);  // read before the queues, so that no row is missed
        const std::size_t most = std::max({ticks.size(), cuts.size(), events.size()});
        if (most == 0 && was_stopping) return;

        const bool is_due = most >= batch_rows || was_stopping || Clock::now() - last_commit >= batch_time;
        if (most > 0 && is_due) {
            if (!write_batch()) is_failed.store(true, std::memory_order_release);
            fold_when_long();
            last_commit = Clock::now();
            continue;
        }
        std::unique_lock lock(mutex);
        wake.wait_for(lock, poll_time,
                      [&] { return is_stopping.load(std::memory_order_acquire) || ticks.size() >= batch_rows; });
    }
}

/// Keeps the -wal file short. A failure does no harm: the -wal file is complete.
void Recorder::Impl::fold_when_long() {
    if (is_folded.exchange(false, std::memory_order_acquire)) {
        database.try_run("PRAGMA wal_checkpoint(TRUNCATE)");
        return;
    }
    std::error_code unknown;
    const auto bytes = std::filesystem::file_size(path + "-wal", unknown);
    if (unknown || bytes < checkpoint_bytes || is_fold_due.load(std::memory_order_relaxed)) return;
    is_fold_due.store(true, std::memory_order_release);
    wake.notify_all();
}

void Recorder::Impl::checkpoint_until_stopped() {
    SqliteDatabase own;
    own.open(path);
    std::unique_lock lock(mutex);
    const auto is_awaited = [&] {
        return is_stopping.load(std::memory_order_acquire) || is_fold_due.load(std::memory_order_acquire);
    };
    while (true) {
        wake.wait_for(lock, checkpoint_time, is_awaited);
        if (is_stopping.load(std::memory_order_acquire)) return;
        lock.unlock();
        if (own.try_run("PRAGMA wal_checkpoint(PASSIVE)")) is_folded.store(true, std::memory_order_release);
        is_fold_due.store(false, std::memory_order_release);
        lock.lock();
    }
}

void Recorder::Impl::start() {
    const auto write = [this]() noexcept {
        try {
            write_until_stopped();
            if (is_abandoned.load(std::memory_order_acquire)) close_abandoned();
        } catch (const std::exception&) {  // out of memory
            has_writer_ended.store(true, std::memory_order_release);
            is_failed.store(true, std::memory_order_release);
        }
    };
    const auto checkpoint = [this]() noexcept {
        try {
            checkpoint_until_stopped();
        } catch (const std::exception&) {
            // The -wal file grows, but is complete.
        }
    };
    try {
        writer = std::thread(write);
        checkpointer = std::thread(checkpoint);
    } catch (const std::system_error& refused) {
        stop();
        database.fail(std::string("the system gives no thread (") + refused.code().message() + "). " +
                      text::thread_advice());
    }
    open.store(this);
}

/// Runs on the writer's thread, because the main thread cannot continue.
void Recorder::Impl::close_abandoned() {
    wake.notify_all();
    checkpointer.join();
    insert_event << integer(last_tick) << last_time << std::string_view(last_event) << std::string_view(last_detail);
    insert_event.run();
    close("incomplete");
    is_saved.store(true, std::memory_order_release);
}

void Recorder::Impl::wait_if_abandoned() const noexcept {
    while (is_abandoned.load(std::memory_order_acquire)) std::this_thread::sleep_for(std::chrono::seconds(1));
}

void Recorder::Impl::stop() {
    open.store(nullptr);
    {
        const std::lock_guard lock(mutex);
        is_stopping.store(true, std::memory_order_release);
    }
    wake.notify_all();
    if (writer.joinable()) writer.join();
    if (checkpointer.joinable()) checkpointer.join();
    if (!has_writer_ended.load(std::memory_order_acquire)) return;
    database.fail("out of memory");
    lost_ticks += ticks.size();
    lost_cuts += cuts.size();
    lost_events += events.size();
}

}  // namespace kerf::session
