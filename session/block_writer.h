// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "session/packed_column.h"
#include "session/session_tables.h"
#include "session/sqlite_database.h"

namespace kerf::session {

/// Rows of one table in memory, stored by column.
class RowBlock {
public:
    explicit RowBlock(std::size_t columns) : cells_(columns * max_block_rows) {}

    /// Appends the next number of the present row, from left to right.
    RowBlock& operator<<(double number) noexcept { return put(to_cell(number)); }
    RowBlock& operator<<(std::int64_t number) noexcept { return put(to_cell(number)); }
    void end_row() noexcept {
        ++rows_;
        column_ = 0;
    }
    void clear() noexcept { rows_ = column_ = 0; }

    [[nodiscard]] std::size_t rows() const noexcept { return rows_; }
    [[nodiscard]] bool is_full() const noexcept { return rows_ == max_block_rows; }
    [[nodiscard]] std::span<const std::uint64_t> column(std::size_t column) const noexcept {
        return std::span(cells_).subspan(column * max_block_rows, rows_);
    }

private:
    RowBlock& put(std::uint64_t cell) noexcept {
        cells_[column_++ * max_block_rows + rows_] = cell;
        return *this;
    }

    std::vector<std::uint64_t> cells_;
    std::size_t rows_ = 0, column_ = 0;
};

/// Moves the rows of one table into compressed blocks of max_block_rows rows during a run.
///
/// The caller inserts each row into the table and also adds it here. A full block is compressed a few columns at a
/// time, so that the caller's commits are not delayed. Then one transaction adds the block and deletes its plain rows:
/// each row is in the file once at all times. If a block cannot be written, its rows and all later rows stay plain.
/// [one thread at a time]
class BlockWriter {
public:
    explicit BlockWriter(const Table& table);
    void prepare(SqliteDatabase& database);
    void finalize() noexcept;

    /// Returns the block for the next row. Pre: it is not full.
    [[nodiscard]] RowBlock& next_rows() noexcept { return gathered_; }
    [[nodiscard]] bool is_full() const noexcept { return gathered_.is_full(); }

    /// Does a part of the work. Call it after each commit, outside of a transaction.
    void work();
    /// Compresses all remaining rows.
    void finish();
    /// Leaves all rows plain from now on, after a failed transaction.
    void give_up(const std::string& why);

    /// Returns the reason for plain rows; empty if there are none.
    [[nodiscard]] const std::string& error() const noexcept { return error_; }

private:
    struct PackedColumn {
        int differences = 0;
        std::vector<unsigned char> bytes;
    };

    void take_gathered();
    void pack_columns(std::size_t count);
    void write_block();

    Table table_;
    RowBlock gathered_, full_;
    ColumnPacker packer_;
    std::vector<std::optional<std::size_t>> like_;  ///< for each column: the column that predicts it
    std::vector<PackedColumn> packed_;              ///< the compressed columns of `full_`
    std::int64_t block_ = 0;
    std::string error_;
    SqliteDatabase* database_ = nullptr;
    SqliteStatement insert_, remove_;
};

}  // namespace kerf::session
