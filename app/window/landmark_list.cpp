// SPDX-License-Identifier: Apache-2.0
#include "app/window/landmark_list.h"

#include <algorithm>
#include <utility>

namespace kerf::window {

namespace {

constexpr std::size_t max_changes = 500;

}  // namespace

void LandmarkList::begin_change(Joined joined) {
    const bool is_continued = joined.kind != Joined::Kind::none && joined == joined_;
    joined_ = joined;
    if (is_continued) return;
    if (before_.size() == max_changes) before_.erase(before_.begin());
    before_.push_back(now_);
}

void LandmarkList::add(const std::string& id, Vec3 at) {
    begin_change();
    now_.landmarks.push_back({.id = id, .at = at});
    now_.selected = now_.landmarks.size() - 1;
}

void LandmarkList::move(std::size_t index, bool is_end, Vec3 at) {
    if (index >= now_.landmarks.size()) return;
    begin_change({is_end ? Joined::Kind::end : Joined::Kind::start, index});
    PickedLandmark& landmark = now_.landmarks[index];
    (is_end && landmark.to ? *landmark.to : landmark.at) = at;
}

void LandmarkList::rename(std::size_t index, const std::string& id) {
    if (index >= now_.landmarks.size() || now_.landmarks[index].id == id) return;
    begin_change({Joined::Kind::name, index});
    now_.landmarks[index].id = id;
}

void LandmarkList::remove(std::size_t index) {
    if (index >= now_.landmarks.size()) return;
    begin_change();
    now_.landmarks.erase(now_.landmarks.begin() + static_cast<std::ptrdiff_t>(index));
    now_.selected.reset();
    if (!now_.landmarks.empty()) now_.selected = std::min(index, now_.landmarks.size() - 1);
}

std::optional<std::pair<std::size_t, std::size_t>> LandmarkList::joinable() const {
    if (!now_.selected || now_.landmarks[*now_.selected].to) return std::nullopt;
    for (std::size_t from = *now_.selected; from-- > 0;)
        if (!now_.landmarks[from].to) return std::pair(from, *now_.selected);
    return std::nullopt;
}

bool LandmarkList::join(const std::string& id) {
    const auto ends = joinable();
    if (!ends) return false;
    begin_change();
    now_.landmarks[ends->first].id = id;
    now_.landmarks[ends->first].to = now_.landmarks[ends->second].at;
    now_.landmarks.erase(now_.landmarks.begin() + static_cast<std::ptrdiff_t>(ends->second));
    now_.selected = ends->first;
    return true;
}

void LandmarkList::reverse(std::size_t index) {
    if (index >= now_.landmarks.size() || !now_.landmarks[index].to) return;
    begin_change();
    std::swap(now_.landmarks[index].at, *now_.landmarks[index].to);
}

void LandmarkList::select(std::optional<std::size_t> index) {
    now_.selected = index && *index < now_.landmarks.size() ? index : std::nullopt;
    joined_ = {};
}

void LandmarkList::select_next(int step) {
    const auto count = static_cast<int>(now_.landmarks.size());
    if (count == 0) return;
    const int from = now_.selected ? static_cast<int>(*now_.selected) : (step > 0 ? -1 : count);
    select(static_cast<std::size_t>((from + step + count) % count));
}

bool LandmarkList::undo() {
    if (before_.empty()) return false;
    now_ = std::move(before_.back());
    before_.pop_back();
    joined_ = {};
    return true;
}

void LandmarkList::clear() {
    now_ = {};
    before_.clear();
    joined_ = {};
}

bool LandmarkList::has(const std::string& id) const {
    return std::any_of(now_.landmarks.begin(), now_.landmarks.end(),
                       [&](const PickedLandmark& landmark) { return landmark.id == id; });
}

}  // namespace kerf::window
