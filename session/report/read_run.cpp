// SPDX-License-Identifier: Apache-2.0
#include "session/report/read_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "session/read_deductions.h"
#include "session/record_checksum.h"
#include "session/recorded_rows.h"
#include "session/recorder.h"
#include "session/session_file.h"
#include "session/session_tables.h"
#include "text/plain_numbers.h"

namespace kerf::session {

namespace {

/// Returns whether a page needs a column of `ticks`. The other columns stay compressed.
bool is_drawn(std::string_view column) {
    constexpr std::array names{"tick", "time", "step", "thrust", "torque", "depth", "tissue", "removed"};
    constexpr std::array starts{"device_from_handle_", "world_from_tool_", "modelled_f", "commanded_m", "signal_"};
    return std::ranges::find(names, column) != names.end() ||
           std::ranges::any_of(starts, [&](std::string_view start) { return column.starts_with(start); });
}

/// Returns whether only an observer of the rows needs a column of `ticks`.
bool is_only_observed(std::string_view column) { return column.starts_with("commanded_f") || column == "feed_rate"; }

/// Reads one session's tables. The first table that no run writes causes the error.
class Reading {
public:
    Reading(const std::string& path, SessionFile& file, RowObserver* observer)
        : path_(path), file_(file), bytes_left_(file.bytes()), observer_(observer) {}

    std::optional<RecordedRun> run(std::string& error) {
        read_keys();
        read_lists();
        read_result();
        read_ticks();
        read_surface();
        complete();
        if (error_.empty()) check_rows();
        error = file_.outside_reason().empty() ? error_ : file_.outside_reason();
        return error.empty() ? std::optional(std::move(run_)) : std::nullopt;
    }

private:
    void fail(const std::string& what) {
        if (error_.empty())
            error_ = path_ + ": " + what + ", so the file is damaged. Name a session.db that a run has written.";
    }

    /// Returns a text. Rows that refer to the same bytes could contain more text than the file has bytes. A run never
    /// writes such rows.
    std::string text(const SessionQuery& query, int column) {
        std::string value = query.text(column);
        if (value.size() > bytes_left_) {
            fail("holds more text than it has bytes");
            return {};
        }
        bytes_left_ -= value.size();
        return value;
    }
    /// Returns a number; NaN for NULL, which is how SQLite stores it.
    double number(const SessionQuery& query, int column, const char* table) {
        if (query.is_number(column)) return query.number(column);
        if (!query.is_null(column)) fail(std::string("its table `") + table + "` has something else than a number");
        return std::numeric_limits<double>::quiet_NaN();
    }
    static int small(std::int64_t integer) {
        constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
        return static_cast<int>(std::clamp(integer, -most, most));
    }

    /// Reads the rows in the order in which the run wrote them: sorting would need memory or a temporary file.
    template <class Take>
    void each(const char* table, const std::string& columns, Take take) {
        SessionQuery query(file_.handle(), "SELECT " + columns + " FROM " + table + " ORDER BY rowid");
        while (error_.empty() && query.next()) take(query);
        if (query.has_failed()) fail(std::string("its table `") + table + "` cannot be read");
    }

    void read_keys();
    void read_lists();
    void read_result();
    void read_ticks();
    void read_surface();
    void read_zones();
    void complete();
    void check_rows();

    [[nodiscard]] std::string key(const std::string& name) const {
        const auto found = keys_.find(name);
        return found != keys_.end() ? found->second : std::string();
    }
    [[nodiscard]] double number_of(const std::string& name) const {
        const text::PlainNumbers point;
        const std::string value = key(name);
        return value.empty() ? std::numeric_limits<double>::quiet_NaN() : std::strtod(value.c_str(), nullptr);
    }
    [[nodiscard]] std::uint64_t count_of(const std::string& name) const {
        return std::strtoull(key(name).c_str(), nullptr, 10);
    }

    const std::string& path_;
    SessionFile& file_;
    std::uint64_t bytes_left_;
    RowObserver* observer_;  ///< may be null
    std::map<std::string, std::string> keys_;
    EventRow last_event_;
    RecordedRun run_;
    std::string error_;
};

void Reading::read_keys() {
    constexpr std::string_view version = "version.";
    each("session", "key, value", [&](const SessionQuery& row) {
        std::string name = text(row, 0), value = text(row, 1);
        if (name.compare(0, version.size(), version) == 0)
            run_.summary.versions.emplace_back(name.substr(version.size()), value);
        keys_[std::move(name)] = std::move(value);
    });
    RunSummary& summary = run_.summary;
    summary.procedure = key("run.procedure");
    summary.procedure_version = key("run.procedure_version");
    summary.anatomy = key("run.anatomy");
    summary.rehearsal = key("run.rehearsal");
    summary.hand = key("run.hand");
    if (keys_.contains("run.leader")) summary.leader = key("run.leader");
    if (keys_.contains("run.parent")) {
        summary.parent = key("run.parent");
        summary.parent_ticks = std::strtoull(key("run.parent_ticks").c_str(), nullptr, 10);
    }
    if (keys_.contains("run.leader_setup")) summary.leader_setup = key("run.leader_setup");
    summary.device = key("condition.device");
    summary.variant = key("condition.variant");
    run_.procedure = recorded_procedure(key("procedure_text"), summary.rehearsal);
    run_.procedure.variant_title = key("run.variant_title");
    summary.force_scale = number_of("condition.force_scale");
    summary.coupling_stiffness = number_of("condition.coupling_stiffness");
}

void Reading::read_lists() {
    each("tissues", "id", [&](const SessionQuery& row) { run_.summary.tissues.push_back(text(row, 0)); });
    each("signals", "id, help, display_unit, per_unit", [&](const SessionQuery& row) {
        run_.summary.signals.push_back({text(row, 0), text(row, 1), text(row, 2), number(row, 3, "signals")});
    });
    if (run_.summary.signals.size() > max_signal_columns)
        fail("has more than " + std::to_string(max_signal_columns) + " signals");
    if (observer_ != nullptr && error_.empty()) observer_->on_begin(run_);
    each("events", "tick, time, id, detail", [&](const SessionQuery& row) {
        last_event_ = {static_cast<std::uint64_t>(row.integer(0)), number(row, 1, "events"), text(row, 2),
                       text(row, 3)};
        run_.drawn.add(last_event_);
        if (observer_ != nullptr) observer_->on_event(last_event_);
    });
}

/// Reads the results that the run wrote at its end.
void Reading::read_result() {
    RunSummary& summary = run_.summary;
    summary.score = number_of("result.score");
    if (const std::string rules = key("result.score_rules"); !rules.empty())
        summary.score_rules = static_cast<int>(std::strtol(rules.c_str(), nullptr, 10));
    summary.score_band = key("result.score_band");
    summary.deductions = read_deductions(key("summary"));
    summary.duration = number_of("result.duration");
    summary.ticks = count_of("result.ticks");
    summary.removed = number_of("result.removed");
    summary.hash = std::strtoull(key("hash").c_str(), nullptr, 16);
    for (const Verdict verdict : {Verdict::pass, Verdict::fail, Verdict::incomplete, Verdict::invalid})
        if (key("result.verdict") == to_text(verdict)) summary.verdict = verdict;
    each("reasons", "reason", [&](const SessionQuery& row) { summary.reasons.push_back(text(row, 0)); });
    each("removed", "tissue, volume", [&](const SessionQuery& row) {
        summary.removed_by_tissue.emplace_back(text(row, 0), number(row, 1, "removed"));
    });
    each("steps", "id, title, done, start, steps.\"end\", broken_limits", [&](const SessionQuery& row) {
        StepRow step{
            text(row, 0), text(row, 1), row.integer(2) != 0, number(row, 3, "steps"), number(row, 4, "steps"), {}};
        const std::string limits = text(row, 5);
        for (std::size_t from = 0; from < limits.size();) {
            const std::size_t end = std::min(limits.find('\n', from), limits.size());
            step.broken_limits.push_back(limits.substr(from, end - from));
            from = end + 1;
        }
        summary.steps.push_back(std::move(step));
    });
    each("metrics",
         "id, revision, scope, occurrence, occurrences, value, display_unit, per_unit, uncertainty, status, help",
         [&](const SessionQuery& row) {
             MetricRow metric;
             metric.id = text(row, 0);
             metric.revision = small(row.integer(1));
             metric.scope = text(row, 2);
             metric.occurrence = small(row.integer(3));
             metric.occurrences = small(row.integer(4));
             metric.value = number(row, 5, "metrics");
             metric.unit = text(row, 6);
             metric.per_unit = number(row, 7, "metrics");
             metric.uncertainty = row.is_null(8) ? -1.0 : number(row, 8, "metrics");
             metric.status = text(row, 9);
             metric.help = text(row, 10);
             summary.metrics.push_back(std::move(metric));
         });
}

void Reading::read_ticks() {
    const auto count = recorded_row_count(file_.handle(), ticks_table);
    if (!count) return fail(std::string("its table `") + ticks_table + "` cannot be read");
    run_.drawn.expect(*count);
    const std::vector<Table> tables = recorded_tables(file_.handle());
    const Table& ticks = find_table(tables, ticks_table);
    const bool is_observed = observer_ != nullptr;
    std::vector<std::string> wanted;
    for (const TableColumn& column : ticks.columns)
        if (is_drawn(column.name) || (is_observed && is_only_observed(column.name))) wanted.push_back(column.name);
    RecordedRows rows(file_.handle(), ticks, wanted);
    while (error_.empty() && rows.next()) {
        std::size_t column = 0;
        const auto integer = [&] { return rows.integer(column++); };
        const auto next = [&] {
            const std::size_t at = column++;
            if (rows.is_number(at)) return rows.number(at);
            if (!rows.is_null(at)) fail("its table `ticks` has something else than a number");
            return std::numeric_limits<double>::quiet_NaN();
        };
        const auto vector = [&] {
            const double x = next(), y = next(), z = next();
            return Vec3{x, y, z};
        };
        const auto pose = [&] {
            const Vec3 position = vector();
            const double w = next(), x = next(), y = next(), z = next();
            return Pose{position, {w, x, y, z}};
        };
        TickRow row;
        const std::int64_t tick = integer();
        row.tick = static_cast<std::uint64_t>(tick);
        row.time = next();
        row.step = small(integer());
        row.device_from_handle = pose();
        row.world_from_tool = pose();
        for (std::size_t i = 0; i < 3; ++i) row.modelled[i] = next();
        for (std::size_t i = is_observed ? 0 : 3; i < 6; ++i) row.commanded[i] = next();
        row.thrust = next();
        row.torque = next();
        row.depth = next();
        if (is_observed) row.feed_rate = next();
        row.tissue = small(integer());
        row.removed = next();
        for (std::size_t i = 0; i < run_.summary.signals.size(); ++i) row.signals[i] = next();
        if (tick < 0 || (run_.drawn.last() && row.tick <= run_.drawn.last()->tick))
            fail("tick " + std::to_string(tick) + " is there twice or before the first");
        run_.drawn.add(row);
        if (is_observed && error_.empty()) observer_->on_tick(row);
    }
    if (!rows.fault().empty()) fail(rows.fault());
}

void Reading::read_surface() {
    bool is_there = false;
    SessionQuery version(file_.handle(), "PRAGMA user_version");
    const bool has_zones = version.next() && version.integer(0) >= first_schema_with_zones;
    run_.is_bone_placed = has_zones;
    const std::string centre = has_zones ? ", centre_x, centre_y, centre_z" : "";
    each("surface", "step, half_x, half_y, half_z, positions, normals, tissues, triangles" + centre,
         [&](const SessionQuery& row) {
             if (is_there) return fail("has two surfaces");
             is_there = true;
             DrawnSurface surface;
             surface.step = number(row, 0, "surface");
             surface.half_size = {number(row, 1, "surface"), number(row, 2, "surface"), number(row, 3, "surface")};
             surface.positions = row.bytes(4);
             surface.normals = row.bytes(5);
             surface.tissues = row.bytes(6);
             surface.triangles = row.bytes(7);
             if (has_zones)
                 surface.centre = {number(row, 8, "surface"), number(row, 9, "surface"), number(row, 10, "surface")};
             if (!is_sound(surface)) return fail("its surface has triangles without vertices");
             run_.drawn.set_bone(std::move(surface));
         });
    if (has_zones) read_zones();
}

/// Reads what only sessions with zones have.
void Reading::read_zones() {
    each(zones_table, "id, step, half_x, half_y, half_z, positions, normals, triangles, centre_x, centre_y, centre_z",
         [&](const SessionQuery& row) {
             const auto real = [&](int column) { return number(row, column, zones_table); };
             ZoneRow zone{text(row, 0)};
             zone.surface.step = real(1);
             zone.surface.half_size = {real(2), real(3), real(4)};
             zone.surface.positions = row.bytes(5);
             zone.surface.normals = row.bytes(6);
             zone.surface.tissues.resize(zone.surface.positions.size() / 8, 0);
             zone.surface.triangles = row.bytes(7);
             zone.surface.centre = {real(8), real(9), real(10)};
             if (!is_sound(zone.surface)) return fail("its zone has triangles without vertices");
             run_.summary.zones.push_back(std::move(zone));
         });
    each(approaches_table, "step, zone, clearance, time, at_x, at_y, at_z", [&](const SessionQuery& row) {
        const auto real = [&](int column) { return number(row, column, approaches_table); };
        ApproachRow approach{text(row, 0), text(row, 1), real(2), real(3), {real(4), real(5), real(6)}};
        if (!is_finite(approach.at)) return fail("it has an approach without a point");
        run_.summary.approaches.push_back(std::move(approach));
    });
}

/// Completes the summary of a run that was cut short, and reports lost rows.
void Reading::complete() {
    RunSummary& summary = run_.summary;
    const std::uint64_t lost = count_of("lost_ticks") + count_of("lost_events") + count_of("lost_cuts");
    run_.has_result = keys_.contains("result.verdict");
    if (run_.has_result) {
        if (key("state") != "finished")
            run_.missing = "The record is incomplete: " + std::to_string(lost) + " rows of it were lost.";
        if (!run_.missing.empty()) summary.reasons.push_back(run_.missing);
        return;
    }
    run_.missing =
        "The run was cut short: its record ends without a result, so nothing was judged and the bone is not drawn.";
    if (last_event_.id == plugin_failed_event)
        run_.missing =
            "A plugin ended the run. " + last_event_.detail + ". Nothing was judged and the bone is not drawn.";
    if (last_event_.id == crashed_event)
        run_.missing = "The run crashed. " + last_event_.detail + ". Nothing was judged and the bone is not drawn.";
    // A run that ended while it wrote its result left a part of it.
    summary.steps.clear();
    summary.metrics.clear();
    summary.removed_by_tissue.clear();
    summary.approaches.clear();
    run_.drawn.set_bone({});
    summary.verdict = Verdict::incomplete;
    summary.reasons = {run_.missing};
    const auto& last = run_.drawn.last();
    summary.ticks = run_.drawn.ticks();
    summary.duration = last ? last->time : 0.0;
    summary.removed = last ? last->removed : 0.0;
}

void Reading::check_rows() {
    if (check_record(file_.handle()) == RecordCheck::changed)
        error_ = path_ +
                 ": its rows are not those that the run wrote: they do not give its checksum. The file is damaged, or "
                 "was edited. Take an undamaged copy; or replay it with `kerf run --replay` to see what its inputs "
                 "come to.";
}

}  // namespace

std::optional<RecordedRun> read_run(const std::string& path, std::string& error, bool is_own, RowObserver* observer) {
    std::vector<std::string> tables;
    for (const Table& table : session_tables({})) tables.push_back(table.name);
    SessionFile file;
    if (error = file.open(path, tables, is_own); !error.empty()) return std::nullopt;
    return Reading(path, file, observer).run(error);
}

}  // namespace kerf::session
