// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace kerf::bone {

/// A snapshot of a paged vector. It never changes: other threads may read it while the vector is modified.
template <class T>
class Pages {
public:
    static constexpr std::size_t page_size = 1024;
    using Page = std::array<T, page_size>;

    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] const T& operator[](std::size_t n) const noexcept { return (*pages_[n / page_size])[n % page_size]; }
    [[nodiscard]] const std::vector<std::shared_ptr<const Page>>& pages() const noexcept { return pages_; }

private:
    template <class>
    friend class PagedVector;
    std::vector<std::shared_ptr<const Page>> pages_;
    std::size_t size_ = 0;
};

/// A vector in pages of 1024 values, so that a snapshot costs one pointer a page. A page in a snapshot is never
/// written: the vector replaces it by a copy first.   [one thread]
template <class T>
class PagedVector {
public:
    static constexpr std::size_t page_size = Pages<T>::page_size;

    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] const T& operator[](std::size_t n) const noexcept { return (*pages_[n / page_size])[n % page_size]; }
    void set(std::size_t n, const T& value) { writable(n / page_size)[n % page_size] = value; }
    void push_back(const T& value) {
        if (size_ == pages_.size() * page_size) {
            pages_.push_back(std::make_shared<typename Pages<T>::Page>());
            is_shared_.push_back(false);
        }
        set(size_++, value);
    }

    /// Returns a snapshot of the values.
    [[nodiscard]] Pages<T> snapshot() {
        Pages<T> copy;
        copy.pages_.assign(pages_.begin(), pages_.end());
        copy.size_ = size_;
        is_shared_.assign(pages_.size(), true);
        return copy;
    }
    /// Returns the numbers of the pages that differ from an earlier snapshot.
    [[nodiscard]] std::vector<std::size_t> differing_pages(const Pages<T>& earlier) const {
        std::vector<std::size_t> pages;
        for (std::size_t page = 0; page < std::max(pages_.size(), earlier.pages_.size()); ++page)
            if (page >= pages_.size() || page >= earlier.pages_.size() || pages_[page] != earlier.pages_[page])
                pages.push_back(page);
        return pages;
    }
    void restore(const Pages<T>& earlier) {
        pages_.clear();
        for (const auto& page : earlier.pages_)
            pages_.push_back(std::const_pointer_cast<typename Pages<T>::Page>(page));
        is_shared_.assign(pages_.size(), true);
        size_ = earlier.size_;
    }

private:
    [[nodiscard]] typename Pages<T>::Page& writable(std::size_t page) {
        if (is_shared_[page]) {
            pages_[page] = std::make_shared<typename Pages<T>::Page>(*pages_[page]);
            is_shared_[page] = false;
        }
        return *pages_[page];
    }

    std::vector<std::shared_ptr<typename Pages<T>::Page>> pages_;
    std::vector<bool> is_shared_;  ///< for each page: a snapshot has it
    std::size_t size_ = 0;
};

}  // namespace kerf::bone
