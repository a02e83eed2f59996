// SPDX-License-Identifier: Apache-2.0
// What docs/design/session.md promises: a session is read by a few lines of Python.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "session/recorder.h"
#include "synthetic_run.h"
#include "tests/support/temporary_folder.h"

namespace kerf::session {
namespace {

using test::TemporaryFolder;

/// The page's function, between the fences of its only block of Python.
std::string reader_of_the_page() {
    const std::string page = test::contents_of(KERF_SOURCE_DIR "/docs/design/session.md"), fence = "```python\n";
    const std::size_t begin = page.find(fence);
    if (begin == std::string::npos) return {};
    const std::size_t end = page.find("```", begin + fence.size());
    return page.substr(begin + fence.size(), end - begin - fence.size());
}

/// The same without numpy, which not every machine has.
constexpr const char* reader_without_numpy = R"(
import array, math, sqlite3, struct, zlib

def bits_of_guess(number, factor):
    product = struct.unpack("<f", struct.pack("<f", number))[0] * factor
    return struct.unpack("<I", struct.pack("<f", product))[0] if math.isfinite(product) else 0

def column(path, table, name):
    database = sqlite3.connect(path)
    form, like, factor = database.execute(
        "SELECT format, like_column, factor FROM columns WHERE table_name=? AND name=?", (table, name)).fetchone()
    width = 4 if form == "float32" else 8
    bits = []
    for rows, differences, data in database.execute(
            "SELECT rows, differences, data FROM blocks WHERE table_name=? AND column_name=? ORDER BY block", (table, name)):
        planes = zlib.decompress(data)
        part = [int.from_bytes(planes[row::rows], "little") for row in range(rows)]
        part = [value >> 1 ^ -(value & 1) for value in part]
        for _ in range(differences):
            for row in range(1, rows):
                part[row] += part[row - 1]
        bits += part
    if like:
        bits = [value + bits_of_guess(number, factor) for value, number in zip(bits, column(path, table, like))]
    numbers = array.array({"int64": "q", "float64": "d", "float32": "f"}[form])
    numbers.frombytes(b"".join((value % 256**width).to_bytes(width, "little") for value in bits))
    numbers.extend(value for (value,) in database.execute(f'SELECT "{name}" FROM {table} ORDER BY rowid'))
    return numbers
)";

/// Prints columns as the bits of doubles, a sum for each.
constexpr const char* sums = R"(
import struct, sys
for table, name in (("ticks", "tick"), ("ticks", "device_from_handle_x"), ("ticks", "thrust"), ("ticks", "tissue"),
                    ("ticks", "commanded_fz"), ("cuts", "sequence"), ("cuts", "to_z")):
    total = 0
    numbers = list(column(sys.argv[1], table, name))
    for number in numbers:
        total = (total * 31 + struct.unpack("<Q", struct.pack("<d", number))[0]) % 2**64
    print(table, name, len(numbers), total)
)";

int exit_code_of(const std::string& command) {
    const int status = std::system((command + " > /dev/null 2>&1").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string output_of(const std::string& command) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen((command + " 2>&1").c_str(), "r"), &pclose);
    std::string all;
    std::array<char, 512> some{};
    while (pipe != nullptr && std::fgets(some.data(), static_cast<int>(some.size()), pipe.get()) != nullptr)
        all += some.data();
    return all;
}

/// Runs a reader on a session of more rows than a block has; compares with what was recorded.
void expect_reads(const std::string& reader) {
    const TemporaryFolder folder;
    constexpr double force_scale = 0.06375;
    SessionHeader header;
    header.conditions.force_scale = force_scale;
    auto recorder = Recorder::create(folder / "session.db", header).recorder;
    ASSERT_NE(recorder, nullptr);
    std::array<std::uint64_t, 7> expected{};
    const auto add = [&](std::size_t column, double number) {
        expected[column] = expected[column] * 31 + std::bit_cast<std::uint64_t>(number);
    };
    constexpr std::size_t count = 5000;
    for (const TickRow& row : test::synthetic_ticks(count)) {
        TickRow tick = row;
        tick.device_from_handle.position.x = tick.tick % 2 == 0 ? -0.0 : 0.1 * tick.thrust;
        tick.commanded[2] = force_scale * tick.coupled[2] + (tick.tick % 100 == 0 ? 1.0 : 0.0);
        recorder->push(tick);
        recorder->wait_for_capacity();
        add(0, static_cast<double>(tick.tick));
        add(1, tick.device_from_handle.position.x);
        add(2, static_cast<double>(static_cast<float>(tick.thrust)));
        add(3, tick.tissue);
        add(4, static_cast<double>(static_cast<float>(tick.commanded[2])));
        if (tick.tick % 2 != 0) continue;
        CutRow cut;
        cut.sequence = tick.tick / 2;
        cut.to.position.z = 0.25 * static_cast<double>(tick.tick);
        recorder->push_cut(cut);
        add(5, static_cast<double>(cut.sequence));
        add(6, cut.to.position.z);
    }
    ASSERT_EQ(recorder->finish(test::synthetic_summary()), "");

    std::ofstream(folder / "read.py") << reader << sums;
    std::ostringstream wanted;
    const char* const columns[] = {"ticks tick",   "ticks device_from_handle_x", "ticks thrust",
                                   "ticks tissue", "ticks commanded_fz",         "cuts sequence",
                                   "cuts to_z"};
    for (std::size_t i = 0; i < expected.size(); ++i)
        wanted << columns[i] << ' ' << (i < 5 ? count : count / 2) << ' ' << expected[i] << '\n';
    // The page's last line reads session.db where it is run
    EXPECT_EQ(output_of("cd " + folder.path() + " && python3 read.py session.db"), wanted.str());
}

TEST(PythonReader, OfThePageReadsEachNumber) {
    ASSERT_NE(reader_of_the_page(), "") << "docs/design/session.md has no Python";
    if (exit_code_of("python3 -c 'import numpy, sqlite3, zlib'") != 0)
        GTEST_SKIP() << "skipped: python3 or numpy is not installed";
    expect_reads(reader_of_the_page());
}

TEST(PythonReader, NeedsNothingButTheStandardLibrary) {
    if (exit_code_of("python3 -c 'import sqlite3, zlib'") != 0) GTEST_SKIP() << "skipped: python3 is not installed";
    expect_reads(reader_without_numpy);
}

}  // namespace
}  // namespace kerf::session
