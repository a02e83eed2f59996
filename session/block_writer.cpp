// SPDX-License-Identifier: Apache-2.0
#include "session/block_writer.h"

#include <sqlite3.h>

#include <new>
#include <span>
#include <utility>

namespace kerf::session {
namespace {

// A block fills in 17 batches or more. It is compressed in eight parts.
constexpr std::size_t columns_at_once = 8;
constexpr const char* out_of_memory = "out of memory";

}  // namespace

BlockWriter::BlockWriter(const Table& table)
    : table_(table), gathered_(table.columns.size()), full_(table.columns.size()) {
    packed_.reserve(table.columns.size());
    for (const TableColumn& column : table.columns) like_.push_back(find_column(table, column.like));
}

void BlockWriter::prepare(SqliteDatabase& database) {
    database_ = &database;
    insert_.prepare(database, "INSERT INTO blocks VALUES('" + table_.name + "',?,?,?,?,?)");
    remove_.prepare(database, "DELETE FROM \"" + table_.name + "\" WHERE rowid < (SELECT min(rowid) FROM \"" +
                                  table_.name + "\") + ?");
}

void BlockWriter::finalize() noexcept {
    insert_.finalize();
    remove_.finalize();
}

void BlockWriter::give_up(const std::string& why) {
    if (error_.empty()) error_ = why;
    gathered_.clear();
    full_.clear();
    packed_.clear();
}

void BlockWriter::work() {
    if (!error_.empty()) return gathered_.clear();
    try {
        if (gathered_.is_full()) {
            pack_columns(table_.columns.size());  // of the last block, if they are not compressed yet
            take_gathered();
        }
        pack_columns(columns_at_once);
    } catch (const std::bad_alloc&) {
        give_up(out_of_memory);
    }
}

void BlockWriter::finish() {
    try {
        pack_columns(table_.columns.size());
        take_gathered();
        pack_columns(table_.columns.size());
    } catch (const std::bad_alloc&) {
        give_up(out_of_memory);
    }
}

void BlockWriter::take_gathered() {
    if (!error_.empty() || gathered_.rows() == 0) return;
    std::swap(gathered_, full_);
}

void BlockWriter::pack_columns(std::size_t count) {
    if (!error_.empty() || full_.rows() == 0) return;
    for (; count > 0 && packed_.size() < table_.columns.size(); --count) {
        const std::size_t column = packed_.size();
        const Guess guess{like_[column] ? full_.column(*like_[column]) : std::span<const std::uint64_t>(),
                          table_.columns[column].factor};
        const auto [differences, bytes] = packer_.pack(full_.column(column), table_.columns[column].format, guess);
        if (bytes.empty()) return give_up(out_of_memory);
        packed_.push_back({differences, {bytes.begin(), bytes.end()}});
    }
    if (packed_.size() == table_.columns.size()) write_block();
}

void BlockWriter::write_block() {
    database_->run("BEGIN");
    for (std::size_t column = 0; column < packed_.size(); ++column) {
        insert_ << block_ << static_cast<std::int64_t>(full_.rows()) << table_.columns[column].name
                << std::int64_t{packed_[column].differences} << std::span<const unsigned char>(packed_[column].bytes);
        insert_.run();
    }
    remove_ << static_cast<std::int64_t>(full_.rows());
    remove_.run();
    if (database_->is_good() && sqlite3_changes64(database_->handle()) != static_cast<std::int64_t>(full_.rows()))
        database_->fail("table " + table_.name + " lacks rows of a block");
    database_->run("COMMIT");
    if (!database_->is_good()) return give_up(database_->recover());
    ++block_;
    packed_.clear();
    full_.clear();
}

}  // namespace kerf::session
