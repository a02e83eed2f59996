// SPDX-License-Identifier: Apache-2.0
#include "bone/measure/border.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "bone/import/least_squares.h"

namespace kerf::bone {
namespace {

constexpr double bin = 1e-3;  // [m]
constexpr std::size_t min_bins = 6;

}  // namespace

std::optional<Measured> border_roughness(std::span<const Vec3> points, const Path& path, const BorderView& view,
                                         double wall) {
    if (path.along.size() < 2) return std::nullopt;
    constexpr double min_cosine = 0.1;
    const auto in_view = [&](Vec3 v) { return v - dot(v, view.normal) * view.normal; };
    const Vec3 chord = in_view(path.along.back() - path.along.front()), along = normalized(chord);
    Vec3 out = cross(view.normal, along);
    if (dot(out, view.side) < 0.0) out = -out;
    if (!(dot(out, in_view(view.side)) > min_cosine)) return std::nullopt;

    struct Top {
        double along = 0.0, out = -HUGE_VAL;
    };
    std::vector<Top> outline(static_cast<std::size_t>(std::ceil(length(chord) / bin)));
    for (const Vec3 p : points) {
        const Vec3 d = p - path.along.front();
        const double at = dot(d, along) / bin;
        if (!(at >= 0.0 && at < static_cast<double>(outline.size())) || distance_to(path, p) > path.within) continue;
        Top& top = outline[static_cast<std::size_t>(at)];
        if (dot(d, out) > top.out) top = {at, dot(d, out)};
    }
    std::erase_if(outline, [](const Top& top) { return !std::isfinite(top.out); });
    if (outline.size() < min_bins) return std::nullopt;

    LeastSquares<3> equations;
    const double scale = static_cast<double>(outline.size());  // gives all unknowns the same order of magnitude
    const auto row = [&](const Top& top) {
        const double t = top.along / scale;
        return std::array<double, 3>{1.0, t, t * t};
    };
    for (const Top& top : outline) equations.add(row(top), top.out);
    const auto solved = equations.solve();
    if (!solved) return std::nullopt;
    double squares = 0.0;
    for (const Top& top : outline) {
        const auto terms = row(top);
        const double left = top.out - ((*solved)[0] * terms[0] + (*solved)[1] * terms[1] + (*solved)[2] * terms[2]);
        squares += left * left;
    }
    return Measured{std::sqrt(squares / static_cast<double>(outline.size())), wall};
}

}  // namespace kerf::bone
