// SPDX-License-Identifier: Apache-2.0
#include "app/window/landmark_overlay.h"

#include <algorithm>
#include <cmath>

namespace kerf::window {

namespace {

constexpr int spots_of_axis = 61;
constexpr float grip = 9.0f;  // [pixel] around the end of a landmark

ImU32 faint(ImU32 colour) { return (colour & ~IM_COL32_A_MASK) | (static_cast<ImU32>(130) << IM_COL32_A_SHIFT); }

/// Returns whether bone lies between the eye and a point.
bool is_hidden(Vec3 point, const Camera& camera, const LandmarkSource& source) {
    constexpr double min_slack = 0.4e-3;  // [m] a point on the surface does not hide itself
    const Vec3 eye = camera.eye();
    const double distance = length(point - eye);
    const auto hit = source.surface_point(eye, (1.0 / distance) * (point - eye));
    return hit && length(hit->position - eye) < distance - std::max(min_slack, source.scene().spacing);
}

void paint_arrow(ImVec2 from, ImVec2 to, ImU32 colour, ImDrawList& list) {
    const float x = to.x - from.x, y = to.y - from.y, length = std::sqrt(x * x + y * y);
    if (length < 2.0f) return;
    constexpr float tall = 11.0f, wide = 5.0f;
    const ImVec2 along{x / length, y / length}, base{to.x - tall * along.x, to.y - tall * along.y};
    list.AddTriangleFilled(to, {base.x - wide * along.y, base.y + wide * along.x},
                           {base.x + wide * along.y, base.y - wide * along.x}, colour);
}

}  // namespace

Vec3 PictureArea::direction_at(const Camera& camera, float x, float y) const {
    const double wide = static_cast<double>(right - left), tall = static_cast<double>(bottom - top);
    return camera.direction_through(2.0 * static_cast<double>(x - left) / wide - 1.0,
                                    1.0 - 2.0 * static_cast<double>(y - top) / tall, aspect());
}

std::optional<ImVec2> PictureArea::pixel_of(const Camera& camera, Vec3 point) const {
    const auto shown = camera.shown_at(point, aspect());
    if (!shown) return std::nullopt;
    return ImVec2{left + 0.5f * (1.0f + shown->x) * (right - left), top + 0.5f * (1.0f - shown->y) * (bottom - top)};
}

LandmarkOverlay::Mark LandmarkOverlay::mark_of(const PickedLandmark& landmark, const Camera& camera,
                                               const PictureArea& area, const LandmarkSource& source) {
    Mark mark{landmark.id, {}};
    const int count = landmark.to ? spots_of_axis : 1;
    for (int i = 0; i < count; ++i) {
        const double fraction = count > 1 ? static_cast<double>(i) / (count - 1) : 0.0;
        const Vec3 point = landmark.at + fraction * (landmark.to.value_or(landmark.at) - landmark.at);
        Spot spot;
        if (const auto pixel = area.pixel_of(camera, point)) spot = {*pixel, true, !is_hidden(point, camera, source)};
        mark.spots.push_back(spot);
    }
    return mark;
}

void LandmarkOverlay::update(const Camera& camera, const PictureArea& area, const LandmarkSource& source,
                             const std::vector<PickedLandmark>& picked) {
    written_.clear();
    picked_.clear();
    for (const PickedLandmark& landmark : source.written()) written_.push_back(mark_of(landmark, camera, area, source));
    for (const PickedLandmark& landmark : picked) picked_.push_back(mark_of(landmark, camera, area, source));
}

void LandmarkOverlay::paint_mark(const Mark& mark, ImU32 colour, float size, ImDrawList& list, const Fonts& fonts) {
    const ImU32 shade = IM_COL32(0, 0, 0, 170), dim = faint(colour);
    const std::vector<Spot>& spots = mark.spots;
    for (std::size_t i = 0; i + 1 < spots.size(); ++i) {
        if (!spots[i].is_before_eye || !spots[i + 1].is_before_eye) continue;
        const bool is_seen = spots[i].is_seen && spots[i + 1].is_seen;
        if (is_seen)
            list.AddLine(spots[i].at, spots[i + 1].at, colour, 0.5f * size);
        else if (i % 2 == 0)  // dashed
            list.AddLine(spots[i].at, spots[i + 1].at, dim, 0.3f * size);
    }
    const bool is_axis = spots.size() > 1;
    for (const Spot* spot : {&spots.front(), &spots.back()}) {
        if (!spot->is_before_eye) continue;
        const ImU32 shown = spot->is_seen ? colour : dim;
        if (is_axis && spot == &spots.back() && spots.front().is_before_eye)
            paint_arrow(spots.front().at, spot->at, shown, list);
        else if (spot->is_seen)
            list.AddCircleFilled(spot->at, size, colour, 24);
        if (!is_axis || spot == &spots.front()) list.AddCircle(spot->at, size, spot->is_seen ? shade : dim, 24, 1.3f);
    }
    const Spot& first = spots.front();
    if (!first.is_before_eye) return;
    const ImVec2 at{first.at.x + size + 4.0f, first.at.y - 0.5f * fonts.small->FontSize};
    list.AddText(fonts.small, fonts.small->FontSize, {at.x + 1.0f, at.y + 1.0f}, shade, mark.words.c_str());
    list.AddText(fonts.small, fonts.small->FontSize, at, first.is_seen ? colour : dim, mark.words.c_str());
}

void LandmarkOverlay::paint(ImDrawList& list, const Fonts& fonts, const PictureArea& area,
                            std::optional<std::size_t> selected) const {
    list.PushClipRect({area.left, area.top}, {area.right, area.bottom}, true);
    for (const Mark& mark : written_) paint_mark(mark, theme::on_hand, 4.0f, list, fonts);
    for (std::size_t i = 0; i < picked_.size(); ++i)
        paint_mark(picked_[i], selected == i ? theme::limit : theme::modelled, 5.5f, list, fonts);
    list.PopClipRect();
}

std::optional<LandmarkOverlay::End> LandmarkOverlay::end_at(float x, float y) const {
    std::optional<End> nearest;
    float nearest_square = grip * grip;
    for (std::size_t i = 0; i < picked_.size(); ++i)
        for (const bool is_end : {false, true}) {
            if (is_end && picked_[i].spots.size() == 1) continue;
            const Spot& spot = is_end ? picked_[i].spots.back() : picked_[i].spots.front();
            const float right = spot.at.x - x, down = spot.at.y - y, square = right * right + down * down;
            if (!spot.is_seen || square > nearest_square) continue;
            nearest_square = square;
            nearest = End{i, is_end};
        }
    return nearest;
}

}  // namespace kerf::window
