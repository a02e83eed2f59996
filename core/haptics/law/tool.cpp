// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/law/tool.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "core/plugin/number_text.h"
#include "core/plugin/plugin_call.h"
#include "kerf/units.hpp"

namespace kerf {

namespace {

/// Returns the index of the table entry with this id and dimension.
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
    kerf_solid solid{.size = sizeof(kerf_solid),
                     .kind = static_cast<std::uint32_t>(whole.is_prism() ? KERF_SOLID_PRISM : KERF_SOLID_REVOLUTION),
                     .profile = profile.data(),
                     .profile_count = static_cast<std::uint32_t>(profile.size()),
                     .cutting_first = cutting_first,
                     .cutting_count = cutting_count,
                     .bore = cutting.bore(),
                     .gap_count = static_cast<std::uint32_t>(gaps.size()),
                     .reserved = 0,
                     .gap = {}};
    std::copy(gaps.begin(), gaps.end(), solid.gap);
    return solid;
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

/// Returns the plugin's own reason for refusing the parameters, with spaces for control characters.
std::string why_refused(const kerf_tool_shape& shape) {
    const char* end = std::find(std::begin(shape.refusal), std::end(shape.refusal), '\0');
    std::string words(shape.refusal, end);
    std::replace_if(
        words.begin(), words.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20u || c == 0x7f; }, ' ');
    return words.empty() ? "it refused them." : words;
}

constexpr double widest = 0.1;  // [m]

std::string in_mm(double metres) { return number_text(1e3 * metres, 6) + " mm"; }

std::string point(std::uint32_t i, const char* field, double value, const std::string& expected) {
    return "point " + std::to_string(i) + ": `" + field + "` is " + in_mm(value) + ", expected " + expected + ".";
}

/// Returns the fault in the bending values, or an empty text. Deflection and slope at the tip are both 0, or both are
/// positive and at most a limit.
std::string fault_of_bending(const kerf_tool_shape& shape) {
    constexpr double softest = 0.1, steepest = 10.0;  // [m/N], [rad/N]
    const auto out_of = [](const char* field, double value, double maximum, const char* unit) {
        return std::string("`") + field + "` is " + number_text(value, 6) + " " + unit + ", expected 0 … " +
               number_text(maximum, 6) + " " + unit + ".";
    };
    if (!(shape.tip_deflection >= 0.0 && shape.tip_deflection <= softest))
        return out_of("tip_deflection", shape.tip_deflection, softest, "m/N");
    if (!(shape.tip_slope >= 0.0 && shape.tip_slope <= steepest))
        return out_of("tip_slope", shape.tip_slope, steepest, "rad/N");
    if ((shape.tip_deflection > 0.0) != (shape.tip_slope > 0.0))
        return "`tip_deflection` and `tip_slope` must both be 0, or neither.";
    return {};
}

/// Returns the fault in the bore, or an empty text. A bore must be narrower than the cutting part at every point.
std::string fault_of_bore(const kerf_tool_shape& shape) {
    if (shape.bore == 0.0) return {};
    if (shape.kind != KERF_SOLID_REVOLUTION)
        return "`bore` is " + in_mm(shape.bore) + ", expected 0 mm: only a solid of revolution has one.";
    if (shape.cutting_count == 0)
        return "`bore` is " + in_mm(shape.bore) + ", expected 0 mm: the tool removes no bone.";
    double narrowest = widest;
    for (std::uint32_t i = 0; i < shape.cutting_count; ++i)
        narrowest = std::min(narrowest, shape.profile[shape.cutting_first + i].radius);
    if (shape.bore > 0.0 && shape.bore < narrowest) return {};
    if (narrowest == 0.0) return "`bore` is " + in_mm(shape.bore) + ", expected 0 mm: what cuts comes to a point.";
    return "`bore` is " + in_mm(shape.bore) + ", expected 0 mm, or more and less than " + in_mm(narrowest) +
           ", the narrowest radius of what cuts. Make the tool wider or the bore narrower.";
}

/// Returns the fault in the gaps, or an empty text. A gap lies within the cutting region, with a part that cuts before
/// it and behind it.
std::string fault_of_gaps(const kerf_tool_shape& shape) {
    if (shape.gap_count > KERF_MAX_GAPS)
        return "`gap_count` is " + std::to_string(shape.gap_count) + ", expected 0 … " + std::to_string(KERF_MAX_GAPS) +
               ".";
    if (shape.gap_count > 0 && shape.kind != KERF_SOLID_REVOLUTION)
        return "`gap_count` is " + std::to_string(shape.gap_count) +
               ", expected 0: only a solid of revolution has several parts that cut.";
    std::uint32_t before = shape.cutting_first;
    for (std::uint32_t i = 0; i < shape.gap_count; ++i) {
        const auto& [first, last] = shape.gap[i];
        if (first <= before || last <= first || last + 1 >= shape.cutting_first + shape.cutting_count)
            return "gap " + std::to_string(i) + " reaches from point " + std::to_string(first) + " to point " +
                   std::to_string(last) + ", expected two of those between " + std::to_string(before) + " and " +
                   std::to_string(shape.cutting_first + shape.cutting_count - 1) +
                   ": each part that cuts has two points at least.";
        before = last;
    }
    return {};
}

/// Returns the fault in the outline, or an empty text. Cutting works with any radii along an outline that does not turn
/// back along the axis (tests/core/field/outline_sweep_test.cpp). So the radii need not be monotone.
std::string fault_of_outline(const kerf_tool_shape& shape, std::uint32_t capacity) {
    const auto count = [](const char* field, std::uint32_t is, std::uint32_t minimum, std::uint32_t maximum) {
        return std::string("`") + field + "` is " + std::to_string(is) + ", expected " + std::to_string(minimum) +
               " … " + std::to_string(maximum) + ".";
    };
    if (shape.profile_count < 2 || shape.profile_count > capacity)
        return count("profile_count", shape.profile_count, 2, capacity);
    if (shape.cutting_first >= shape.profile_count)
        return count("cutting_first", shape.cutting_first, 0, shape.profile_count - 1);
    const std::uint32_t behind = shape.profile_count - shape.cutting_first;
    if (shape.cutting_count == 1 || shape.cutting_count > behind ||
        (shape.cutting_count == 0 && shape.cutting_first > 0))
        return "`cutting_count` is " + std::to_string(shape.cutting_count) +
               (shape.cutting_first > 0 ? " from point " + std::to_string(shape.cutting_first) + " on" : "") +
               ", expected " + (shape.cutting_first > 0 ? "" : "0, or ") + "2 … " + std::to_string(behind) +
               (shape.cutting_first > 0
                    ? ": what cuts has two points at least. List them between `safe()` and `cuts()`."
                    : ".");
    if (shape.reserved != 0 || shape.reserved2 != 0)
        return "`reserved` is " + std::to_string(shape.reserved) + ", expected 0.";
    for (std::uint32_t i = 0; i < shape.profile_count; ++i) {
        const auto& [z, radius] = shape.profile[i];
        if (!std::isfinite(z)) return point(i, "z", z, "a finite number");
        if (!(radius >= 0.0 && radius < widest)) return point(i, "radius", radius, "0 mm … " + in_mm(widest));
        if (i > 0 && !(z < shape.profile[i - 1].z))
            return point(i, "z", z,
                         "less than " + in_mm(shape.profile[i - 1].z) +
                             ", the `z` of the point before it: list the points from the tip backwards");
    }
    if (const std::string fault = fault_of_bore(shape); !fault.empty()) return fault;
    if (const std::string fault = fault_of_gaps(shape); !fault.empty()) return fault;
    constexpr double longest = 1.0;  // [m]
    if (const double tip = shape.profile[0].z; !(shape.grip_z < tip && shape.grip_z > tip - longest))
        return "`grip_z` is " + in_mm(shape.grip_z) + ", expected a point less than " + in_mm(longest) +
               " behind the tip at " + in_mm(tip) + ".";
    if (shape.hands > 2) return count("hands", shape.hands, 0, 2);
    return fault_of_bending(shape);
}

/// Returns the fault in a prism, or an empty text. A prism must be convex, so its outline may bend towards the axis
/// only. Its thickness is at most its kerf.
std::string fault_of_prism(const kerf_tool_shape& shape) {
    for (std::uint32_t i = 2; i < shape.profile_count; ++i) {
        const auto &a = shape.profile[i - 2], &b = shape.profile[i - 1], &c = shape.profile[i];
        if ((c.radius - b.radius) * (b.z - a.z) >= (b.radius - a.radius) * (c.z - b.z)) continue;
        const double maximum = b.radius + (b.radius - a.radius) * (c.z - b.z) / (b.z - a.z);
        return point(i, "radius", c.radius, "at most " + in_mm(maximum) + ", on the line through the two before it");
    }
    if (!(shape.kerf > 0.0 && shape.kerf < 0.1))
        return "`kerf` is " + in_mm(shape.kerf) + ", expected more than 0 mm and less than 100 mm.";
    if (!(shape.thickness > 0.0 && shape.thickness <= shape.kerf))
        return "`thickness` is " + in_mm(shape.thickness) + ", expected more than 0 mm and at most the kerf of " +
               in_mm(shape.kerf) + ".";
    return {};
}

/// Returns the fault in the thread or in the part that stays in bone, or an empty text. A thread is on the cutting
/// part, and only a tool with a thread can stay.
std::string fault_of_thread(const kerf_tool_shape& shape) {
    if (shape.thread_radius == 0.0)
        return shape.stay_count == 0 ? ""
                                     : "`stay_count` is " + std::to_string(shape.stay_count) +
                                           ", expected 0: without a thread nothing holds it in bone.";
    if (shape.kind != KERF_SOLID_REVOLUTION || shape.cutting_count < 2)
        return "`thread_radius` is " + in_mm(shape.thread_radius) +
               ", expected 0 mm: only a solid of revolution that removes bone has one.";
    double core = 0.0;
    if (shape.cutting_first > 0 || shape.bore > 0.0 || shape.gap_count > 0)
        return "`thread_radius` is " + in_mm(shape.thread_radius) +
               ", expected 0 mm: what has a thread cuts from its tip on, in one part, and has no bore.";
    for (std::uint32_t i = 0; i < shape.cutting_count; ++i) core = std::max(core, shape.profile[i].radius);
    if (!(shape.thread_radius >= core && shape.thread_radius < widest))
        return "`thread_radius` is " + in_mm(shape.thread_radius) + ", expected 0 mm, or " + in_mm(core) +
               ", the widest that it cuts, to " + in_mm(widest) + ".";
    constexpr double longest = 0.1;  // [m]
    if (!(shape.thread_lead > 0.0 && shape.thread_lead < longest))
        return "`thread_lead` is " + in_mm(shape.thread_lead) + ", expected more than 0 mm and less than " +
               in_mm(longest) + ".";
    if (shape.thread_count < 2 || shape.thread_count > shape.cutting_count)
        return "`thread_count` is " + std::to_string(shape.thread_count) + ", expected 2 … " +
               std::to_string(shape.cutting_count) + ": a thread is on what cuts.";
    if (shape.stay_count != 0 && (shape.stay_count < shape.cutting_count || shape.stay_count > shape.profile_count))
        return "`stay_count` is " + std::to_string(shape.stay_count) + ", expected 0, or " +
               std::to_string(shape.cutting_count) + " … " + std::to_string(shape.profile_count) +
               ": all that cuts, and the head.";
    return {};
}

/// The answer of a tool's `shape`.
struct MadeShape {
    static constexpr std::uint32_t capacity = 64;
    kerf_profile_point points[capacity]{};
    kerf_tool_shape shape{};
    kerf_status status;

    explicit MadeShape(const ToolSetup& setup) {
        shape.size = sizeof shape;
        shape.profile = points;
        shape.profile_capacity = capacity;
        shape.kind = KERF_SOLID_REVOLUTION;
        status = call_shape(*setup.tool, setup.tool_parameters.data(), shape);
        shape.profile = points;
    }
    MadeShape(const MadeShape&) = delete;
    MadeShape& operator=(const MadeShape&) = delete;

    /// Pre: both are outlines.
    [[nodiscard]] bool is_same_as(const MadeShape& other) const {
        const auto values = [](const kerf_tool_shape& s) {
            kerf_tool_shape copy = s;
            copy.profile = nullptr;
            std::fill(std::begin(copy.refusal), std::end(copy.refusal), '\0');
            return copy;
        };
        const kerf_tool_shape a = values(shape), b = values(other.shape);
        return other.status == status && std::memcmp(&a, &b, sizeof a) == 0 &&
               std::memcmp(points, other.points, shape.profile_count * sizeof(kerf_profile_point)) == 0;
    }
};

}  // namespace

bool outline_of(const ToolSetup& setup, ToolOutline& out, std::string& error) {
    constexpr std::uint32_t capacity = MadeShape::capacity;
    constexpr double heaviest = 20.0;  // [kg]
    const MadeShape made(setup);
    kerf_tool_shape shape = made.shape;
    const kerf_profile_point* const points = made.points;
    if (made.status != KERF_OK) {
        error =
            std::string("tool `") + setup.tool->id + "` cannot be made from these parameters: " + why_refused(shape);
        return false;
    }
    if (const std::string fault = fault_of_outline(shape, capacity); !fault.empty()) {
        error = std::string("tool `") + setup.tool->id + "` gives an outline that is no solid: " + fault;
        return false;
    }
    if (!made.is_same_as(MadeShape(setup))) {
        error = std::string("tool `") + setup.tool->id +
                "` gives two outlines for the same parameters, expected one: `shape` depends on something else.";
        return false;
    }
    out.handling = {shape.grip_z, shape.hands == 2 ? 2 : 1, {shape.tip_deflection, shape.tip_slope}};
    out.profile.assign(points, points + shape.profile_count);
    out.cutting_first = shape.cutting_first;
    out.cutting_count = shape.cutting_count;
    out.gaps.assign(shape.gap, shape.gap + shape.gap_count);
    if (const std::string fault = fault_of_thread(shape); !fault.empty()) {
        error = std::string("tool `") + setup.tool->id + "` gives a thread that cannot be: " + fault;
        return false;
    }
    out.thread_radius = shape.thread_radius;
    out.thread_lead = shape.thread_lead;
    out.thread_count = shape.thread_count;
    out.stay_count = shape.stay_count;
    if (shape.cutting_count == 0)
        shape.cutting_count = 2;  // the cutting solid of a tool that removes nothing, never used
    out.inertia = {shape.mass, shape.centre_z, shape.gyration};
    const bool has_mass = shape.mass > 0.0 && shape.mass <= heaviest && std::abs(shape.centre_z) < 1.0 &&
                          shape.gyration > 0.0 && shape.gyration < 1.0;
    if (shape.mass != 0.0 && !has_mass) {
        error = std::string("tool `") + setup.tool->id +
                "` has a mass that no hand holds: it needs 0 to 20 kg, centred within 1 m of the tip, with a radius of "
                "gyration above 0 mm.";
        return false;
    }
    const kerf_profile_point* const cutting = points + shape.cutting_first;
    if (shape.kind == KERF_SOLID_PRISM) {
        if (const std::string fault = fault_of_prism(shape); !fault.empty()) {
            error = std::string("tool `") + setup.tool->id + "` gives a prism that is no blade: " + fault;
            return false;
        }
        out.cutting = ToolSolid::prism({cutting, cutting + shape.cutting_count}, shape.kerf);
        out.whole = ToolSolid::prism({points, points + shape.profile_count}, shape.thickness);
        return true;
    }
    if (shape.kind != KERF_SOLID_REVOLUTION) {
        error = std::string("tool `") + setup.tool->id + "` gives a solid of kind " + std::to_string(shape.kind) +
                "; this Kerf knows 1, a solid of revolution, and 2, a prism.";
        return false;
    }
    const std::vector<kerf_profile_point> region{cutting, cutting + shape.cutting_count};
    std::vector<ToolSolid::Gap> gaps;
    for (const auto& [first, last] : out.gaps) gaps.push_back({points[first].z, points[last].z});
    out.cutting = ToolSolid::parts(region, shape.bore, gaps);
    if (out.has_thread())
        out.crest = ToolSolid({{points[shape.thread_count > 2 ? 1 : 0].z, out.thread_radius},  // without the tip
                               {points[shape.thread_count - 1].z, out.thread_radius}});
    if (out.is_implant()) out.staying = ToolSolid({points, points + out.stay_count});
    out.whole = ToolSolid({points, points + shape.profile_count});
    return true;
}

double turn_of_feed(const ToolSetup& setup, const ToolOutline& outline) noexcept {
    if (setup.tool->tool->feed != KERF_FEED_TURN) return 0.0;
    return 2.0 * std::numbers::pi / (outline.has_thread() ? outline.thread_lead : 1e-3);
}

}  // namespace kerf
