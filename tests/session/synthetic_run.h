// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "session/recording.h"
#include "session/report/drawn_run.h"

/// A made-up run, with the shape of a real one: through cortex into spongy bone and out again.
namespace kerf::test {

inline session::RunSummary synthetic_summary() {
    session::RunSummary summary;
    summary.procedure = "Pilot hole in a lumbar pedicle";
    summary.procedure_version = "0.3";
    summary.anatomy = "Lumbar vertebra, phantom";
    summary.rehearsal = "too-deep";
    summary.hand = "simulated hand";
    summary.device = "Touch, simulated";
    summary.verdict = session::Verdict::fail;
    summary.reasons = {"The bit came within 0.4 mm of the spinal canal; the limit is 1 mm. Aim further to the side.",
                       "The hole is 31.2 mm deep; at most 30 mm were asked for."};
    summary.score = 61.7;
    summary.duration = 14.0;
    summary.steps = {{"pilot-hole", "Drill the pilot hole", true, 0.0, 12.1, {"clearance to spinal-canal", "depth"}},
                     {"withdraw", "Withdraw the bit", false, 12.1, 14.0, {}}};
    summary.metrics = {{"pilot-hole.depth", 1, "pilot-hole", 1, 1, 31.23456e-3, "mm", 1e-3, 0.13e-3, "broken",
                        "depth of the tip past the entry"},
                       {"pilot-hole.clearance", 2, "pilot-hole", 1, 1, 0.412e-3, "mm", 1e-3, 0.13e-3, "broken",
                        "least distance from the bit to the spinal canal"},
                       {"pilot-hole.peak-thrust", 1, "pilot-hole", 1, 2, 38.4721, "N", 1.0, -1.0, "info",
                        "greatest thrust in the first cortex"},
                       {"pilot-hole.deviation", 1, "pilot-hole", 1, 1, 0.0349, "deg", 0.017453292519943295, 0.005, "ok",
                        "angle between hole and plan"}};
    summary.ticks = 14000;
    summary.removed = 2.2e-7;
    summary.removed_by_tissue = {{"cortical", 0.6e-7}, {"cancellous", 1.6e-7}};
    summary.force_scale = 0.05;
    summary.coupling_stiffness = 700.0;
    summary.hash = 0x0123456789abcdefu;
    summary.versions = {{"kerf", "0.1.0"}, {"kerf.drilling", "0.1.0"}};
    summary.tissues = {"cortical", "cancellous"};
    summary.signals = {{"spindle_speed", "speed of the bit", "rpm", 0.10471975511965977},
                       {"chip.thickness", "uncut chip", "um", 1e-6}};
    return summary;
}

inline std::vector<session::TickRow> synthetic_ticks(std::size_t count = 14000) {
    std::vector<session::TickRow> rows(count);
    double removed = 0.0, load = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        session::TickRow& row = rows[i];
        row.tick = i;
        row.time = 1e-3 * static_cast<double>(i);
        row.step = row.time < 12.1 ? 0 : 1;
        row.depth = row.time < 12.1 ? -4e-3 + 2.9e-3 * row.time : 31.09e-3 - 18e-3 * (row.time - 12.1);
        const bool is_cutting = row.depth > 0.0 && row.time < 12.1;
        row.tissue = row.depth < 0.0 ? -1 : row.depth < 3e-3 || row.depth > 29e-3 ? 0 : 1;
        const double aim = !is_cutting ? 0.0 : row.tissue == 0 ? 34.0 : 9.0;
        load += 0.006 * (aim - load);
        const double ripple =
            is_cutting ? 1.0 + 0.06 * std::sin(0.9 * row.time * 31.0) + 0.04 * std::sin(211.0 * row.time) : 0.05;
        row.thrust = load * ripple;
        row.torque = -0.0021 * row.thrust * (1.0 + 0.1 * std::sin(7.0 * row.time));
        row.world_from_tool = {{0.0, 0.0, -row.depth}, {0.0, 1.0, 0.0, 0.0}};  // shaft along −z
        row.device_from_handle = row.world_from_tool;
        row.modelled = {1.5 * std::sin(row.time) * (is_cutting ? 1.0 : 0.1), 0.4, row.thrust, 0, 0, row.torque};
        row.coupled = row.modelled;
        removed += is_cutting ? 2e-11 : 0.0;
        row.removed = removed;
        row.signals[0] = 104.7 - 0.6 * row.thrust;
        row.signals[1] = is_cutting ? 3e-6 : 0.0;
    }
    return rows;
}

/// What a page shows of rows that are in memory.
inline session::DrawnRun drawn_run(const std::vector<session::TickRow>& rows,
                                   const std::vector<session::EventRow>& events = {}, session::DrawnSurface bone = {}) {
    session::DrawnRun run(rows.size());
    for (const session::TickRow& row : rows) run.add(row);
    for (const session::EventRow& event : events) run.add(event);
    run.set_bone(std::move(bone));
    return run;
}

inline std::vector<session::EventRow> synthetic_events() {
    return {{1380, 1.38, "entry", "first bone met"},
            {2414, 2.414, "kerf.drilling.breakthrough", "cortical to cancellous"},
            {11400, 11.4, "limit_broken", "clearance to <spinal-canal>"},
            {11750, 11.75, "limit_broken", "depth"},
            {12100, 12.1, "step_done", "pilot-hole"}};
}

/// A block of 24 × 24 × 12 mm with a round pit of 8 mm in its upper face.
inline Mesh synthetic_bone(int cells = 96) {
    Mesh mesh;
    const auto add_vertex = [&](Vec3 at, std::uint8_t tissue) {
        mesh.vertices.push_back(at);
        mesh.tissue.push_back(tissue);
        return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    };
    const double half = 12e-3, top = 6e-3;
    const auto height = [&](double x, double y) {
        const double r = std::hypot(x, y);
        return r < 3.6e-3 ? top - 9e-3 : r < 4e-3 ? top - 9e-3 * (4e-3 - r) / 0.4e-3 : top;
    };
    const auto tissue_at = [&](double z) { return static_cast<std::uint8_t>(z > top - 2.5e-3 ? 0 : 1); };
    const auto at = [&](int i) { return -half + 2.0 * half * i / cells; };
    // The upper face with its pit
    std::vector<std::uint32_t> grid;
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
            const double z = height(at(i), at(j));
            grid.push_back(add_vertex({at(i), at(j), z}, tissue_at(z)));
        }
    const auto node = [&](int i, int j) { return grid[static_cast<std::size_t>(j * (cells + 1) + i)]; };
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            mesh.triangles.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
            mesh.triangles.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
        }
    // The other five faces
    const auto quad = [&](Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
        const auto p = add_vertex(a, tissue_at(a.z - 1e-6)), q = add_vertex(b, tissue_at(b.z - 1e-6)),
                   r = add_vertex(c, tissue_at(c.z - 1e-6)), s = add_vertex(d, tissue_at(d.z - 1e-6));
        mesh.triangles.push_back({p, q, r});
        mesh.triangles.push_back({p, r, s});
    };
    const double h = half, b = -top, m = top - 2.5e-3;
    const auto side = [&](Vec3 from, Vec3 to) {  // anticlockwise seen from outside
        for (const auto& [low, high] : {std::pair{b, m}, {m, top}})
            quad({from.x, from.y, low}, {to.x, to.y, low}, {to.x, to.y, high}, {from.x, from.y, high});
    };
    quad({-h, -h, b}, {-h, h, b}, {h, h, b}, {h, -h, b});
    side({-h, -h, 0}, {h, -h, 0});
    side({h, -h, 0}, {h, h, 0});
    side({h, h, 0}, {-h, h, 0});
    side({-h, h, 0}, {-h, -h, 0});
    return mesh;  // no normals: whoever draws it must make them
}

}  // namespace kerf::test
