// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/session/recording.h"
#include "core/session/sqlite_database.h"

namespace kerf {

/// One column of one table, as the file itself describes it in its table `columns`.
struct TableColumn {
    std::string name;
    std::string type;       ///< "INTEGER", "REAL", "TEXT" or "BLOB"
    std::string unit;       ///< SI; empty for none
    std::string dimension;  ///< "force", "length" …; empty for none
    std::string frame;      ///< in which it is expressed; empty for none
    std::string help;
};

struct Table {
    std::string name;
    std::vector<TableColumn> columns;
};

/// Every table of a session file; `ticks` ends with one column for each signal.   [any]
[[nodiscard]] std::vector<Table> session_tables(const std::vector<SignalColumn>& signals);

/// The columns of `ticks` that hold the signals: "signal_" and the id, with "_" for what SQL would not take bare.
[[nodiscard]] std::vector<std::string> signal_column_names(const std::vector<SignalColumn>& signals);

/// Creates the tables and fills `columns`.
void create_tables(SqliteDatabase& database, const std::vector<Table>& tables);

/// INSERT INTO name VALUES(?,…), one place for each column.
[[nodiscard]] std::string insert_sql(const Table& table);

}  // namespace kerf
