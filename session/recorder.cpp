// SPDX-License-Identifier: Apache-2.0
#include "session/recorder.h"

#include <time.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "core/field/spsc_ring.h"
#include "core/plugin/si_unit.h"
#include "session/block_writer.h"
#include "session/content_hash.h"
#include "session/record_checksum.h"
#include "session/session_tables.h"
#include "session/sqlite_database.h"
#include "session/summary.h"
#include "text/plain_numbers.h"
#include "text/write_file.h"

namespace kerf {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::size_t ring_rows = 8192;  // 8 s at 1 kHz
constexpr std::size_t event_rows = 1024;
constexpr std::size_t batch_rows = 250;
constexpr auto batch_time = milliseconds(100);  // with the time of a commit, well below the promised 0.25 s
constexpr auto poll_time = milliseconds(10);
// Merging the -wal file into the session waits for the disk. It has its own thread, so that a commit never waits. The
// writer merges the few rows that arrive meanwhile itself: only then can the -wal file restart.
constexpr auto checkpoint_time = milliseconds(5000);
constexpr std::uintmax_t checkpoint_bytes = 8 << 20;

/// An event without heap memory.
struct EventSlot {
    std::uint64_t tick = 0;
    double time = 0.0;
    char id[64]{};
    char detail[256]{};
};

/// Copies as much as fits, without cutting a UTF-8 character.
template <std::size_t N>
void copy_text(char (&to)[N], const std::string& from) noexcept {
    std::size_t count = std::min(from.size(), N - 1);
    if (count < from.size())
        while (count > 0 && (static_cast<unsigned char>(from[count]) & 0xc0u) == 0x80u) --count;
    std::memcpy(to, from.data(), count);
    to[count] = '\0';
}

std::int64_t integer(std::uint64_t value) noexcept { return static_cast<std::int64_t>(value); }

SqliteStatement& operator<<(SqliteStatement& row, std::int32_t value) { return row << std::int64_t{value}; }

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

std::string text_of(double value) {
    const PlainNumbers point;
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

/// Returns an error of SQLite for people, with advice.
std::string for_people(const std::string& error) {
    const bool is_full = error.find("disk is full") != std::string::npos;
    return is_full ? "the disk is full. Free some space, or give a folder on another disk." : error + ".";
}

}  // namespace

struct Recorder::Impl {
    Impl() : ticks(ring_rows), cuts(ring_rows), events(event_rows) {}

    // From the loop to the writer.
    SpscRing<TickRow> ticks;
    SpscRing<CutRow> cuts;
    SpscRing<EventSlot> events;
    std::atomic<std::uint64_t> lost_ticks{0}, lost_cuts{0}, lost_events{0};

    // The file. The writer uses it while it runs, the caller before and after.
    std::string path;
    std::vector<Table> tables;
    std::size_t signal_count = 0;
    SqliteDatabase database;
    SqliteStatement begin, commit, insert_tick, insert_cut, insert_event;
    std::optional<BlockWriter> tick_blocks, cut_blocks;

    std::thread writer, checkpointer;
    std::mutex mutex;  ///< of `wake` alone; the loop never locks it
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
    bool is_closed = false;
    std::string error;        ///< the first error, once closed
    std::string plain_error;  ///< the reason for plain rows in a complete session
    std::string fold_error;   ///< the reason why the -wal file remains next to a complete session

    void create(const SessionHeader& header);
    void open_to_write();
    void start();
    void stop();
    void write_until_stopped();
    void close_abandoned();
    void compress_rest();
    void checkpoint_until_stopped();
    bool write_batch();
    void write_tick(const TickRow& row);
    void fold_when_long();
    void finalize();
    void close(const char* state);
    bool write_state(const char* state);
    void set(const char* table, std::string_view key, std::string_view value);
    void write_results(const RunSummary& summary, const DrawnSurface& bone_after);
};

// ---- before the first tick ---------------------------------------------------------------------------------------

void Recorder::Impl::set(const char* table, std::string_view key, std::string_view value) {
    SqliteStatement insert(database, std::string("INSERT INTO ") + table + " VALUES(?,?)");
    insert << key << value;
    insert.run();
}

void Recorder::Impl::create(const SessionHeader& header) {
    signal_count = std::min<std::size_t>(header.signals.size(), max_signal_columns);
    tables = session_tables(header.signals, header.conditions.force_scale);

    database.run("PRAGMA auto_vacuum=INCREMENTAL");  // before the first table: pages of compressed rows are freed
    database.run("PRAGMA journal_mode=MEMORY");      // not readable before it is complete: no rollback needed
    database.run("PRAGMA application_id=" + std::to_string(session_application_id));
    database.run("PRAGMA user_version=" + std::to_string(session_schema_version));
    database.run("BEGIN");
    create_tables(database, tables);
    SqliteStatement(database, "INSERT INTO notice VALUES('" + std::string(notice_line) + "')").run();

    set("session", "state", "running");
    set("session", "run.procedure", header.procedure);
    set("session", "run.procedure_version", header.procedure_version);
    set("session", "run.anatomy", header.anatomy);
    set("session", "run.rehearsal", header.rehearsal);
    set("session", "run.hand", header.hand);
    if (!header.variant_title.empty()) set("session", "run.variant_title", header.variant_title);
    set("session", "procedure_text", header.procedure_text);
    set("session", "anatomy_hash", hex16(header.anatomy_hash));
    std::string notes;
    for (const std::string& note : header.anatomy_notes) notes += (notes.empty() ? "" : "\n") + note;
    set("session", "anatomy_notes", notes);
    for (const auto& [part, version] : header.versions) set("session", "version." + part, version);
    set("session", "condition.device", header.conditions.device);
    set("session", "condition.force_scale", text_of(header.conditions.force_scale));
    set("session", "condition.assist", header.conditions.assist);
    set("session", "condition.variant", header.conditions.variant);
    set("session", "condition.coupling_stiffness", text_of(header.conditions.coupling_stiffness));

    set("envelope", "uuid", header.envelope.uuid);
    set("envelope", "learner", header.envelope.learner);
    set("envelope", "cohort", header.envelope.cohort);
    set("envelope", "mode", header.envelope.mode);
    set("envelope", "station", header.envelope.station);
    set("envelope", "start", header.envelope.start);
    set("envelope", "consent", header.envelope.consent);

    SqliteStatement tissue(database, "INSERT INTO tissues VALUES(?,?)");
    for (std::size_t i = 0; i < header.tissues.size(); ++i) {
        tissue << integer(i) << header.tissues[i];
        tissue.run();
    }
    SqliteStatement signal(database, "INSERT INTO signals VALUES(?,?,?,?,?,?,?)");
    const std::vector<std::string> signal_columns = signal_column_names(header.signals);
    for (std::size_t i = 0; i < signal_count; ++i) {
        const SignalColumn& column = header.signals[i];
        signal << integer(i) << column.id << signal_columns[i] << si_unit_of(column.unit) << column.unit
               << column.per_unit << column.help;
        signal.run();
    }
    database.run("COMMIT");
}

void Recorder::Impl::open_to_write() {
    database.run("PRAGMA journal_mode=WAL");
    database.run("PRAGMA synchronous=NORMAL");
    database.run("PRAGMA wal_autocheckpoint=0");
    database.run("PRAGMA secure_delete=OFF");  // plain rows remain in a block when deleted: no need to overwrite them

    begin.prepare(database, "BEGIN");
    commit.prepare(database, "COMMIT");
    insert_tick.prepare(database, insert_sql(find_table(tables, ticks_table)));
    insert_cut.prepare(database, insert_sql(find_table(tables, cuts_table)));
    insert_event.prepare(database, insert_sql(find_table(tables, "events")));
    tick_blocks.emplace(find_table(tables, ticks_table));
    cut_blocks.emplace(find_table(tables, cuts_table));
    tick_blocks->prepare(database);
    cut_blocks->prepare(database);
}

// ---- while it runs -----------------------------------------------------------------------------------------------

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
        wake.wait_for(lock, poll_time, [&] { return is_stopping.load(std::memory_order_acquire); });
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
        database.fail(std::string("the system gives no thread (") + refused.code().message() + ")");
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

// ---- after the last tick -----------------------------------------------------------------------------------------

void Recorder::Impl::write_results(const RunSummary& summary, const DrawnSurface& bone_after) {
    SqliteStatement insert_step(database, insert_sql(find_table(tables, "steps")));
    for (std::size_t i = 0; i < summary.steps.size(); ++i) {
        const StepRow& step = summary.steps[i];
        std::string limits;
        for (const std::string& limit : step.broken_limits) limits += (limits.empty() ? "" : "\n") + limit;
        insert_step << integer(i) << step.id << step.title << std::int64_t{step.done} << step.start << step.end
                    << limits;
        insert_step.run();
    }
    SqliteStatement insert_metric(database, insert_sql(find_table(tables, "metrics")));
    for (const MetricRow& metric : summary.metrics) {
        insert_metric << metric.id << metric.revision << metric.scope << metric.occurrence << metric.occurrences
                      << metric.value << si_unit_of(metric.unit) << metric.unit << metric.per_unit;
        metric.uncertainty < 0.0 ? insert_metric.null() : insert_metric << metric.uncertainty;
        insert_metric << metric.status << metric.help;
        insert_metric.run();
    }
    SqliteStatement insert_reason(database, insert_sql(find_table(tables, "reasons")));
    for (std::size_t i = 0; i < summary.reasons.size(); ++i) {
        insert_reason << integer(i) << summary.reasons[i];
        insert_reason.run();
    }
    SqliteStatement insert_removed(database, insert_sql(find_table(tables, "removed")));
    for (std::size_t i = 0; i < summary.removed_by_tissue.size(); ++i) {
        insert_removed << integer(i) << summary.removed_by_tissue[i].first << summary.removed_by_tissue[i].second;
        insert_removed.run();
    }
    if (!bone_after.is_empty()) {
        SqliteStatement insert_surface(database, insert_sql(find_table(tables, "surface")));
        insert_surface << bone_after.step << bone_after.half_size.x << bone_after.half_size.y << bone_after.half_size.z;
        for (const auto* bytes :
             {&bone_after.positions, &bone_after.normals, &bone_after.tissues, &bone_after.triangles})
            insert_surface << std::span<const unsigned char>(*bytes);
        insert_surface.run();
    }
    set("session", "result.verdict", to_text(summary.verdict));
    set("session", "result.score", text_of(summary.score));
    set("session", "result.duration", text_of(summary.duration));
    set("session", "result.ticks", std::to_string(summary.ticks));
    set("session", "result.removed", text_of(summary.removed));
    set("session", "summary", summary_json(summary));
    set("session", "hash", hex16(summary.hash));
}

void Recorder::Impl::finalize() {
    for (SqliteStatement* statement : {&begin, &commit, &insert_tick, &insert_cut, &insert_event})
        statement->finalize();
    if (tick_blocks) tick_blocks->finalize();
    if (cut_blocks) cut_blocks->finalize();
}

/// Compresses the remaining rows. All are in the file; on a full disk they stay plain.
void Recorder::Impl::compress_rest() {
    if (!database.is_good()) return;
    for (BlockWriter* blocks : {&*tick_blocks, &*cut_blocks}) {
        blocks->finish();
        if (plain_error.empty()) plain_error = blocks->error();
    }
}

/// Writes the final state and the checksum of the whole session in one transaction.
bool Recorder::Impl::write_state(const char* state) {
    database.run("BEGIN");
    SqliteStatement(database, std::string("UPDATE session SET value='") + state + "' WHERE key='state'").run();
    set("session", "lost_ticks", std::to_string(lost_ticks.load()));
    set("session", "lost_events", std::to_string(lost_events.load()));
    set("session", "lost_cuts", std::to_string(lost_cuts.load()));
    if (!database.is_good()) return false;
    const auto checksum = record_checksum(database.handle());
    if (!checksum) database.fail("its rows cannot be read back");
    if (checksum) set("session", record_checksum_key, hex16(*checksum));
    return database.run("COMMIT");
}

/// Writes the final state, merges the -wal file and closes.
void Recorder::Impl::close(const char* state) {
    // A program that cannot continue skips all work that is not needed.
    if (!is_abandoned.load(std::memory_order_acquire)) compress_rest();
    finalize();
    // A transaction that did not fit may leave space for these few bytes.
    if (!database.is_good()) {
        error = database.recover();
        state = "incomplete";
    }
    if (!write_state(state)) {
        const std::string why = database.recover();
        if (error.empty()) error = why;
        database.run("UPDATE session SET value='incomplete' WHERE key='state'");
        (void)database.recover();
    }
    database.try_run("PRAGMA incremental_vacuum");
    database.run("PRAGMA wal_checkpoint(TRUNCATE)");
    database.run("PRAGMA journal_mode=DELETE");
    fold_error = database.error();
    database.close();
    is_closed = true;
}

// ---- interface ---------------------------------------------------------------------------------------------------

Recorder::Recorder(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}

Recorder::~Recorder() {
    if (impl_->is_closed) return;
    impl_->stop();
    impl_->close("incomplete");
}

SavedRecord Recorder::save_what_is_open(const char* event_id, const char* detail) noexcept {
    Impl* impl = Impl::open.exchange(nullptr);
    if (impl == nullptr) return {};
    impl->last_event = event_id;
    impl->last_detail = detail;
    impl->is_abandoned.store(true, std::memory_order_release);
    impl->is_stopping.store(true, std::memory_order_release);  // the writer checks it every 10 ms
    constexpr timespec pause{0, 10'000'000};
    for (int attempts = 0; attempts < 200; ++attempts) {
        if (impl->is_saved.load(std::memory_order_acquire)) return {impl->path.c_str(), true};
        nanosleep(&pause, nullptr);
    }
    return {impl->path.c_str(), false};
}

Recorder::Created Recorder::create(const std::string& path, const SessionHeader& header) {
    const std::string part = path + ".part";
    const std::vector<std::string> all{part, part + "-journal", path + "-wal", path + "-shm", path + "-journal", path};
    for (const std::string& file : all) {
        std::error_code error;
        std::filesystem::remove(file, error);
        if (error) return {nullptr, file + " could not be replaced: " + error.message()};
    }
    auto impl = std::make_unique<Impl>();
    impl->path = path;
    SqliteDatabase& database = impl->database;
    const auto failed = [&](const std::string& why) -> Created {
        database.close();
        for (const std::string& file : all) {
            std::error_code ignored;
            std::filesystem::remove(file, ignored);
        }
        return {nullptr, why};
    };
    const auto refusal = [&] { return path + " could not be made: " + for_people(database.error()); };

    if (database.open(part)) impl->create(header);
    if (!database.is_good()) return failed(refusal());
    database.close();
    if (std::string why = rename_into_position(part, path); !why.empty()) return failed(why);
    if (database.open(path)) impl->open_to_write();
    if (database.is_good()) impl->start();
    if (!database.is_good()) {
        impl->finalize();
        return failed(refusal());
    }
    return {std::unique_ptr<Recorder>(new Recorder(std::move(impl))), {}};
}

void Recorder::push(const TickRow& row) noexcept {
    if (!impl_->ticks.push(row)) impl_->lost_ticks.fetch_add(1, std::memory_order_relaxed);
}

void Recorder::push_cut(const CutRow& cut) noexcept {
    if (!impl_->cuts.push(cut)) impl_->lost_cuts.fetch_add(1, std::memory_order_relaxed);
}

void Recorder::push_event(const EventRow& event) noexcept {
    EventSlot slot;
    slot.tick = event.tick;
    slot.time = event.time;
    copy_text(slot.id, event.id);
    copy_text(slot.detail, event.detail);
    if (!impl_->events.push(slot)) impl_->lost_events.fetch_add(1, std::memory_order_relaxed);
}

bool Recorder::wait_for_capacity() {
    const auto is_filled = [](const auto& ring, std::size_t parts) { return ring.size() > ring.capacity() / parts; };
    const auto any_filled = [&](std::size_t parts) {
        return is_filled(impl_->ticks, parts) || is_filled(impl_->cuts, parts) || is_filled(impl_->events, parts);
    };
    if (any_filled(2))
        while (any_filled(4) && !impl_->has_writer_ended.load(std::memory_order_acquire))
            std::this_thread::sleep_for(milliseconds(1));
    return !impl_->is_failed.load(std::memory_order_acquire);
}

RecorderLosses Recorder::losses() const noexcept {
    return {impl_->lost_ticks.load(), impl_->lost_events.load(), impl_->lost_cuts.load()};
}

EventRow Recorder::as_kept(EventRow event) {
    EventSlot slot;
    copy_text(slot.id, event.id);
    copy_text(slot.detail, event.detail);
    event.id = slot.id;
    event.detail = slot.detail;
    return event;
}

std::string Recorder::finish(const RunSummary& summary, const DrawnSurface& bone_after) {
    if (impl_->is_closed) return "this session is finished already";
    impl_->stop();

    impl_->database.run("BEGIN");
    impl_->write_results(summary, bone_after);
    impl_->database.run("COMMIT");
    impl_->close(losses().any() ? "incomplete" : "finished");
    if (!impl_->error.empty()) return impl_->path + " is incomplete: " + for_people(impl_->error);
    if (!impl_->fold_error.empty())
        return impl_->path + " is complete together with session.db-wal, which could not be folded into it: " +
               for_people(impl_->fold_error) + " Keep both files together.";
    if (!impl_->plain_error.empty())
        return impl_->path + " is complete, and larger than it needs to be: some rows could not be compressed: " +
               for_people(impl_->plain_error);
    return {};
}

}  // namespace kerf
