// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

namespace kerf::documents {

/// The help that a trainee gets: plan, zones, limits and hints.
enum class Assist {
    off,         ///< none
    on_request,  ///< of the running step, once the trainee has requested it
    stepwise,    ///< of the running step
    full,        ///< of all steps
};

/// The words of documents, commands and records.
inline constexpr std::array<std::pair<const char*, Assist>, 4> assist_words{
    {{"off", Assist::off}, {"on-request", Assist::on_request}, {"stepwise", Assist::stepwise}, {"full", Assist::full}}};

[[nodiscard]] constexpr const char* to_text(Assist assist) noexcept {
    return assist_words[static_cast<std::size_t>(assist)].first;
}
/// Returns nothing for another word.
[[nodiscard]] constexpr std::optional<Assist> assist_of(std::string_view word) noexcept {
    for (const auto& [known, assist] : assist_words)
        if (word == known) return assist;
    return std::nullopt;
}

}  // namespace kerf::documents
