// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/plugin/si_unit.h"
#include "session/content_hash.h"
#include "session/record_checksum.h"
#include "session/recorder_impl.h"
#include "text/plain_numbers.h"

namespace kerf::session {
namespace {

std::string text_of(double value) {
    const text::PlainNumbers point;
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

}  // namespace

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
    if (!header.leader.empty()) set("session", "run.leader", header.leader);
    if (!header.parent.empty()) {
        set("session", "run.parent", header.parent);
        set("session", "run.parent_ticks", std::to_string(header.parent_ticks));
    }
    if (!header.leader_setup.empty()) set("session", "run.leader_setup", header.leader_setup);
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
    if (header.conditions.is_examination) set("session", "condition.examination", "1");
    set("session", "condition.coupling_stiffness", text_of(header.conditions.coupling_stiffness));

    for (const auto& [name, value] : header.device_values) set("session", "device." + name, text_of(value));

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
    // Opens the -wal file while the folder surely has this name.
    database.run("BEGIN IMMEDIATE");
    database.run("COMMIT");

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
        insert_surface << bone_after.centre.x << bone_after.centre.y << bone_after.centre.z;
        insert_surface.run();
    }
    write_zones(summary);
}

void Recorder::Impl::write_verdict(const RunSummary& summary) {
    set("session", "result.verdict", to_text(summary.verdict));
    set("session", "result.score", text_of(summary.score));
    set("session", "result.score_rules", std::to_string(summary.score_rules));
    set("session", "result.score_band", summary.score_band);
    set("session", "result.duration", text_of(summary.duration));
    set("session", "result.ticks", std::to_string(summary.ticks));
    set("session", "result.removed", text_of(summary.removed));
    set("session", "summary", summary_json(summary));
    set("session", "hash", hex16(summary.hash));
}

void Recorder::Impl::write_zones(const RunSummary& summary) {
    SqliteStatement insert_zone(database, insert_sql(find_table(tables, zones_table)));
    for (std::size_t i = 0; i < summary.zones.size(); ++i) {
        const DrawnSurface& surface = summary.zones[i].surface;
        if (surface.is_empty()) continue;
        insert_zone << integer(i) << summary.zones[i].id << surface.step << surface.half_size.x << surface.half_size.y
                    << surface.half_size.z;
        for (const auto* bytes : {&surface.positions, &surface.normals, &surface.triangles})
            insert_zone << std::span<const unsigned char>(*bytes);
        insert_zone << surface.centre.x << surface.centre.y << surface.centre.z;
        insert_zone.run();
    }
    SqliteStatement insert_approach(database, insert_sql(find_table(tables, approaches_table)));
    for (const ApproachRow& row : summary.approaches) {
        insert_approach << row.step << row.zone << row.clearance << row.time << row.at.x << row.at.y << row.at.z;
        insert_approach.run();
    }
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

/// Writes the verdict, the final state and the checksum of the whole session in one transaction: no file has a verdict
/// without a checksum.
bool Recorder::Impl::write_state(const char* state, const RunSummary* summary) {
    database.run("BEGIN");
    if (summary != nullptr) write_verdict(*summary);
    SqliteStatement(database, std::string("UPDATE session SET value='") + state + "' WHERE key='state'").run();
    set("session", "lost_ticks", std::to_string(lost_ticks.load()));
    set("session", "lost_events", std::to_string(lost_events.load()));
    set("session", "lost_cuts", std::to_string(lost_cuts.load()));
    if (!database.is_good()) return false;
    std::string reason;
    const auto checksum = record_checksum({database.handle(), &reason});
    if (!checksum) database.fail(reason.empty() ? "its rows cannot be read back" : reason);
    if (checksum) set("session", record_checksum_key, hex16(*checksum));
    return database.run("COMMIT");
}

/// Writes the verdict, if there is one, and the final state, merges the -wal file and closes.
void Recorder::Impl::close(const char* state, const RunSummary* summary) {
    own_files.release();
    // A program that cannot continue skips all work that is not needed.
    if (!is_abandoned.load(std::memory_order_acquire)) compress_rest();
    finalize();
    // A transaction that did not fit may leave space for these few bytes.
    if (!database.is_good()) {
        error = database.recover();
        state = "incomplete";
        summary = nullptr;  // its rows may be missing
    }
    if (!write_state(state, summary)) {
        const std::string why = database.recover();
        if (error.empty()) error = why;
        database.run("UPDATE session SET value='incomplete' WHERE key='state'");
        (void)database.recover();
    }
    was_removed = is_removed();
    if (was_removed) database.keep_files_on_close();  // files of these names belong to another program
    database.try_run("PRAGMA incremental_vacuum");
    if (!was_removed) fold();
    database.close();
    is_closed = true;
}

void Recorder::Impl::fold() {
    database.run("PRAGMA wal_checkpoint(TRUNCATE)");
    database.run("PRAGMA journal_mode=DELETE");
    fold_error = database.error();
}

}  // namespace kerf::session
