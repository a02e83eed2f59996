// SPDX-License-Identifier: Apache-2.0
// Bad drivers of devices, as the program meets them: each is named with its call.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

using test::Ended;
using test::TemporaryFolder;

/// A driver alone in its folder.
class Driver {
public:
    explicit Driver(const std::string& how) : file_(folder_ / ("plugins/driver_that_" + how + ".so")) {
        std::filesystem::create_directory(folder_ / "plugins");
        std::filesystem::copy(KERF_BUILD_DIR "/tests/bad_plugins/driver_that_" + how + ".so", file_);
    }
    [[nodiscard]] Ended kerf(const std::string& command) const {
        return test::kerf(command,
                          "KERF_STATION=" + (folder_ / "none.yaml") + " KERF_PLUGIN_PATH=" + (folder_ / "plugins"));
    }
    [[nodiscard]] std::string out() const { return folder_ / "out"; }
    [[nodiscard]] const std::string& file() const { return file_; }

private:
    TemporaryFolder folder_;
    std::string file_;
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

struct Fault {
    const char *how, *command, *says;
};
class DriverGuard : public testing::TestWithParam<Fault> {};

TEST_P(DriverGuard, NamesTheDriverAndItsCall) {
    const auto& [how, command, says] = GetParam();
    const Driver driver(how);
    const Ended ended = driver.kerf(command);
    EXPECT_EQ(ended.exit_code, 3) << ended.out << ended.err;
    EXPECT_TRUE(has(ended.err, "plugin test.driver (" + driver.file() + "): " + says)) << ended.err;
}

constexpr const char* test_it = "devices test still --for '1 s'";
INSTANTIATE_TEST_SUITE_P(
    Drivers, DriverGuard,
    testing::Values(Fault{"crashes_in_find", "devices", "`find` of `still` crashed (SIGSEGV"},
                    Fault{"crashes_in_open", test_it, "`open` of `still` crashed (SIGSEGV"},
                    Fault{"crashes_in_read", test_it, "`read` of `still` crashed (SIGSEGV"},
                    Fault{"throws_in_read", test_it, "`read` of `still` threw an exception: not today"},
                    Fault{"sleeps_in_read", test_it, "`read` of `still` did not come back within 5 s"},
                    Fault{"crashes_in_problem", test_it, "`problem` of `still` crashed (SIGSEGV"},
                    Fault{"crashes_in_close", test_it, "`close` of `still` crashed (SIGSEGV"}),
    [](const auto& tested) { return std::string(tested.param.how); });

TEST(DriverGuard, LetsASoundDriverBeTested) {
    const Driver driver("does_nothing_wrong");
    const Ended ended = driver.kerf(test_it);
    EXPECT_NE(ended.exit_code, 3) << ended.out << ended.err;
    EXPECT_TRUE(has(ended.out, "position")) << ended.out << ended.err;
}

TEST(DriverGuard, KeepsTheRecordOfARunThatADriverEnds) {
    for (const auto& [how, says] : {std::pair{"crashes_in_write", "`write` of `still` crashed (SIGSEGV"},
                                    std::pair{"exits_in_write", "`write` of `still` ended the program (`exit`)"}}) {
        const Driver driver(how);
        const Ended run =
            driver.kerf("run " KERF_SOURCE_DIR
                        "/procedures/pedicle-awl.yaml --set accuracy.spacing='0.5 mm' --device still --out " +
                        driver.out());
        EXPECT_EQ(run.exit_code, 3) << run.out << run.err;
        EXPECT_FALSE(has(run.out, "verdict")) << run.out;
        EXPECT_TRUE(has(run.err, "plugin test.driver (" + driver.file() + "): " + says)) << run.err;
        EXPECT_TRUE(has(run.err, "is kept in " + driver.out() + "/session.db")) << run.err;
    }
}

}  // namespace
}  // namespace kerf::app
