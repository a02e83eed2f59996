// SPDX-License-Identifier: Apache-2.0
#include "bone/measure/evaluate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "bone/measure/angle.h"
#include "bone/measure/border.h"
#include "bone/measure/distance.h"
#include "bone/measure/fit_plane.h"
#include "bone/measure/propagate.h"
#include "bone/measure/tangent.h"
#include "bone/measure/thickness.h"
#include "documents/fracture.h"
#include "text/quantity.h"

namespace kerf::bone {
namespace {

std::string quoted_id(const std::string& id) { return "`" + id + "`"; }

/// A landmark or construction.
struct Entity {
    documents::Sort sort = documents::Sort::point;
    Vec3 at{};
    Vec3 direction{};  ///< unit; direction of a line, normal of a plane

    [[nodiscard]] Line line() const noexcept { return {at, direction}; }
    [[nodiscard]] Plane plane() const noexcept { return {at, direction}; }
};

class Evaluation {
public:
    Evaluation(const documents::Measure& measure, const MeasuredScene& scene) : measure_(&measure), scene_(&scene) {}

    documents::MeasureReading reading() {
        documents::MeasureReading reading;
        if (!value()) {  // also collects the inputs
            reading.why_not = why_not_;
            return reading;
        }
        has_inputs_ = true;
        // A query of the surface takes longer than geometry does.
        constexpr std::size_t few = 64, many = 512;
        const auto measured = propagate(
            uncertainties_,
            [&](std::span<const double> shifts) -> std::optional<TracedValue> {
                shifts_ = shifts;
                operands_.assign(operands_.size(), 0.0);
                const auto at = value();
                if (!at) return std::nullopt;
                return TracedValue{*at, operands_};
            },
            [&](std::span<const double> drawn) {
                shifts_ = {};
                drawn_ = drawn;
                return value();
            },
            is_of_surface_ ? few : many);
        if (measured && std::isfinite(measured->value) && std::isfinite(measured->uncertainty)) {
            reading.value = measured->value;
            reading.uncertainty = measured->uncertainty;
        } else {
            reading.why_not = "within the tolerances of its landmarks there is none";
        }
        return reading;
    }

private:
    using MaybeEntity = std::optional<Entity>;

    // ---- inputs

    /// Returns the present shift of an input, which has the name of its owner. The first pass records all inputs.
    double shift_of(const std::string& what, int component, double uncertainty) {
        const auto key = std::pair(what, component);
        const auto found = inputs_.find(key);
        if (found != inputs_.end()) return found->second < shifts_.size() ? shifts_[found->second] : 0.0;
        if (has_inputs_ || !(uncertainty > 0.0)) return 0.0;
        inputs_.emplace(key, uncertainties_.size());
        uncertainties_.push_back(uncertainty);
        return 0.0;
    }
    Vec3 shifted(const std::string& what, int first, Vec3 at, double uncertainty) {
        return at + Vec3{shift_of(what, first, uncertainty), shift_of(what, first + 1, uncertainty),
                         shift_of(what, first + 2, uncertainty)};
    }

    std::nullopt_t fail(std::string why) {
        if (why_not_.empty()) why_not_ = std::move(why);
        return std::nullopt;
    }

    // ---- operands of the last function of the measure

    /// Returns where the numbers of an operand begin. The first pass lists all operands.
    std::size_t operand_at(const std::string& what, std::size_t count) {
        const auto [found, is_new] = operand_begins_.emplace(what, operands_.size());
        if (is_new) operands_.resize(operands_.size() + count);
        return found->second;
    }
    [[nodiscard]] bool is_drawn() const noexcept { return !drawn_.empty(); }

    /// Returns a landmark or construction that the measure is computed from last, as drawn if it is drawn.
    MaybeEntity operand(const std::string& id) {
        const std::size_t at = operand_at(id, 6);
        if (is_drawn()) {
            Entity drawn{sorts_.at(id), {drawn_[at], drawn_[at + 1], drawn_[at + 2]}, {}};
            if (drawn.sort != documents::Sort::point)
                drawn.direction = normalized(Vec3{drawn_[at + 3], drawn_[at + 4], drawn_[at + 5]});
            return drawn;
        }
        const MaybeEntity found = entity(id);
        if (!found) return std::nullopt;
        sorts_.emplace(id, found->sort);
        const Vec3 p = found->at, d = found->direction;
        const std::array<double, 6> numbers{p.x, p.y, p.z, d.x, d.y, d.z};
        std::copy(numbers.begin(), numbers.end(), operands_.begin() + static_cast<std::ptrdiff_t>(at));
        return found;
    }
    /// Returns a length that the measure `id` is computed from, as drawn if it is drawn.
    template <class Compute>
    std::optional<double> operand_of(const std::string& id, Compute compute) {
        const std::size_t at = operand_at("of " + id, 1);  // no name of a thing has a space
        if (is_drawn()) return drawn_[at];
        const std::optional<double> computed = compute();
        if (computed) operands_[at] = *computed;
        return computed;
    }

    // ---- landmarks and constructions

    /// Returns the pose that takes a landmark of the whole bone to the frame of body 0.
    [[nodiscard]] Pose bone_from_landmark(Vec3 at) const {
        const auto& poses = scene_->world_from_body;
        const std::size_t body = documents::body_at(*scene_->anatomy, at);
        return body == 0 || body >= poses.size() ? identity_pose() : inverse(poses[0]) * poses[body];
    }

    MaybeEntity landmark(const std::string& id) {
        for (const documents::LandmarkPoint& point : scene_->anatomy->points) {
            if (point.id != id) continue;
            const Pose pose = bone_from_landmark(point.at);
            const Vec3 at = shifted(id, 0, point.at, standard_uncertainty_of(point.tolerance));
            return Entity{documents::Sort::point, pose * at, {}};
        }
        for (const documents::LandmarkAxis& axis : scene_->anatomy->axes) {
            if (axis.id != id) continue;
            const Pose pose = bone_from_landmark(0.5 * (axis.from + axis.to));
            const double u = standard_uncertainty_of(axis.tolerance);
            const Vec3 from = pose * shifted(id, 0, axis.from, u), to = pose * shifted(id, 3, axis.to, u);
            return Entity{documents::Sort::line, from, normalized(to - from)};
        }
        for (const documents::LandmarkPlane& plane : scene_->anatomy->planes) {
            if (plane.id != id) continue;
            const Pose pose = bone_from_landmark(plane.at);
            const double off = shift_of(id, 0, standard_uncertainty_of(plane.tolerance));
            return Entity{documents::Sort::plane, pose * (plane.at + off * plane.normal),
                          rotate(pose.rotation, plane.normal)};
        }
        return fail("there is no " + quoted_id(id));
    }

    /// Each construction is computed once for each set of shifts, even if several others use it.
    MaybeEntity entity(const std::string& id) {
        if (const auto known = things_.find(id); known != things_.end()) return known->second;
        const auto& all = scene_->constructions;
        const auto found =
            std::find_if(all.begin(), all.end(), [&](const documents::Construction& c) { return c.id == id; });
        MaybeEntity made = found != all.end() ? construct(*found) : landmark(id);
        things_.emplace(id, made);
        return made;
    }

    std::optional<std::vector<Vec3>> points(const std::vector<std::string>& ids) {
        std::vector<Vec3> found;
        for (const std::string& id : ids) {
            const MaybeEntity one = entity(id);
            if (!one) return std::nullopt;
            found.push_back(one->at);
        }
        return found;
    }

    /// Shifts points by the residual's part of their uncertainty. `number` is the number of the first point.
    void shift_by_residual(const documents::Construction& made, std::size_t number, double residual,
                           std::vector<Vec3>& at) {
        for (std::size_t i = 0; i < at.size(); ++i)
            at[i] = shifted(made.id + "#", static_cast<int>(3 * (number + i)), at[i], residual);
    }

    MaybeEntity construct(const documents::Construction& made) {
        switch (made.kind) {
            case documents::Construction::Kind::middle:
                return middle(made);
            case documents::Construction::Kind::line:
                return line(made);
            case documents::Construction::Kind::plane:
                return plane(made);
            case documents::Construction::Kind::mirror:
                return mirror(made);
            case documents::Construction::Kind::tangent:
                return tangent(made);
            case documents::Construction::Kind::entry:
                return entry(made);
        }
        return std::nullopt;
    }

    MaybeEntity middle(const documents::Construction& made) {
        const auto at = points(made.of);
        if (!at) return std::nullopt;
        Entity mean{documents::Sort::point, {}, {}};
        for (const Vec3 p : *at) mean.at = mean.at + p / static_cast<double>(at->size());
        return mean;
    }

    MaybeEntity line(const documents::Construction& made) {
        auto at = points(made.of);
        if (!at) return std::nullopt;
        auto fitted = line_through(*at);
        if (fitted) {
            shift_by_residual(made, 0, fitted->residual, *at);
            fitted = line_through(*at);
        }
        if (!fitted) return fail("the points of " + quoted_id(made.id) + " are at one spot");
        return Entity{documents::Sort::line, fitted->line.point, fitted->line.direction};
    }

    MaybeEntity plane(const documents::Construction& made) {
        auto at = points(made.of);
        if (!at) return std::nullopt;
        auto fitted = plane_through(*at);
        if (fitted) {
            shift_by_residual(made, 0, fitted->residual, *at);
            fitted = plane_through(*at);
        }
        if (!fitted) return fail("the points of " + quoted_id(made.id) + " lie on one line");
        return Entity{documents::Sort::plane, fitted->plane.point, fitted->plane.normal};
    }

    MaybeEntity mirror(const documents::Construction& made) {
        auto left = points(made.of), right = points(made.right);
        if (!left || !right) return std::nullopt;
        auto fitted = mirror_plane(*left, *right);
        if (fitted) {
            shift_by_residual(made, 0, fitted->residual, *left);
            shift_by_residual(made, left->size(), fitted->residual, *right);
            fitted = mirror_plane(*left, *right);
        }
        if (!fitted) return fail("the pairs of " + quoted_id(made.id) + " have no direction in common");
        return Entity{documents::Sort::plane, fitted->plane.point, fitted->plane.normal};
    }

    /// A border of the bone and its view; its points are gathered once.
    struct Border {
        Path path;
        BorderView view;
        const std::vector<Vec3>* points = nullptr;
    };
    std::optional<Border> border(const documents::Construction& made) {
        auto along = points(made.of);
        const MaybeEntity view = entity(made.in);
        if (!along || !view) return std::nullopt;
        Border found{{std::move(*along), made.within}, {view->direction, made.side_direction()}};
        auto gathered = surfaces_.find(made.id);
        if (gathered == surfaces_.end()) {
            double margin = 0.0;
            for (const double u : uncertainties_) margin = std::max(margin, u);
            Path wide = found.path;
            wide.within += margin;
            gathered = surfaces_.emplace(made.id, scene_->surface->points_in(wide)).first;
        }
        found.points = &gathered->second;
        if (found.points->empty())
            return fail("no bone lies within " + text::quantity_text(made.within, "mm") + " of " + way_of(made));
        return found;
    }
    static std::string way_of(const documents::Construction& made) {
        std::string way = "the way";
        for (std::size_t i = 0; i < made.of.size(); ++i)
            way += (i == 0 ? " from " : i + 1 == made.of.size() ? " to " : " over ") + quoted_id(made.of[i]);
        return way;
    }

    MaybeEntity tangent(const documents::Construction& made) {
        const auto found = border(made);
        if (!found) return std::nullopt;
        const MeasuredSurface& surface = *scene_->surface;
        const double contact = surface.contact_uncertainty();
        const std::array<double, 2> shifts{shift_of(made.id, 0, contact), shift_of(made.id, 1, contact)};
        const auto touching =
            tangent_of(*found->points, found->path, found->view, 2.0 * surface.wall_uncertainty(), shifts);
        if (!touching)
            return fail("no line touches the " + made.side + " side of the bone in front and behind the middle of " +
                        way_of(made));
        return Entity{documents::Sort::line, touching->line.point, touching->line.direction};
    }

    /// Returns the shift along a line for the uncertainty of a wall that it passes.
    double wall_shift(const std::string& what, int component, double cosine) {
        return shift_of(what, component, scene_->surface->wall_uncertainty() / std::max(min_wall_cosine, cosine));
    }

    MaybeEntity entry(const documents::Construction& made) {
        const MaybeEntity on = entity(made.of.front());
        if (!on) return std::nullopt;
        const auto stretches = scene_->surface->stretches_on(on->line(), 0.0, max_search_distance);
        if (stretches.empty()) return fail(quoted_id(made.of.front()) + " meets no bone");
        const Stretch& first = stretches.front();
        return Entity{documents::Sort::point,
                      on->at + (first.begin + wall_shift(made.id, 0, first.cosine_at_begin)) * on->direction,
                      {}};
    }

    // ---- the measure itself

    std::optional<double> value() {
        things_.clear();
        values_.clear();
        return value_of(*measure_);
    }

    std::optional<double> value_of(const documents::Measure& measure) {
        switch (measure.kind) {
            case documents::Measure::Kind::angle:
                return angle(measure);
            case documents::Measure::Kind::distance:
                return distance(measure);
            case documents::Measure::Kind::thickness:
                return thickness(measure);
            case documents::Measure::Kind::surface_distance:
                return surface_distance(measure);
            case documents::Measure::Kind::roughness:
                return roughness(measure);
            case documents::Measure::Kind::difference:
                return difference(measure);
        }
        return std::nullopt;
    }

    /// Returns the projection of a thing onto a plane. A line stays a line. A plane becomes its trace, with the normal
    /// across.
    MaybeEntity projected(const Entity& one, const Plane& view, const std::string& view_id) {
        const auto line =
            one.sort == documents::Sort::plane ? projected_onto(view, one.plane()) : projected_onto(view, one.line());
        if (!line) return fail("seen in " + quoted_id(view_id) + ", one of both has no direction");
        if (one.sort == documents::Sort::line) return Entity{documents::Sort::line, line->point, line->direction};
        return Entity{documents::Sort::plane, line->point, normalized(cross(view.normal, line->direction))};
    }

    std::optional<double> angle(const documents::Measure& measure) {
        MaybeEntity one = operand(measure.of), other = operand(measure.to);
        if (!one || !other) return std::nullopt;
        if (!measure.in.empty()) {
            const MaybeEntity view = operand(measure.in);
            if (!view) return std::nullopt;
            one = projected(*one, view->plane(), measure.in);
            other = projected(*other, view->plane(), measure.in);
            if (!one || !other) return std::nullopt;
        }
        if (one->sort == documents::Sort::plane && other->sort == documents::Sort::plane)
            return angle_between(one->plane(), other->plane());
        if (one->sort == documents::Sort::plane) return angle_between(other->line(), one->plane());
        if (other->sort == documents::Sort::plane) return angle_between(one->line(), other->plane());
        return angle_between(one->line(), other->line());
    }

    std::optional<double> distance(const documents::Measure& measure) {
        MaybeEntity one = operand(measure.of), other = operand(measure.to);
        if (!one || !other) return std::nullopt;
        if (other->sort == documents::Sort::point) std::swap(one, other);
        if (one->sort != documents::Sort::point) return distance_between(one->line(), other->line());
        if (other->sort == documents::Sort::point) return distance_between(one->at, other->at);
        if (other->sort == documents::Sort::line) return distance_between(one->at, other->line());
        return distance_between(one->at, other->plane());
    }

    std::optional<double> thickness(const documents::Measure& measure) {
        return operand_of(measure.id, [&] { return computed_thickness(measure); });
    }
    std::optional<double> computed_thickness(const documents::Measure& measure) {
        const MaybeEntity at = entity(measure.of), along = entity(measure.to);
        if (!at || !along) return std::nullopt;
        const auto stretch = stretch_at(*scene_->surface, {at->at, along->direction});
        if (!stretch)
            return fail("no bone lies at " + quoted_id(measure.of) + " or behind it, along " + quoted_id(measure.to));
        if (!stretch->is_complete)
            return fail("the bone at " + quoted_id(measure.of) + " goes on, along " + quoted_id(measure.to) +
                        ", beyond what was read of it");
        return stretch->end - stretch->begin + wall_shift(measure.id, 0, stretch->cosine_at_begin) +
               wall_shift(measure.id, 1, stretch->cosine_at_end);
    }

    std::optional<double> surface_distance(const documents::Measure& measure) {
        const MaybeEntity at = operand(measure.of);
        const auto wall =
            operand_of(measure.id, [&]() -> std::optional<double> { return wall_shift(measure.id, 0, 1.0); });
        if (!at || !wall) return std::nullopt;
        is_of_surface_ = true;
        const auto distance = scene_->surface->distance_to(at->at);
        if (!distance) return fail(quoted_id(measure.of) + " lies beyond what was read of the bone");
        return *distance + *wall;
    }

    std::optional<double> roughness(const documents::Measure& measure) {
        return operand_of(measure.id, [&] { return computed_roughness(measure); });
    }
    std::optional<double> computed_roughness(const documents::Measure& measure) {
        const auto& all = scene_->constructions;
        const auto made =
            std::find_if(all.begin(), all.end(), [&](const documents::Construction& c) { return c.id == measure.of; });
        if (made == all.end() || made->kind != documents::Construction::Kind::tangent)
            return fail(quoted_id(measure.of) + " is no tangent");
        const auto found = border(*made);
        if (!found) return std::nullopt;
        const auto measured =
            border_roughness(*found->points, found->path, found->view, scene_->surface->wall_uncertainty());
        if (!measured) return fail("the border along " + way_of(*made) + " is too short");
        return measured->value + wall_shift(measure.id, 0, 1.0);
    }

    /// Both measures use the same landmarks, so uncertainty common to both cancels. Each measure is computed once for
    /// each set of shifts, even if several differences use it.
    std::optional<double> difference(const documents::Measure& measure) {
        const auto named = [&](const std::string& id) -> std::optional<double> {
            const auto& all = scene_->measures;
            const auto found =
                std::find_if(all.begin(), all.end(), [&](const documents::Measure& one) { return one.id == id; });
            if (found == all.end() || found->id == measure.id) return fail("there is no measure " + quoted_id(id));
            if (const auto known = values_.find(id); known != values_.end()) return known->second;
            return values_[id] = value_of(*found);
        };
        const auto one = named(measure.of), other = named(measure.to);
        if (!one || !other) return std::nullopt;
        return *one - *other;
    }

    const documents::Measure* measure_;
    const MeasuredScene* scene_;
    std::map<std::pair<std::string, int>, std::size_t> inputs_;
    std::vector<double> uncertainties_;
    std::span<const double> shifts_;
    bool has_inputs_ = false;
    std::vector<double> operands_;
    std::map<std::string, std::size_t> operand_begins_;
    std::map<std::string, documents::Sort> sorts_;  ///< of the operands
    std::span<const double> drawn_;                 ///< operands; empty while they are computed
    bool is_of_surface_ = false;                    ///< the last function queries the surface
    std::map<std::string, MaybeEntity> things_;
    std::map<std::string, std::optional<double>> values_;  ///< measures that differences use
    std::map<std::string, std::vector<Vec3>> surfaces_;    ///< points of each tangent
    std::string why_not_;
};

}  // namespace

documents::MeasureReading evaluate(const documents::Measure& measure, const MeasuredScene& scene) {
    return Evaluation(measure, scene).reading();
}

}  // namespace kerf::bone
