// SPDX-License-Identifier: Apache-2.0
#include "bone/import/landmark_checks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include "bone/report/import_report.h"
#include "documents/read_anatomy.h"
#include "documents/solids.h"

namespace kerf::bone {
namespace {

constexpr double max_bone_in_zone = 0.25;  // [–] that may be bone, because a zone's border is coarse
constexpr double finest = 1e-3;            // [m] between the sample points of a zone
constexpr double max_points = 200'000.0;

/// Returns a landmark's location in the document. A landmark of a markups file has no line.
text::Reason named(const documents::Anatomy& anatomy, const char* sort, const std::string& id,
                   std::string message = {}) {
    const text::Reason list = documents::in_anatomy(anatomy, {"landmarks", sort}),
                       own = documents::in_anatomy(anatomy, {"landmarks", sort, id}, message);
    const bool has_own = own.place.line != list.place.line || own.place.column != list.place.column;
    return has_own ? own : documents::in_anatomy(anatomy, {"landmarks", "markups"}, std::move(message));
}

std::string millimetres(double metres) { return rounded(metres * 1e3, 1); }

/// Returns `left_pedicle` for `right_pedicle`; empty for a name without the word `right`.
std::string other_side(const std::string& id) {
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    for (std::size_t at = id.find("right"); at != std::string::npos; at = id.find("right", at + 1)) {
        const std::size_t end = at + 5;
        const bool is_word = (at == 0 || !is_letter(id[at - 1])) && (end == id.size() || !is_letter(id[end]));
        if (is_word) return id.substr(0, at) + "left" + id.substr(end);
    }
    return {};
}

void check_sides(const documents::Anatomy& anatomy, text::Diagnostics& diagnostics) {
    struct Landmark {
        Vec3 at;
        const char* sort;
    };
    std::map<std::string, Landmark> places;
    for (const documents::LandmarkPoint& point : anatomy.points) places[point.id] = {point.at, "points"};
    for (const documents::LandmarkAxis& axis : anatomy.axes) places[axis.id] = {0.5 * (axis.from + axis.to), "axes"};
    for (const documents::LandmarkPlane& plane : anatomy.planes) places[plane.id] = {plane.at, "planes"};
    for (const auto& [id, right] : places) {
        const auto left = places.find(other_side(id));
        if (left == places.end() || left->second.at.x > right.at.x) continue;
        text::Diagnostic swapped = text::error_at(
            named(anatomy, right.sort, id), "E0612",
            "`" + left->first + "` lies at x " + millimetres(left->second.at.x) + " mm and `" + id + "` at x " +
                millimetres(right.at.x) +
                " mm, but x grows to the patient's left (LPS). Swap them; or, if all coordinates are RAS, turn the "
                "sign of every x and y.");
        swapped.reason = named(anatomy, left->second.sort, left->first, "the other one is here.");
        diagnostics.push_back(std::move(swapped));
    }
}

std::string where(const PointOnBone& place) {
    const bool is_far = std::abs(place.distance) >= 0.99 * place.known;
    return (is_far ? "more than " : "") + millimetres(std::abs(place.distance)) + " mm " +
           (place.distance < 0.0 ? "inside the bone's surface" : "outside the bone");
}

void check_points(const documents::Anatomy& anatomy, const Body& body, text::Diagnostics& diagnostics) {
    using Lies = documents::LandmarkPoint::Lies;
    for (const documents::LandmarkPoint& point : anatomy.points) {
        if (point.lies == Lies::anywhere) continue;
        const PointOnBone place = locate_on_bone(body, point.at);
        if (!place.is_in_region) continue;
        const double d = place.distance;
        const bool is_true = point.lies == Lies::on_bone   ? std::abs(d) <= point.tolerance
                             : point.lies == Lies::in_bone ? d <= point.tolerance
                                                           : d >= -point.tolerance;
        if (is_true) continue;
        const char* must = point.lies == Lies::on_bone ? "on it" : point.lies == Lies::in_bone ? "in it" : "outside it";
        diagnostics.push_back(
            text::error_at(named(anatomy, "points", point.id), "E0613",
                           "the point `" + point.id + "` lies " + where(place) + ", must lie " + must + " within " +
                               millimetres(point.tolerance) +
                               " mm. Check its coordinates (LPS, millimetres), `lies`, or how the bone is made."));
    }
}

}  // namespace

PointOnBone locate_on_bone(const Body& body, Vec3 at) noexcept {
    return {uncut_distance(body, locate(body, at)), clamp_voxels * body.grid().spacing,
            outside_region(body, at) == 0.0};
}

double fraction_in_bone(const Body& body, const documents::Zone& zone) {
    std::size_t inside = 0, in_bone = 0;
    const Box box = bounds_of(zone.solids);
    const Region& region = body.region;  // nothing is known beyond it
    const Vec3 low{std::max(box.low.x, region.low.x), std::max(box.low.y, region.low.y),
                   std::max(box.low.z, region.low.z)};
    const Vec3 high{std::min(box.high.x, region.high.x), std::min(box.high.y, region.high.y),
                    std::min(box.high.z, region.high.z)};
    const Vec3 extent = high - low;
    if (!(extent.x > 0.0 && extent.y > 0.0 && extent.z > 0.0)) return 0.0;
    const double step = std::max(finest, std::cbrt(extent.x * extent.y * extent.z / max_points));
    for (double x = low.x + 0.5 * step; x < high.x; x += step)
        for (double y = low.y + 0.5 * step; y < high.y; y += step)
            for (double z = low.z + 0.5 * step; z < high.z; z += step) {
                if (documents::distance_to_any(zone.solids, {x, y, z}) >= 0.0) continue;
                ++inside;
                in_bone += uncut_distance(body, locate(body, {x, y, z})) < 0.0;
            }
    return inside > 0 ? static_cast<double>(in_bone) / static_cast<double>(inside) : 0.0;
}

namespace {

/// Warns of zones of which no part is in the bone's box, enlarged on each side by its own size.
void check_distances(const documents::Anatomy& anatomy, const Body& body, text::Diagnostics& diagnostics) {
    const Grid& grid = body.grid();
    const Vec3 low = grid.sample_position(0, 0, 0),
               high = grid.sample_position(grid.bricks[0] * brick_edge, grid.bricks[1] * brick_edge,
                                           grid.bricks[2] * brick_edge);
    const Vec3 size = high - low;
    for (const documents::Zone& zone : anatomy.zones) {
        const Box box = bounds_of(zone.solids);
        const double apart =
            std::max({low.x - size.x - box.high.x, box.low.x - high.x - size.x, low.y - size.y - box.high.y,
                      box.low.y - high.y - size.y, low.z - size.z - box.high.z, box.low.z - high.z - size.z});
        if (zone.solids.empty() || zone.is_tissue || apart <= 0.0) continue;
        diagnostics.push_back(text::warning_at(documents::in_anatomy(anatomy, {"zones", zone.id}), "W0687",
                                               "the zone `" + zone.id +
                                                   "` is far from the bone, so no tool can come near it. Check its "
                                                   "coordinates (LPS, millimetres)."));
    }
}

}  // namespace

void check_landmarks(const documents::Anatomy& anatomy, const Body& body, text::Diagnostics& diagnostics) {
    check_sides(anatomy, diagnostics);
    check_points(anatomy, body, diagnostics);
    check_distances(anatomy, body, diagnostics);
    for (const documents::Zone& zone : anatomy.zones)
        if (const double share = fraction_in_bone(body, zone); share > max_bone_in_zone && !zone.is_tissue)
            diagnostics.push_back(text::warning_at(
                documents::in_anatomy(anatomy, {"zones", zone.id}), "W0614",
                rounded(100.0 * share, 0) + " % of the zone `" + zone.id +
                    "` lies in bone. If it should be free, check its coordinates (LPS, millimetres)."));
}

}  // namespace kerf::bone
