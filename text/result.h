// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

#include "kerf/assert.hpp"
#include "text/source.h"

namespace kerf::text {

/// A value, or the errors because of which there is none. Warnings may come with a value. So may errors where the
/// function returns the part that it could read.
template <class T>
class [[nodiscard]] Result {
public:
    Result(T value, Diagnostics found = {}) : value_(std::move(value)), found_(std::move(found)) {}
    Result(Diagnostics errors) : found_(std::move(errors)) {
        KERF_ASSERT(has_error(found_), "a result without a value has the error that explains it");
    }

    [[nodiscard]] bool has_value() const noexcept { return value_.has_value(); }
    explicit operator bool() const noexcept { return has_value(); }
    // Pre: has_value().
    const T& operator*() const& noexcept { return *value_; }
    T& operator*() & noexcept { return *value_; }
    T&& operator*() && noexcept { return *std::move(value_); }
    const T* operator->() const noexcept { return &*value_; }
    T* operator->() noexcept { return &*value_; }

    [[nodiscard]] const Diagnostics& diagnostics() const noexcept { return found_; }

    /// Appends the diagnostics to `all` and returns the value, if there is one.
    std::optional<T> take(Diagnostics& all) && {
        all.insert(all.end(), found_.begin(), found_.end());
        return std::move(value_);
    }

private:
    std::optional<T> value_;
    Diagnostics found_;
};

}  // namespace kerf::text
