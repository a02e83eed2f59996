// SPDX-License-Identifier: Apache-2.0
#include "run/verdict/law_checks.h"

#include <gtest/gtest.h>

#include <string>

#include "core/haptics/law/channel.h"

namespace kerf::run {
namespace {

constexpr double mm3 = 1e-9;

/// A ledger whose law resists with a force [N] over each millisecond, at 1 mm/s.
class Resisted {
public:
    void resist(double force) {
        EvaluatedLaw law;
        law.count = law.law_count = 1;
        law.channel[0].d[2] = 1.0;
        AppliedMotion applied;
        applied.rate[2] = 1e-3;
        applied.lambda = &force;
        applied.dt = 1e-3;
        static_cast<void>(ledger_.add(law, applied, true));
    }
    [[nodiscard]] const LawLedger& ledger() const { return ledger_; }

private:
    LawLedger ledger_;
};

/// Removes `step` each 50 ms under `force`. Returns the volume at which the bone went without force; 0: never.
double removed_when_odd(double force, double step, double end, bool is_driven = true) {
    Resisted law;
    LawChecks checks;
    for (double removed = 0.0; removed < end; removed += step) {
        for (int i = 0; i < 50; ++i) law.resist(force);
        if (checks.follow(removed, law.ledger(), is_driven, "`saw`")) return removed;
    }
    return 0.0;
}

TEST(LawChecks, FindsBoneThatGoesWithoutForce) {
    EXPECT_NEAR(removed_when_odd(0.0, 1.1 * mm3, 100 * mm3), 22 * mm3, 1.2 * mm3);
    EXPECT_EQ(removed_when_odd(0.0, 0.01 * mm3, 15 * mm3), 0.0) << "a little may, until the tool leaves";
    EXPECT_EQ(removed_when_odd(0.05, 1.1 * mm3, 100 * mm3), 0.0) << "a fast burr is hardly resisted";
}

TEST(LawChecks, ExpectsWorkOfAToolWithoutADrive) {
    // 0.05 N over 50 µm are 2.5 µJ for 1.1 mm³, where bone takes 1 mJ/mm³ and more.
    EXPECT_GT(removed_when_odd(0.05, 1.1 * mm3, 100 * mm3, false), 0.0);
    EXPECT_EQ(removed_when_odd(5.0, 1.1 * mm3, 100 * mm3, false), 0.0);
}

TEST(LawChecks, LetsAToolShaveTheWallsOfALargeCut) {
    Resisted law;
    LawChecks checks;
    double removed = 0.0;
    for (int i = 0; i < 1000; ++i) {
        law.resist(1.0);
        EXPECT_FALSE(checks.follow(removed += 2 * mm3, law.ledger(), true, "`saw`"));
    }
    for (int i = 0; i < 40; ++i) EXPECT_FALSE(checks.follow(removed += 2 * mm3, law.ledger(), true, "`saw`"));
    checks.restart(removed, law.ledger());  // another tool
    std::string detail;
    for (int i = 0; i < 40 && detail.empty(); ++i)
        detail = checks.follow(removed += 2 * mm3, law.ledger(), true, "`saw`").value_or("");
    EXPECT_EQ(detail, "`saw`: it removed 20 mm3 of bone without force, of 22 mm3 in all. Add a channel where the tool "
                      "removes bone");
}

TEST(LawChecks, JudgesALittleWhenTheToolLeaves) {
    // A saw that begins a cut grazes bone: 5.7 mm3 of the first 6.8 mm3, measured on the amputation.
    const auto verdict = [](int graze, int cuts) {
        Resisted law;
        LawChecks checks;
        double removed = 0.0;
        for (int i = 0; i < graze; ++i) EXPECT_FALSE(checks.follow(removed += 2 * mm3, law.ledger(), true, "`saw`"));
        for (int i = 0; i < cuts; ++i) {
            law.resist(10.0);
            EXPECT_FALSE(checks.follow(removed += 2 * mm3, law.ledger(), true, "`saw`"));
        }
        return checks.end_tool(removed).value_or("");
    };
    EXPECT_NE(verdict(4, 0), "") << "nothing but grazing";
    EXPECT_EQ(verdict(4, 20), "") << "it went on to cut";
    EXPECT_EQ(verdict(2, 0), "") << "a little may";
}

TEST(LawChecks, MakesTheVerdictInvalid) {
    session::RunSummary summary;
    summary.verdict = session::Verdict::pass;
    LawChecks checks;
    checks.note("haptics.unresisted", "a part of the tool");
    checks.judge(false, summary);
    EXPECT_EQ(summary.verdict, session::Verdict::pass);
    EXPECT_TRUE(summary.reasons.empty());

    checks.note("haptics.quarantined", "`saw`: `tau` is nan.");
    checks.note("haptics.quarantined", "`saw`: `tau` is nan, again.");
    checks.note("haptics.law_made_energy", "`saw`: 12 mJ");
    checks.judge(false, summary);
    EXPECT_EQ(summary.verdict, session::Verdict::invalid);
    ASSERT_EQ(summary.reasons.size(), 2u);
    EXPECT_EQ(summary.reasons[0], "The force law or the solve failed for a time. `saw`: `tau` is nan.");
    EXPECT_EQ(summary.reasons[1], "The force law is unsound. `saw`: 12 mJ.");
    const auto rows = checks.rows(LawLedger{});
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0].value, 2.0);
    EXPECT_EQ(rows[0].status, "broken");
    EXPECT_EQ(rows[1].status, "broken");
    EXPECT_EQ(rows[2].status, "ok");
}

}  // namespace
}  // namespace kerf::run
