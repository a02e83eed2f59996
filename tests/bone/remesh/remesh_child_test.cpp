// SPDX-License-Identifier: Apache-2.0
// What a strategy can do wrong costs one request, never the process that asked.
#include "bone/remesh/remesh_child.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "bone/remesh/accept.h"
#include "kerf/units.hpp"
#include "tests/bone/surface/shapes.h"

namespace kerf::bone {
namespace {

using namespace literals;
using namespace std::chrono_literals;

constexpr const char* program = KERF_BUILD_DIR "/libexec/kerf/kerf-remesh";
constexpr const char* zoo = KERF_BUILD_DIR "/lib/kerf-remesh-zoo/kerf_remesh_animals.so";

RemeshRequest cube_request() {
    RemeshRequest request;
    request.base = tagged(test::cube(10.0_mm));
    request.locked.assign(request.base.mesh.vertices.size(), 1);
    return request;
}

std::unique_ptr<RemeshChild> child_with(const std::string& animal) {
    std::string error;
    auto child = RemeshChild::start({program, zoo, animal}, error);
    EXPECT_NE(child, nullptr) << error;
    return child;
}

TEST(RemeshChild, ReturnsWhatTheStrategyMade) {
    const auto child = child_with("copies");
    const RemeshRequest request = cube_request();
    for (int n = 0; n < 3; ++n) {
        const RemeshResult result = child->remesh(request, 5s);
        ASSERT_EQ(result.status, KERF_OK) << result.message;
        EXPECT_EQ(result.mesh.mesh.triangles, request.base.mesh.triangles);
        EXPECT_EQ(flaw_of_result(request, result.mesh), "");
    }
    EXPECT_EQ(child->plugin(), "test.animals 0.1.0");
    EXPECT_EQ(child->restarts(), 0);
}

TEST(RemeshChild, TakesNoResultOfAStrategyThatIsNotConstant) {
    const auto child = child_with("counts");
    for (int n = 0; n < 3; ++n) {
        const RemeshResult result = child->remesh(cube_request(), 5s);
        EXPECT_EQ(result.status, KERF_FAILED);
        EXPECT_EQ(result.message, "the same request gave another result when it was made again");
    }
}

TEST(RemeshChild, GrowsItsMemoryWithTheMesh) {
    const auto child = child_with("copies");
    EXPECT_EQ(child->remesh(cube_request(), 5s).status, KERF_OK);
    RemeshRequest large;
    large.base = tagged(test::sphere(20.0_mm, 7));
    const RemeshResult result = child->remesh(large, 20s);
    ASSERT_EQ(result.status, KERF_OK) << result.message;
    EXPECT_EQ(result.mesh.mesh.vertices.size(), large.base.mesh.vertices.size());
}

TEST(RemeshChild, StartsAgainWhenTheStrategyDies) {
    for (const char* animal : {"dies", "exits"}) {
        const auto child = child_with(animal);
        for (int n = 0; n < RemeshChild::max_restarts; ++n) {
            EXPECT_EQ(child->remesh(cube_request(), 5s).status, KERF_FAILED);
            EXPECT_TRUE(child->is_running());
        }
        const RemeshResult last = child->remesh(cube_request(), 5s);
        EXPECT_EQ(last.status, KERF_FAILED);
        EXPECT_NE(last.message.find("not started again after 3 restarts"), std::string::npos) << last.message;
        EXPECT_FALSE(child->is_running());
        EXPECT_EQ(child->remesh(cube_request(), 5s).status, KERF_FAILED);
    }
}

TEST(RemeshChild, EndsAStrategyThatHangs) {
    const auto child = child_with("hangs");
    const auto start = std::chrono::steady_clock::now();
    const RemeshResult result = child->remesh(cube_request(), 50ms);
    EXPECT_EQ(result.status, KERF_FAILED);
    EXPECT_NE(result.message.find("no answer within 50 ms"), std::string::npos) << result.message;
    EXPECT_LT(std::chrono::steady_clock::now() - start, 20s);
    EXPECT_EQ(child->restarts(), 1);
}

TEST(RemeshChild, OutlivesTheThreadThatStartedItAgain) {
    const auto child = child_with("hangs");
    std::thread([&] { (void)child->remesh(cube_request(), 50ms); }).join();
    std::this_thread::sleep_for(100ms);
    const RemeshResult result = child->remesh(cube_request(), 50ms);
    EXPECT_NE(result.message.find("no answer within 50 ms"), std::string::npos) << result.message;
}

TEST(RemeshChild, LetsAStrategyCancelAtItsDeadline) {
    const auto child = child_with("gives_way");
    EXPECT_EQ(child->remesh(cube_request(), 50ms).status, KERF_REMESH_CANCELLED);
    EXPECT_EQ(child->restarts(), 0);
}

TEST(RemeshChild, RefusesAResultThatIsNotInItsMemory) {
    for (const char* animal :
         {"leaves_the_arena", "overflows", "invents_a_vertex", "returns_nan", "invents_a_status"}) {
        const auto child = child_with(animal);
        const RemeshResult result = child->remesh(cube_request(), 5s);
        EXPECT_EQ(result.status, KERF_FAILED) << animal;
        EXPECT_NE(result.message, "") << animal;
    }
}

TEST(RemeshChild, CutsAMessageWithoutAnEnd) {
    const RemeshResult result = child_with("rambles")->remesh(cube_request(), 5s);
    EXPECT_EQ(result.status, KERF_REMESH_REFUSED);
    EXPECT_EQ(result.message.size(), sizeof(kerf_remesh_out::message));
    EXPECT_EQ(result.message.find('\n'), std::string::npos);
}

TEST(RemeshChild, DoesNotTakeAMeshThatTheHostFindsWrong) {
    for (const char* animal : {"moves_a_vertex", "flips_a_face", "drops_a_face"}) {
        const RemeshRequest request = cube_request();
        const RemeshResult result = child_with(animal)->remesh(request, 5s);
        ASSERT_EQ(result.status, KERF_OK) << animal << ": " << result.message;
        EXPECT_NE(flaw_of_result(request, result.mesh), "") << animal;
    }
}

TEST(RemeshChild, IsRefusedWithTheReason) {
    std::string error;
    EXPECT_EQ(RemeshChild::start({program, zoo, "unicorn"}, error), nullptr);
    EXPECT_NE(error.find("no strategy `unicorn`"), std::string::npos) << error;
    EXPECT_EQ(RemeshChild::start({program, "/nowhere/module.so", "copies"}, error), nullptr);
    EXPECT_NE(error.find("cannot be loaded"), std::string::npos) << error;
    EXPECT_EQ(RemeshChild::start({"/nowhere/kerf-remesh", zoo, "copies"}, error), nullptr);
    EXPECT_NE(error.find("cannot be started"), std::string::npos) << error;
    EXPECT_EQ(RemeshChild::start({"/bin/true", zoo, "copies"}, error), nullptr);
    EXPECT_NE(error.find("does not answer"), std::string::npos) << error;
}

}  // namespace
}  // namespace kerf::bone
