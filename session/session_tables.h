// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "session/packed_column.h"
#include "session/recording.h"
#include "session/sqlite_database.h"

namespace kerf::session {

/// One column of one table, as the file describes it in its table `columns`.
struct TableColumn {
    std::string name;
    std::string type;       ///< "INTEGER", "REAL", "TEXT" or "BLOB"
    std::string unit;       ///< name of the SI unit; empty for none; unit_of_row if each row has its own
    std::string dimension;  ///< "force", "length" …; empty for none
    std::string frame;      ///< frame of the value; empty for none
    std::string help;
    NumberFormat format = NumberFormat::none;  ///< for columns that `blocks` contains
    std::string like{};                        ///< an earlier column that predicts this one, times `factor`
    double factor = 1.0;
};

/// The unit of numbers whose table has their SI unit in its column `unit`.
inline constexpr const char* unit_of_row = "see column unit";

struct Table {
    std::string name;
    std::vector<TableColumn> columns;
};

/// The tables whose rows a run compresses in blocks.
inline constexpr const char *ticks_table = "ticks", *cuts_table = "cuts";
/// The tables of a session from first_schema_with_zones on.
inline constexpr const char *zones_table = "zones", *approaches_table = "approaches";

/// Returns every table of a session file. `ticks` ends with one column per signal.   [any]
/// @param force_scale   [–] device newton per bone newton
[[nodiscard]] std::vector<Table> session_tables(const std::vector<SignalColumn>& signals, double force_scale = 1.0);

/// Returns the columns of `ticks` that contain signals: "signal_" and the id, with "_" for characters that SQL requires
/// to quote.
[[nodiscard]] std::vector<std::string> signal_column_names(const std::vector<SignalColumn>& signals);

/// Creates the tables and fills `columns`.
void create_tables(SqliteDatabase& database, const std::vector<Table>& tables);

/// Returns the table with this name. Pre: there is one.   [any]
[[nodiscard]] const Table& find_table(const std::vector<Table>& tables, std::string_view name);

/// Returns the index of a column in its table; nothing for an unknown column.   [any]
[[nodiscard]] std::optional<std::size_t> find_column(const Table& table, std::string_view name);

/// Returns INSERT INTO name VALUES(?,…), with one `?` per column.
[[nodiscard]] std::string insert_sql(const Table& table);

}  // namespace kerf::session
