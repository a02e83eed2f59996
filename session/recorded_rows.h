// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "session/packed_column.h"
#include "session/session_file.h"
#include "session/session_tables.h"

namespace kerf::session {

/// Reads the rows of `ticks` or `cuts` in the order in which a run wrote them: first the rows compressed in `blocks`,
/// then the plain ones. Sessions before schema 4 have plain rows only. Keeps one block in memory at a time.   [main]
class RecordedRows {
public:
    /// @param wanted   names of the columns of `table` to read; the others are not unpacked
    RecordedRows(const SessionHandle& database, const Table& table, const std::vector<std::string>& wanted);

    bool next();
    /// Returns the reason for an early end, for people: "block 3 of its table `ticks` is cut short". Empty at the end
    /// of a sound table.
    [[nodiscard]] const std::string& fault() const noexcept { return fault_; }

    /// Returns a cell of the present row, or a property of it, by its index in `wanted`.
    [[nodiscard]] bool is_null(std::size_t column) const;
    [[nodiscard]] bool is_number(std::size_t column) const;
    [[nodiscard]] double number(std::size_t column) const;
    [[nodiscard]] std::int64_t integer(std::size_t column) const;

private:
    bool load_block();
    bool unpack_column(std::size_t column);
    bool fail(const std::string& fault);

    const Table table_;
    std::vector<std::size_t> unpacked_;  ///< indices of table columns: the wanted ones, then their predictors
    std::vector<std::optional<std::size_t>>
        index_in_unpacked_;  ///< for each column of the table: its index in `unpacked_`
    std::string fault_;

    std::optional<SessionQuery> blocks_;
    SessionQuery plain_;
    ColumnUnpacker unpacker_;
    std::vector<std::uint64_t> cells_;  ///< of the present block, column by column
    std::size_t rows_ = 0, row_ = 0;
    std::int64_t block_ = 0;
    bool is_in_block_ = false;
};

/// Returns the tables of a session, with its own signals and predictions.   [main]
[[nodiscard]] std::vector<Table> recorded_tables(const SessionHandle& database);

/// Returns the number of rows that `RecordedRows` reads, according to the file; nothing if it cannot be read.   [main]
[[nodiscard]] std::optional<std::uint64_t> recorded_row_count(const SessionHandle& database, const std::string& table);

}  // namespace kerf::session
