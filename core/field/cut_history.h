// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "core/field/cut_field.h"

namespace kerf {

/// The records that have cut a piece, in their order. Copies share what they have in common: the history of an image,
/// and of a piece that came off, costs one pointer.   [worker]
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
    /// The oldest first.
    [[nodiscard]] std::vector<CutRecord> records() const {
        std::vector<CutRecord> all(count_);
        std::size_t n = count_;
        for (const Link* link = last_.get(); link != nullptr; link = link->before.get()) all[--n] = link->record;
        return all;
    }

private:
    struct Link {
        CutRecord record;
        std::shared_ptr<Link> before;

        Link(const CutRecord& one, std::shared_ptr<Link> earlier) : record(one), before(std::move(earlier)) {}
        Link(const Link&) = delete;
        Link& operator=(const Link&) = delete;
        /// Link by link: a chain that goes at once would go as deep into the stack as it is long.
        ~Link() {
            while (before != nullptr && before.use_count() == 1) before = std::move(before->before);
        }
    };
    std::shared_ptr<Link> last_;
    std::size_t count_ = 0;
};

}  // namespace kerf
