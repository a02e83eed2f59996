// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/window/landmark_page.h"

namespace kerf::window {

/// The landmarks that a user has picked and not yet written. Each change can be undone.
class LandmarkList {
public:
    [[nodiscard]] const std::vector<PickedLandmark>& all() const noexcept { return now_.landmarks; }
    [[nodiscard]] std::optional<std::size_t> selected() const noexcept { return now_.selected; }

    /// Adds a point, and selects it.
    void add(const std::string& id, Vec3 at);
    /// Moves a point or an end of an axis. Calls that follow one another for the same end are one change.
    void move(std::size_t index, bool is_end, Vec3 at);
    /// Ends the row of moves that are one change.
    void end_move() noexcept { joined_ = {}; }
    /// Renames a landmark. Calls that follow one another for the same landmark are one change.
    void rename(std::size_t index, const std::string& id);
    void remove(std::size_t index);
    /// Joins the selected point and the point before it in the list to an axis that ends at the selected one. Returns
    /// false if there are no two points.
    bool join(const std::string& id);
    /// Swaps the ends of an axis.
    void reverse(std::size_t index);
    void select(std::optional<std::size_t> index);
    /// Selects the next landmark, or with −1 the one before, around the end.
    void select_next(int step);
    /// Undoes the last change. Returns false if there is none.
    bool undo();
    /// Removes all, without undo.
    void clear();

    /// Returns the indices of the two points that `join` would join: from, to.
    [[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> joinable() const;
    /// Returns whether a picked landmark has this name.
    [[nodiscard]] bool has(const std::string& id) const;

private:
    struct State {
        std::vector<PickedLandmark> landmarks{};
        std::optional<std::size_t> selected{};
    };
    /// A change that later ones of the same kind continue.
    struct Joined {
        enum class Kind { none, start, end, name } kind = Kind::none;
        std::size_t index = 0;
        bool operator==(const Joined&) const = default;
    };
    void begin_change(Joined joined);
    void begin_change() { begin_change(Joined{}); }

    State now_;
    std::vector<State> before_;
    Joined joined_;
};

}  // namespace kerf::window
