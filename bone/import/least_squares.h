// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace kerf::bone {

/// Accumulates the normal equations of a linear least-squares problem in N unknowns: rows · x ≈ value.
template <std::size_t N>
class LeastSquares {
public:
    void add(const std::array<double, N>& row, double value) noexcept {
        for (std::size_t i = 0; i < N; ++i) {
            for (std::size_t j = 0; j < N; ++j) matrix_[i][j] += row[i] * row[j];
            right_[i] += row[i] * value;
        }
    }

    /// Returns the unknowns, by elimination with pivots; nothing if the rows do not determine them.
    [[nodiscard]] std::optional<std::array<double, N>> solve() const noexcept {
        auto m = matrix_;
        auto x = right_;
        double largest = 0.0;
        for (std::size_t i = 0; i < N; ++i) largest = std::max(largest, std::abs(m[i][i]));
        for (std::size_t column = 0; column < N; ++column) {
            std::size_t pivot = column;
            for (std::size_t i = column + 1; i < N; ++i)
                if (std::abs(m[i][column]) > std::abs(m[pivot][column])) pivot = i;
            if (!(std::abs(m[pivot][column]) > 1e-12 * largest)) return std::nullopt;
            std::swap(m[pivot], m[column]);
            std::swap(x[pivot], x[column]);
            for (std::size_t i = column + 1; i < N; ++i) {
                const double factor = m[i][column] / m[column][column];
                for (std::size_t j = column; j < N; ++j) m[i][j] -= factor * m[column][j];
                x[i] -= factor * x[column];
            }
        }
        for (std::size_t i = N; i-- > 0;) {
            for (std::size_t j = i + 1; j < N; ++j) x[i] -= m[i][j] * x[j];
            x[i] /= m[i][i];
        }
        return x;
    }

private:
    std::array<std::array<double, N>, N> matrix_{};
    std::array<double, N> right_{};
};

}  // namespace kerf::bone
