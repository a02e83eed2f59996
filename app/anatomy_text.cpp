// SPDX-License-Identifier: Apache-2.0
#include "app/anatomy_text.h"

#include <algorithm>
#include <cmath>

#include "bone/import/landmark_checks.h"
#include "bone/import/make_body.h"
#include "bone/report/import_report.h"

namespace kerf::app {
namespace {

std::string millimetres(double metres, int digits = 1) { return bone::rounded(metres * 1e3, digits) + " mm"; }

std::string position_text(const Body& body, Vec3 at) {
    const bone::PointOnBone place = bone::locate_on_bone(body, at);
    if (!place.is_in_region) return "outside the region, not checked";
    const bool is_far = std::abs(place.distance) >= 0.99 * place.known;
    return std::string(is_far ? "more than " : "") + millimetres(std::abs(place.distance)) +
           (place.distance < 0.0 ? " inside the bone's surface" : " outside the bone");
}

std::string shift_text(const bone::BorderShift& shift) {
    const std::string head = "Border at " + shift.axis + ": ";
    if (!shift.lower || !shift.upper)
        return head + "a threshold moved by " + bone::rounded(shift.step, 0) + " loses the entry on one side.";
    const double largest = std::max(std::abs(*shift.lower), std::abs(*shift.upper));
    return head + "± " + bone::rounded(shift.step, 0) + " " + shift.unit + " moves the cortex at the entry by " +
           millimetres(largest, 2) + " (" + millimetres(*shift.lower, 2) + " lower, " + millimetres(*shift.upper, 2) +
           " higher).";
}

}  // namespace

std::string anatomy_text(const documents::Anatomy& anatomy, const Body& body, const bone::ImportReport& import) {
    std::string text;
    const auto add = [&](const std::string& line) { text += line + "\n"; };
    for (const std::string& note : import.notes) add(note);
    for (const documents::LandmarkPoint& point : anatomy.points)
        add("Point " + point.id + ": " + position_text(body, point.at) + ", known to " + millimetres(point.tolerance) +
            ".");
    for (const documents::LandmarkPlane& plane : anatomy.planes)
        add("Plane " + plane.id + ": its point " + position_text(body, plane.at) + ", known to " +
            millimetres(plane.tolerance) + ".");
    for (const documents::Zone& zone : anatomy.zones)
        add("Zone " + zone.id + ": " + bone::rounded(100.0 * bone::fraction_in_bone(body, zone), 0) +
            " % of it lies in bone.");
    for (const bone::BorderShift& shift : import.shifts) add(shift_text(shift));
    return text;
}

std::string anatomy_text(const run::LoneAnatomy& alone) {
    return anatomy_text(alone.anatomy, alone.body, alone.import) + "The bone was sampled at " +
           millimetres(alone.spacing) + ". To check what a procedure needs of it, write `--for PROCEDURE.yaml`.\n";
}

}  // namespace kerf::app
