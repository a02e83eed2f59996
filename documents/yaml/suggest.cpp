// SPDX-License-Identifier: Apache-2.0
// The names that a message suggests.
#include <algorithm>
#include <cstddef>
#include <utility>

#include "documents/yaml/read_map.h"

namespace kerf::documents {
namespace {

constexpr std::size_t longest_word = 48;  // longer ones are no slip of the finger
constexpr std::size_t max_candidates = 200;
constexpr std::size_t max_listed = 8;  // more words are counted, not shown

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        std::swap(before, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

std::string lower(std::string_view text) {
    std::string low(text);
    for (char& c : low)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return low;
}

struct NameDistance {
    std::size_t distance = 0;
    std::size_t length = 0;  ///< of the part of the name that was compared
};

/// Returns the edit distance from a word to a name, or to the end of the name behind a `.` or `/` if that is smaller:
/// `drilling` means `kerf.drilling`. Capital letters count as small ones.
NameDistance distance_to_name(std::string_view word, std::string_view name) {
    const std::string low_word = lower(word), low_name = lower(name);
    const std::string_view whole = low_name;
    NameDistance best{edit_distance(low_word, whole), whole.size()};
    for (std::size_t at = whole.find_first_of("./"); at != std::string_view::npos;
         at = whole.find_first_of("./", at + 1)) {
        const std::string_view end = whole.substr(at + 1);
        if (const std::size_t distance = edit_distance(low_word, end); distance < best.distance)
            best = {distance, end.size()};
    }
    return best;
}

/// Whether two names differ by the side of the patient alone: the one is not meant by the other.
bool is_other_side(std::string_view one, std::string_view other) {
    constexpr std::string_view right = "right", left = "left";
    const auto is_swapped = [&](std::string_view a, std::string_view b) {
        const std::size_t at = a.find(right);
        return at != std::string_view::npos && a.size() + left.size() == b.size() + right.size() &&
               a.substr(0, at) == b.substr(0, at) && b.substr(at, left.size()) == left &&
               a.substr(at + right.size()) == b.substr(at + left.size());
    };
    const auto ends_swapped = [](std::string_view a, std::string_view b) {
        return a.ends_with("_r") && b.ends_with("_l") && a.substr(0, a.size() - 1) == b.substr(0, b.size() - 1);
    };
    return is_swapped(one, other) || is_swapped(other, one) || ends_swapped(one, other) || ends_swapped(other, one);
}

/// Returns the name of an option: its dashes resemble nothing.
std::string_view without_dashes(std::string_view word) {
    return word.substr(std::min(word.find_first_not_of('-'), word.size()));
}

struct Nearest {
    const std::string* name = nullptr;  ///< null: none is near
    bool is_tied = false;               ///< another name is as near
};

/// Returns the candidate at the smallest distance from the word. At most a third of the word differs, and less than
/// half of a word of two letters.
Nearest nearest_name(std::string_view word, const std::vector<std::string>& candidates) {
    Nearest nearest;
    if (word.size() > longest_word) return nearest;
    std::size_t best_distance = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (std::size_t i = 0; i < std::min(candidates.size(), max_candidates); ++i) {
        const std::string& candidate = candidates[i];
        if (candidate.size() > longest_word || is_other_side(word, candidate)) continue;
        const auto [distance, length] = distance_to_name(word, candidate);
        if (2 * distance >= std::max(word.size(), length)) continue;
        if (distance < best_distance) {
            nearest = {&candidate};
            best_distance = distance;
        } else if (nearest.name != nullptr && distance == best_distance && candidate != *nearest.name) {
            nearest.is_tied = true;
        }
    }
    return nearest;
}

}  // namespace

std::string closest(std::string_view word, const std::vector<std::string>& candidates, const Report& report) {
    return report.is_full() ? std::string() : closest(word, candidates);
}

std::string closest(std::string_view word, const std::vector<std::string>& candidates) {
    const Nearest nearest = nearest_name(word, candidates);
    return nearest.is_tied || nearest.name == nullptr ? std::string() : *nearest.name;
}

bool is_near_any(std::string_view word, const std::vector<std::string>& candidates) {
    return nearest_name(word, candidates).name != nullptr;
}

std::vector<std::string> nearest_first(std::vector<std::string> words, std::string_view like) {
    if (like.size() > longest_word || words.size() > max_candidates) return words;
    like = without_dashes(like);
    const std::string wanted = lower(like);
    const auto rank = [&](const std::string& word) -> std::size_t {
        if (wanted.size() > 2 && lower(word).find(wanted) != std::string::npos) return 0;
        const auto [distance, length] = distance_to_name(like, without_dashes(word).substr(0, longest_word));
        return 2 * distance <= std::max(like.size(), length) ? distance
                                                             : longest_word;  // else they have little in common
    };
    std::vector<std::pair<std::size_t, std::string>> ranked;
    ranked.reserve(words.size());
    for (std::string& word : words) ranked.emplace_back(rank(word), std::move(word));
    std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < words.size(); ++i) words[i] = std::move(ranked[i].second);
    return words;
}

std::string or_choose(const std::string& meant, const std::string& advice) {
    return meant.empty() ? " " + advice : std::string();
}

std::string write_instead(std::string_view word, const std::vector<std::string>& known) {
    if (known.empty()) return "There is none.";
    const std::string meant = closest(word, known);
    return "Write " + (meant.empty() ? listed(known, word) : "`" + meant + "`") + ".";
}

std::string listed(const std::vector<std::string>& words, std::string_view like) {
    if (words.size() > max_listed && !like.empty()) return listed(nearest_first(words, like));
    std::string text;
    const std::size_t shown = std::min(words.size(), max_listed);
    for (std::size_t i = 0; i < shown; ++i) {
        if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
        text += "`" + words[i] + "`";
    }
    return words.size() > max_listed ? text + " or " + std::to_string(words.size() - max_listed) + " more" : text;
}

void refuse_unknown(UnknownName name, Report& report) {
    std::string meant = closest(name.word, name.known, report);
    if (name.is_key && !meant.empty()) meant += ':';
    report.error(name.code, name.span,
                 name.subject + " is unknown: " +
                     (name.known.empty() ? name.if_none
                                         : "expected " + listed(name.known, name.word) + name.of + "." +
                                               or_choose(meant, name.advice)),
                 meant, std::move(name.reason));
}

}  // namespace kerf::documents
