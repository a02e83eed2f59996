// SPDX-License-Identifier: Apache-2.0
#include "documents/made/mandible/text.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "documents/made/anatomy_text.h"
#include "documents/made/lines.h"
#include "documents/made/mandible/bone.h"
#include "documents/made/mandible/teeth.h"
#include "documents/read_anatomy.h"
#include "kerf/assert.hpp"

namespace kerf::documents {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// The reduction of both angles, seen from the side. The saw cuts along a plane that falls by 8 degrees more than the
/// lower border, from 56 mm in front of the corner; the burr turns the posterior border by 3 degrees, up to 36 mm.
struct ReductionPlan {
    static constexpr double steeper = 8.0 * degree, turned = 3.0 * degree;
    static constexpr double in_front = 56.0, high = 36.0, burred = 22.0;  // [mm]
    Vec3 along_cut{}, cut_normal{};  ///< the normal points down and back, out of the bone that stays
    Vec3 along_border{}, into_border{};
    Vec3 on_lower{}, on_posterior{};  ///< where the cut ends in front, and where it begins
    Vec3 corner{};                    ///< of the planned borders
    Vec3 at_burr{};                   ///< on the posterior border
    Vec3 midline{};                   ///< where the directions of all burred borders meet

    explicit ReductionPlan(const MandibleFrame& frame) {
        const double fall = frame.fall + steeper, rise = frame.rise - turned;
        along_cut = {0, -std::cos(fall), -std::sin(fall)};
        cut_normal = {0, std::sin(fall), -std::cos(fall)};
        along_border = {0, std::cos(rise), std::sin(rise)};
        into_border = {0, -std::sin(rise), std::cos(rise)};
        on_lower = in_front * frame.ahead;
        on_posterior = meeting(on_lower, along_cut, {}, frame.up);
        corner = meeting(on_lower, along_cut, high * frame.up, along_border);
        at_burr = burred * frame.up;
        midline = meeting(at_burr, into_border, on_lower, -cut_normal);
    }

private:
    /// Where two lines of the sagittal plane meet.
    static Vec3 meeting(Vec3 a, Vec3 along, Vec3 b, Vec3 other) {
        const Vec3 across{0, -other.z, other.y};
        return a + dot(b - a, across) / dot(along, across) * along;
    }
};

Vec3 mirrored(Vec3 p) { return {-p.x, p.y, p.z}; }

/// Both sides of a landmark: `right_cut` and `left_cut`, or `gonion_right` and `gonion_left`.
std::string both(const char* name, bool side_is_first, const std::string& of_right, const std::string& of_left) {
    const std::string id = name;
    return side_is_first ? "    right_" + id + ": " + of_right + "    left_" + id + ": " + of_left
                         : "    " + id + "_right: " + of_right + "    " + id + "_left: " + of_left;
}

std::string point(const char* name, Vec3 right, const char* tolerance) {
    const auto of = [&](Vec3 at) { return "{at: " + vector_text(at) + " mm, tolerance: " + tolerance + "}\n"; };
    return both(name, false, of(right), of(mirrored(right)));
}

std::string axis(const char* name, Vec3 from, Vec3 to) {
    const auto of = [&](Vec3 a, Vec3 b) {
        return "{from: " + vector_text(a) + " mm, to: " + vector_text(b) + " mm, tolerance: 1 mm}\n";
    };
    return both(name, true, of(from, to), of(mirrored(from), mirrored(to)));
}

std::string plane(const char* name, Vec3 at, Vec3 normal, Vec3 normal_of_left) {
    const auto of = [&](Vec3 p, Vec3 n) {
        return "{at: " + vector_text(p) + " mm, normal: " + direction_text(n) + ", tolerance: 1 mm}\n";
    };
    return both(name, true, of(at, normal), of(mirrored(at), normal_of_left));
}

class MandibleWriter {
public:
    explicit MandibleWriter(const DimensionValues& values) : v_(values), bone_(values), plan_(bone_.frame()) {
        parts_ = bone_.parts() + teeth_parts(bone_.crest(), mm("first_molar.width")) + bone_.canal_parts();
        tissues_ = tissues();
        // The landmarks are found on the bone; an anatomy needs one of them.
        text::Diagnostics none;
        auto read = read_anatomy_text(
                        "mandible", "apiVersion: kerf/v1\nkind: Anatomy\nmetadata: {id: mandible, title: Lower jaw}\n" +
                                        solids() + "landmarks: {points: {corner: {at: 0 0 0 mm, tolerance: 1 mm}}}\n")
                        .take(none);
        KERF_ASSERT(read.has_value(), "write solids that can be read");
        made_ = std::move(read->phantom);
    }

    [[nodiscard]] std::string all() const { return solids() + "\n" + landmarks() + "\n" + zones(); }

private:
    [[nodiscard]] double mm(const char* name) const { return 1e3 * v_[name]; }
    [[nodiscard]] std::string solids() const { return "phantom:\n  parts:\n" + parts_ + "\n" + tissues_; }
    [[nodiscard]] std::string tissues() const;
    [[nodiscard]] std::string landmarks() const;
    [[nodiscard]] std::string zones() const;

    /// Returns how far the border of the made bone is from a point in a direction [mm].
    [[nodiscard]] double to_border(Vec3 from, Vec3 along) const {
        return 1e3 * Lines(made_).to_border(1e-3 * from, along);
    }
    /// Returns x of the middle of the bone of the right side at a point that is seen from the side.
    [[nodiscard]] double middle(Vec3 at) const {
        constexpr double outside = -100.0, step = 0.02;
        const double lateral = outside + to_border({outside, at.y, at.z}, {1, 0, 0}) + step;
        return lateral + 0.5 * to_border({lateral, at.y, at.z}, {1, 0, 0});
    }

    const DimensionValues& v_;
    MandibleBone bone_;
    ReductionPlan plan_;
    std::string parts_, tissues_;
    PhantomSource made_;
};

Vec3 at_x(double x, Vec3 p) { return {x, p.y, p.z}; }

std::string MandibleWriter::tissues() const {
    const auto region = [](const char* part, double thickness) {
        return std::string("      - {part: ") + part + ", thickness: " + rounded_text(thickness) + " mm}\n";
    };
    const double ramus = mm("ramus.cortex");
    return "tissues:\n  - id: cortical\n    thickness: " + rounded_text(mm("body.cortex")) +
           " mm\n    density: 1.85 g/cm3\n    regions:\n" + region("condyle", 0.45 * ramus) + region("ramus", ramus) +
           region("angle", ramus) + region("coronoid", 0.9 * ramus) +
           folded(
               "source",
               "Body and ramus: the dimensions above. The condyle has 0.45 times the cortex of the ramus, the coronoid "
               "process 0.9 times [recalled]. Around the canal it is as thick, which is more than it has. Density: "
               "apparent density of cortical bone, 1.8 to 2.0 g/cm3.",
               4) +
           "  - id: cancellous\n    density: " + with_decimals(1e-3 * v_["cancellous.density"], 3) + " g/cm3\n" +
           folded("source", "The dimension above. A lower jaw of 306 to 698 HU is among the denser ones.", 4);
}

std::string MandibleWriter::landmarks() const {
    const MandibleFrame& frame = bone_.frame();
    // The corner of the bone, where it is nearest to that of the borders.
    const Vec3 to_middle = normalized(frame.up + frame.ahead);
    double rounding = 3.0, gonion_x = HUGE_VAL;  // how far the bone is from the corner, nearly
    for (; rounding < 15.0 && !std::isfinite(gonion_x); rounding += 1.0) gonion_x = middle(rounding * to_middle);
    const Vec3 corner = at_x(gonion_x, {});
    const Vec3 gonion = corner + to_border(corner, to_middle) * to_middle;
    // The lowest point of the chin, as the lower border leads.
    Vec3 menton{};
    double lowest = HUGE_VAL;
    for (double back = 2.0; back < 14.0; back += 0.5) {
        const Vec3 below = frame.in_body(0, mm("body.length") - back, -20.0);
        if (const double far = to_border(below, frame.above); far < lowest)
            lowest = far, menton = below + far * frame.above;
    }

    const double border_x = middle(plan_.at_burr + 1.5 * plan_.into_border),
                 end_x = middle(plan_.on_lower - 2.0 * plan_.cut_normal);
    // The cut follows the middle of the bone.
    const Vec3 behind_cut = plan_.on_posterior + 6.0 * plan_.along_cut,
               ahead_cut = plan_.on_posterior + 45.0 * plan_.along_cut;
    const Vec3 a = at_x(middle(behind_cut), behind_cut), b = at_x(middle(ahead_cut), ahead_cut);
    const auto on_cut = [&](double ahead) { return a + (ahead - 6.0) / 39.0 * (b - a); };
    const Vec3 along = normalized(b - a), into_end = -plan_.cut_normal;
    const Vec3 grip = frame.in_body(0, 8.0, 3.5);
    const auto on_grip = [&](double height) { return frame.in_body(middle(grip), 8.0, height); };
    const Vec3 at_burr = at_x(border_x, plan_.at_burr), at_end = at_x(end_x, plan_.on_lower);
    const Vec3 body_normal = normalized(cross(along, plan_.cut_normal));

    std::string text = "landmarks:\n  points:\n" + point("gonion", gonion, "1 mm") +
                       point("condylion", bone_.condylion(), "1 mm") + "    menton: {at: " + vector_text(menton) +
                       " mm, tolerance: 1 mm, lies: on_bone}\n";
    text +=
        "    # In front of the chin, where the directions of all burred borders meet: so it lies straight to the side "
        "of each.\n    midline: {at: " +
        vector_text(plan_.midline) + " mm, tolerance: 1 mm}\n";
    text += "    # The corner of the planned borders, and a point on each. They state the plan, so they have no "
            "tolerance.\n";
    const auto planned = [&](const char* name, Vec3 at) { return point(name, at_x(border_x, at), "0 mm"); };
    text += planned("planned_corner", plan_.corner) + planned("planned_up", plan_.corner + 40.0 * plan_.along_border) +
            planned("planned_front", plan_.corner + 56.0 * plan_.along_cut);
    text +=
        "  axes:\n    # Along the planned ostectomy, from behind the ramus to near the lower border: in the plane, and "
        "in the middle of\n    # the bone.\n" +
        axis("cut", on_cut(-13.0), on_cut(53.0)) + "    # From below into the angle that is cut off.\n" +
        axis("grip", on_grip(-20.5), on_grip(3.5)) +
        "    # From behind into the posterior border, across the planned one.\n" +
        axis("posterior", at_burr - 16.0 * plan_.into_border, at_burr + 12.0 * plan_.into_border) +
        "    # From below into the end of the ostectomy at the lower border, across its plane.\n" +
        axis("anterior", at_end - 15.0 * into_end, at_end + 10.0 * into_end);
    const auto flipped = [](Vec3 normal) { return -mirrored(normal); };
    text += "  planes:\n    # The planned ostectomy. Its normal points down and back, out of the bone that stays.\n" +
            plane("ostectomy", on_cut(0.0), plan_.cut_normal, plan_.cut_normal) +
            "    # The burr moves along the borders in these: up the ramus, and on in the direction of the cut.\n" +
            plane("ramus", at_burr, {-1, 0, 0}, {-1, 0, 0}) + plane("body", at_end, body_normal, flipped(body_normal)) +
            "    frankfort: {at: 0 0 " + rounded_text(mm("ramus.height") + 12.5) +
            " mm, normal: 0 0 1, tolerance: 1 mm}\n";
    return text;
}

std::string MandibleWriter::zones() const {
    std::string text =
        "zones:\n  # The inferior alveolar nerve in its canal, from the mandibular to the mental foramen.\n";
    for (const double side : {-1.0, 1.0})
        text += std::string("  nerve_") + (side < 0 ? "right" : "left") + ":\n" + loft_item(bone_.canal(side), 4) +
                "    - {" + tube_text(bone_.mental(side, 0.0), bone_.mental(side, 0.63), 1.5) + "}\n";
    return text;
}

}  // namespace

std::string mandible_text(const MakeRequest&, const DimensionValues& values) { return MandibleWriter(values).all(); }

}  // namespace kerf::documents
