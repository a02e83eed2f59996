// SPDX-License-Identifier: Apache-2.0
#include "session/exact_summary.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "session/content_hash.h"

namespace kerf::session {
namespace {

double in_mm3(double volume) { return std::round(volume * 1e13) / 1e4; }
double in_mm2(double area) { return std::round(area * 1e8) / 1e2; }

}  // namespace

nlohmann::ordered_json exact_summary(const ExactRow& exact) {
    using Json = nlohmann::ordered_json;
    Json strategies = Json::array();
    for (const ExactRow::Strategy& one : exact.strategies) {
        Json parameters = Json::object();
        for (const auto& [id, value] : one.parameters) parameters[id] = value;
        strategies.push_back({{"strategy", one.id},
                              {"module", one.module},
                              {"module_hash", hex16(one.module_hash)},
                              {"kernel", one.kernel},
                              {"parameters", std::move(parameters)}});
    }
    Json pieces = Json::array();
    for (const ExactRow::Piece& piece : exact.pieces) {
        Json walls = Json::object();
        for (const auto& [tissue, area] : piece.wall_areas) walls[tissue] = in_mm2(area);
        pieces.push_back({{"body", piece.body},
                          {"file", piece.file},
                          {"triangles", piece.triangles},
                          {"volume_mm3", in_mm3(piece.volume)},
                          {"field_volume_mm3", in_mm3(piece.field_volume)},
                          {"walls_mm2", std::move(walls)}});
    }
    const bool is_made = exact.why_not.empty();
    return {{"digest", is_made ? Json(hex16(exact.digest)) : Json(nullptr)},
            {"why_not", is_made ? Json(nullptr) : Json(exact.why_not)},
            {"strategies", std::move(strategies)},
            {"records", exact.records},
            {"stretches", exact.stretches},
            {"removed_mm3", in_mm3(exact.removed)},
            {"field_removed_mm3", in_mm3(exact.field_removed)},
            {"allowed_difference_mm3", in_mm3(exact.allowed)},
            {"crumbs", exact.crumbs},
            {"crumbs_mm3", in_mm3(exact.crumb_volume)},
            {"refused_attempts", exact.refusals},
            {"handed_over", exact.handed_over},
            {"pieces", std::move(pieces)},
            {"notes", exact.notes}};
}

}  // namespace kerf::session
