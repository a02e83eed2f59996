// SPDX-License-Identifier: Apache-2.0
#include "documents/hand_input.h"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <system_error>
#include <utility>

namespace kerf::documents {

namespace {
constexpr std::pair<HandInput::Kind, std::string_view> words[] = {
    {HandInput::Kind::undo, "undo"},   {HandInput::Kind::redo, "redo"},         {HandInput::Kind::remove, "remove"},
    {HandInput::Kind::fuse, "fuse"},   {HandInput::Kind::subtract, "subtract"}, {HandInput::Kind::release, "release"},
    {HandInput::Kind::pause, "pause"}, {HandInput::Kind::assist, "assist"}};
constexpr std::string_view insert = "insert:", place = "place:";
constexpr std::string_view image = "image:";  // then both angles
constexpr std::string_view release_shaft = "regrip:1", grip_shaft = "regrip:0";
/// Writes a number so that reading gives the same bits.
std::string digits_of(double value) {
    char digits[32];
    return {digits, std::to_chars(std::begin(digits), std::end(digits), value).ptr};
}

/// Returns a finite number that is all of a text.
std::optional<double> number_of(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::optional<HandInput> image_input(std::string_view angles) {
    const std::size_t space = angles.find(' ');
    if (space == std::string_view::npos) return std::nullopt;
    const auto about = number_of(angles.substr(0, space)), tilt = number_of(angles.substr(space + 1));
    if (!about || !tilt) return std::nullopt;
    return HandInput{HandInput::Kind::image, {}, *about, *tilt};
}

}  // namespace

std::string text_of(const HandInput& input) {
    for (const auto& [kind, word] : words)
        if (kind == input.kind) return std::string(word);
    if (input.kind == HandInput::Kind::insert) return std::string(insert) + input.id;
    if (input.kind == HandInput::Kind::place) return std::string(place) + input.id;
    if (input.kind == HandInput::Kind::regrip) return std::string(input.value != 0.0 ? release_shaft : grip_shaft);
    if (input.kind == HandInput::Kind::image)
        return std::string(image) + digits_of(input.value) + " " + digits_of(input.tilt);
    return input.id + " " + digits_of(input.value);
}

std::optional<HandInput> hand_input(std::string_view text) {
    for (const auto& [kind, word] : words)
        if (text == word) return HandInput{kind};
    if (text.starts_with(insert)) return HandInput{HandInput::Kind::insert, std::string(text.substr(insert.size()))};
    if (text.starts_with(place)) return HandInput{HandInput::Kind::place, std::string(text.substr(place.size()))};
    if (text == release_shaft || text == grip_shaft)
        return HandInput{HandInput::Kind::regrip, {}, text == release_shaft ? 1.0 : 0.0};
    if (text.starts_with(image)) return image_input(text.substr(image.size()));
    const std::size_t space = text.find(' ');
    if (space == 0 || space == std::string_view::npos) return std::nullopt;
    const auto value = number_of(text.substr(space + 1));
    if (!value) return std::nullopt;
    return HandInput{HandInput::Kind::drive, std::string(text.substr(0, space)), *value};
}

}  // namespace kerf::documents
