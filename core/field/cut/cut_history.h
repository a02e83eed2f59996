// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "core/field/cut/cut_field.h"

namespace kerf {

/// The records that have cut a piece, in their order. Copies store their common records once, so a copy costs one
/// pointer.   [worker] A copy may be passed to another thread.
class CutHistory {
public:
    CutHistory() = default;
    CutHistory(const CutHistory&) = default;
    CutHistory(CutHistory&& other) noexcept : last_(std::move(other.last_)), count_(std::exchange(other.count_, 0)) {}
    CutHistory& operator=(CutHistory other) noexcept {
        std::swap(last_, other.last_);
        std::swap(count_, other.count_);
        return *this;
    }
    ~CutHistory() = default;

    void push(const CutRecord& record) {
        last_ = std::make_shared<Link>(record, std::move(last_));
        ++count_;
    }
    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    /// Returns all records, oldest first.
    [[nodiscard]] std::vector<CutRecord> records() const { return records_after({}); }
    /// Returns the records after an earlier history, oldest first. Pre: `continues(earlier)`.
    [[nodiscard]] std::vector<CutRecord> records_after(const CutHistory& earlier) const {
        std::vector<CutRecord> all(count_ - earlier.count_);
        const Link* link = last_.get();
        for (std::size_t n = all.size(); n > 0; link = link->before.get()) all[--n] = link->record;
        return all;
    }
    /// Returns whether this history is a copy of `earlier`, with or without further records.
    [[nodiscard]] bool continues(const CutHistory& earlier) const noexcept {
        return earlier.count_ <= count_ && first(earlier.count_).last_ == earlier.last_;
    }
    /// Returns the longest history that both continue.
    [[nodiscard]] CutHistory common_with(const CutHistory& other) const noexcept {
        CutHistory mine = first(std::min(count_, other.count_)), theirs = other.first(mine.count_);
        while (mine.last_ != theirs.last_) {
            mine = mine.first(mine.count_ - 1);
            theirs = theirs.first(mine.count_);
        }
        return mine;
    }
    [[nodiscard]] bool operator==(const CutHistory& other) const noexcept { return last_ == other.last_; }

private:
    /// Returns the first `count` records. Pre: `count` ≤ `count()`.
    [[nodiscard]] CutHistory first(std::size_t count) const noexcept {
        const std::shared_ptr<Link>* link = &last_;
        for (std::size_t n = count_; n > count; --n) link = &(*link)->before;
        CutHistory history;
        history.last_ = *link;
        history.count_ = count;
        return history;
    }

    struct Link {
        CutRecord record;
        std::shared_ptr<Link> before;

        Link(const CutRecord& one, std::shared_ptr<Link> earlier) : record(one), before(std::move(earlier)) {}
        Link(const Link&) = delete;
        Link& operator=(const Link&) = delete;
        /// Frees the chain link by link: a recursive destructor would need stack in proportion to its length.
        ~Link() {
            while (before != nullptr && before.use_count() == 1) {
                std::atomic_thread_fence(std::memory_order_acquire);  // orders this after the last use on any thread
                before = std::move(before->before);
            }
        }
    };
    std::shared_ptr<Link> last_;
    std::size_t count_ = 0;
};

}  // namespace kerf
