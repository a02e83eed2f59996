// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/tool.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include "kerf/units.hpp"

namespace kerf {

namespace {

/// The index of the entry of a table with this id and dimension.
template <class Entry>
std::optional<std::uint32_t> find(const Entry* table, std::uint32_t count, const kerf_need& need) {
    for (std::uint32_t i = 0; i < count; ++i)
        if (std::string_view(table[i].id) == need.id && table[i].dimension == need.dimension) return i;
    return std::nullopt;
}

}  // namespace

std::string bind_law(ToolSetup& setup) {
    const kerf_component& tool = *setup.tool;
    const kerf_force& law = *setup.force->force;
    setup.bound.clear();
    for (std::uint32_t i = 0; i < law.need_count; ++i) {
        const kerf_need& need = law.needs[i];
        const bool is_drive = need.kind == KERF_NEED_DRIVE;
        const auto at = is_drive ? find(tool.tool->drives, tool.tool->drive_count, need)
                                 : find(tool.params, tool.param_count, need);
        if (!at)
            return std::string("the force `") + setup.force->id + "` needs a tool with the " +
                   (is_drive ? "drive" : "parameter") + " `" + need.id + "`; `" + tool.id +
                   "` has none of that dimension.";
        setup.bound.push_back(*at);
    }
    if (law.tool_count == 0) return {};
    const auto* const end = law.tools + law.tool_count;
    const auto* const held =
        std::find_if(law.tools, end, [&](const char* id) { return std::string_view(id) == tool.id; });
    if (held == end) {
        std::string all;
        for (const auto* id = law.tools; id != end; ++id) all += (all.empty() ? "`" : ", `") + std::string(*id) + "`";
        return std::string("the force `") + setup.force->id + "` does not take the tool `" + tool.id + "`; it takes " +
               all + ".";
    }
    setup.held = static_cast<std::uint32_t>(held - law.tools);
    return {};
}

kerf_solid ToolOutline::solid() const noexcept {
    return {.size = sizeof(kerf_solid),
            .kind = static_cast<std::uint32_t>(whole.is_prism() ? KERF_SOLID_PRISM : KERF_SOLID_REVOLUTION),
            .profile = profile.data(),
            .profile_count = static_cast<std::uint32_t>(profile.size()),
            .cutting_count = cutting_count};
}

kerf_tick_in tick_in_of(const ToolSetup& setup, const kerf_bone_query& bone, double dt) noexcept {
    kerf_tick_in in{};
    in.size = sizeof in;
    in.dt = dt;
    in.tool_params = setup.tool_parameters.data();
    in.tool_param_count = static_cast<std::uint32_t>(setup.tool_parameters.size());
    in.tool = setup.held;
    in.tool_id = setup.tool->id;
    in.bound = setup.bound.data();
    in.force_params = setup.force_parameters.data();
    in.drive = setup.drives.data();
    in.bone = &bone;
    return in;
}

namespace {

/// In a plugin's words, as far as they are fit to print.
std::string why_refused(const kerf_tool_shape& shape) {
    const char* end = std::find(std::begin(shape.refusal), std::end(shape.refusal), '\0');
    std::string words(shape.refusal, end);
    std::replace_if(
        words.begin(), words.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20u || c == 0x7f; }, ' ');
    return words.empty() ? "it refused them." : words;
}

}  // namespace

bool outline_of(const ToolSetup& setup, ToolOutline& out, std::string& error) {
    constexpr std::uint32_t capacity = 64;
    constexpr double heaviest = 20.0;  // [kg]
    kerf_profile_point points[capacity];
    kerf_tool_shape shape{};
    shape.size = sizeof shape;
    shape.profile = points;
    shape.profile_capacity = capacity;
    shape.kind = KERF_SOLID_REVOLUTION;
    if (setup.tool->tool->shape(setup.tool_parameters.data(), &shape) != KERF_OK) {
        error =
            std::string("tool `") + setup.tool->id + "` cannot be made from these parameters: " + why_refused(shape);
        return false;
    }
    bool is_sound = shape.profile_count >= 2 && shape.profile_count <= capacity && shape.cutting_count != 1 &&
                    shape.cutting_count <= shape.profile_count && std::isfinite(shape.grip_z);
    for (std::uint32_t i = 0; is_sound && i < shape.profile_count; ++i)
        is_sound = std::isfinite(points[i].z) && points[i].radius >= 0.0 && points[i].radius < 0.1 &&
                   (i == 0 || points[i].z < points[i - 1].z);
    if (!is_sound) {
        error = std::string("tool `") + setup.tool->id +
                "` gives an outline that is no solid: list (z, radius) from the tip backwards, in metres.";
        return false;
    }
    out.grip_z = shape.grip_z;
    out.profile.assign(points, points + shape.profile_count);
    out.cutting_count = shape.cutting_count;
    if (shape.cutting_count == 0) shape.cutting_count = 2;  // it removes nothing: a tip is enough
    out.inertia = {shape.mass, shape.centre_z, shape.gyration};
    const bool has_mass = shape.mass > 0.0 && shape.mass <= heaviest && std::abs(shape.centre_z) < 1.0 &&
                          shape.gyration > 0.0 && shape.gyration < 1.0;
    if (shape.mass != 0.0 && !has_mass) {
        error = std::string("tool `") + setup.tool->id +
                "` has a mass that no hand holds: it needs 0 to 20 kg, centred within 1 m of the tip, with a radius of "
                "gyration above 0 mm.";
        return false;
    }
    if (shape.kind == KERF_SOLID_PRISM) {
        bool is_convex = true;  // backwards the outline bends towards the axis only
        for (std::uint32_t i = 2; i < shape.profile_count; ++i) {
            const auto &a = points[i - 2], &b = points[i - 1], &c = points[i];
            is_convex = is_convex && (c.radius - b.radius) * (b.z - a.z) >= (b.radius - a.radius) * (c.z - b.z);
        }
        if (!is_convex || !(shape.thickness > 0.0 && shape.thickness <= shape.kerf && shape.kerf < 0.1)) {
            error = std::string("tool `") + setup.tool->id +
                    "` gives a prism that is no blade: it needs a convex outline, a thickness above 0 mm and a kerf "
                    "from that to 100 mm.";
            return false;
        }
        out.cutting = ToolSolid::prism({points, points + shape.cutting_count}, shape.kerf);
        out.whole = ToolSolid::prism({points, points + shape.profile_count}, shape.thickness);
        return true;
    }
    if (shape.kind != KERF_SOLID_REVOLUTION) {
        error = std::string("tool `") + setup.tool->id + "` gives a solid of kind " + std::to_string(shape.kind) +
                "; this Kerf knows 1, a solid of revolution, and 2, a prism.";
        return false;
    }
    out.cutting = ToolSolid({points, points + shape.cutting_count});
    out.whole = ToolSolid({points, points + shape.profile_count});
    return true;
}

}  // namespace kerf
