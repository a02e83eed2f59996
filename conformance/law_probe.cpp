// SPDX-License-Identifier: Apache-2.0
#include "conformance/law_probe.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/haptics/law/tool.h"

namespace kerf::conformance {

LawProbe::LawProbe(const Subject& subject, const WalkSettings& settings)
    : law_(subject, settings), refusal_(law_.refusal()) {
    if (!refusal_.empty()) return;
    law_.begin(at_depth(-1.0));
    law_.run_up();
    ready_.assign(law_.state().begin(), law_.state().end());
}

bool LawProbe::evaluate(const Pose& at) {
    std::copy(ready_.begin(), ready_.end(), law_.state().begin());
    law_.bone().forget_threads();
    law_.place(at);
    return law_.resist() == KERF_OK;
}

Response LawProbe::move(const Pose& from, const Vec6& rate, int ticks) {
    Response response;
    response.ticks = ticks;
    const Pose step{law_.dt() * linear(rate), quat_from_rotation_vector(law_.dt() * angular(rate))};
    const int from_tick = ticks / 2;
    const double weight = 1.0 / (ticks - from_tick);
    for (int i = 0; i < ticks; ++i) {
        if (i == 0 ? !evaluate(from) : law_.resist() != KERF_OK) return response;
        if (i >= from_tick) {
            const Vec6 wrench = law_.force_at(rate);
            for (std::size_t k = 0; k < 6; ++k) response.wrench[k] += weight * wrench[k];
            for (const kerf_channel& c : law_.channels()) {
                const double lambda = channel_force(c, dot(direction(c), rate), law_.dt()).lambda;
                response.loaded += weight * std::abs(lambda);
                if (c.kind == KERF_CUT) response.cutting += weight * lambda;
            }
        }
        if (law_.commit(law_.pose() * step) != KERF_OK) return response;
        const kerf_commit_out& out = law_.committed();
        const auto is_cut = [](const kerf_action& a) {
            return a.kind == KERF_ACTION_CUT && a.value == KERF_CUT_REGION;
        };
        if (std::any_of(out.action, out.action + std::min(out.action_count, KERF_MAX_ACTIONS), is_cut))
            ++response.cut_ticks;
    }
    response.signals.assign(law_.signals().begin(), law_.signals().end());
    return response;
}

Vec6 LawProbe::feed(double speed) const {
    const Subject& subject = law_.subject();
    if (subject.tool->tool->feed == KERF_FEED_SIDE) return {speed, 0, 0, 0, 0, 0};
    return {0, 0, speed, 0, 0, speed * turn_of_feed(subject.setup(), law_.outline())};
}

std::vector<std::pair<std::string, Vec6>> LawProbe::motions(double speed) const {
    const Subject& subject = law_.subject();
    std::vector<std::pair<std::string, Vec6>> motions{{"fed", feed(speed)}};
    if (subject.tool->tool->feed != KERF_FEED_AXIS || is_threaded() ||
        (subject.force->force->does_not & KERF_DOES_NOT_RESIST_SIDEWAYS) != 0)
        return motions;
    for (const Vec3 v : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}})
        motions.emplace_back("moved along " + name_of_direction(v), make_vec6(speed * v, {}));
    return motions;
}

LawProbe::Help LawProbe::largest_help() {
    Help help;
    for (const Vec3 v : all_directions()) {
        const Vec3 f = move(at_depth(0), make_vec6(probe_speed * v, {})).force();
        help.largest = std::max(help.largest, length(f));
        if (const double newtons = dot(f, v); newtons > help.newtons) {
            help.newtons = newtons;
            help.force = f;
            help.along = v;
        }
    }
    return help;
}

double against(const Response& response, const Vec6& rate) {
    return -dot(response.force(), (1.0 / length(linear(rate))) * linear(rate));
}

std::vector<double> drives_at(const kerf_component& tool, double fraction) {
    std::vector<double> drives;
    for (std::uint32_t i = 0; i < tool.tool->drive_count; ++i) {
        const kerf_drive& row = tool.tool->drives[i];
        drives.push_back(std::clamp(fraction * row.def, row.min, row.max));
    }
    return drives;
}

const std::array<Vec3, 26>& all_directions() {
    static const std::array<Vec3, 26> directions = [] {
        std::array<Vec3, 26> all{};
        std::size_t count = 0;
        for (const double x : {0.0, 1.0, -1.0})
            for (const double y : {0.0, 1.0, -1.0})
                for (const double z : {0.0, 1.0, -1.0})
                    if (x != 0.0 || y != 0.0 || z != 0.0)
                        all[count++] = (1.0 / std::sqrt(x * x + y * y + z * z)) * Vec3{x, y, z};
        return all;
    }();
    return directions;
}

std::string in_newtons(Vec3 force) {
    return "(" + number(force.x) + ", " + number(force.y) + ", " + number(force.z) + ") N";
}

std::string name_of_direction(Vec3 direction) {
    std::string text;
    const auto add = [&](double part, const char* axis) {
        if (std::abs(part) > 0.1) text += (text.empty() ? "" : " ") + std::string(part > 0.0 ? "+" : "-") + axis;
    };
    add(direction.x, "x");
    add(direction.y, "y");
    add(direction.z, "z");
    return text;
}

Vec6 rotated(Quat by, const Vec6& wrench) { return make_vec6(rotate(by, linear(wrench)), rotate(by, angular(wrench))); }

}  // namespace kerf::conformance
