// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace kerf::conformance {

/// A program that runs beside this one, its output read.   [main]
class ChildProgram {
public:
    struct Settings {
        std::vector<std::string> arguments;      ///< the program's file first
        std::vector<std::string> environment{};  ///< "NAME=value", beside or in place of this program's
        bool with_errors = false;                ///< stderr is read too; else it goes where ours goes
    };
    explicit ChildProgram(const Settings& settings);
    /// Ends it if it runs still.
    ~ChildProgram();
    ChildProgram(const ChildProgram&) = delete;
    ChildProgram& operator=(const ChildProgram&) = delete;

    /// Why it could not be started; empty if it could.
    [[nodiscard]] const std::string& error() const noexcept { return error_; }
    /// Reads the next line, without its end. False at the end of its output, or when `is_interrupted` says so.
    bool read_line(std::string& line, const std::function<bool()>& is_interrupted);
    /// Waits for its end and returns its exit code; −1 if a signal ended it.
    int wait();

private:
    [[nodiscard]] bool has_ended();

    int process_ = -1, output_ = -1, status_ = 0;
    std::string bytes_, error_;
};

}  // namespace kerf::conformance
