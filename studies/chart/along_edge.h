// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Integrals along an edge that bone meets in stretches. For training and research; not for diagnosis, planning or
/// deciding treatment.
namespace kerf::chart {

/// Calls `found(from, to, kind)` for each stretch on which `kind_at` is the same and not negative. Borders are found by
/// so many bisections of one of the `looks` pieces; a stretch within a piece is not seen.
template <int bisections = 40, class KindAt, class Found>
void for_stretches(double from, double to, int looks, const KindAt& kind_at, const Found& found) {
    const auto close = [&](double begun, double end, int kind) {
        if (kind >= 0 && end > begun) found(begun, end, kind);
    };
    double begun = from, seen = from;
    int kind = kind_at(seen);
    for (int i = 1; i <= looks; ++i) {
        const double s = from + (to - from) * i / looks;
        const int next = kind_at(s);
        if (next != kind) {
            double inner = seen, outer = s;
            for (int k = 0; k < bisections; ++k) {
                const double middle = 0.5 * (inner + outer);
                (kind_at(middle) == kind ? inner : outer) = middle;
            }
            close(begun, inner, kind);
            begun = inner;
            kind = next;
        }
        seen = s;
    }
    close(begun, to, kind);
}

/// Calls `add(s, ds)` at the eight points of Gauss and Legendre between two ends.
template <class Add>
void for_gauss_points(double from, double to, const Add& add) {
    constexpr double node[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
    constexpr double weight[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    for (int i = 0; i < 4; ++i)
        for (const double sign : {-1.0, 1.0}) add(middle + sign * half * node[i], half * weight[i]);
}

}  // namespace kerf::chart
