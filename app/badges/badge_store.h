// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "app/badges/badge.h"

namespace kerf::app {

/// The badges of this user on this machine: a folder with a small file for each digest. Programs may read and write it
/// at the same time: each file is replaced as a whole.
class BadgeStore {
public:
    /// @param folder  empty: there is none
    explicit BadgeStore(std::string folder) : folder_(std::move(folder)) {}
    /// Returns the folder of $KERF_BADGES, else kerf/badges in the user's folder for states. `KERF_BADGES=off` gives a
    /// store that is off.   [main]
    [[nodiscard]] static BadgeStore of_environment();

    /// Returns whether the user wants no badges: none is read, kept or missed.
    [[nodiscard]] bool is_off() const noexcept { return is_off_; }
    [[nodiscard]] const std::string& folder() const noexcept { return folder_; }

    struct Found {
        std::optional<Badge> badge{};
        std::string fault{};  ///< names a file that is ignored, for people; empty: none is
    };
    /// Reads the badge of a digest. Does not follow a link, wait for a FIFO or trust another user's file.   [main]
    [[nodiscard]] Found find(const std::string& digest) const;

    struct Kept {
        std::optional<Badge> badge{};  ///< that the file has now; nothing: it was not written
        std::string fault{};           ///< for people; may be there with a badge, if a damaged file was replaced
    };
    /// Writes a badge, unless the one that is there is to be kept (`kept_of`). Replaces no link, FIFO or other user's
    /// file.   [main]
    [[nodiscard]] Kept keep(const Badge& badge) const;

private:
    [[nodiscard]] std::string file_of(const std::string& digest) const { return folder_ + "/" + digest + ".json"; }

    std::string folder_;
    bool is_off_ = false;
};

/// Returns the reason why there are no badges, and the remedy, for people.   [any] pure.
[[nodiscard]] std::string no_folder_for_badges();

}  // namespace kerf::app
