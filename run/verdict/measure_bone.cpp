// SPDX-License-Identifier: Apache-2.0
#include "run/verdict/measure_bone.h"

#include <cstddef>
#include <utility>

#include "bone/measure/evaluate.h"
#include "bone/measure/field_surface.h"
#include "documents/read_procedure.h"
#include "documents/yaml/document.h"

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
}

}  // namespace kerf::run
