// SPDX-License-Identifier: Apache-2.0
#include "app/preview/preview_page.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "app/anatomy_text.h"
#include "app/preview/png.h"
#include "app/preview/view.h"
#include "bone/report/import_report.h"
#include "documents/solids.h"
#include "session/recorder.h"
#include "session/report/place_labels.h"
#include "session/report/report_data.h"
#include "text/palette.h"

namespace kerf::app {
namespace {

constexpr std::string_view style = R"css(
body { margin: 0; background: #f6f7f8; color: #1b2126; font: 15px/1.5 system-ui, "Segoe UI", "Noto Sans", "DejaVu Sans", sans-serif; }
main { max-width: 1500px; margin: 0 auto; padding: 20px 24px; }
h1 { font-size: 24px; margin: 0; } h2 { font-size: 17px; margin: 26px 0 8px; } .soft { color: #5b666f; }
.views { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 340px), 1fr)); gap: 14px; align-items: start; }
figure { margin: 0; min-width: 0; background: #fff; border: 1px solid #dde2e6; border-radius: 8px; padding: 8px; }
figcaption { font-size: 13px; color: #5b666f; padding: 4px 2px 0; } svg { display: block; width: 100%; height: auto; }
.key span { margin-right: 18px; white-space: nowrap; } .key i { display: inline-block; width: 12px; height: 12px; border-radius: 3px; margin-right: 6px; }
li { margin: 2px 0; overflow-wrap: anywhere; } h1, h2 { overflow-wrap: anywhere; }
@media (max-width: 640px) { main { padding: 14px 12px; } figure { padding: 5px; } }
 footer { color: #5b666f; margin-top: 24px; font-size: 13px; }
)css";

std::string px(double value) { return bone::rounded(value, 1); }

constexpr double font = 14;  // in a picture of 460 columns, which a narrow screen draws at three quarters

/// What lies over the picture of a view: lines, and names of points.
struct Overlay {
    struct Name {
        std::string text;
        const char* colour;
        double x = 0.0, y = 0.0;  ///< of the point
    };
    std::string lines{};
    std::vector<Name> names{};
};

std::string label(double x, double y, const std::string& text, const char* colour) {
    return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" font-size=\"" + px(font) + "\" fill=\"" + colour +
           "\" stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\">" + session::html_escaped(text) + "</text>";
}

std::string line(const View& view, Vec3 from, Vec3 to, const char* colour, const char* more = "") {
    return "<line x1=\"" + px(view.x_of(from)) + "\" y1=\"" + px(view.y_of(from)) + "\" x2=\"" + px(view.x_of(to)) +
           "\" y2=\"" + px(view.y_of(to)) + "\" stroke=\"" + colour + "\" stroke-width=\"1.6\" " + more + "/>";
}

bool is_in(const View& view, Vec3 p) {
    const double x = view.x_of(p), y = view.y_of(p);
    return x > 4 && y > 12 && x < view.columns - 4 && y < view.rows - 4;
}

/// Draws landmarks, with their tolerance as a circle.
/// @param reach   largest distance of a landmark from the plane of the view [m]
void add_landmarks(const View& view, const run::Scene& scene, double reach, Overlay& overlay) {
    std::string& marks = overlay.lines;
    const auto is_near = [&](Vec3 p) { return std::abs(dot(p - view.centre, view.away())) <= reach && is_in(view, p); };
    for (const documents::LandmarkAxis& axis : scene.anatomy.axes) {
        if (!is_near(axis.from) && !is_near(axis.to)) continue;
        marks += line(view, axis.from, axis.to, "#1f6f9f", "stroke-dasharray=\"6 3\"");
        if (is_in(view, axis.from))
            overlay.names.push_back({axis.id, "#1f6f9f", view.x_of(axis.from), view.y_of(axis.from)});
    }
    for (const documents::LandmarkPoint& point : scene.anatomy.points) {
        if (!is_near(point.at)) continue;
        marks += "<circle cx=\"" + px(view.x_of(point.at)) + "\" cy=\"" + px(view.y_of(point.at)) + "\" r=\"" +
                 px(std::max(3.0, point.tolerance / view.pixel())) +
                 "\" fill=\"none\" stroke=\"#0a7d4b\" stroke-width=\"1.6\"/>";
        overlay.names.push_back({point.id, "#0a7d4b", view.x_of(point.at), view.y_of(point.at)});
    }
    for (const documents::LandmarkPlane& plane : scene.anatomy.planes) {
        if (!is_in(view, plane.at)) continue;
        marks += line(view, plane.at, plane.at + 10e-3 * plane.normal, "#7a3fa0");
        overlay.names.push_back({plane.id, "#7a3fa0", view.x_of(plane.at), view.y_of(plane.at)});
    }
}

/// Adds the names of zones that are in the picture.
void add_zones(const View& view, const run::Scene& scene, Overlay& overlay) {
    for (const documents::Zone& zone : scene.anatomy.zones) {
        const Box box = documents::bounds_of(zone.solids);
        const Vec3 middle = 0.5 * (box.low + box.high);
        if (is_in(view, middle)) overlay.names.push_back({zone.id, "#a61e1e", view.x_of(middle), view.y_of(middle)});
    }
}

/// Returns the box of the scale in the lower left corner.
session::Rect scale_box(const View& view) {
    return {0.0, view.rows - 26.0, 24.0 + 10e-3 / view.pixel() + session::text_width("10 mm", font), 26.0};
}

/// Draws names so that no two overlap. A line leads from a name to its point if they are apart.
std::string names_svg(const View& view, const std::vector<Overlay::Name>& names) {
    constexpr double height = font + 3, near = 24.0;
    std::vector<session::Label> labels;
    labels.reserve(names.size());
    for (const Overlay::Name& name : names)
        labels.push_back({name.x, name.y, session::text_width(name.text, font), height});
    const session::Rect frame{2.0, 2.0, view.columns - 4.0, view.rows - 4.0};
    const auto places = session::place_labels(labels, frame, {scale_box(view)});
    std::string svg;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (!places[i]) continue;
        const session::Rect& box = *places[i];
        const double x = std::clamp(names[i].x, box.left, box.left + box.width),
                     y = std::clamp(names[i].y, box.top, box.top + box.height);
        if (std::hypot(x - names[i].x, y - names[i].y) > near)
            svg += "<path d=\"M" + px(names[i].x) + " " + px(names[i].y) + "L" + px(x) + " " + px(y) + "\" stroke=\"" +
                   names[i].colour + "\" fill=\"none\"/>";
        svg += label(box.left, box.top + font - 1, names[i].text, names[i].colour);
    }
    return svg;
}

/// Draws a scale of 10 mm in the lower left corner.
std::string scale(const View& view) {
    const double y = view.rows - 12.0, length = 10e-3 / view.pixel();
    return "<path d=\"M12 " + px(y) + "h" + px(length) + "M12 " + px(y - 4) + "v8M" + px(12 + length) + " " +
           px(y - 4) + "v8\" stroke=\"#1b2126\" stroke-width=\"2\" fill=\"none\"/><path d=\"M12 " + px(y) + "h" +
           px(length) + "\" stroke=\"#fff\" stroke-width=\"1\"/>" + label(16 + length, y + 4, "10 mm", "#1b2126");
}

std::string figure(const View& view, const Picture& picture, const Overlay& overlay) {
    const std::string size =
        "width=\"" + std::to_string(view.columns) + "\" height=\"" + std::to_string(view.rows) + "\"";
    return "<figure><svg viewBox=\"0 0 " + std::to_string(view.columns) + " " + std::to_string(view.rows) +
           "\" role=\"img\"><title>" + session::html_escaped(view.title) + "</title><image " + size + " href=\"" +
           png_link(picture) + "\"/>" + overlay.lines + scale(view) + names_svg(view, overlay.names) +
           "</svg><figcaption>" + session::html_escaped(view.title) + "</figcaption></figure>\n";
}

/// Returns the pose of the tool at the goal of a step.
Pose goal_pose(const run::Scene& scene, std::size_t step) {
    double depth = 0.0;
    for (const documents::Goal& goal : scene.procedure.steps[step].goals)
        if (goal.quantity == "depth" && goal.bound.at_least) depth = std::max(depth, *goal.bound.at_least);
    return scene.frames[step].pose_at({.depth = depth});
}

/// Draws the outline of the tool in the plane of the view.
std::string tool_outline(const View& view, const ToolOutline& outline, const Pose& tool) {
    const Vec3 along = tool * Vec3{0, 0, 1} - tool * Vec3{};
    Vec3 across = cross(along, view.away());
    if (length(across) < 0.1 && outline.cutting.is_prism()) {  // seen along its axis: the swept rectangle
        const Vec3 aside = outline.cutting.largest_radius() * rotate(tool.rotation, {1, 0, 0});
        const Vec3 up = 0.5 * outline.cutting.thickness() * rotate(tool.rotation, {0, 1, 0});
        std::string corners;
        for (const Vec3 corner : {aside + up, aside - up, -1.0 * (aside + up), up - aside}) {
            const Vec3 at = tool.position + corner;
            corners += px(view.x_of(at)) + "," + px(view.y_of(at)) + " ";
        }
        return "<polygon points=\"" + corners + "\" fill=\"none\" stroke=\"#5fb0ff\" stroke-width=\"2\"/>";
    }
    if (length(across) < 0.1) {  // seen along its axis
        const double radius = outline.whole.largest_radius() / view.pixel();
        return "<circle cx=\"" + px(view.x_of(tool.position)) + "\" cy=\"" + px(view.y_of(tool.position)) + "\" r=\"" +
               px(radius) + "\" fill=\"none\" stroke=\"#5fb0ff\" stroke-width=\"2\"/>";
    }
    across = normalized(across);
    // A blade is seen from its edge, or flat.
    const ToolSolid& whole = outline.whole;
    const bool is_edge_on = whole.is_prism() && std::abs(dot(across, rotate(tool.rotation, {0, 1, 0}))) > 0.7;
    std::string there, back;
    for (const kerf_profile_point& point : whole.outline()) {
        const Vec3 middle = tool * Vec3{0, 0, point.z};
        const double half = is_edge_on ? 0.5 * whole.thickness() : point.radius;
        const Vec3 a = middle + half * across, b = middle - half * across;
        there += px(view.x_of(a)) + "," + px(view.y_of(a)) + " ";
        back = px(view.x_of(b)) + "," + px(view.y_of(b)) + " " + back;
    }
    return "<polygon points=\"" + there + back + "\" fill=\"none\" stroke=\"#5fb0ff\" stroke-width=\"2\"/>";
}

/// Returns the box that all outside views show: the region, or the bone.
Box shown_box(const run::Scene& scene) {
    const Body& bone = planned_bone(scene);
    if (bone.region.is_bounded()) return {bone.region.low, bone.region.high};
    Box box{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    const Grid& grid = bone.grid();
    for (int k = 0; k < grid.bricks[2]; ++k)
        for (int j = 0; j < grid.bricks[1]; ++j)
            for (int i = 0; i < grid.bricks[0]; ++i) {
                if (bone.surface.is_all_air(grid.brick_index(i, j, k))) continue;
                const Vec3 low = grid.sample_position(i * brick_edge, j * brick_edge, k * brick_edge);
                const Vec3 high =
                    grid.sample_position((i + 1) * brick_edge, (j + 1) * brick_edge, (k + 1) * brick_edge);
                box = joined(box, {low, high});
            }
    return box;
}

std::string outside_views(const run::Scene& scene, const std::vector<Pose>& tools) {
    const Box box = shown_box(scene);
    const Vec3 centre = 0.5 * (box.low + box.high), size = box.high - box.low;
    struct Direction {
        const char* title;
        Vec3 right, up;
    };
    std::string figures;
    for (const Direction& d :
         {Direction{"From behind: the patient's left is on the left", {-1, 0, 0}, {0, 0, 1}},
          Direction{"From the patient's left: the front is on the left", {0, 1, 0}, {0, 0, 1}},
          Direction{"From above: the front is up, the patient's left on the left", {-1, 0, 0}, {0, -1, 0}}}) {
        View view{d.title, centre, d.right, d.up};
        const auto extent = [&](Vec3 axis) {
            return std::abs(size.x * axis.x) + std::abs(size.y * axis.y) + std::abs(size.z * axis.z) + 16e-3;
        };
        view.rows = std::clamp(static_cast<int>(view.columns * extent(d.up) / extent(d.right)), 200, 460);
        view.width = std::max(extent(d.right), extent(d.up) * view.columns / view.rows);
        Overlay overlay;
        add_landmarks(view, scene, 1.0, overlay);
        add_zones(view, scene, overlay);
        figures += figure(view, from_outside(view, scene, tools), overlay);
    }
    return "<section><h2>From outside</h2><div class=\"views\">" + figures + "</div></section>\n";
}

std::string step_views(const run::Scene& scene, std::size_t step) {
    const run::AxisFrame& frame = scene.frames[step];
    const Pose tool = goal_pose(scene, step);
    const double depth = frame.depth_of(tool.position);
    const bool has_plane = frame.across != Vec3{};
    Vec3 across = has_plane ? frame.across : frame.medial;
    if (length(across) < 0.5)
        across = normalized(cross(frame.along, std::abs(frame.along.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
    const Vec3 other = cross(frame.along, across);
    const char* side = has_plane                    ? ", across the plane"
                       : length(frame.medial) > 0.5 ? "; the midline is on the right"
                                                    : "";
    const double width = std::max(60e-3, 1.8 * depth);
    std::string figures;
    for (const bool is_first : {true, false}) {
        View view{is_first ? std::string("Along the axis") + side
                           : std::string(has_plane ? "In the plane" : "Along the axis, a quarter turn further"),
                  frame.entry + 0.5 * depth * frame.along, is_first ? across : other, -1.0 * frame.along, width};
        Overlay overlay{.lines = tool_outline(view, scene.tool(step).outline, tool)};
        add_landmarks(view, scene, 3e-3, overlay);
        figures += figure(view, cut_through(view, scene), overlay);
    }
    View section{"Across the axis, " + bone::rounded(0.5e3 * depth, 1) + " mm behind the entry",
                 frame.entry + 0.5 * depth * frame.along, across, cross(across, frame.along), 50e-3};
    figures += figure(section, cut_through(section, scene),
                      {.lines = tool_outline(section, scene.tool(step).outline, {section.centre, tool.rotation})});
    return "<section><h2>Step " + session::html_escaped(scene.procedure.steps[step].id) + ": the tool at its goal, " +
           bone::rounded(depth * 1e3, 1) + " mm deep</h2><div class=\"views\">" + figures + "</div></section>\n";
}

std::string notes_section(const run::Scene& scene) {
    std::string items, text = anatomy_text(scene.anatomy, scene.body, scene.import);
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = text.find('\n', at);
        items += "<li>" + session::html_escaped(text.substr(at, end - at)) + "</li>";
        at = end + 1;
    }
    return "<section><h2>Import and positions</h2><ul>" + items + "</ul></section>\n";
}

std::string key(const run::Scene& scene) {
    const auto entry = [](const std::string& colour, const std::string& text) {
        return "<span><i style=\"background:" + colour + "\"></i>" + text + "</span>";
    };
    std::string tissues;
    for (std::size_t m = 0; m < scene.body.materials.size(); ++m)
        tissues += entry(text::tissue_colour(scene.body.materials[m].id, m).hex(),
                         session::html_escaped(scene.body.materials[m].id));
    return "<p class=\"key\">" + tissues + entry("#db3329", "zone") + entry("#386bb8", "tool") +
           entry("#ffb826", "border of bone") + entry("#0a7d4b", "point, with its tolerance") +
           entry("#1f6f9f", "axis") + (scene.fragment ? entry("#cc8c40", "fragment, where it lies now") : "") +
           (scene.implants.empty() ? "" : entry("#737880", "implant, where it is planned")) +
           "</p><p class=\"soft\">Parts behind bone are paler.</p>";
}

}  // namespace

std::string preview_page(const run::Scene& scene) {
    std::vector<Pose> tools;
    for (std::size_t step = 0; step < scene.procedure.steps.size(); ++step) tools.push_back(goal_pose(scene, step));
    std::string page = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
                       "content=\"width=device-width, initial-scale=1\"><title>" +
                       session::html_escaped(scene.procedure.title) + "</title><style>" + std::string(style) +
                       "</style></head><body><main><h1>" + session::html_escaped(scene.procedure.title) +
                       "</h1><p class=\"soft\">" + session::html_escaped(scene.anatomy.title) +
                       ", before anything is cut. Spacing " + bone::rounded(scene.procedure.spacing * 1e3, 2) +
                       " mm.</p>" + key(scene);
    page += outside_views(scene, tools);
    for (std::size_t step = 0; step < scene.procedure.steps.size(); ++step) page += step_views(scene, step);
    return page + notes_section(scene) + "<footer>" + std::string(session::notice_line) +
           ".</footer></main></body></html>\n";
}

}  // namespace kerf::app
