// SPDX-License-Identifier: Apache-2.0
#include "app/learner_code.h"

#include <algorithm>

namespace kerf::app {

bool is_code(const std::string& word) {
    return !word.empty() && word.size() <= 64 && std::all_of(word.begin(), word.end(), [](unsigned char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
               c == '-';
    });
}

std::string refusal_of_learner(const std::string& code) {
    if (code.empty()) return {};
    if (!is_code(code)) return std::string("The code ") + code_rule;
    if (code.front() == '.') return "The code begins with `.`, so its folder would be hidden. Begin with a letter.";
    return {};
}

}  // namespace kerf::app
