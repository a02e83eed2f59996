// SPDX-License-Identifier: Apache-2.0
#include "app/badges/badge.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "conformance/kit_version.h"
#include "session/recorder.h"
#include "text/sha256.h"

namespace kerf::app {

namespace {

using Json = nlohmann::ordered_json;

constexpr int schema = 1, max_level = 5, max_count = 1'000'000;
constexpr std::size_t max_name = 200;  ///< characters of id and version
constexpr char plain[] = "abcdefghijklmnopqrstuvwxyz0123456789_ ,()";
constexpr std::size_t max_does_not = 1000;  ///< characters of what its laws leave out

struct Number {
    const char* key;
    int Badge::*member;
    int min, max;
};
constexpr std::array numbers{
    Number{"kit", &Badge::kit, 1, max_count},       Number{"requested", &Badge::requested, 1, max_level},
    Number{"level", &Badge::level, 0, max_level},   Number{"tests", &Badge::tests, 1, max_count},
    Number{"failed", &Badge::failed, 0, max_count}, Number{"excluded", &Badge::excluded, 0, max_count}};

/// Returns the number of a key if it is a whole number from `min` to `max`.
std::optional<int> number_in(const Json& document, const char* key, int min, int max) {
    const auto found = document.find(key);
    if (found == document.end() || !found->is_number_integer()) return std::nullopt;
    const auto value = found->get<std::int64_t>();
    return value >= min && value <= max ? std::optional(static_cast<int>(value)) : std::nullopt;
}

std::optional<std::string> text_in(const Json& document, const char* key) {
    const auto found = document.find(key);
    return found != document.end() && found->is_string() ? std::optional(found->get<std::string>()) : std::nullopt;
}

std::string kit_words(int kit) {
    return kit < conformance::kit_version   ? " of an older kit"
           : kit > conformance::kit_version ? " of a newer kit"
                                            : "";
}

}  // namespace

std::string text_of(const Badge& badge) {
    Json document{
        {"schema", schema}, {"notice", session::notice_line}, {"digest", badge.digest}, {"plugin", badge.plugin}};
    for (const Number& number : numbers) document[number.key] = badge.*number.member;
    if (!badge.does_not.empty()) document["does_not"] = badge.does_not.substr(0, max_does_not);
    return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<Badge> read_badge(std::string_view text, const std::string& digest, std::string& fault) {
    const auto refuse = [&](const std::string& why) {
        fault = why;
        return std::nullopt;
    };
    const Json document = Json::parse(text, nullptr, false);
    if (!document.is_object()) return refuse("it is damaged");
    if (const auto found = number_in(document, "schema", 1, max_count); found != schema)
        return refuse(found ? "its schema is " + std::to_string(*found) + ", and this Kerf reads " +
                                  std::to_string(schema)
                            : "it has no `schema`");
    Badge badge;
    const auto plugin = text_in(document, "plugin");
    if (text_in(document, "digest") != digest || !text::is_sha256(digest))
        return refuse("its `digest` is not the one of its name");
    badge.digest = digest;
    if (!plugin || plugin->size() > max_name) return refuse("its `plugin` is no id");
    badge.plugin = *plugin;
    for (const Number& number : numbers) {
        const auto value = number_in(document, number.key, number.min, number.max);
        if (!value) return refuse("its `" + std::string(number.key) + "` is out of range");
        badge.*number.member = *value;
    }
    if (document.contains("does_not")) {
        const auto left_out = text_in(document, "does_not");
        if (!left_out || left_out->size() > max_does_not || left_out->find_first_not_of(plain) != std::string::npos)
            return refuse("its `does_not` is no text of its laws");
        badge.does_not = *left_out;
    }
    if (badge.level > badge.requested || badge.failed + badge.excluded > badge.tests ||
        (badge.failed > 0 && badge.level == badge.requested))
        return refuse("its numbers contradict each other");
    return badge;
}

std::string words_of(const Badge& badge) {
    const std::string all = std::to_string(badge.tests) + " tests";
    std::string words = "checked: " + (badge.level > 0 ? "level " + std::to_string(badge.level) : "no level") +
                        kit_words(badge.kit) + ", ";
    if (badge.failed > 0)
        words +=
            std::to_string(badge.failed) + " of " + all + " up to level " + std::to_string(badge.requested) + " failed";
    else
        words +=
            (badge.excluded > 0 ? std::to_string(badge.tests - badge.excluded) : std::string("all")) + " of " + all;
    if (badge.excluded > 0) words += ", " + std::to_string(badge.excluded) + " excluded";
    if (!badge.does_not.empty()) words += "; does not " + badge.does_not;
    return words;
}

const Badge& kept_of(const Badge& earlier, const Badge& newer) noexcept {
    const auto rank = [](const Badge& badge) { return std::pair(badge.level, badge.requested); };
    return newer.failed == 0 && earlier.kit == newer.kit && rank(earlier) > rank(newer) ? earlier : newer;
}

}  // namespace kerf::app
