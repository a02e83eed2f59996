// SPDX-License-Identifier: Apache-2.0
#include "conformance/acceptance_run.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "conformance/sandbox.h"
#include "conformance/subject.h"
#include "conformance/tool_rig.h"
#include "core/plugin/plain_text.h"

namespace kerf::conformance {

namespace {

using Json = nlohmann::json;

/// In the child: the subject, and six numbers a row.
std::string wrenches_along(const std::string& plugin, const AcceptanceFile& file) {
    PluginLoad load = load_tried_plugin(plugin);
    if (load.plugin == nullptr) return Json{{"error", load.refusal}}.dump();
    const auto names = subjects_of(load.plugin->entry());
    std::string known;
    const SubjectName* chosen = nullptr;
    for (const SubjectName& name : names) {
        if (name.scope != Scope::law) continue;
        known += (known.empty() ? "`" : ", `") + name.name + "`";
        if (chosen == nullptr && (file.subject.empty() || file.subject == name.name)) chosen = &name;
    }
    if (chosen == nullptr)
        return Json{{"error", known.empty()
                                  ? "the plugin has no law. Only a law has forces to record."
                                  : "the plugin has no law " + quoted_plain(file.subject) + "; it has " + known + "."}}
            .dump();
    const Subject subject = subject_of(std::move(load.plugin), *chosen);
    ToolRig rig(subject, {.thickness = 12e-3});
    Json answer{{"subject", chosen->name}, {"wrenches", Json::array()}};
    double drive = 1.0;
    for (std::size_t r = 0; r < file.rows.size(); ++r) {
        const AcceptanceRow& row = file.rows[r];
        if (row.drive != drive) rig.drive(drive = row.drive);
        const AcceptanceRow& last = r == 0 ? row : file.rows[r - 1];
        const std::uint64_t count = r == 0 ? 1 : row.tick - last.tick;
        const Pose &from = last.block_from_tool, &to = row.block_from_tool;
        const Vec3 turn = small_rotation_vector(conjugate(from.rotation) * to.rotation);
        TickResult tick;
        for (std::uint64_t i = 1; i <= count; ++i) {
            const double share = static_cast<double>(i) / static_cast<double>(count);
            if (tick.is_quarantined) break;
            tick = rig.lead({from.position + share * (to.position - from.position),
                             from.rotation * quat_from_rotation_vector(share * turn)});
        }
        if (tick.is_quarantined)
            return Json{{"error", "the law was shut off before tick " + std::to_string(row.tick) +
                                      ": it gave what no tool can follow. `kerf check` names the channel."}}
                .dump();
        const Vec3 force = linear(tick.bone_on_tool), torque = angular(tick.bone_on_tool);
        answer["wrenches"].push_back({force.x, force.y, force.z, torque.x, torque.y, torque.z});
    }
    return answer.dump();
}

}  // namespace

std::string run_script(const std::string& plugin, AcceptanceFile& file) {
    const Ended ended =
        run_in_child([&] { return wrenches_along(plugin, file); }, {.cpu_seconds = 120, .wall_seconds = 300});
    if (ended.how != Ended::How::returned) return ended.text;
    const Json answer = Json::parse(ended.text, nullptr, false);
    if (!answer.is_object()) return "the kit's child gave no answer.";
    if (answer.contains("error")) return answer["error"];
    file.subject = answer["subject"];
    for (std::size_t r = 0; r < file.rows.size(); ++r)
        file.rows[r].wrench = answer["wrenches"].at(r).get<std::array<double, 6>>();
    return {};
}

}  // namespace kerf::conformance
