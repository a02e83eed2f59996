// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "documents/procedure.h"
#include "session/recorded_rows.h"
#include "session/report/read_run.h"
#include "session/session_file.h"
#include "session/session_tables.h"
#include "tests/support/recorded_folder.h"
#include "tests/support/watched_run.h"

/// Operations that a ctest fixture has run once for all tests that judge them (kerf_add_operation, kerf_judge).
namespace kerf::test {

/// Returns the ticks of the session in a folder, all of their columns. Throws if they cannot be read.
inline std::vector<session::TickRow> recorded_ticks(const std::string& folder) {
    session::SessionFile file;
    if (const std::string error = file.open(folder + "/session.db", {}); !error.empty())
        throw std::runtime_error(error);
    const std::vector<session::Table> tables = session::recorded_tables(file.handle());
    const session::Table& table = session::find_table(tables, session::ticks_table);
    const auto signal_count = static_cast<std::size_t>(std::ranges::count_if(
        table.columns, [](const session::TableColumn& column) { return column.name.starts_with("signal_"); }));
    std::vector<std::string> all;
    for (const session::TableColumn& column : table.columns) all.push_back(column.name);
    session::RecordedRows rows(file.handle(), table, all);
    std::vector<session::TickRow> ticks;
    while (rows.next()) {
        std::size_t column = 0;
        const auto integer = [&] { return static_cast<std::int32_t>(rows.integer(column++)); };
        const auto number = [&] { return rows.number(column++); };
        const auto pose = [&] {
            std::array<double, 7> part{};
            for (double& one : part) one = number();
            return Pose{{part[0], part[1], part[2]}, {part[3], part[4], part[5], part[6]}};
        };
        session::TickRow& row = ticks.emplace_back();
        row.tick = static_cast<std::uint64_t>(rows.integer(column++));
        row.time = number();
        row.step = integer();
        row.device_from_handle = pose();
        row.world_from_tool = pose();
        for (Vec6* wrench : {&row.modelled, &row.coupled, &row.limited, &row.commanded})
            for (double& component : *wrench) component = number();
        for (double* value : {&row.thrust, &row.torque, &row.depth, &row.feed_rate}) *value = number();
        row.tissue = integer();
        row.iterations = integer();
        for (double* value : {&row.power_hand, &row.power_drive, &row.removed}) *value = number();
        for (std::size_t i = 0; i < signal_count; ++i) row.signals[i] = number();
    }
    if (!rows.fault().empty()) throw std::runtime_error(rows.fault());
    return ticks;
}

/// Returns whether a run ended as its rehearsal expects, judged from the recorded steps.
inline bool ended_as_expected(const documents::Rehearsal& rehearsal, const session::RunSummary& summary) {
    if (rehearsal.expect != to_text(summary.verdict)) return false;
    if (summary.verdict != session::Verdict::fail) return true;
    bool is_named = false, is_alone = true;
    for (const session::StepRow& step : summary.steps) {
        is_alone = is_alone && step.done;
        for (const std::string& limit : step.broken_limits) {
            const bool is_the_one =
                limit == rehearsal.expect_limit && (rehearsal.expect_step.empty() || rehearsal.expect_step == step.id);
            is_named = is_named || is_the_one;
            is_alone = is_alone && is_the_one;
        }
    }
    return is_named && (is_alone || rehearsal.expects_others);
}

/// Returns the pieces that a session's summary lists; no table has them.
inline std::vector<session::PieceRow> recorded_pieces(session::SessionFile& file) {
    session::SessionQuery query(file.handle(), "SELECT value FROM session WHERE key = 'summary'");
    std::vector<session::PieceRow> pieces;
    if (!query.next()) return pieces;
    const auto summary = nlohmann::json::parse(query.text(0));
    for (const auto& piece : summary.at("pieces"))
        pieces.push_back({piece.at("body"), 1e-9 * piece.at("volume_mm3").get<double>(), piece.at("file"),
                          piece.at("material") == "metal"});
    return pieces;
}

/// Returns the run whose session is in a folder, without its ticks. Throws what is wrong with it.
inline WatchedRun recorded_run(const std::string& folder, const documents::Rehearsal& rehearsal) {
    const std::string path = folder + "/session.db";
    std::string error;
    auto recorded = session::read_run(path, error);
    if (!recorded) throw std::runtime_error(error);
    WatchedRun run;
    run.summary = std::move(recorded->summary);
    run.is_as_expected = ended_as_expected(rehearsal, run.summary);

    session::SessionFile file;
    if (error = file.open(path, {}); !error.empty()) throw std::runtime_error(error);
    run.summary.pieces = recorded_pieces(file);
    session::SessionQuery events(file.handle(), "SELECT tick, time, id, detail FROM events ORDER BY rowid");
    while (events.next())
        run.events.push_back(
            {static_cast<std::uint64_t>(events.integer(0)), events.number(1), events.text(2), events.text(3)});
    return run;
}

}  // namespace kerf::test
