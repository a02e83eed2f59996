// SPDX-License-Identifier: Apache-2.0
#include "bone/import/fit_landmarks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "bone/import/fit_condyles.h"
#include "bone/import/fit_neck.h"
#include "bone/import/fit_sphere.h"
#include "bone/import/fit_tube.h"
#include "bone/import/planned_region.h"
#include "bone/surface/diagnose.h"
#include "documents/read_anatomy.h"
#include "text/distinguishing_digits.h"

namespace kerf::bone {
namespace {

std::string millimetres(double metres, int digits = 1) { return rounded(metres * 1e3, digits) + " mm"; }
std::string percent(double fraction, int digits = 0) { return rounded(100.0 * fraction, digits) + " %"; }
text::ComparedTexts compared_percent(double fraction, double bound) {
    return text::compared(fraction, bound, 0, 6, &percent);
}

/// Returns a position as YAML, to a hundredth of a millimetre.
std::string yaml_position(Vec3 at) {
    const auto hundredths = [](double x) { return rounded(std::round(x * 1e5) * 1e-2 + 0.0 /* no -0.00 */, 2); };
    return hundredths(at.x) + " " + hundredths(at.y) + " " + hundredths(at.z) + " mm";
}

/// A landmark's id, its position in the document, and the limits of its fit.
struct FitRequest {
    std::string id;
    text::Reason place;
    double residual = 0.0;  ///< [m] at most
    double within = 0.0;    ///< [m]
};

class Fits {
public:
    Fits(documents::Anatomy& anatomy, const BoneShape& bone, ImportReport& report, text::Diagnostics& diagnostics)
        : anatomy_(anatomy), bone_(bone), report_(report), diagnostics_(diagnostics) {}

    bool fit_all() {
        for (documents::LandmarkPoint& point : anatomy_.points)
            if (point.fit) fit(point);
        const auto is_condyles = [](const documents::LandmarkAxis& a) {
            return a.fit->shape == documents::LandmarkFit::Shape::condyles;
        };
        for (const bool now : {false, true})  // condyles need another axis, so they come last
            for (documents::LandmarkAxis& axis : anatomy_.axes)
                if (axis.fit && is_condyles(axis) == now) fit(axis);
        return !is_refused_;
    }

private:
    void refuse(const FitRequest& request, const char* code, const std::string& message, std::string write = {}) {
        text::Diagnostic error = text::error_at(request.place, code, message);
        error.write = std::move(write);
        diagnostics_.push_back(std::move(error));
        is_refused_ = true;
    }

    FitRequest request_of(const char* sort, const std::string& id, const documents::LandmarkFit& fit,
                          double tolerance) const {
        return {id, documents::in_anatomy(anatomy_, {"landmarks", sort, id, "fit"}), fit.residual.value_or(tolerance),
                fit.within};
    }

    /// Checks the residual and the distance from the guess.
    bool is_allowed(const FitRequest& request, double residual, Vec3 found, Vec3 guess, double off, const char* key) {
        if (off > request.within) {
            const text::ComparedTexts away = text::compared(off, request.within, 1, 6, &millimetres);
            refuse(request, "E0617",
                   "the fit of `" + request.id + "` leaves its guess: it lies " + away.value + " from `" + key + ": " +
                       yaml_position(guess) + "`, must be within " + away.bound +
                       ". Check the scan; if the fit is right, move the guess.",
                   std::string(key) + ": " + yaml_position(found));
            return false;
        }
        if (residual > request.residual) {
            const text::ComparedTexts shown = text::compared(residual, request.residual, 2, 6, &millimetres);
            refuse(request, "E0616",
                   "the residual of `" + request.id + "` is too large: got " + shown.value + ", expected at most " +
                       shown.bound + ". Check the guess and the bone there; if both are right, allow it.",
                   "residual: {at_most: " + rounded(std::ceil(residual * 1e4) * 0.1, 1) + " mm}");
            return false;
        }
        return true;
    }

    /// Returns an acceptable sphere; nothing, with one error, if there is none.
    std::optional<FittedSphere> sphere_at(const FitRequest& request, Vec3 guess, double radius) {
        const auto sphere = fit_sphere(bone_, {guess, radius, request.within});
        if (!sphere || sphere->fraction < min_sphere_fraction) {
            const text::ComparedTexts shown = compared_percent(sphere ? sphere->fraction : 0.0, min_sphere_fraction);
            refuse(request, "E0615",
                   "the bone has no sphere for `" + request.id + "` near `at: " + yaml_position(guess) + "`: got " +
                       (sphere ? shown.value : "none") + " of the directions on one with a radius of about " +
                       millimetres(radius) + ", expected at least " + shown.bound +
                       ". Check the guess and its radius, and that the bone is complete there.");
            return std::nullopt;
        }
        if (!is_allowed(request, sphere->residual, sphere->centre, guess, length(sphere->centre - guess), "at"))
            return std::nullopt;
        return sphere;
    }

    static std::string text_of(const FittedSphere& sphere) {
        return "a sphere of radius " + millimetres(sphere.radius) + ", residual " + millimetres(sphere.residual, 2) +
               " over " + percent(sphere.fraction) + " of the directions";
    }

    void fit(documents::LandmarkPoint& point) {
        const FitRequest request = request_of("points", point.id, *point.fit, point.tolerance);
        const auto sphere = sphere_at(request, point.at, point.fit->radius);
        if (!sphere) return;
        note("Point " + point.id + ": fitted at " + position_text(sphere->centre) + ", " + text_of(*sphere) + "; " +
             millimetres(length(sphere->centre - point.at)) + " from its guess.");
        point.at = sphere->centre;
        point.fit.reset();
        heads_[point.id] = *sphere;
        report_.fitted_points.push_back(point);
    }

    void fit(documents::LandmarkAxis& axis) {
        const FitRequest request = request_of("axes", axis.id, *axis.fit, axis.tolerance);
        switch (axis.fit->shape) {
            case documents::LandmarkFit::Shape::tube:
                return fit_as_tube(axis, request);
            case documents::LandmarkFit::Shape::neck:
                return fit_as_neck(axis, request);
            case documents::LandmarkFit::Shape::condyles:
                return fit_as_condyles(axis, request);
            case documents::LandmarkFit::Shape::sphere:
                break;  // only points are spheres
        }
    }

    /// Returns the distances of an axis's ends from a fitted line [m].
    static std::array<double, 2> off_ends(const documents::LandmarkAxis& axis, Vec3 from, Vec3 to) {
        const Vec3 along = normalized(to - from);
        return {length(cross(axis.from - from, along)), length(cross(axis.to - from, along))};
    }

    void place(documents::LandmarkAxis& axis, Vec3 from, Vec3 to, const std::string& what) {
        const auto off = off_ends(axis, from, to);
        note("Axis " + axis.id + ": fitted from " + position_text(from) + " to " + position_text(to) + ", " + what +
             "; " + millimetres(std::max(off[0], off[1])) + " from its guess.");
        axis.from = from;
        axis.to = to;
        axis.fit.reset();
        report_.fitted_axes.push_back(axis);
    }

    bool is_allowed(const FitRequest& request, const documents::LandmarkAxis& axis, double residual, Vec3 from,
                    Vec3 to) {
        const auto off = off_ends(axis, from, to);
        return off[0] >= off[1] ? is_allowed(request, residual, from, axis.from, off[0], "from")
                                : is_allowed(request, residual, to, axis.to, off[1], "to");
    }

    void fit_as_tube(documents::LandmarkAxis& axis, const FitRequest& request) {
        const auto tube = fit_tube(bone_, {axis.from, axis.to, axis.fit->radius, request.within});
        const text::ComparedTexts shown = compared_percent(tube ? tube->fraction : 0.0, min_tube_fraction);
        if (!tube || tube->fraction < min_tube_fraction)
            return refuse(request, "E0615",
                          "the bone is no tube between the ends of `" + request.id + "`: got " +
                              (tube ? shown.value : "none") +
                              " of its sections' points on one with a radius of about " +
                              millimetres(axis.fit->radius) + ", expected at least " + shown.bound +
                              ". Check `from`, `to` and the radius: between the ends the bone must be round.");
        if (!is_allowed(request, axis, tube->residual, tube->from, tube->to)) return;
        place(axis, tube->from, tube->to,
              "a tube of radius " + millimetres(tube->radius) + ", residual " + millimetres(tube->residual, 2) +
                  " over " + percent(tube->fraction) + " of the points of its sections");
    }

    void fit_as_neck(documents::LandmarkAxis& axis, const FitRequest& request) {
        const auto head = heads_.find(axis.fit->reference);
        if (head == heads_.end()) {  // the head's own error gives the reason
            is_refused_ = true;
            return;
        }
        const FittedSphere& sphere = head->second;
        const bool is_from_base = length(axis.from - sphere.centre) > length(axis.to - sphere.centre);
        const Vec3 to_base = (is_from_base ? axis.from : axis.to) - sphere.centre;
        const auto neck = fit_neck(bone_, {sphere.centre, sphere.radius, to_base});
        if (!neck)
            return refuse(request, "E0615",
                          "the bone has no neck for `" + request.id +
                              "`: got no section narrower than those beside it, from " +
                              millimetres(0.5 * sphere.radius) + " to " + millimetres(2.0 * sphere.radius) +
                              " below `" + axis.fit->reference +
                              "`, expected one. Check `from` and `to`: the axis must pass "
                              "through the neck.");
        const auto foot = [&](Vec3 p) { return sphere.centre + dot(p - sphere.centre, neck->to_base) * neck->to_base; };
        const Vec3 from = foot(axis.from), to = foot(axis.to);
        if (!is_allowed(request, axis, neck->residual, from, to)) return;
        place(axis, from, to,
              "a neck of " + rounded(neck->area * 1e6, 0) + " mm2 at its narrowest, residual " +
                  millimetres(neck->residual, 2) + " over " + std::to_string(neck->used) + " sections");
    }

    void fit_as_condyles(documents::LandmarkAxis& axis, const FitRequest& request) {
        const auto shaft = std::find_if(anatomy_.axes.begin(), anatomy_.axes.end(),
                                        [&](const documents::LandmarkAxis& a) { return a.id == axis.fit->reference; });
        if (shaft == anatomy_.axes.end())
            return refuse(request, "E0618",
                          "the shaft of the condyles `" + request.id + "` is unknown: got `" + axis.fit->reference +
                              "`, expected an axis of this anatomy. Add it under `landmarks.axes`.");
        if (shaft->fit) {  // the axis's own error gives the reason
            is_refused_ = true;
            return;
        }
        std::size_t failed = 0;
        const auto line = fit_condyles(bone_, {axis.from, axis.to, shaft->from, shaft->to, request.within}, failed);
        if (!line)
            return refuse(request, "E0615",
                          "the bone has no condyle for `" + request.id + "` near `" + (failed == 0 ? "from" : "to") +
                              ": " + yaml_position(failed == 0 ? axis.from : axis.to) +
                              "`: got no backmost point, seen along `" + shaft->id + "`, expected one within " +
                              millimetres(request.within) + ". Check the guess: it must be at the back of a condyle.");
        if (!is_allowed(request, axis, line->residual, line->from, line->to)) return;
        place(axis, line->from, line->to,
              "along the backs of two condyles, residual " + millimetres(line->residual, 2));
    }

    void note(std::string text) { report_.notes.push_back(std::move(text)); }

    documents::Anatomy& anatomy_;
    const BoneShape& bone_;
    ImportReport& report_;
    text::Diagnostics& diagnostics_;
    std::map<std::string, FittedSphere> heads_;
    bool is_refused_ = false;
};

/// Returns `all`, extended by a ball around `at`.
Box with_ball(const Box& all, Vec3 at, double radius) { return joined(all, grown({at, at}, radius)); }

}  // namespace

bool has_fits(const documents::Anatomy& anatomy) noexcept {
    const auto is_fitted = [](const auto& landmark) { return landmark.fit.has_value(); };
    return std::any_of(anatomy.points.begin(), anatomy.points.end(), is_fitted) ||
           std::any_of(anatomy.axes.begin(), anatomy.axes.end(), is_fitted);
}

Box region_of_fits(const documents::Anatomy& anatomy) noexcept {
    constexpr double largest = 1.0 + max_size_deviation;
    Box all{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    const auto add = [&](Vec3 at, const documents::LandmarkFit& fit, double radii) {
        all = with_ball(all, at, 2.0 * fit.within + radii * largest * fit.radius);
    };
    for (const documents::LandmarkPoint& point : anatomy.points)
        if (point.fit) add(point.at, *point.fit, 1.5);
    for (const documents::LandmarkAxis& axis : anatomy.axes) {
        if (!axis.fit) continue;
        const bool is_neck = axis.fit->shape == documents::LandmarkFit::Shape::neck;
        for (const documents::LandmarkPoint& head : anatomy.points)
            if (is_neck && head.fit && head.id == axis.fit->reference) add(head.at, *head.fit, 3.0);
        if (is_neck) continue;
        add(axis.from, *axis.fit, 1.5);
        add(axis.to, *axis.fit, 1.5);
    }
    return all;
}

bool fit_landmarks(documents::Anatomy& anatomy, const BoneShape& bone, ImportReport& report,
                   text::Diagnostics& diagnostics) {
    return Fits(anatomy, bone, report, diagnostics).fit_all();
}

void use_fits(documents::Anatomy& anatomy, const ImportReport& report) {
    const auto use = [](auto& landmarks, const auto& fitted) {
        for (auto& landmark : landmarks)
            for (const auto& one : fitted)
                if (landmark.id == one.id) landmark = one;
    };
    use(anatomy.points, report.fitted_points);
    use(anatomy.axes, report.fitted_axes);
}

}  // namespace kerf::bone
