// SPDX-License-Identifier: Apache-2.0
#include "session/report/place_labels.h"

#include <algorithm>
#include <array>
#include <utility>

namespace kerf::session {
namespace {

bool is_within(const Rect& box, const Rect& frame) noexcept {
    return box.left >= frame.left && box.top >= frame.top && box.left + box.width <= frame.left + frame.width &&
           box.top + box.height <= frame.top + frame.height;
}

bool is_free(const Rect& box, const std::vector<Rect>& taken) noexcept {
    return std::none_of(taken.begin(), taken.end(), [&](const Rect& other) { return do_meet(box, other); });
}

/// Returns the nearest free position of a label: rings around its point, each from the right clockwise.
std::optional<Rect> nearest_free(const Label& label, const Rect& frame, const std::vector<Rect>& taken) {
    constexpr double gap = 6.0, step = 5.0;
    constexpr std::array<std::pair<double, double>, 8> directions{
        {{1, 0}, {-1, 0}, {1, -1}, {1, 1}, {-1, -1}, {-1, 1}, {0, -1}, {0, 1}}};
    const double farthest = frame.width + frame.height;
    for (double ring = gap; ring < farthest; ring += step)
        for (const auto& [right, down] : directions) {
            const Rect box{label.x + right * (ring + 0.5 * label.width) - 0.5 * label.width,
                           label.y + down * (ring + 0.5 * label.height) - 0.5 * label.height, label.width,
                           label.height};
            if (is_within(box, frame) && is_free(box, taken)) return box;
        }
    return std::nullopt;
}

}  // namespace

bool do_meet(const Rect& a, const Rect& b) noexcept {
    return a.left < b.left + b.width && b.left < a.left + a.width && a.top < b.top + b.height &&
           b.top < a.top + a.height;
}

std::vector<std::optional<Rect>> place_labels(std::span<const Label> labels, const Rect& frame,
                                              std::vector<Rect> taken) {
    std::vector<std::optional<Rect>> places;
    places.reserve(labels.size());
    for (const Label& label : labels) {
        places.push_back(nearest_free(label, frame, taken));
        if (places.back()) taken.push_back(*places.back());
    }
    return places;
}

double text_width(std::string_view text, double size) noexcept {
    constexpr double mean_advance = 0.62;  // of DejaVu Sans, the widest of the fonts that the pages name
    const auto letters = std::count_if(text.begin(), text.end(),
                                       [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; });
    return mean_advance * size * static_cast<double>(letters);
}

}  // namespace kerf::session
