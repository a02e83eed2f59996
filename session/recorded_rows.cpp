// SPDX-License-Identifier: Apache-2.0
#include "session/recorded_rows.h"

#include <sqlite3.h>

#include <algorithm>
#include <cstdlib>
#include <span>

#include "session/recorder.h"
#include "text/plain_numbers.h"

namespace kerf::session {
namespace {

// Upper bound of zlib's output for incompressible numbers. A run writes no more.
constexpr std::size_t max_packed_bytes = 8 * max_block_rows + 1024;

bool has_blocks(const SessionHandle& database) {
    SessionQuery version(database, "PRAGMA user_version");
    return version.next() && version.integer(0) >= first_schema_with_blocks;
}

std::string text_list(const std::vector<std::string>& words) {
    std::string list;
    for (const std::string& word : words) list += (list.empty() ? "'" : ", '") + word + '\'';
    return list;
}

/// Returns a query of blocks that leaves unwanted and overlong bytes in the file.
std::string blocks_sql(const std::string& table, const std::vector<std::string>& wanted) {
    return "SELECT block, rows, column_name, differences, CASE WHEN column_name IN (" + text_list(wanted) +
           ") AND length(data) <= " + std::to_string(max_packed_bytes) +
           " THEN data END FROM blocks WHERE table_name = '" + table + "' ORDER BY rowid";
}

/// Returns a query with the table's name before each column: without it, SQLite takes an unknown quoted name for a
/// text.
std::string plain_sql(const std::string& table, const std::vector<std::string>& wanted) {
    std::string columns;
    for (const std::string& name : wanted) columns += (columns.empty() ? "" : ", ") + table + ".\"" + name + '"';
    return "SELECT " + columns + " FROM " + table;
}

}  // namespace

RecordedRows::RecordedRows(const SessionHandle& database, const Table& table, const std::vector<std::string>& wanted)
    : table_(table), index_in_unpacked_(table.columns.size()), plain_(database, plain_sql(table.name, wanted)) {
    std::vector<std::string> names = wanted;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto column = find_column(table_, names[i]);
        if (!column || index_in_unpacked_[*column]) {  // two signals with the same column name
            fail("its table `" + table_.name + "` has no column of its own for `" + names[i] + "`");
            return;
        }
        index_in_unpacked_[*column] = i;
        unpacked_.push_back(*column);
        const std::string& like = table_.columns[*column].like;
        if (!like.empty() && std::find(names.begin(), names.end(), like) == names.end()) names.push_back(like);
    }
    if (!has_blocks(database)) return;
    blocks_.emplace(database, blocks_sql(table.name, names));
    cells_.resize(names.size() * max_block_rows);
}

bool RecordedRows::fail(const std::string& fault) {
    fault_ = fault;
    return false;
}

bool RecordedRows::next() {
    if (!fault_.empty()) return false;
    if (is_in_block_ && ++row_ < rows_) return true;
    is_in_block_ = blocks_ && load_block();
    if (is_in_block_) return true;
    blocks_.reset();
    if (!fault_.empty()) return false;
    if (plain_.next()) return true;
    return plain_.has_failed() ? fail("its table `" + table_.name + "` cannot be read") : false;
}

/// Loads the next block: one row per column, in the order of the table.
bool RecordedRows::load_block() {
    const std::string name = "block " + std::to_string(block_) + " of its table `" + table_.name + "`";
    for (std::size_t column = 0; column < index_in_unpacked_.size(); ++column) {
        if (!blocks_->next()) {
            if (blocks_->has_failed()) return fail("its table `blocks` cannot be read");
            return column == 0 ? false : fail(name + " is cut short");
        }
        const std::int64_t rows = blocks_->integer(1);
        const bool is_next = blocks_->integer(0) == block_ && blocks_->text(2) == table_.columns[column].name;
        if (!is_next || (column > 0 && rows != static_cast<std::int64_t>(rows_)))
            return fail(name + " lacks its column `" + table_.columns[column].name + "`");
        if (rows < 1 || rows > static_cast<std::int64_t>(max_block_rows))
            return fail(name + " has " + std::to_string(rows) + " rows, and a block has 1 to " +
                        std::to_string(max_block_rows));
        rows_ = static_cast<std::size_t>(rows);
        if (!index_in_unpacked_[column]) continue;
        if (!unpack_column(column)) return fail(name + " has a damaged column `" + table_.columns[column].name + "`");
    }
    ++block_;
    row_ = 0;
    return true;
}

/// Unpacks one column. Pre: the query is at its row.
bool RecordedRows::unpack_column(std::size_t column) {
    const std::string_view bytes = blocks_->bytes_view(4);
    const int differences = static_cast<int>(std::clamp<std::int64_t>(blocks_->integer(3), -1, 1000));
    const auto cells = [&](std::size_t of) {
        return std::span(cells_).subspan(*index_in_unpacked_[of] * max_block_rows, rows_);
    };
    Guess guess{{}, table_.columns[column].factor};
    if (const auto like = find_column(table_, table_.columns[column].like)) guess.like = cells(*like);
    return unpacker_.unpack({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()}, differences,
                            table_.columns[column].format, cells(column), guess);
}

bool RecordedRows::is_null(std::size_t column) const {
    return !is_in_block_ && plain_.is_null(static_cast<int>(column));
}

bool RecordedRows::is_number(std::size_t column) const {
    return is_in_block_ || plain_.is_number(static_cast<int>(column));
}

double RecordedRows::number(std::size_t column) const {
    if (!is_in_block_) return plain_.number(static_cast<int>(column));
    const std::uint64_t cell = cells_[column * max_block_rows + row_];
    return table_.columns[unpacked_[column]].format == NumberFormat::int64 ? static_cast<double>(integer_of(cell))
                                                                           : double_of(cell);
}

std::int64_t RecordedRows::integer(std::size_t column) const {
    if (!is_in_block_) return plain_.integer(static_cast<int>(column));
    return integer_of(cells_[column * max_block_rows + row_]);
}

std::vector<Table> recorded_tables(const SessionHandle& database) {
    std::vector<SignalColumn> signals;
    SessionQuery ids(database, "SELECT id, display_unit FROM signals ORDER BY rowid");
    while (signals.size() < max_signal_columns && ids.next()) signals.push_back({ids.text(0), {}, ids.text(1), 1.0});
    SessionQuery scale(database, "SELECT value FROM session WHERE key = 'condition.force_scale'");
    const text::PlainNumbers point;
    return session_tables(signals, scale.next() ? std::strtod(scale.text(0).c_str(), nullptr) : 1.0);
}

std::optional<std::uint64_t> recorded_row_count(const SessionHandle& database, const std::string& table) {
    // Not count(*): for it SQLite calls no progress handler, and a cycle of pages would never end.
    SessionQuery plain(database, "SELECT total(1) FROM " + table);
    if (!plain.next()) return std::nullopt;
    constexpr double most = 1e15;
    const auto count = static_cast<std::uint64_t>(std::clamp(plain.number(0), 0.0, most));
    if (!has_blocks(database)) return count;
    SessionQuery blocks(database,
                        "SELECT total(rows) FROM blocks WHERE table_name = '" + table + "' AND column_name = 'tick'");
    if (!blocks.next()) return std::nullopt;
    return count + static_cast<std::uint64_t>(std::clamp(blocks.number(0), 0.0, most));
}

}  // namespace kerf::session
