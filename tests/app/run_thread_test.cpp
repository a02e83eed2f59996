// SPDX-License-Identifier: Apache-2.0
#include "app/run_thread.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>

#include "app/standard_streams.h"

namespace kerf::app {
namespace {

TEST(RunThread, CarriesOutWorkInOrderOnOneThread) {
    int order = 0;
    auto first = RunThread::of_process().run([&] { return std::pair(++order, std::this_thread::get_id()); });
    auto second = RunThread::of_process().run([&] { return std::pair(++order, std::this_thread::get_id()); });
    const auto a = first.get(), b = second.get();
    EXPECT_EQ(a.first, 1);
    EXPECT_EQ(b.first, 2);
    EXPECT_EQ(a.second, b.second);
    EXPECT_NE(a.second, std::this_thread::get_id());
}

TEST(RunThread, KeepsItsPriority) {
    const auto priority = [] { return getpriority(PRIO_PROCESS, 0); };
    const int before = RunThread::of_process().run(priority).get();
    int of_window = 0, of_run = 0;
    std::thread window([&] {
        setpriority(PRIO_PROCESS, 0, before + 5);
        of_window = priority();
        of_run = RunThread::of_process().run(priority).get();
    });
    window.join();
    EXPECT_EQ(of_window, before + 5);
    EXPECT_EQ(of_run, before);
}

TEST(RunThread, WaitsForWorkWhoseResultIsDropped) {
    std::atomic<bool> is_done{false};
    {
        const auto dropped = RunThread::of_process().run([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            is_done = true;
        });
    }
    EXPECT_TRUE(is_done);
}

TEST(RunThread, PassesExceptionsOn) {
    auto failed = RunThread::of_process().run([]() -> int { throw std::runtime_error("no memory"); });
    EXPECT_THROW(static_cast<void>(failed.get()), std::runtime_error);
    EXPECT_EQ(RunThread::of_process().run([] { return 7; }).get(), 7);
}

TEST(ErrorCopy, HasWhatIsPrintedWhileItLives) {
    print_error("before\n");
    {
        const ErrorCopy copy;
        print_error("kerf: a\n");
        static_cast<void>(complain("b\x1b", exit_fault));
        EXPECT_EQ(copy.text(), "kerf: a\nkerf: b\\x1b\n");
    }
    print_error("after\n");
    EXPECT_EQ(ErrorCopy().text(), "");
}

}  // namespace
}  // namespace kerf::app
