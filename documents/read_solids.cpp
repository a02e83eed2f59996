// SPDX-License-Identifier: Apache-2.0
#include "documents/read_solids.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "documents/shapes/shapes.h"
#include "kerf/units.hpp"
#include "text/codes.h"
#include "text/printable.h"
#include "text/quantity.h"

namespace kerf::documents {
namespace {

EllipticTubeSolid read_elliptic_tube(const Node& node, const std::string& name, Report& report) {
    EllipticTubeSolid tube;
    MapReader map(node, shapes::elliptic_tube, name, report);
    read_ends(map, tube, name);
    shapes::elliptic_tube.fill(map, tube);
    if (const Node* up = map.find("up")) {
        tube.up = read_vector(*up, map.name_of("up"), map.need_of("up"), report).value_or(tube.up);
        const Vec3 along = normalized(tube.to - tube.from);
        if (length(cross(along, normalized(tube.up))) < 1e-3 && length(along) > 0.0)
            report.error(text::Code::degenerate, up->span,
                         map.name_of("up") + " points along the tube, expected across it. Turn it.");
    }
    map.finish();
    return tube;
}

SuperellipsoidSolid read_superellipsoid(const Node& node, const std::string& name, Report& report) {
    SuperellipsoidSolid solid;
    MapReader map(node, shapes::superellipsoid, name, report);
    shapes::superellipsoid.fill(map, solid);
    const auto read = [&](const char* key, Vec3& into) {
        const Node* found = map.find(key);
        if (found != nullptr) into = read_vector(*found, map.name_of(key), map.need_of(key), report).value_or(into);
        return found;
    };
    const Node* along = read("along", solid.along);
    const Node* up = read("up", solid.up);
    if (length(cross(normalized(solid.along), normalized(solid.up))) < 1e-3)
        report.error(text::Code::degenerate,
                     (up      ? up
                      : along ? along
                              : &node)
                         ->span,
                     name + ".up points along `along`, expected across it. Turn it.");
    map.finish();
    return solid;
}

/// Reads a point of an outline: two numbers and a unit.
std::optional<Vec3> read_outline_point(const Node& node, const std::string& name, Report& report) {
    const std::optional<std::string> text = read_text(node, name, report);
    if (!text) return std::nullopt;
    const std::size_t gap = text->find(' '), unit = gap == std::string::npos ? gap : text->find(' ', gap + 1);
    if (unit == std::string::npos) {
        report.error(text::Code::not_a_number, node.span,
                     name + " has a point that is not two numbers and a unit: got " + text::excerpt(*text) +
                         ". Write `-9 6.5 mm`.");
        return std::nullopt;
    }
    const text::QuantityNeed need{dimension::length, "mm", -0.5, 0.5};
    const auto parsed = [&](const std::string& number) -> std::optional<double> {
        const text::Parsed<double> one = text::parse_quantity(number + text->substr(unit), name, need);
        if (!one.value) report.error(one.problem.code, node.span, one.problem.message, one.problem.write);
        return one.value;
    };
    const std::optional<double> x = parsed(text->substr(0, gap)),
                                y = x ? parsed(text->substr(gap + 1, unit - gap - 1)) : std::nullopt;
    if (!y) return std::nullopt;
    return Vec3{*x, *y, 0.0};
}

/// Reads a section: a superellipse, or an outline that runs anticlockwise in either order of writing.
void read_section(const Node& node, const std::string& name, LoftSection& section, Report& report) {
    constexpr std::size_t min_points = 3, max_points = 64;
    MapReader map(node, shapes::loft_section, name, report);
    shapes::loft_section.fill(map, section);
    const Node* outline = map.find("outline");
    const auto has = [&](const char* key) { return map.find(key) != nullptr; };
    if (outline == nullptr) {
        for (const char* key : {"width", "height"})
            if (!has(key))
                report.error(
                    text::Code::missing_key, node.span,
                    name + " has a section without `" + key + "`. Write `" + key + ": 20 mm`, or an `outline:`.");
    } else {
        const std::array others{"width", "height", "exponent", "taper"};
        if (const auto other = std::find_if(others.begin(), others.end(), has); other != others.end())
            report.error(
                text::Code::one_of, map.find(*other)->span,
                "`" + std::string(*other) + "` does not belong to a section with an `outline:`. Leave one out.");
        const std::string outline_name = map.name_of("outline");
        const int errors = report.errors();
        for (const Node& item : read_list(*outline, outline_name, report)) {
            if (report.errors() > errors || section.outline.size() > max_points) break;
            if (const auto point = read_outline_point(item, outline_name, report)) section.outline.push_back(*point);
        }
        if (report.errors() > errors)
            section.outline.clear();
        else if (section.outline.size() < min_points || section.outline.size() > max_points)
            report.error(text::Code::out_of_range, outline->span,
                         outline_name + " has " + std::to_string(outline->children.size()) + " points, expected " +
                             std::to_string(min_points) + " to " + std::to_string(max_points) + ".");
        else if (crosses_itself(smoothed(section.outline)))
            report.error(text::Code::degenerate, outline->span,
                         outline_name + " crosses itself. Write its points in their order around the section.");
    }
    map.finish();
}

/// Checks that all sections have an outline with as many points, running in the same direction, or none; turns them
/// anticlockwise. Returns false if not.
bool check_outlines(LoftSolid& loft, const Node& sections, Report& report) {
    const Outline& first = loft.sections.front().outline;
    const double enclosed = area_of(first);
    for (std::size_t i = 1; i < loft.sections.size(); ++i) {
        const Outline& outline = loft.sections[i].outline;
        const std::string problem = outline.size() != first.size()
                                        ? "has " + std::to_string(outline.size()) +
                                              " points in its outline, the first section " +
                                              std::to_string(first.size()) + ": expected as many"
                                    : area_of(outline) * enclosed < 0.0
                                        ? "has an outline in the opposite direction to that of the first section"
                                        : std::string();
        if (problem.empty()) continue;
        report.error(text::Code::degenerate, sections.children[i].span,
                     "This section " + problem + ". Points of the same place belong together.");
        return false;
    }
    if (enclosed < 0.0)
        for (LoftSection& section : loft.sections) std::reverse(section.outline.begin(), section.outline.end());
    return true;
}

/// Checks `up` of a loft: it is across the path everywhere.
void check_path(LoftSolid& loft, const Node& sections, const Node* up, const std::string& name, Report& report) {
    constexpr double shortest = 0.1e-3;  // [m] between sections
    constexpr double min_across = 0.1;   // [–] sine of the angle between `up` and the path
    for (std::size_t i = 1; i < loft.sections.size(); ++i)
        if (length(loft.sections[i].at - loft.sections[i - 1].at) < shortest) {
            report.error(
                text::Code::degenerate, sections.children[i].span,
                "This section lies where the one before lies: expected at least 0.1 mm between them. Move it.");
            return;
        }
    lay_path(loft);
    const bool is_across = std::all_of(loft.path.begin(), loft.path.end(), [&](const LoftFrame& frame) {
        return length(cross(frame.along, normalized(loft.up))) >= min_across;
    });
    if (!is_across) {
        report.error(text::Code::degenerate, up != nullptr ? up->span : sections.span,
                     name + ".up points along the path somewhere, expected across it. Turn it.");
        return;
    }
    if (const double found = crossing(loft); found >= 1.0)
        report.error(text::Code::degenerate, sections.span,
                     "The sections of " + name +
                         " cross where its path bends: the bend's radius is smaller than half of the section there. "
                         "Make the section smaller, or the path straighter.");
    else if (has_crossed_outline(loft))
        report.error(text::Code::degenerate, sections.span,
                     "The outlines of " + name +
                         " cross themselves between two sections. Begin them at the same place, or add a section.");
}

LoftSolid read_loft(const Node& node, const std::string& name, Report& report) {
    constexpr std::size_t max_sections = 64;
    LoftSolid loft;
    MapReader map(node, shapes::loft, name, report);
    shapes::loft.fill(map, loft);
    const int errors_before = report.errors();
    const Node* up = map.find("up");
    if (up != nullptr) loft.up = read_vector(*up, map.name_of("up"), map.need_of("up"), report).value_or(loft.up);
    const Node* sections = map.find("sections");
    if (sections != nullptr) {
        for (const Node& item : read_list(*sections, map.name_of("sections"), report)) {
            if (loft.sections.size() == max_sections) break;
            read_section(item, map.name_of("sections"), loft.sections.emplace_back(), report);
        }
        if (loft.sections.size() < 2 || sections->children.size() > max_sections)
            report.error(text::Code::out_of_range, sections->span,
                         map.name_of("sections") + " has " + std::to_string(sections->children.size()) +
                             " sections, expected 2 to " + std::to_string(max_sections) + ".");
    }
    map.finish();
    if (report.errors() > errors_before || sections == nullptr || loft.sections.size() < 2) return {};
    if (!check_outlines(loft, *sections, report)) return {};
    check_path(loft, *sections, up, name, report);
    return loft;
}

Vec3 mirrored(Vec3 v) noexcept { return {-v.x, v.y, v.z}; }

struct Mirror {
    void operator()(BoxSolid& box) const { box.centre = mirrored(box.centre); }
    void operator()(TubeSolid& tube) const { tube.from = mirrored(tube.from), tube.to = mirrored(tube.to); }
    void operator()(EllipticTubeSolid& tube) const {
        tube.from = mirrored(tube.from), tube.to = mirrored(tube.to), tube.up = mirrored(tube.up);
    }
    void operator()(SphereSolid& sphere) const { sphere.centre = mirrored(sphere.centre); }
    void operator()(SuperellipsoidSolid& solid) const {
        solid.centre = mirrored(solid.centre), solid.along = mirrored(solid.along), solid.up = mirrored(solid.up);
    }
    void operator()(LoftSolid& loft) const {
        for (LoftSection& section : loft.sections) {
            section.at = mirrored(section.at), section.turn = -section.turn;
            for (Vec3& point : section.outline) point = mirrored(point);
            std::reverse(section.outline.begin(), section.outline.end());
        }
        loft.up = mirrored(loft.up);
        if (!loft.path.empty()) lay_path(loft);
    }
};

/// Returns a part on the other side of the plane x = 0.
PhantomPart mirrored(PhantomPart part) {
    part.id = mirrored_id(part.id);
    std::visit(Mirror{}, part.solid);
    return part;
}

/// The one solid that a map names by its key.
Solid read_solid(MapReader& map, Report& report) {
    const Node* node = map.one_of();
    return node ? read_solid(*node, map.name_of(node->key), report) : BoxSolid{};
}

}  // namespace

TubeSolid read_tube(const Node& node, const std::string& name, Report& report) {
    TubeSolid tube;
    MapReader map(node, shapes::tube, name, report);
    read_ends(map, tube, name);
    shapes::tube.fill(map, tube);
    map.finish();
    return tube;
}

Solid read_solid(const Node& node, const std::string& name, Report& report) {
    if (node.key == "tube") return read_tube(node, name, report);
    if (node.key == "elliptic_tube") return read_elliptic_tube(node, name, report);
    if (node.key == "superellipsoid") return read_superellipsoid(node, name, report);
    if (node.key == "loft") return read_loft(node, name, report);
    if (node.key == "sphere") {
        SphereSolid sphere;
        read_map(node, shapes::sphere, name, sphere, report);
        return sphere;
    }
    BoxSolid box;
    read_map(node, shapes::box, name, box, report);
    return box;
}

std::vector<Solid> read_solids(const Node& node, const std::string& name, Report& report) {
    std::vector<Solid> solids;
    for (const Node& solid : read_list(node, name, report)) {
        MapReader map(solid, shapes::tissue_solid, name, report);
        solids.push_back(read_solid(map, report));
        map.finish();
    }
    return solids;
}

std::vector<PhantomPart> read_parts(const Node& node, const std::string& where, Report& report) {
    std::vector<PhantomPart> parts;
    UniqueIds ids("part");
    for (const Node& item : read_list(node, where, report)) {
        MapReader map(item, shapes::part, item_name(item, "part"), report);
        PhantomPart part;
        shapes::part.fill(map, part);
        ids.add_own(part.id, item, report);
        part.solid = read_solid(map, report);
        if (const Node* subtract = map.find("subtract")) {
            part.subtract = read_yes_no(*subtract, "subtract", report).value_or(false);
            if (part.subtract && parts.empty())
                report.error(
                    text::Code::degenerate, subtract->span,
                    "The first part is subtracted from nothing. Put it behind the parts that it is subtracted from.");
        }
        const Node* mirror = map.find("mirror");
        const bool is_mirrored = mirror != nullptr && read_yes_no(*mirror, "mirror", report).value_or(false);
        map.finish();
        parts.push_back(std::move(part));
        if (is_mirrored) parts.push_back(mirrored(parts.back()));
    }
    return parts;
}

}  // namespace kerf::documents
