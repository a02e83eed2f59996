// SPDX-License-Identifier: Apache-2.0
#include "text/sha256.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace kerf::text {
namespace {

// The examples of FIPS 180-4 ("SHA-256 Example (One Block)", "(Multi-Block)", "(Long Message)"), and the empty message.
TEST(Sha256, GivesThePublishedDigests) {
    EXPECT_EQ(sha256_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(sha256_of(std::string(1'000'000, 'a')),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, DependsOnTheBytesNotOnTheParts) {
    std::string text;
    for (int i = 0; i < 300; ++i) text += static_cast<char>(i % 251);
    for (const std::size_t length : {55u, 56u, 63u, 64u, 65u, 119u, 120u, 128u, 300u}) {
        Sha256 in_parts;
        for (std::size_t at = 0; at < length; at += 7)
            in_parts.add(std::string_view(text).substr(at, std::min<std::size_t>(7, length - at)));
        EXPECT_EQ(in_parts.finish(), sha256_of(text.substr(0, length))) << length;
    }
}

TEST(Sha256, IsRecognised) {
    EXPECT_TRUE(is_sha256(sha256_of("")));
    EXPECT_FALSE(is_sha256(""));
    EXPECT_FALSE(is_sha256(std::string(63, 'a')));
    EXPECT_FALSE(is_sha256(std::string(64, 'A')));
    EXPECT_FALSE(is_sha256("../../" + std::string(58, 'a')));
}

}  // namespace
}  // namespace kerf::text
