// SPDX-License-Identifier: Apache-2.0
// A viewer of text. Kerf's own window uses the same interface.
#include "viewer.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

using namespace kerf::run;

namespace {

std::size_t triangles_of(const ViewedSurface& surface) {
    std::size_t count = 0;
    for (const ViewedBodySurface& body : surface.bodies)
        for (std::size_t brick = 0; brick < body.patches.capacity(); ++brick)
            if (const auto& patch = body.patches[brick]; patch != nullptr) count += patch->triangles.size();
    return count;
}

void print_line(const ViewedScene& scene, const ViewedMoment& moment) {
    const ViewedState& state = moment.state;
    const auto step = static_cast<std::size_t>(state.step);
    const std::string title = step < scene.steps.size() ? scene.steps[step].title : "done";
    const auto tissue = static_cast<std::size_t>(state.tissue);
    const char* in = state.tissue < 0 ? "air" : scene.tissues[tissue].name.c_str();
    const std::string bar(static_cast<std::size_t>(std::clamp(state.force / 2.0, 0.0, 30.0)), '#');
    std::printf("%6.1f s  %-34.34s %6.1f mm  %-11.11s %6.1f N %s\n", state.time, title.c_str(), 1e3 * state.depth, in,
                state.force, bar.c_str());
}

}  // namespace

void show(ViewedRun& run) {
    const ViewedScene& scene = run.scene();
    std::printf("%s, led by %s\n", scene.title.c_str(), scene.hand.c_str());
    double next = 0.0;
    std::vector<ViewedMoment> moments;
    std::vector<ViewedEvent> events;
    while (!run.result() && !run.is_closed()) {
        run.take(moments);
        for (const ViewedMoment& moment : moments)
            if (moment.state.time >= next) {
                print_line(scene, moment);
                next += 1.0;
            }
        moments.clear();
        run.take(events);
        for (const ViewedEvent& event : events)
            if (event.kind == ViewedEvent::Kind::goal || event.kind == ViewedEvent::Kind::limit)
                std::printf("%6.1f s  %s\n", event.time, event.words.c_str());
        events.clear();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    if (const auto result = run.result())
        std::printf("%s, %.0f of 100, %zu triangles of bone are left\n", result->verdict.c_str(), result->score,
                    triangles_of(*run.surface()));
}
