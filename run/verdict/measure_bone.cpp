// SPDX-License-Identifier: Apache-2.0
#include "run/verdict/measure_bone.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "bone/measure/evaluate.h"
#include "bone/measure/field_surface.h"
#include "core/plugin/unit.h"
#include "documents/read_procedure.h"
#include "documents/yaml/document.h"
#include "run/span_in.h"
#include "run/verdict/within_bound.h"
#include "text/codes.h"
#include "text/quantity.h"

namespace kerf::run {
namespace {

std::vector<documents::MeasureReading> measure(const Scene& scene, const Body& body, const CutField& cut,
                                               std::span<const Pose> world_from_body) {
    std::vector<documents::MeasureReading> readings;
    if (scene.procedure.measures.empty()) return readings;
    const bone::FieldSurface surface(body, cut);
    const bone::MeasuredScene measured{.constructions = scene.procedure.constructions,
                                       .measures = scene.procedure.measures,
                                       .anatomy = &scene.anatomy,
                                       .world_from_body = world_from_body,
                                       .surface = &surface};
    for (const documents::Measure& one : scene.procedure.measures) readings.push_back(bone::evaluate(one, measured));
    return readings;
}

}  // namespace

std::vector<documents::MeasureReading> measure_bone(const Scene& scene, const PresentBone& bone,
                                                    std::span<const Pose> world_from_body) {
    return measure(scene, *bone.piece(0).bone, bone.cut(0), world_from_body);
}

namespace {

/// Warns of goals that the intact bone reaches.
void warn_of_goals_reached(const Scene& scene, const documents::Document& document, documents::Report& report) {
    const auto& procedure = scene.procedure;
    for (std::size_t s = 0; s < procedure.steps.size(); ++s)
        for (std::size_t g = 0; g < procedure.steps[s].goals.size(); ++g) {
            const documents::Goal& goal = procedure.steps[s].goals[g];
            for (std::size_t m = 0; m < scene.measured_before.size(); ++m) {
                const std::optional<double>& value = scene.measured_before[m].value;
                if (procedure.measures[m].id != goal.measure || !value || !is_within(goal.bound, *value)) continue;
                const std::string unit = procedure.measures[m].unit();
                const double hundredth = 0.01 * parse_unit(unit).value_or(Unit{}).factor;
                report.warning(text::Code::goal_reached_before, span_in(document, "steps", s, "goals"),
                               "The goal `" + goal.measure + "` of the step `" + procedure.steps[s].id +
                                   "` is reached before the first cut: got " +
                                   text::quantity_text(std::round(*value / hundredth) * hundredth, unit) +
                                   ". Write bounds that only the operation reaches.");
            }
        }
}

}  // namespace

void measure_before_cuts(Scene& scene, text::Diagnostics& diagnostics) {
    if (scene.procedure.measures.empty()) return;
    std::vector<Pose> world_from_body{identity_pose()};
    if (scene.fragment) world_from_body.push_back(scene.world_from_fragment);
    scene.measured_before = measure(scene, scene.body, CutField(scene.body, 0), world_from_body);

    const auto document = documents::document_of(scene.procedure);
    documents::Report report(*document, diagnostics);
    const documents::Node* measures = document->root.find("measures");
    for (std::size_t m = 0; m < scene.measured_before.size(); ++m) {
        const documents::MeasureReading& reading = scene.measured_before[m];
        if (reading.value) continue;
        const std::string& id = scene.procedure.measures[m].id;
        const documents::Node* node = measures != nullptr ? measures->find(id) : nullptr;
        report.error(
            text::Code::no_measure, node != nullptr ? node->key_span : documents::TextSpan{},
            "The measure `" + id + "` cannot be made of this bone: " + reading.why_not +
                ". Check the landmarks that it is made of. If a tangent finds no bone, write a larger `within:`; of a "
                "scan or surface, give the anatomy an axis there, so that this bone is read.");
    }
    warn_of_goals_reached(scene, *document, report);
}

}  // namespace kerf::run
