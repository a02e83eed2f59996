// SPDX-License-Identifier: Apache-2.0
#include "session/first_difference.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "session/recorded_rows.h"
#include "session/session_file.h"
#include "session/session_tables.h"

namespace kerf::session {
namespace {

/// A hashed value of a tick, by the start of the names of its columns.
struct Hashed {
    std::string_view start;
    const char* what;
};
constexpr Hashed hashed[] = {{"device_from_handle_", "the pose of the handle"},
                             {"world_from_tool_", "the pose of the tool"},
                             {"modelled_", "the wrench of the bone"},
                             {"coupled_", "the wrench of the coupling"}};

/// The ticks and events of a session.
class Rows {
public:
    std::string open(const std::string& path) {
        std::vector<std::string> names;
        for (const Table& table : session_tables({})) names.push_back(table.name);
        if (std::string error = file_.open(path, names); !error.empty()) return error;
        path_ = path;
        const std::vector<Table> tables = recorded_tables(file_.handle());
        const Table& ticks = find_table(tables, ticks_table);
        columns_ = {"tick", "time", "step"};
        for (const Hashed& value : hashed)
            for (const TableColumn& column : ticks.columns)
                if (column.name.starts_with(value.start)) columns_.push_back(column.name);
        ticks_.emplace(file_.handle(), ticks, columns_);
        events_.emplace(file_.handle(), "SELECT tick, id FROM events ORDER BY rowid");
        return {};
    }
    [[nodiscard]] const std::vector<std::string>& columns() const noexcept { return columns_; }
    RecordedRows& ticks() { return *ticks_; }
    SessionQuery& events() { return *events_; }
    /// Returns why the rows ended early, for people; empty if they did not.
    [[nodiscard]] std::string fault() const {
        if (!file_.outside_reason().empty()) return file_.outside_reason();
        if (!ticks_->fault().empty()) return path_ + ": " + ticks_->fault() + ".";
        return events_->has_failed() ? path_ + ": its events cannot be read." : "";
    }

private:
    SessionFile file_;
    std::string path_;
    std::vector<std::string> columns_;
    std::optional<RecordedRows> ticks_;
    std::optional<SessionQuery> events_;
};

bool is_same(double a, double b) {
    return (std::isnan(a) && std::isnan(b)) || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Returns the value of `hashed` in which two rows differ, or null.
const char* difference(const Rows& rows, const RecordedRows& a, const RecordedRows& b) {
    if (a.integer(0) != b.integer(0) || a.integer(2) != b.integer(2)) return "the running step";
    for (std::size_t column = 3; column < rows.columns().size(); ++column)
        if (!is_same(a.number(column), b.number(column)))
            return std::find_if(std::begin(hashed), std::end(hashed),
                                [&](const Hashed& value) { return rows.columns()[column].starts_with(value.start); })
                ->what;
    return nullptr;
}

std::optional<FirstDifference> first_tick(Rows& recorded, Rows& replayed) {
    RecordedRows &a = recorded.ticks(), &b = replayed.ticks();
    FirstDifference last;
    while (true) {
        const bool has_a = a.next(), has_b = b.next();
        if (!has_a && !has_b) return std::nullopt;
        if (has_a) last = {static_cast<std::uint64_t>(a.integer(0)), a.number(1), static_cast<int>(a.integer(2)), ""};
        if (has_a != has_b) {
            last.what = has_a ? "the end of the run, which is earlier" : "the end of the run, which is later";
            return last;
        }
        if (const char* what = difference(recorded, a, b); what != nullptr) {
            last.what = what;
            return last;
        }
    }
}

/// Returns the first event that only one session has, with its tick.
std::optional<FirstDifference> first_event(Rows& recorded, Rows& replayed) {
    SessionQuery &a = recorded.events(), &b = replayed.events();
    while (true) {
        const bool has_a = a.next(), has_b = b.next();
        if (!has_a && !has_b) return std::nullopt;
        if (has_a && has_b && a.integer(0) == b.integer(0) && a.text(1) == b.text(1)) continue;
        const bool is_a = has_a && (!has_b || a.integer(0) <= b.integer(0));
        const SessionQuery& earlier = is_a ? a : b;
        const auto tick = static_cast<std::uint64_t>(std::max<std::int64_t>(0, earlier.integer(0)));
        return FirstDifference{tick, 1e-3 * static_cast<double>(tick), -1, "the event `" + earlier.text(1) + "`"};
    }
}

/// Returns the step of a tick; −1 if it has none.
int step_of(const std::string& path, std::uint64_t tick) {
    Rows rows;
    if (!rows.open(path).empty()) return -1;
    while (rows.ticks().next())
        if (static_cast<std::uint64_t>(rows.ticks().integer(0)) >= tick)
            return static_cast<int>(rows.ticks().integer(2));
    return -1;
}

}  // namespace

std::optional<FirstDifference> first_difference(const std::string& recorded, const std::string& replayed,
                                                std::string& error) {
    Rows a, b;
    for (const auto& [rows, path] : {std::pair{&a, &recorded}, std::pair{&b, &replayed}})
        if (error = rows->open(*path); !error.empty()) return std::nullopt;
    auto tick = first_tick(a, b), event = first_event(a, b);
    for (const Rows* rows : {&a, &b})
        if (error = rows->fault(); !error.empty()) return std::nullopt;
    if (event && (!tick || event->tick < tick->tick)) {
        event->step = step_of(recorded, event->tick);
        return event;
    }
    return tick;
}

}  // namespace kerf::session
