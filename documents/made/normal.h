// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace kerf::documents {

/// Normally distributed numbers, each fixed by seed, name and attempt. A new dimension changes no other.
class NormalSource {
public:
    explicit NormalSource(std::uint32_t seed) : seed_(seed) {}

    /// Returns the number of a name in an attempt: mean 0, standard deviation 1.   [any] pure
    [[nodiscard]] double at(std::string_view name, int attempt) const noexcept;
    /// Returns a uniformly distributed number in [0, 1) of a name in an attempt.
    [[nodiscard]] double uniform(std::string_view name, int attempt) const noexcept;

private:
    std::uint32_t seed_;
};

}  // namespace kerf::documents
