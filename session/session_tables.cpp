// SPDX-License-Identifier: Apache-2.0
#include "session/session_tables.h"

#include <algorithm>
#include <cstddef>

#include "core/plugin/si_unit.h"

namespace kerf::session {
namespace {

using Columns = std::vector<TableColumn>;

void append(Columns& columns, const Columns& more) { columns.insert(columns.end(), more.begin(), more.end()); }

/// Sets the formats of the columns in `blocks`: the inputs of a replay stay exact.
Table with_formats(Table table, const std::vector<std::string>& exact) {
    for (TableColumn& column : table.columns) {
        const bool is_exact = std::any_of(exact.begin(), exact.end(),
                                          [&](const std::string& start) { return column.name.starts_with(start); });
        column.format = column.type == "INTEGER" ? NumberFormat::int64
                        : is_exact               ? NumberFormat::float64
                                                 : NumberFormat::float32;
    }
    return table;
}

Columns pose_columns(const std::string& name, const std::string& frame, const std::string& help) {
    Columns columns;
    for (const char* axis : {"x", "y", "z"})
        columns.push_back({name + "_" + axis, "REAL", "m", "length", frame, help + ", position " + axis});
    for (const char* part : {"qw", "qx", "qy", "qz"})
        columns.push_back({name + "_" + part, "REAL", "", "rotation", frame, help + ", unit quaternion " + part});
    return columns;
}

Columns wrench_columns(const std::string& name, const std::string& help) {
    Columns columns;
    for (const char* axis : {"x", "y", "z"})
        columns.push_back({name + "_f" + axis, "REAL", "N", "force", "world", help + ", force " + axis});
    for (const char* axis : {"x", "y", "z"})
        columns.push_back(
            {name + "_m" + axis, "REAL", "N*m", "torque", "world", help + ", moment " + axis + " about the tip"});
    return columns;
}

/// Predicts the force on the hand from the coupling: they are equal unless a device limit applies.
void add_guesses(Table& ticks, double force_scale) {
    const auto is_like = [&](const std::string& name, const std::string& other, double factor) {
        for (TableColumn& column : ticks.columns)
            if (column.name == name) column.like = other, column.factor = factor;
    };
    for (const char* part : {"_fx", "_fy", "_fz", "_mx", "_my", "_mz"}) {
        is_like(std::string("limited") + part, std::string("coupled") + part, 1.0);
        is_like(std::string("commanded") + part, std::string("coupled") + part, force_scale);
    }
    is_like("signal_drive_power", "power_drive", 1.0);
}

Table tick_table(const std::vector<SignalColumn>& signals, double force_scale) {
    Columns columns{{"tick", "INTEGER", "", "", "", "number of the tick, counted from the start of the run"},
                    {"time", "REAL", "s", "time", "", "simulated time since the start of the run"},
                    {"step", "INTEGER", "", "", "", "position of the running step in table steps, -1 for none"}};
    append(columns, pose_columns("device_from_handle", "world", "what the device reported"));
    append(columns, pose_columns("world_from_tool", "world", "the tool as simulated; its origin is the tip"));
    append(columns, wrench_columns("modelled", "bone on tool"));
    append(columns, wrench_columns("coupled", "coupling on hand, bone newtons"));
    append(columns, wrench_columns("limited", "coupling on hand after the limits of the device, bone newtons"));
    append(columns, wrench_columns("commanded", "sent to the device, device newtons"));
    append(
        columns,
        {{"thrust", "REAL", "N", "force", "tool", "bone on tool against the feed, positive while the bone pushes back"},
         {"torque", "REAL", "N*m", "torque", "tool", "bone on tool about the shaft"},
         {"depth", "REAL", "m", "length", "step axis",
          "tip past the entry along the axis of the step, negative before it"},
         {"feed_rate", "REAL", "m/s", "velocity", "tool", "speed of the tool along its shaft"},
         {"tissue", "INTEGER", "", "", "", "position in table tissues of what is under the tip, -1 for none"},
         {"iterations", "INTEGER", "", "", "", "iterations of the force balance"},
         {"power_hand", "REAL", "W", "power", "", "from the hand into the tool, bone side"},
         {"power_drive", "REAL", "W", "power", "", "from the motor into the tool"},
         {"removed", "REAL", "m^3", "volume", "", "bone removed so far"}});
    const std::vector<std::string> names = signal_column_names(signals);
    for (std::size_t i = 0; i < names.size(); ++i)
        columns.push_back({names[i], "REAL", si_unit_of(signals[i].unit), "see table signals", "", signals[i].help});
    Table table = with_formats({ticks_table, columns}, {"time", "device_from_handle"});
    add_guesses(table, force_scale);
    return table;
}

Table cut_table() {
    Columns columns{{"sequence", "INTEGER", "", "", "", "number of the cut"},
                    {"tick", "INTEGER", "", "", "", "tick in which it was made"},
                    {"body", "INTEGER", "", "", "", "body that was cut"},
                    {"solid", "INTEGER", "", "", "", "solid of the tool that cut"}};
    append(columns, pose_columns("from", "body", "tool at the beginning of the sweep"));
    append(columns, pose_columns("to", "body", "tool at the end of the sweep"));
    return with_formats({cuts_table, columns}, {});
}

std::string quoted(const std::string& name) { return '"' + name + '"'; }

}  // namespace

std::vector<std::string> signal_column_names(const std::vector<SignalColumn>& signals) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < signals.size() && i < max_signal_columns; ++i) {
        std::string name = "signal_";
        for (const char c : signals[i].id) {
            const bool is_bare = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
            name += is_bare ? c : '_';
        }
        if (std::find(names.begin(), names.end(), name) != names.end()) name.append("_").append(std::to_string(i));
        names.push_back(name);
    }
    return names;
}

// NOLINTNEXTLINE(readability-function-size): a table, one row for each column
std::vector<Table> session_tables(const std::vector<SignalColumn>& signals, double force_scale) {
    const Columns key_value{{"key", "TEXT", "", "", "", "what is stated"},
                            {"value", "TEXT", "", "", "",
                             "its value; condition.coupling_stiffness in N/m, result.duration in s, result.removed in "
                             "m^3"}};
    return {
        {"notice", {{"text", "TEXT", "", "", "", "what this file must not be used for"}}},
        {"columns",
         {{"table_name", "TEXT", "", "", "", "table described"},
          {"name", "TEXT", "", "", "", "column described"},
          {"unit", "TEXT", "", "", "",
           "SI unit of the numbers; empty for none; 'see column unit' where each row of the table names its own"},
          {"dimension", "TEXT", "", "", "", "physical quantity; empty for none"},
          {"frame", "TEXT", "", "", "", "frame it is expressed in; world is patient LPS"},
          {"format", "TEXT", "", "", "", "how blocks keeps it: int64, float64 or float32; empty for never"},
          {"like_column", "TEXT", "", "", "", "column of the table that guesses this one in blocks; empty for none"},
          {"factor", "REAL", "", "", "", "by which that column is multiplied"},
          {"help", "TEXT", "", "", "", "meaning"}}},
        {"session", key_value},
        {"envelope", key_value},
        {"tissues",
         {{"position", "INTEGER", "", "", "", "as in ticks.tissue"}, {"id", "TEXT", "", "", "", "name of the tissue"}}},
        {"signals",
         {{"position", "INTEGER", "", "", "", "order in which the force model declares it"},
          {"id", "TEXT", "", "", "", "name of the signal"},
          {"column_name", "TEXT", "", "", "", "column of ticks that holds it"},
          {"unit", "TEXT", "", "", "", "SI unit of the column; empty for none"},
          {"display_unit", "TEXT", "", "", "", "unit to show it in"},
          {"per_unit", "REAL", unit_of_row, "", "", "one display unit: divide by it to show"},
          {"help", "TEXT", "", "", "", "meaning"}}},
        tick_table(signals, force_scale),
        {"events",
         {{"tick", "INTEGER", "", "", "", "tick in which it happened"},
          {"time", "REAL", "s", "time", "", "simulated time since the start of the run"},
          {"id", "TEXT", "", "", "", "what happened"},
          {"detail", "TEXT", "", "", "", "more about it, for people"}}},
        cut_table(),
        {"blocks",
         {{"table_name", "TEXT", "", "", "", "ticks or cuts"},
          {"block", "INTEGER", "", "", "", "number of the block, from 0; its rows come before those that are plain"},
          {"rows", "INTEGER", "", "", "", "how many rows it has, at most 4096"},
          {"column_name", "TEXT", "", "", "", "column whose numbers these are"},
          {"differences", "INTEGER", "", "", "", "how often the difference to the row before was taken"},
          {"data", "BLOB", "", "", "",
           "zlib of byte 0 of all rows, byte 1 of all rows ...; each row is 2 d, or -2 d - 1 where d is negative; d "
           "are "
           "the bits in the column's format, little-endian, minus those of the guess, as differences"}}},
        {"steps",
         {{"position", "INTEGER", "", "", "", "order in the procedure, as in ticks.step"},
          {"id", "TEXT", "", "", "", "name of the step"},
          {"title", "TEXT", "", "", "", "title for people"},
          {"done", "INTEGER", "", "", "", "1 when its goals were reached"},
          {"start", "REAL", "s", "time", "", "when it began"},
          {"end", "REAL", "s", "time", "", "when it ended"},
          {"broken_limits", "TEXT", "", "", "", "limits broken in it, one a line"}}},
        {"metrics",
         {{"id", "TEXT", "", "", "", "name of the metric"},
          {"revision", "INTEGER", "", "", "", "revision of its definition"},
          {"scope", "TEXT", "", "", "", "step it is about, or run"},
          {"occurrence", "INTEGER", "", "", "", "which of several, from 1"},
          {"occurrences", "INTEGER", "", "", "", "how many there are"},
          {"value", "REAL", unit_of_row, "", "", "the number"},
          {"unit", "TEXT", "", "", "", "SI unit of the numbers of this row; empty for none"},
          {"display_unit", "TEXT", "", "", "", "unit to show it in"},
          {"per_unit", "REAL", unit_of_row, "", "", "one display unit: divide by it to show"},
          {"uncertainty", "REAL", unit_of_row, "", "", "half width; empty when not stated"},
          {"status", "TEXT", "", "", "", "ok, broken, info or a grade"},
          {"help", "TEXT", "", "", "", "meaning"}}},
        {"reasons",
         {{"position", "INTEGER", "", "", "", "order in which they are reported"},
          {"reason", "TEXT", "", "", "", "of the verdict, for people"}}},
        {"removed",
         {{"position", "INTEGER", "", "", "", "as in ticks.tissue"},
          {"tissue", "TEXT", "", "", "", "name of the tissue"},
          {"volume", "REAL", "m^3", "volume", "", "removed of it"}}},
        {"surface",
         {{"step", "REAL", "m", "length", "", "one step of a position"},
          {"half_x", "REAL", "m", "length", "world", "half the size of the box around it, along x"},
          {"half_y", "REAL", "m", "length", "world", "half the size of the box around it, along y"},
          {"half_z", "REAL", "m", "length", "world", "half the size of the box around it, along z"},
          {"positions", "BLOB", "", "", "world",
           "of each vertex x, y, z and 0 in steps from the middle of the box, int16, little-endian"},
          {"normals", "BLOB", "", "", "world", "of each vertex x, y, z and 0 in 127ths, int8"},
          {"tissues", "BLOB", "", "", "", "of each vertex, as in ticks.tissue, uint8"},
          {"triangles", "BLOB", "", "", "",
           "three vertices each: uint16 up to 65535 vertices, else uint32, little-endian"},
          {"centre_x", "REAL", "m", "length", "world", "middle of the box, x"},
          {"centre_y", "REAL", "m", "length", "world", "middle of the box, y"},
          {"centre_z", "REAL", "m", "length", "world", "middle of the box, z"}}},
        {zones_table,
         {{"position", "INTEGER", "", "", "", "order in the anatomy"},
          {"id", "TEXT", "", "", "", "name of the zone"},
          {"step", "REAL", "m", "length", "", "one step of a position"},
          {"half_x", "REAL", "m", "length", "world", "half the size of the box around it, along x"},
          {"half_y", "REAL", "m", "length", "world", "half the size of the box around it, along y"},
          {"half_z", "REAL", "m", "length", "world", "half the size of the box around it, along z"},
          {"positions", "BLOB", "", "", "world", "as in surface"},
          {"normals", "BLOB", "", "", "world", "as in surface"},
          {"triangles", "BLOB", "", "", "", "as in surface"},
          {"centre_x", "REAL", "m", "length", "world", "middle of the box, x"},
          {"centre_y", "REAL", "m", "length", "world", "middle of the box, y"},
          {"centre_z", "REAL", "m", "length", "world", "middle of the box, z"}}},
        {approaches_table,
         {{"step", "TEXT", "", "", "", "name of the step"},
          {"zone", "TEXT", "", "", "", "name of the zone"},
          {"clearance", "REAL", "m", "length", "",
           "smallest distance of the tool from it in the step, negative inside"},
          {"time", "REAL", "s", "time", "", "when it was reached"},
          {"at_x", "REAL", "m", "length", "world", "closest point of the tool, x"},
          {"at_y", "REAL", "m", "length", "world", "closest point of the tool, y"},
          {"at_z", "REAL", "m", "length", "world", "closest point of the tool, z"}}},
    };
}

void create_tables(SqliteDatabase& database, const std::vector<Table>& tables) {
    for (const Table& table : tables) {
        std::string columns;
        for (const TableColumn& column : table.columns)
            columns += (columns.empty() ? "" : ", ") + quoted(column.name) + " " + column.type;
        database.run("CREATE TABLE " + quoted(table.name) + " (" + columns + ")");
    }
    SqliteStatement describe(database, "INSERT INTO columns VALUES(?,?,?,?,?,?,?,?,?)");
    for (const Table& table : tables)
        for (const TableColumn& column : table.columns) {
            describe << table.name << column.name << column.unit << column.dimension << column.frame
                     << to_text(column.format) << column.like << column.factor << column.help;
            describe.run();
        }
}

const Table& find_table(const std::vector<Table>& tables, std::string_view name) {
    return *std::find_if(tables.begin(), tables.end(), [&](const Table& table) { return table.name == name; });
}

std::optional<std::size_t> find_column(const Table& table, std::string_view name) {
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        if (table.columns[i].name == name) return i;
    return std::nullopt;
}

std::string insert_sql(const Table& table) {
    std::string places;
    for (std::size_t i = 0; i < table.columns.size(); ++i) places += i == 0 ? "?" : ",?";
    return "INSERT INTO " + quoted(table.name) + " VALUES(" + places + ")";
}

}  // namespace kerf::session
