// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

enum class Outcome { pass, fail, not_applicable };
[[nodiscard]] constexpr const char* to_text(Outcome outcome) noexcept {
    return outcome == Outcome::pass ? "pass" : outcome == Outcome::fail ? "fail" : "n/a";
}

/// Who makes the force.
enum class Method { as_printed, kerf };
[[nodiscard]] constexpr const char* to_text(Method method) noexcept {
    return method == Method::kerf ? "kerf" : "as printed";
}

inline constexpr const char* led = "led";    ///< a hand that is where it is told to be
inline constexpr const char* bare = "bare";  ///< a mass that is no device of the records

/// One test in one place.
struct Finding {
    std::string test{};   ///< "S-02"
    std::string scene{};  ///< a few words; the same in every place, so that it names a row
    Method method = Method::kerf;
    std::string device = bare, hand = "none";
    int delay = 0;  ///< [ticks]
    std::string measured{}, criterion{};
    Outcome outcome = Outcome::not_applicable;
    std::string reason{};  ///< why it is not applicable, or what a reader should know of the figure
};

using Report = std::function<void(const Finding&)>;

/// printf's `%.3g`, whatever the locale.
[[nodiscard]] std::string figure(double value, const char* unit = "");
[[nodiscard]] constexpr Outcome passes(bool condition) noexcept { return condition ? Outcome::pass : Outcome::fail; }

}  // namespace kerf::stability
