// SPDX-License-Identifier: Apache-2.0
// A femur whose head, neck, shaft and condyles are known, because it is made of them.
#include "bone/import/fit_landmarks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "bone/import/make_body.h"
#include "documents/read_anatomy.h"
#include "documents/solids.h"
#include "kerf/units.hpp"

namespace kerf::bone {
namespace {

using namespace literals;

// The neck rises at 125° to the shaft and leads 15° to the front; the head is 50 mm from the shaft's axis. Along the
// back of the shaft runs a ridge. Every guess is 5 mm to 15 mm off, every radius 1 mm to 2 mm.
const char* const femur_text = R"(apiVersion: kerf/v1
kind: Anatomy
metadata: {id: femur, title: Left femur}
phantom:
  parts:
    - {id: shaft, tube: {from: 0 0 -390 mm, to: 0 0 -12 mm, radius: 13 mm}}
    - {id: ridge, tube: {from: 0 12 -340 mm, to: 0 12 -70 mm, radius: 3 mm}}
    - {id: trochanter, tube: {from: 6 6 -40 mm, to: 8 8 6 mm, radius: 13 mm}}
    - {id: neck, tube: {from: 0 0 -20 mm, to: -39.5617 -10.6005 8.6788 mm, radius: 15 mm}}
    - {id: head, sphere: {centre: -39.5617 -10.6005 8.6788 mm, radius: 23 mm}}
    - {id: metaphysis, tube: {from: -22 -4 -392 mm, to: 22 -4 -392 mm, radius: 17 mm}}
    - {id: medial, sphere: {centre: -24 8 -400 mm, radius: 20 mm}}
    - {id: lateral, sphere: {centre: 24 6 -402 mm, radius: 19 mm}}
    - {id: canal, tube: {from: 0 0 -360 mm, to: 0 0 -60 mm, radius: 5.3 mm}, subtract: true}
tissues: [{id: bone, density: 1.85 g/cm3}]
landmarks:
  points:
    head: {at: -46 -6 14 mm, fit: {sphere: {radius: 21 mm, within: 14 mm}}, tolerance: 1 mm}
  axes:
    shaft: {from: 7 -6 -90 mm, to: -5 9 -330 mm, fit: {tube: {radius: 14 mm}}, tolerance: 1 mm}
    neck: {from: 24 -2 -46 mm, to: -52 -8 12 mm, fit: {neck: {head: head}}, tolerance: 1 mm}
    condyles: {from: -29 31 -405 mm, to: 30 22 -397 mm, fit: {condyles: {shaft: shaft}}, tolerance: 1 mm}
)";

const Vec3 head_centre{-(39.5617_mm), -(10.6005_mm), 8.6788_mm}, medial{-(24.0_mm), 8.0_mm, -(400.0_mm)},
    lateral{24.0_mm, 6.0_mm, -(402.0_mm)}, neck_base{0, 0, -(20.0_mm)};

/// Where a plane along the shaft touches both condyles from behind: n · (c2 − c1) = r1 − r2 in the plane across z.
std::array<Vec3, 2> backs_of_condyles() {
    const double r1 = 20.0_mm, r2 = 19.0_mm;
    const Vec3 d{lateral.x - medial.x, lateral.y - medial.y, 0};
    const double along = (r1 - r2) / length(d);
    const Vec3 n = along * normalized(d) + std::sqrt(1.0 - along * along) * normalized(Vec3{-d.y, d.x, 0});
    return {medial + r1 * n, lateral + r2 * n};
}

documents::Anatomy femur() {
    text::Diagnostics diagnostics;
    auto anatomy = documents::read_anatomy_text("femur.yaml", femur_text).take(diagnostics);
    EXPECT_TRUE(anatomy) << to_text(diagnostics);
    return anatomy.value_or(documents::Anatomy{});
}

const BoneShape endless(const documents::Anatomy& anatomy) {
    return {[&](Vec3 p) { return distance_to(anatomy.phantom, p); },
            {{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}}};
}

struct Fitted {
    documents::Anatomy anatomy;
    ImportReport report;
    text::Diagnostics diagnostics;
    bool is_done = false;

    [[nodiscard]] Vec3 head() const { return anatomy.points.at(0).at; }
    [[nodiscard]] const documents::LandmarkAxis& axis(const std::string& id) const {
        return *std::find_if(anatomy.axes.begin(), anatomy.axes.end(), [&](const auto& a) { return a.id == id; });
    }
    [[nodiscard]] std::string codes() const {
        std::string all;
        for (const text::Diagnostic& d : diagnostics) all += (all.empty() ? "" : " ") + d.code;
        return all;
    }
};

Fitted fit(const documents::Anatomy& written) {
    Fitted fitted{written, {}, {}, false};
    fitted.is_done = fit_landmarks(fitted.anatomy, endless(written), fitted.report, fitted.diagnostics);
    return fitted;
}

double degrees_between(Vec3 a, Vec3 b) { return std::atan2(length(cross(a, b)), dot(a, b)) * 180.0 / std::numbers::pi; }
double from_line(Vec3 p, Vec3 from, Vec3 to) { return length(cross(p - from, normalized(to - from))); }

/// How far the ends of an axis are from a line, the farther one.
double off(const documents::LandmarkAxis& axis, Vec3 from, Vec3 to) {
    return std::max(from_line(axis.from, from, to), from_line(axis.to, from, to));
}

/// All positions of an anatomy, changed.
documents::Anatomy changed(documents::Anatomy anatomy, const std::function<Vec3(Vec3)>& move) {
    for (documents::PhantomPart& part : anatomy.phantom.parts) {
        if (auto* tube = std::get_if<documents::TubeSolid>(&part.solid))
            tube->from = move(tube->from), tube->to = move(tube->to);
        if (auto* sphere = std::get_if<documents::SphereSolid>(&part.solid)) sphere->centre = move(sphere->centre);
    }
    for (documents::LandmarkPoint& point : anatomy.points) point.at = move(point.at);
    for (documents::LandmarkAxis& axis : anatomy.axes) axis.from = move(axis.from), axis.to = move(axis.to);
    return anatomy;
}

void expect_moved(const Fitted& moved, const Fitted& still, const std::function<Vec3(Vec3)>& move) {
    ASSERT_TRUE(moved.is_done) << to_text(moved.diagnostics);
    constexpr double same = 0.1_mm;  // the rays lie otherwise on the bone
    EXPECT_LT(length(moved.head() - move(still.head())), same);
    for (const documents::LandmarkAxis& axis : moved.anatomy.axes) {
        EXPECT_LT(length(axis.from - move(still.axis(axis.id).from)), same) << axis.id;
        EXPECT_LT(length(axis.to - move(still.axis(axis.id).to)), same) << axis.id;
    }
}

// ---- known geometry -------------------------------------------------------------------------------------------------

TEST(FitLandmarks, FindsTheHeadOfAFemur) {
    const Fitted found = fit(femur());
    ASSERT_TRUE(found.is_done) << to_text(found.diagnostics);
    RecordProperty("head_mm", std::to_string(length(found.head() - head_centre) * 1e3));
    EXPECT_LT(length(found.head() - head_centre), 1.0_mm);
}

TEST(FitLandmarks, FindsTheShaftBesideItsRidge) {
    const documents::LandmarkAxis shaft = fit(femur()).axis("shaft");
    RecordProperty("shaft_mm", std::to_string(off(shaft, {0, 0, 0}, {0, 0, -1.0}) * 1e3));
    EXPECT_LT(off(shaft, {0, 0, 0}, {0, 0, -1.0}), 1.0_mm);
    EXPECT_LT(degrees_between(shaft.to - shaft.from, {0, 0, -1.0}), 2.0);
}

TEST(FitLandmarks, FindsTheNeckThroughTheHead) {
    const Fitted found = fit(femur());
    const documents::LandmarkAxis& neck = found.axis("neck");
    RecordProperty("neck_mm", std::to_string(off(neck, neck_base, head_centre) * 1e3));
    EXPECT_LT(off(neck, neck_base, head_centre), 1.0_mm);
    EXPECT_LT(degrees_between(neck.to - neck.from, head_centre - neck_base), 2.0);
    EXPECT_LT(from_line(found.head(), neck.from, neck.to), 1e-9) << "it passes through the head's centre";
    EXPECT_NEAR(degrees_between(neck.to - neck.from, found.axis("shaft").to - found.axis("shaft").from), 125.0, 2.0);
}

TEST(FitLandmarks, FindsTheBacksOfTheCondyles) {
    const documents::LandmarkAxis condyles = fit(femur()).axis("condyles");
    const auto [from, to] = backs_of_condyles();
    RecordProperty("condyles_mm",
                   std::to_string(std::max(length(condyles.from - from), length(condyles.to - to)) * 1e3));
    EXPECT_LT(length(condyles.from - from), 1.0_mm);
    EXPECT_LT(length(condyles.to - to), 1.0_mm);
    EXPECT_LT(degrees_between(condyles.to - condyles.from, to - from), 2.0);
}

TEST(FitLandmarks, KeepsTheSenseOfTheGuess) {
    documents::Anatomy turned = femur();
    for (documents::LandmarkAxis& axis : turned.axes) std::swap(axis.from, axis.to);
    const Fitted found = fit(turned), straight = fit(femur());
    ASSERT_TRUE(found.is_done) << to_text(found.diagnostics);
    for (const documents::LandmarkAxis& axis : found.anatomy.axes) {
        EXPECT_LT(length(axis.from - straight.axis(axis.id).to), 0.1_mm) << axis.id;
        EXPECT_LT(length(axis.to - straight.axis(axis.id).from), 0.1_mm) << axis.id;
    }
}

TEST(FitLandmarks, ReportsWhatItFoundAndHowWell) {
    const Fitted found = fit(femur());
    ASSERT_EQ(found.report.notes.size(), 4u);
    for (const std::string& note : found.report.notes) {
        EXPECT_NE(note.find("fitted"), std::string::npos) << note;
        EXPECT_NE(note.find("residual"), std::string::npos) << note;
        EXPECT_NE(note.find("from its guess"), std::string::npos) << note;
    }
    EXPECT_EQ(found.report.fitted_points.size(), 1u);
    EXPECT_EQ(found.report.fitted_axes.size(), 3u);
    EXPECT_FALSE(has_fits(found.anatomy)) << "nothing is left to fit";
}

// ---- properties -----------------------------------------------------------------------------------------------------

TEST(FitLandmarks, IsTheSameBitsEveryTime) {
    const Fitted one = fit(femur()), two = fit(femur());
    EXPECT_TRUE(one.head() == two.head());
    for (const documents::LandmarkAxis& axis : one.anatomy.axes) {
        EXPECT_TRUE(axis.from == two.axis(axis.id).from);
        EXPECT_TRUE(axis.to == two.axis(axis.id).to);
    }
}

TEST(FitLandmarks, MovesWithTheBone) {
    const Fitted still = fit(femur());
    for (const Vec3 turn : {Vec3{0.5, 0, 0}, {0, 0, 1.5}, {1.0, -0.7, 2.0}}) {
        const auto move = [pose = Pose{{120.0_mm, -(300.0_mm), 45.0_mm}, quat_from_rotation_vector(turn)}](Vec3 p) {
            return pose * p;
        };
        expect_moved(fit(changed(femur(), move)), still, move);
    }
}

TEST(FitLandmarks, MirrorsWithTheBone) {
    const auto mirror = [](Vec3 p) { return Vec3{-p.x, p.y, p.z}; };
    expect_moved(fit(changed(femur(), mirror)), fit(femur()), mirror);
}

TEST(FitLandmarks, ForgetsWhereTheGuessWas) {
    const Fitted best = fit(femur());
    const auto backs = backs_of_condyles();
    for (const Vec3 move : {Vec3{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0.6, -0.8, 0}}) {
        SCOPED_TRACE(testing::Message() << move.x << " " << move.y << " " << move.z);
        documents::Anatomy anatomy = femur();
        anatomy.points[0].at = head_centre + 10.0_mm * move;
        const auto set = [&](std::size_t axis, Vec3 from, Vec3 to) {
            anatomy.axes[axis].from = from + 10.0_mm * move;
            anatomy.axes[axis].to = to + 10.0_mm * move;
        };
        set(0, {0, 0, -(90.0_mm)}, {0, 0, -(330.0_mm)});
        set(1, neck_base + 0.5 * (neck_base - head_centre), head_centre);
        set(2, backs[0], backs[1]);
        const Fitted found = fit(anatomy);
        ASSERT_TRUE(found.is_done) << to_text(found.diagnostics);
        EXPECT_LT(length(found.head() - best.head()), 0.1_mm);
        for (const documents::LandmarkAxis& axis : found.anatomy.axes)
            EXPECT_LT(off(axis, best.axis(axis.id).from, best.axis(axis.id).to), 0.1_mm) << axis.id;
        EXPECT_LT(length(found.axis("condyles").from - best.axis("condyles").from), 0.1_mm);
        EXPECT_LT(length(found.axis("condyles").to - best.axis("condyles").to), 0.1_mm);
    }
}

// ---- refusals -------------------------------------------------------------------------------------------------------

documents::Anatomy only_head(documents::Anatomy anatomy) {
    anatomy.axes.clear();
    return anatomy;
}

TEST(FitLandmarks, RefuseASphereInEmptySpace) {
    documents::Anatomy anatomy = only_head(femur());
    anatomy.points[0].at = {-(200.0_mm), 0, 0};
    EXPECT_EQ(fit(anatomy).codes(), "E0615");
}

TEST(FitLandmarks, RefuseAFemurWithoutItsHead) {
    documents::Anatomy anatomy = only_head(femur());
    const Vec3 along = normalized(head_centre - neck_base);
    anatomy.phantom.parts.push_back(
        {"cut", documents::TubeSolid{head_centre - 15.0_mm * along, head_centre + 60.0_mm * along, 60.0_mm}, true, ""});
    EXPECT_EQ(fit(anatomy).codes(), "E0615");
}

TEST(FitLandmarks, RefuseAVertebraForAFemur) {
    text::Diagnostics diagnostics;
    auto vertebra =
        documents::read_anatomy(KERF_SOURCE_DIR "/procedures/anatomy/vertebra-phantom.yaml").take(diagnostics);
    ASSERT_TRUE(vertebra) << to_text(diagnostics);
    vertebra->points = femur().points;
    vertebra->axes = {femur().axes[0]};
    vertebra->points[0].at = {};
    EXPECT_EQ(fit(*vertebra).codes(), "E0615 E0615");
}

TEST(FitLandmarks, RefuseAFitThatLeavesItsGuess) {
    documents::Anatomy anatomy = only_head(femur());
    anatomy.points[0].at = head_centre + Vec3{0, -(9.0_mm), 0};
    anatomy.points[0].fit->within = 8.0_mm;
    const Fitted found = fit(anatomy);
    EXPECT_EQ(found.codes(), "E0617");
    EXPECT_EQ(found.diagnostics.at(0).write, "at: -39.56 -10.60 8.68 mm");
    EXPECT_TRUE(found.head() == anatomy.points[0].at) << "what is refused stays as written";
}

TEST(FitLandmarks, RefuseAnotherSize) {
    documents::Anatomy anatomy = only_head(femur());
    anatomy.points[0].fit->radius = 35.0_mm;
    EXPECT_EQ(fit(anatomy).codes(), "E0615");
}

TEST(FitLandmarks, RefuseALargeResidual) {
    documents::Anatomy anatomy = femur();
    anatomy.axes = {anatomy.axes[0]};
    const auto oval =
        documents::EllipticTubeSolid{{0, 0, -(390.0_mm)}, {0, 0, -(12.0_mm)}, 27.0_mm, 25.0_mm, {0, 1, 0}};
    anatomy.phantom.parts[0].solid = oval;
    EXPECT_EQ(fit(anatomy).codes(), "");
    anatomy.axes[0].fit->residual = 0.1_mm;
    EXPECT_EQ(fit(anatomy).codes(), "E0616");
}

TEST(FitLandmarks, RefuseANeckThatIsNone) {
    // Given a head on a rod that only widens
    documents::Anatomy anatomy = femur();
    anatomy.axes = {anatomy.axes[1]};
    auto& neck = std::get<documents::TubeSolid>(anatomy.phantom.parts[3].solid);
    neck.radius = 22.9_mm;
    // Then the sections in the head itself are the narrowest there are
    EXPECT_EQ(fit(anatomy).codes(), "E0615");
}

TEST(FitLandmarks, RefuseCondylesInEmptySpace) {
    documents::Anatomy anatomy = femur();
    anatomy.points.clear();
    anatomy.axes = {anatomy.axes[2], anatomy.axes[0]};  // the shaft is fitted first, although it is written last
    EXPECT_EQ(fit(anatomy).codes(), "");
    anatomy.axes[0].to = {90.0_mm, 22.0_mm, -(397.0_mm)};
    const Fitted found = fit(anatomy);
    EXPECT_EQ(found.codes(), "E0615");
    EXPECT_NE(found.diagnostics.at(0).message.find("near `to: 90.00"), std::string::npos) << to_text(found.diagnostics);
}

TEST(FitLandmarks, RefuseCondylesWithoutTheirShaft) {
    documents::Anatomy anatomy = femur();
    anatomy.axes = {anatomy.axes[2]};
    EXPECT_EQ(fit(anatomy).codes(), "E0618");
}

// ---- in import ------------------------------------------------------------------------------------------------------

TEST(FittedLandmarks, AreCheckedAsIfTheyWereWritten) {
    // Given a ball, and a guess beside it
    documents::Anatomy ball;
    ball.file = "ball.yaml";
    ball.phantom.parts = {{"ball", documents::SphereSolid{{}, 8.0_mm}, false, ""}};
    ball.tissues = {{"bone", 1850.0, 0.0, ""}};
    ball.points = {{"middle",
                    {10.0_mm, 0, 0},
                    1.0_mm,
                    documents::LandmarkPoint::Lies::in_bone,
                    documents::LandmarkFit{.radius = 8.0_mm}}};

    // When it becomes a body
    text::Diagnostics diagnostics;
    ImportReport report;
    ASSERT_TRUE(make_body(ball, 0.5_mm, &report).take(diagnostics)) << to_text(diagnostics);

    // Then the point lies in bone, where the guess did not
    EXPECT_FALSE(text::has_error(diagnostics)) << to_text(diagnostics);
    use_fits(ball, report);
    EXPECT_LT(length(ball.points[0].at), 0.01_mm);
    EXPECT_FALSE(has_fits(ball));
}

TEST(FittedLandmarks, AreComparedAsAPair) {
    // Given two balls, and guesses between them that are the right way round, with the balls the other way round
    documents::Anatomy balls;
    balls.file = "balls.yaml";
    balls.phantom.parts = {{"a", documents::SphereSolid{{-(9.0_mm), 0, 0}, 8.0_mm}, false, ""},
                           {"b", documents::SphereSolid{{9.0_mm, 40.0_mm, 0}, 8.0_mm}, false, ""}};
    balls.tissues = {{"bone", 1850.0, 0.0, ""}};
    const documents::LandmarkFit sphere{.radius = 8.0_mm};
    balls.points = {{"left_ball", {1.0_mm, 0, 0}, 1.0_mm, documents::LandmarkPoint::Lies::anywhere, sphere},
                    {"right_ball", {-(1.0_mm), 40.0_mm, 0}, 1.0_mm, documents::LandmarkPoint::Lies::anywhere, sphere}};
    text::Diagnostics diagnostics;
    (void)make_body(balls, 0.5_mm).take(diagnostics);
    ASSERT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
    EXPECT_EQ(diagnostics[0].code, "E0612");
}

}  // namespace
}  // namespace kerf::bone
