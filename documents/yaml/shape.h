// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "text/quantity.h"

/// The keys and values of a map of a document, as data. Readers use it, and `kerf schema` prints it.
/// The shapes are in documents/shapes/shapes.h.
namespace kerf::documents {

struct Shape;

/// The form of one value.
struct ValueShape {
    enum class Kind {
        text,        ///< anything, in words
        words,       ///< the same, or a map of languages to it
        id,          ///< one word of letters, digits, `.`, `_` and `-`
        version,     ///< `0.1.0`
        path,        ///< of a file, relative; or the map `shape`, if there is one
        yes_no,      ///< `true` or `false`
        word,        ///< one of `words`; or the map `shape`, if there is one
        quantity,    ///< a number and its unit, as `need` says
        label,       ///< a whole number, as `need` says, or a name
        vector,      ///< three numbers and their unit, as `need` says
        map,         ///< of `shape`
        list,        ///< of `item`, not empty
        named,       ///< a map of `item` under ids that the author chooses
        renamed,     ///< a map of any names to ids
        parameters,  ///< of the instrument's tool and force, or of a made bone: plugin or kind define them
        drives,      ///< of the instrument's tool, likewise
        patch,       ///< of the procedure itself: the paths of values, and what they are instead
        of_signal,   ///< a number in the unit of a signal: the step's law declares it
        of_measure,  ///< an angle or a length, as the measure is
        of_metric,   ///< a number in the unit of a metric of the results
    };
    Kind kind = Kind::text;
    text::QuantityNeed need{};
    std::vector<std::string> words{};
    const Shape* shape = nullptr;
    const Shape* other = nullptr;    ///< of a map: one of this shape, which has a single key, may take its place
    std::vector<ValueShape> item{};  ///< one, where `kind` has items
};

/// How many keys of one group a map has.
enum class Presence {
    optional,
    required,
    one_of,  ///< exactly one of the keys so marked
    any_of,  ///< one of the keys so marked, or several
};

struct KeyShape {
    Presence presence = Presence::optional;
    std::string name;
    ValueShape value;
    std::string help;        ///< one sentence
    std::string example;     ///< as it is written behind the key
    std::string fallback{};  ///< the value that holds if the key is absent; empty: none
};

struct Shape {
    std::string id;  ///< of the definition in the schema
    std::string help;
    std::vector<KeyShape> keys;  ///< in the order in which messages and editors list them

    const KeyShape* find(std::string_view key) const noexcept {
        for (const KeyShape& k : keys)
            if (k.name == key) return &k;
        return nullptr;
    }
};

}  // namespace kerf::documents
