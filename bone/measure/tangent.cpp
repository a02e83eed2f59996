// SPDX-License-Identifier: Apache-2.0
#include "bone/measure/tangent.h"

#include <array>
#include <cmath>
#include <vector>

#include "bone/measure/outline.h"

namespace kerf::bone {

std::optional<Tangent> tangent_of(std::span<const Vec3> points, const Path& path, const BorderView& view, double play,
                                  std::span<const double, 2> shifts) {
    if (path.along.size() < 2) return std::nullopt;
    constexpr double min_cosine = 0.1;
    const auto in_view = [&](Vec3 v) { return v - dot(v, view.normal) * view.normal; };
    const Vec3 chord = in_view(path.along.back() - path.along.front()), along = normalized(chord);
    Vec3 out = cross(view.normal, along);
    if (dot(out, view.side) < 0.0) out = -out;
    if (!(length(chord) > 0.0) || !(dot(out, in_view(view.side)) > min_cosine)) return std::nullopt;

    std::vector<PlanePoint> projected;
    std::vector<Vec3> kept;
    for (const Vec3 p : points) {
        if (!(distance_to(path, p) <= path.within)) continue;
        const Vec3 d = p - path.along.front();
        projected.push_back({dot(d, along), dot(d, out)});
        kept.push_back(p);
    }
    const auto contacts = contacts_of_ruler(projected, 0.5 * length(chord), play);
    if (!contacts) return std::nullopt;

    const PlanePoint a = projected[contacts->first], b = projected[contacts->last];
    const double run = b.along - a.along, rise = b.out - a.out + shifts[1] - shifts[0];
    Tangent tangent;
    tangent.first = kept[contacts->first];
    tangent.last = kept[contacts->last];
    tangent.line = {tangent.first + shifts[0] * out, normalized(run * along + rise * out)};
    tangent.out = normalized(run * out - rise * along);
    return tangent;
}

std::optional<Tangent> tangent_of(std::span<const Vec3> points, const Path& path, const BorderView& view, double play) {
    constexpr std::array<double, 2> none{0.0, 0.0};
    return tangent_of(points, path, view, play, none);
}

double direction_uncertainty(const Tangent& tangent, double contact) noexcept {
    return std::sqrt(2.0) * contact / std::abs(dot(tangent.last - tangent.first, tangent.line.direction));
}

}  // namespace kerf::bone
