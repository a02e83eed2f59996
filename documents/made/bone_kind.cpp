// SPDX-License-Identifier: Apache-2.0
#include "documents/made/bone_kind.h"

#include <algorithm>

#include "documents/made/femur/femur.h"
#include "documents/made/mandible/mandible.h"
#include "documents/made/vertebra/vertebra.h"
#include "kerf/assert.hpp"

namespace kerf::documents {

const std::vector<BoneKind>& bone_kinds() {
    static const std::vector<BoneKind> kinds{vertebra_kind(), femur_kind(), mandible_kind()};
    return kinds;
}

const std::vector<std::string>& made_kinds() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const BoneKind& kind : bone_kinds()) all.push_back(kind.name);
        return all;
    }();
    return names;
}

const std::vector<std::string>& made_levels() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const BoneKind& kind : bone_kinds()) all.insert(all.end(), kind.levels.begin(), kind.levels.end());
        return all;
    }();
    return names;
}

std::vector<MakeRequest> all_made_bones() {
    std::vector<MakeRequest> all;
    for (const BoneKind& kind : bone_kinds()) {
        if (kind.levels.empty()) all.push_back({.kind = kind.name, .level = ""});
        for (const std::string& level : kind.levels) all.push_back({.kind = kind.name, .level = level});
    }
    return all;
}

const BoneKind& bone_kind(const std::string& name) {
    const std::vector<BoneKind>& kinds = bone_kinds();
    const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const BoneKind& k) { return k.name == name; });
    KERF_ASSERT(found != kinds.end(), "name a kind of `made_kinds()`");
    return *found;
}

}  // namespace kerf::documents
