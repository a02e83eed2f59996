// SPDX-License-Identifier: Apache-2.0
// What editors are told of documents, held against what the readers say of them.
#include "documents/schema.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "documents/read_anatomy.h"
#include "documents/read_procedure.h"
#include "tests/documents/catalog.h"
#include "tests/documents/every_key.h"
#include "tests/support/json_schema.h"
#include "tests/support/temporary_folder.h"

namespace kerf::documents {
namespace {

using test::as_json;
using test::JsonSchema;
using Kind = ValueShape::Kind;

const JsonSchema& procedure_schema() {
    static const JsonSchema schema(schema_text(shapes::procedure, example_catalog(), "a comment"));
    return schema;
}
const JsonSchema& anatomy_schema() {
    static const JsonSchema schema(schema_text(shapes::anatomy, {}, "a comment"));
    return schema;
}

struct KindOfDocument {
    const Shape& shape;
    const JsonSchema& schema;
    std::function<bool(const std::string&)> is_read;
};

std::vector<KindOfDocument> documents() {
    return {{shapes::procedure, procedure_schema(),
             [](const std::string& text) {
                 text::Diagnostics found;
                 return read_procedure_text("p.yaml", text, example_catalog()).take(found).has_value();
             }},
            {shapes::anatomy, anatomy_schema(), [](const std::string& text) {
                 text::Diagnostics found;
                 return read_anatomy_text("a.yaml", text).take(found).has_value();
             }}};
}

/// What a person might write for a value by mistake, and no reader takes.
std::vector<std::string> mistakes(const ValueShape& value) {
    switch (value.kind) {
        case Kind::text:
            return {"[a, b]", "{a: b}"};
        case Kind::words:
            return {"[a, b]", "{}", "{english: a}", "{en: [a]}"};
        case Kind::id:
            return {"[a, b]", "two words", "ä"};
        case Kind::version:
            return {"0.1", "1.0.0-beta", "[1]"};
        case Kind::path:
            return {"/etc/passwd", "../bone.yaml", "a\\b", "{a: b}"};
        case Kind::yes_no:
            return {"yes", "no", "'on'", "[true]"};
        case Kind::word:
            return {"wrod", "[pass]"};
        case Kind::quantity:
            if (value.need.unit.empty()) return {"1e9", "-1e9", "many", "1 mm", "[1]", "\"1,5\""};
            return {"5",
                    "5 furlong",
                    "5 K",
                    "\"1,5 " + value.need.unit + "\"",
                    value.need.dimension == dimension::force ? "5 mm" : "5 N",
                    "hard",
                    "[5]"};
        case Kind::label:
            return {"1.5", "-3", "70000", "[1]"};
        case Kind::vector:
            return {
                "1 2 mm",   "\"1, 2, 3 mm\"", "[1 mm, 2 mm]", "5 mm", value.need.unit.empty() ? "0 0 1 mm" : "1 2 3",
                "{x: 1 mm}"};
        case Kind::map:
            return {"5", "[a]", "{surely_unknown: 1}"};
        case Kind::list:
            return {"5", "[]", "{a: b}"};
        case Kind::named:
            return {"5", "[a]", "{two words: {}}"};
        case Kind::renamed:
            return {"5", "[a]", "{F-1: two words}"};
        case Kind::parameters:
            return {"5", "{surely_unknown: 1 mm}", "{diameter: 5}", "{diameter: 5 N}"};
        case Kind::drives:
            return {"5", "{surely_unknown: 1 rpm}", "{spindle_speed: 1000}", "{spindle_speed: 5 mm}"};
        case Kind::patch:
            return {"5", "[a]"};
        case Kind::of_signal:
            return {"5", "5 furlong", "5 mm", "hard", "[5]"};
        case Kind::of_metric:
            return {"[5]"};
        case Kind::of_measure:
            return {"5", "5 furlong", "5 N", "hard", "[5]"};
    }
    return {};
}

TEST(Schema, TakesEveryDocumentOfExamples) {
    for (const KindOfDocument& d : documents())
        for (std::size_t choice = 0; choice < EveryKey::choices; ++choice)
            for (const int depth : {0, 1, 2, 3, 9}) {
                const std::string text = EveryKey{.choice = choice, .depth = depth}.document(d.shape);
                EXPECT_EQ(d.schema.breach(as_json(text)), "") << text;
            }
}

TEST(Schema, TakesTheShippedDocuments) {
    const ComponentCatalog catalog = spine_catalog();
    const JsonSchema schema(schema_text(shapes::procedure, catalog, ""));
    EXPECT_EQ(schema.breach(as_json(test::contents_of(KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml"))), "");
    EXPECT_EQ(anatomy_schema().breach(
                  as_json(test::contents_of(KERF_SOURCE_DIR "/procedures/anatomy/vertebra-phantom.yaml"))),
              "");
    for (const char* name : {"l3", "t12"})
        EXPECT_EQ(anatomy_schema().breach(
                      as_json(test::contents_of(std::string(KERF_SOURCE_DIR "/tests/real-data/") + name + ".yaml"))),
                  "");
}

/// Every seventh of the documents that hold a key, or one of a few, each time beginning at another one: reading a
/// document takes milliseconds, and with each choice of the keys that exclude each other there are tens of thousands.
class DocumentsWith {
public:
    explicit DocumentsWith(const Shape& document) : document_(document) {
        for (std::size_t choice = 0; choice < EveryKey::choices; ++choice)
            whole_.push_back(EveryKey{.choice = choice}.document(document));
    }

    struct Pair {
        std::string whole, changed;
    };
    /// Each with what it becomes when `change` is made to it, a document in which that makes a difference; each once.
    std::vector<Pair> changed_by(EveryKey change) {
        std::map<std::string, std::size_t> changed;  // by text, which choice it was made with
        for (std::size_t choice = 0; choice < EveryKey::choices; ++choice) {
            change.choice = choice;
            std::string text = change.document(document_);
            if (text != whole_[choice]) changed.emplace(std::move(text), choice);
        }
        std::vector<Pair> some;
        std::size_t at = turn_++ % std::clamp<std::size_t>(changed.size(), 1, stride);
        for (const auto& [text, choice] : changed) {
            if (at % stride == 0) some.push_back({whole_[choice], text});
            at += stride - 1;
        }
        if (some.empty() && !changed.empty()) some.push_back({whole_[changed.begin()->second], changed.begin()->first});
        return some;
    }

private:
    static constexpr std::size_t stride = 7;
    const Shape& document_;
    std::vector<std::string> whole_;
    std::size_t turn_ = 0;
};

TEST(Schema, RefusesEveryMistakeInTheFormOfAValue) {
    std::size_t count = 0;
    for (const KindOfDocument& d : documents()) {
        DocumentsWith documents(d.shape);
        for_every_key(d.shape, [&](const Shape& shape, const KeyShape& key) {
            for (const std::string& mistake : mistakes(key.value)) {
                bool is_refused_by_reader = true, is_refused_by_schema = true;
                const auto pairs = documents.changed_by({.altered = shape.id + "/" + key.name, .other = mistake});
                EXPECT_FALSE(pairs.empty()) << shape.id << "/" << key.name;
                for (const auto& [whole, text] : pairs) {
                    is_refused_by_reader = is_refused_by_reader && !d.is_read(text);
                    is_refused_by_schema = is_refused_by_schema && !d.schema.breach(as_json(text)).empty();
                    ++count;
                }
                EXPECT_TRUE(is_refused_by_reader) << shape.id << "/" << key.name << ": " << mistake;
                EXPECT_TRUE(is_refused_by_schema) << shape.id << "/" << key.name << ": " << mistake;
            }
        });
    }
    EXPECT_GT(count, 1000u);
}

TEST(Schema, RefusesADocumentWithoutWhatTheShapeRequires) {
    for (const KindOfDocument& d : documents()) {
        DocumentsWith documents(d.shape);
        for_every_key(d.shape, [&](const Shape& shape, const KeyShape& key) {
            const std::string name = shape.id + "/" + key.name;
            const bool is_needed = key.presence == Presence::required || key.presence == Presence::one_of;
            for (const auto& [whole, text] : documents.changed_by({.dropped = name}))
                EXPECT_EQ(!d.schema.breach(as_json(text)).empty(), is_needed) << name << "\n" << text;
        });
    }
}

TEST(Schema, RefusesAKeyThatIsNotThere) {
    for (const KindOfDocument& d : documents()) {
        DocumentsWith documents(d.shape);
        for_every_key(d.shape, [&](const Shape& shape, const KeyShape& key) {
            if (key.value.kind != Kind::map) return;
            for (const auto& [whole, mark] :
                 documents.changed_by({.altered = shape.id + "/" + key.name, .other = "MARK"})) {
                // The map as it was, with one key more.
                const std::size_t at = mark.find("MARK");
                std::string text = whole;
                text.insert(at + 1, whole[at + 1] == '}' ? "surely_unknown: 1" : "surely_unknown: 1, ");
                EXPECT_FALSE(d.is_read(text)) << text;
                EXPECT_NE(d.schema.breach(as_json(text)), "") << text;
            }
        });
    }
}

TEST(Schema, TakesWhateverUnitTheReaderTakes) {
    const text::QuantityNeed speed{dimension::speed, "mm/s", 0.0, 1e9}, length{dimension::length, "mm", -1e9, 1e9},
        plain{dimension::none, "", -1e9, 1e9};
    const text::QuantityNeed density{dimension::density, "g/cm3", 0.0, 1e9}, volume{dimension::volume, "ml", 0.0, 1e9},
        share{dimension::none, "%", 0.0, 1.0};
    for (const text::QuantityNeed& need : {speed, length, plain, density, volume, share}) {
        const std::regex pattern(text::quantity_pattern(need)), row(text::vector_pattern(need));
        for (const char* text :
             {"1 mm", "1mm",      " 1.5e-3  m ", "1 µm",    "5.",      ".5 cm",    "1/50",    "1 / 50",
              "50 %", "1 mm/s",   "1 m/min",     "1 mm*Hz", "1 g/cm3", "1 g/cm^3", "1 kg/m³", "1 cm3",
              "1 ml", "2 mm^2*m", "1",           "1 1",     "-3",      "+3",       "1e999",   "0x10",
              "inf",  "1 mm/",    "N",           "1 /s",    "1 1/s*m"}) {
            const text::QuantityNeed wide{need.dimension, need.unit, -HUGE_VAL, HUGE_VAL};
            if (text::parse_quantity(text, "it", wide).value) {
                EXPECT_TRUE(std::regex_search(text, pattern)) << text << " as " << need.unit;
            }
        }
        for (const char* text : {"1 2 3 mm", "1 2 3mm", "1  2\t3  mm", "1 2 3", "-1 -2.5 .5 m", "1-2-3 mm", ".5.5.5 mm",
                                 "1 2 mm", "1 2 3 4 mm"})
            if (text::parse_vector(text, "it", need).value) {
                EXPECT_TRUE(std::regex_search(text, row)) << text << " as " << need.unit;
            }
    }
}

TEST(Schema, NamesTheDefaultOfEveryKeyThatHasOne) {
    const auto schema = test::Json::parse(schema_text(shapes::procedure, drilling_catalog(), "a comment"));
    EXPECT_EQ(schema["properties"]["time_limit"]["default"], "120 s");
    const Procedure procedure;
    const Rehearsal rehearsal;
    const auto default_of = [](const Shape& shape, const char* key) {
        const KeyShape& k = *shape.find(key);
        return text::parse_quantity(k.fallback, key, k.value.need).value;
    };
    EXPECT_EQ(default_of(shapes::procedure, "time_limit"), procedure.time_limit);
    EXPECT_EQ(default_of(shapes::accuracy, "spacing"), procedure.spacing);
    EXPECT_EQ(default_of(shapes::accuracy, "force"), procedure.accuracy.force);
    EXPECT_EQ(default_of(shapes::accuracy, "volume"), procedure.accuracy.volume);
    EXPECT_EQ(default_of(shapes::budget, "tick"), procedure.budget.tick);
    EXPECT_EQ(default_of(shapes::hand, "feed"), rehearsal.feed);
    EXPECT_EQ(default_of(shapes::hand, "approach"), rehearsal.approach);
    EXPECT_EQ(default_of(shapes::hand, "push"), rehearsal.push);
    EXPECT_EQ(default_of(shapes::hand, "reaction"), rehearsal.reaction);
}

TEST(Schema, GivesEachSignalItsUnit) {
    const auto is_taken = [](const std::string& limit) {
        const std::string whole =
            EveryKey{.altered = "step/limits", .other = "[{" + limit + ", reason: Because.}]"}.document(
                shapes::procedure);
        return procedure_schema().breach(as_json(whole)).empty();
    };
    EXPECT_TRUE(is_taken("signal: {id: drive_power, at_most: 30 W}"));
    EXPECT_TRUE(is_taken("signal: {id: drive_power, at_most: 30 N*m/s}"));
    EXPECT_TRUE(is_taken("signal: {id: engagement, at_least: 0.5}"));
    EXPECT_FALSE(is_taken("signal: {id: drive_power, at_most: 30 rpm}"));
    EXPECT_FALSE(is_taken("signal: {id: drive_power}"));
    EXPECT_FALSE(is_taken("signal: {id: warmth, at_most: 30 W}"));
}

TEST(Schema, TellsOfEveryParameterWithItsRangeAndDefault) {
    const auto schema = test::Json::parse(schema_text(shapes::procedure, drilling_catalog(), "a comment"));
    EXPECT_EQ(schema["$comment"], "a comment");
    bool is_found = false;
    for (const auto& rule : schema["definitions"]["instrument"]["allOf"]) {
        const auto& then = rule["then"]["properties"];
        if (!then.contains("parameters")) continue;
        const auto& diameter = then["parameters"]["properties"]["diameter"];
        is_found = diameter["default"] == "3.2 mm" &&
                   diameter["description"].get<std::string>().find("0.5 mm … 20 mm") != std::string::npos;
    }
    EXPECT_TRUE(is_found);
}

}  // namespace
}  // namespace kerf::documents
