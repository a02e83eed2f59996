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
    {HandInput::Kind::undo, "undo"}, {HandInput::Kind::redo, "redo"},         {HandInput::Kind::remove, "remove"},
    {HandInput::Kind::fuse, "fuse"}, {HandInput::Kind::subtract, "subtract"}, {HandInput::Kind::release, "release"}};
constexpr std::string_view insert = "insert:", place = "place:";
constexpr std::string_view release_shaft = "regrip:1", grip_shaft = "regrip:0";
}  // namespace

std::string text_of(const HandInput& input) {
    for (const auto& [kind, word] : words)
        if (kind == input.kind) return std::string(word);
    if (input.kind == HandInput::Kind::insert) return std::string(insert) + input.id;
    if (input.kind == HandInput::Kind::place) return std::string(place) + input.id;
    if (input.kind == HandInput::Kind::regrip) return std::string(input.value != 0.0 ? release_shaft : grip_shaft);
    char digits[32];
    const auto end = std::to_chars(std::begin(digits), std::end(digits), input.value).ptr;
    return input.id + " " + std::string(digits, end);
}

std::optional<HandInput> hand_input(std::string_view text) {
    for (const auto& [kind, word] : words)
        if (text == word) return HandInput{kind};
    if (text.starts_with(insert)) return HandInput{HandInput::Kind::insert, std::string(text.substr(insert.size()))};
    if (text.starts_with(place)) return HandInput{HandInput::Kind::place, std::string(text.substr(place.size()))};
    if (text == release_shaft || text == grip_shaft)
        return HandInput{HandInput::Kind::regrip, {}, text == release_shaft ? 1.0 : 0.0};
    const std::size_t space = text.find(' ');
    if (space == 0 || space == std::string_view::npos) return std::nullopt;
    HandInput input{HandInput::Kind::drive, std::string(text.substr(0, space)), 0.0};
    const auto [end, error] = std::from_chars(text.data() + space + 1, text.data() + text.size(), input.value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(input.value)) return std::nullopt;
    return input;
}

}  // namespace kerf::documents
