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

namespace kerf {

/// One column of one table, as the file itself describes it in its table `columns`.
struct TableColumn {
    std::string name;
    std::string type;       ///< "INTEGER", "REAL", "TEXT" or "BLOB"
    std::string unit;       ///< SI by name; empty for none; unit_of_row where each row has its own
    std::string dimension;  ///< "force", "length" …; empty for none
    std::string frame;      ///< in which it is expressed; empty for none
    std::string help;
    NumberFormat format = NumberFormat::none;  ///< of a column that `blocks` holds
    std::string like{};                        ///< an earlier column that this one is nearly, times `factor`
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

/// Every table of a session file; `ticks` ends with one column for each signal.   [any]
/// @param force_scale   [–] device newton per bone newton
[[nodiscard]] std::vector<Table> session_tables(const std::vector<SignalColumn>& signals, double force_scale = 1.0);

/// The columns of `ticks` that hold the signals: "signal_" and the id, with "_" for what SQL would not take bare.
[[nodiscard]] std::vector<std::string> signal_column_names(const std::vector<SignalColumn>& signals);

/// Creates the tables and fills `columns`.
void create_tables(SqliteDatabase& database, const std::vector<Table>& tables);

/// The table of this name. Pre: there is one.   [any]
[[nodiscard]] const Table& find_table(const std::vector<Table>& tables, std::string_view name);

/// The position of a column in its table; nothing if there is none.   [any]
[[nodiscard]] std::optional<std::size_t> find_column(const Table& table, std::string_view name);

/// INSERT INTO name VALUES(?,…), one place for each column.
[[nodiscard]] std::string insert_sql(const Table& table);

}  // namespace kerf
