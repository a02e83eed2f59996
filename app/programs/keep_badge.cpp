// SPDX-License-Identifier: Apache-2.0
#include "app/programs/keep_badge.h"

#include <algorithm>
#include <utility>

#include "app/standard_streams.h"
#include "conformance/kit_version.h"
#include "conformance/report.h"
#include "text/file_digest.h"
#include "text/printable.h"

namespace kerf::app {

using conformance::PluginReport;
using conformance::Status;
using conformance::TestResult;

Badge badge_of(const PluginReport& report, const std::string& digest, int requested) {
    const conformance::Tally count = tally(report);
    Badge badge{.digest = digest,
                .plugin = text::excerpt(report.plugin, 60),
                .kit = conformance::kit_version,
                .requested = requested,
                .does_not = report.does_not};
    int lowest_failed = requested + 1, highest_run = 0;
    for (const TestResult& result : report.results) {
        if (result.status == Status::skipped) {
            badge.excluded += result.text.starts_with("excluded: ") ? 1 : 0;
            continue;
        }
        highest_run = std::max(highest_run, result.level);
        if (result.status == Status::failed) lowest_failed = std::min(lowest_failed, result.level);
    }
    badge.tests = static_cast<int>(count.run()) + badge.excluded;
    badge.failed = static_cast<int>(count.failed);
    badge.level = std::min(lowest_failed - 1, highest_run);
    return badge;
}

BadgeKeeper::BadgeKeeper(const BadgeStore& store, std::string file) : store_(store), file_(std::move(file)) {
    if (store_.is_off()) return;
    text::FileDigest read = text::digest_of_file(file_);
    digest_ = std::move(read.digest);
    fault_ = std::move(read.error);
}

void BadgeKeeper::keep(const PluginReport& report, int requested) const {
    if (store_.is_off()) return;
    const auto complain = [&](const std::string& why) { print_error("kerf: " + file_ + ": " + why + "\n"); };
    if (digest_.empty()) return complain("the badge is not kept: the file cannot be read: " + fault_ + ".");
    const Badge badge = badge_of(report, digest_, requested);
    if (report.error.empty() && tally(report).run() == 0)
        return complain("no badge is kept, because no test ran. Exclude fewer.");
    if (text::digest_of_file(file_).digest != digest_)
        return complain("no badge is kept, because the file has changed during the tests. Check it again.");
    const BadgeStore::Kept kept = store_.keep(badge);
    if (!kept.fault.empty()) complain(kept.fault);
}

}  // namespace kerf::app
