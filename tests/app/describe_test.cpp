// SPDX-License-Identifier: Apache-2.0
#include "app/describe.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/drill_rig.h"
#include "text/quantity.h"

namespace kerf::app {
namespace {

std::string description(const std::string& wanted) {
    std::string error;
    return description_of(test::plugins(), wanted, error).value_or("");
}

TEST(Describe, PrintsEveryValueOfEveryComponent) {
    const std::string text = description("");
    ASSERT_FALSE(test::plugins().catalog().empty());
    for (const ComponentInfo& component : test::plugins().catalog()) {
        EXPECT_NE(text.find(component.plugin + (component.kind == KERF_KIND_REMESHER ? "." : "/") + component.id),
                  std::string::npos);
        for (const auto* values : {&component.parameters, &component.drives})
            for (const ParameterInfo& p : *values)
                for (const std::string& part : {p.id, p.help, p.source, text::quantity_text(p.def, p.display_unit),
                                                "from " + text::quantity_text(p.min, p.display_unit) + " to " +
                                                    text::quantity_text(p.max, p.display_unit)})
                    EXPECT_NE(text.find(part), std::string::npos) << p.id << ": " << part;
        for (const SignalInfo& s : component.signals)
            for (const std::string& part : {s.id, s.help, s.display_unit})
                EXPECT_NE(text.find(part), std::string::npos) << s.id;
        for (const EventInfo& e : component.events)
            EXPECT_NE(text.find(e.id + (e.is_damage ? "  (fails the step)" : "") + "\n        " + e.help + "\n"),
                      std::string::npos)
                << e.id;
    }
    EXPECT_NE(text.find("drilling.wall_broken\n"), std::string::npos);
    EXPECT_NE(text.find("not for diagnosis"), std::string::npos);
}

TEST(Describe, PrintsOneComponent) {
    const std::string text = description("kerf.drilling/twist_drill");
    EXPECT_NE(text.find("    diameter            3.2 mm          from 0.5 mm to 20 mm\n"), std::string::npos) << text;
    EXPECT_NE(text.find("    spindle_speed       1000 rpm        from -3000 rpm to 3000 rpm\n"), std::string::npos)
        << text;
    EXPECT_EQ(text.find("drill_cutting"), std::string::npos);
}

TEST(Describe, SuggestsTheClosestName) {
    std::string error;
    EXPECT_FALSE(description_of(test::plugins(), "kerf.driling", error));
    EXPECT_EQ(error, "there is no plugin or component `kerf.driling`. Write `kerf.drilling`.");
}

TEST(Describe, FindsTheLastPartOfAName) {
    EXPECT_EQ(description("drilling"), description("kerf.drilling"));
    EXPECT_EQ(description("twist_drill"), description("kerf.drilling/twist_drill"));
    std::string error;
    EXPECT_FALSE(description_of(test::plugins(), "twist_dril", error));
    EXPECT_EQ(error, "there is no plugin or component `twist_dril`. Write `kerf.drilling/twist_drill`.");
}

TEST(Describe, PrintsCoreWithoutPlugins) {
    std::string error;
    const auto text = description_of(PluginRegistry(), "", error);
    ASSERT_TRUE(text) << error;
    EXPECT_NE(text->find("forceps"), std::string::npos);
    EXPECT_FALSE(description_of(PluginRegistry(), "kerf.drilling", error));
    EXPECT_NE(error.find("KERF_PLUGIN_PATH"), std::string::npos) << error;
}

}  // namespace
}  // namespace kerf::app
