// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

/// The verdict of `kerf check` on one file of a plugin.
namespace kerf::app {

/// The level from which on a run does not warn of a plugin.
inline constexpr int required_level = 3;

struct Badge {
    std::string digest;  ///< SHA-256 of the plugin's file
    std::string plugin;  ///< "example.peck 0.1.0"; empty: its tables could not be read
    int kit = 0;         ///< conformance::kit_version of the kit that tested it
    int requested = 0;   ///< level of `kerf check --level`, 1 … 5
    int level = 0;       ///< highest level up to which no test failed; 0: none
    int tests = 0;       ///< that ran or were excluded
    int failed = 0;
    int excluded = 0;        ///< by `--exclude`
    std::string does_not{};  ///< what its laws leave out on purpose: "resist sideways (burr_cutting)"; empty: nothing
    friend bool operator==(const Badge&, const Badge&) = default;
};

/// Returns the badge as the text of its file, the same bytes for the same badge.   [any] pure.
[[nodiscard]] std::string text_of(const Badge& badge);

/// Reads the text of a badge's file. Returns nothing, with the reason in `fault`, unless it is a sound badge of this
/// digest.   [any] pure.
[[nodiscard]] std::optional<Badge> read_badge(std::string_view text, const std::string& digest, std::string& fault);

/// Returns "checked: level 4, all of 96 tests".   [any] pure.
[[nodiscard]] std::string words_of(const Badge& badge);

/// Returns the badge to keep of two on the same file: the newer one, unless it found no failure at a lower level of the
/// same kit than the earlier one.   [any] pure.
[[nodiscard]] const Badge& kept_of(const Badge& earlier, const Badge& newer) noexcept;

}  // namespace kerf::app
