// What a render will take of a device's memory.
#include "host/gpu/memory_plan.h"

#include "host/base/error.h"
#include "host/packing/skip_list.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hyalite::core::gpu {
namespace {

DeviceInfo device() {
    DeviceInfo info;
    info.name = "a device";
    info.type = DeviceType::Discrete;
    info.subgroupSize = info.consecutiveLanes = 8;
    info.maxStorageBufferBytes = 128u << 20;
    info.maxTexelBufferElements = 1u << 24;
    info.maxAllocationBytes = 1u << 30;
    info.deviceMemoryBytes = 1u << 30;
    return info;
}

/// A scene of so many triangles, with glass.
PackedScene sceneOf(std::size_t triangleCount) {
    PackedScene scene;
    scene.hasTriangles = triangleCount > 0;
    scene.hasDielectric = true;
    scene.treeDepth = 20;
    scene.triangles.resize(triangleCount);
    scene.normals.resize(triangleCount);
    scene.nodes.resize(triangleCount / 4 + 1);
    scene.materials.resize(1);
    return scene;
}

const RenderSettings whitted{.integrator = Integrator::Whitted, .maxDepth = 5};

Job jobOf(const PackedScene &scene, int side, const RenderSettings &settings = whitted) {
    return {scene, settings, {0, side, 0, side}, 0, 16, false};
}

std::string refusal(const ScenePlan &scene, const JobPlan &job, const DeviceInfo &device) {
    try {
        (void)requireMemory(scene, job, false, device);
    } catch (const Error &error) {
        EXPECT_EQ(error.kind, ErrorKind::LimitExceeded);
        return error.what();
    }
    return {};
}

TEST(MemoryPlan, HasAllThatASceneTakes) {
    const PackedScene scene = sceneOf(1000);
    const ScenePlan plan = planScene(scene, *findKernel("stack"));
    EXPECT_EQ(plan.buffers[layout::bindingTriangles].sizeBytes, 48'000u);
    EXPECT_EQ(plan.buffers[layout::bindingNormals].sizeBytes, 48'000u);
    EXPECT_EQ(plan.buffers[layout::bindingNodes].sizeBytes, 251u * 64u);
    EXPECT_EQ(plan.buffers[layout::bindingNodes].use, BufferUse::Storage);
    EXPECT_EQ(plan.buffers[layout::bindingEmitters].sizeBytes, 16u) << "a binding needs some memory";
    EXPECT_EQ(plan.hostBytes, 0u);
    const ScenePlan listed = planScene(scene, *findKernel("skip-list"));
    EXPECT_EQ(listed.buffers[layout::bindingNodes].sizeBytes, (251u * 2u * 2u + 1u) * 16u)
        << "two lists with both children of each pair, and what rays at their end read";
    EXPECT_EQ(listed.buffers[layout::bindingTriangles].use, BufferUse::Texels);
    EXPECT_GT(listed.hostBytes, listed.buffers[layout::bindingNodes].sizeBytes)
        << "they are made on the host";
}

TEST(MemoryPlan, EstimatesTheTreeOfRayQueries) {
    PackedScene scene = sceneOf(1000);
    scene.trees = {{0, 0, {}}, {0, 600, {}}};
    EXPECT_EQ(planScene(scene, *findKernel("ray-query")).buffers[layout::bindingNodes].sizeBytes,
              600u * 192u);
    scene.instances.resize(3);
    const ScenePlan plan = planScene(scene, *findKernel("ray-query"));
    EXPECT_EQ(plan.buffers[layout::bindingNodes].sizeBytes, (600u + 3u * 400u) * 192u)
        << "instances are placed";
    EXPECT_EQ(plan.buffers[layout::bindingNodes].use, BufferUse::TopLevel);
}

TEST(MemoryPlan, KernelsThatStopInsideOfSamplesKeepTheirSlots) {
    const PackedScene scene = sceneOf(1000);
    const RenderConfig stack = completed({.kernel = findKernel("stack")}, device());
    const JobPlan plan = planJob(jobOf(scene, 100), stack, device());
    EXPECT_FALSE(plan.isDirect);
    EXPECT_EQ(plan.largestTile, (Tile{0, 0, 104, 104}));
    const std::uint64_t slots = 104 * 104;
    EXPECT_EQ(plan.waiting.paths.sizeBytes, slots * sizeof(layout::PathRecord));
    EXPECT_EQ(plan.waiting.pending.sizeBytes, slots * 4 * sizeof(layout::PendingRay));
    EXPECT_EQ(plan.stacks.sizeBytes, slots * 32 * 4);
    EXPECT_EQ(plan.film.sizeBytes, 100u * 100u * sizeof(layout::FilmPixel));
    EXPECT_EQ(plan.helperWaiting.paths.sizeBytes, 0u);
}

TEST(MemoryPlan, PathsWithoutATreeAreRegenerated) {
    const RenderConfig skip = completed(
        {.tileWidth = 64, .tileHeight = 64, .kernel = findKernel("skip-list")}, device(), Workload::Spheres);
    const auto planOf = [&](const PackedScene &scene, Integrator integrator, const RenderConfig &config) {
        const RenderSettings settings{.integrator = integrator};
        return planJob(jobOf(scene, 300, settings), config, device());
    };
    const PackedScene spheres = sceneOf(0);
    const JobPlan plan = planOf(spheres, Integrator::Path, skip);
    EXPECT_TRUE(plan.regeneratesPaths);
    EXPECT_EQ(plan.stacks.sizeBytes, 64u * 64u * 8u * sizeof(layout::SampleRecord));
    EXPECT_FALSE(planOf(spheres, Integrator::Whitted, skip).regeneratesPaths);
    EXPECT_FALSE(planOf(sceneOf(1000), Integrator::Path, skip).regeneratesPaths);
    PackedScene room = sceneOf(2);
    EXPECT_FALSE(planOf(room, Integrator::Path, skip).regeneratesPaths);
    room.trianglePairs.emplace_back();
    EXPECT_TRUE(planOf(room, Integrator::Path, skip).regeneratesPaths);
    RenderConfig counting = skip;
    counting.isCounting = true;
    EXPECT_FALSE(planOf(room, Integrator::Path, counting).regeneratesPaths) << "it resumes inside of samples";
}

TEST(MemoryPlan, KernelsThatEndWithSamplesHaveASmallHelper) {
    const PackedScene scene = sceneOf(1000);
    const RenderConfig skip =
        completed({.tileWidth = 256, .tileHeight = 256, .kernel = findKernel("skip-list")}, device());
    const JobPlan plan = planJob(jobOf(scene, 300), skip, device());
    EXPECT_TRUE(plan.isDirect);
    EXPECT_EQ(plan.samplesInFlight, 8u);
    EXPECT_EQ(plan.largestTile, (Tile{0, 0, 256, 256}));
    EXPECT_EQ(plan.waiting.paths.sizeBytes, 16u);
    EXPECT_EQ(plan.waiting.pendingInRegisters, 4u);
    EXPECT_EQ(plan.stacks.sizeBytes, 16u);
    EXPECT_EQ(plan.maxHelperPixels, 4096u);
    EXPECT_EQ(plan.helperWaiting.paths.sizeBytes, 4096 * 8 * sizeof(layout::PathRecord));
    EXPECT_EQ(plan.helperWaiting.pending.use, BufferUse::Texels);
}

TEST(MemoryPlan, SlotsAreForSamplesThatAreMissing) {
    const PackedScene scene = sceneOf(1000);
    const RenderConfig skip = completed({.kernel = findKernel("skip-list")}, device());
    std::vector<layout::FilmPixel> film(16 * 16);
    Job job = jobOf(scene, 16);
    job.film = film;
    EXPECT_EQ(planJob(job, skip, device()).samplesInFlight, 8u);
    for (layout::FilmPixel &pixel : film)
        pixel.sampleCount = job.sampleEnd - 4;
    EXPECT_EQ(planJob(job, skip, device()).samplesInFlight, 4u);
    film[3].sampleCount = 0;
    EXPECT_EQ(planJob(job, skip, device()).samplesInFlight, 8u) << "a pixel has none";
}

TEST(MemoryPlan, TilesAreSmallerWhereSlotsWouldTakeTooMuch) {
    const PackedScene scene = sceneOf(1000);
    const RenderSettings deep{.integrator = Integrator::Whitted, .maxDepth = 32};
    const RenderConfig stack =
        completed({.tileWidth = 512, .tileHeight = 512, .kernel = findKernel("stack")}, device());
    DeviceInfo small = device();
    small.deviceMemoryBytes = 256u << 20;
    small.maxStorageBufferBytes = 1u << 20;
    for (const DeviceInfo &info : {device(), small}) {
        const JobPlan plan = planJob(jobOf(scene, 512, deep), stack, info);
        EXPECT_LT(plan.largestTile.pixelCount(), 512u * 512u);
        EXPECT_LE(plan.waiting.pending.sizeBytes, info.maxStorageBufferBytes);
        EXPECT_LE(plan.stacks.sizeBytes + plan.waiting.paths.sizeBytes + plan.waiting.pending.sizeBytes,
                  info.deviceMemoryBytes / 4);
        EXPECT_GE(4 * plan.waiting.pending.sizeBytes, info.maxStorageBufferBytes)
            << "not smaller than need be";
    }
}

TEST(MemoryPlan, TheHelperIsSmallerWhereItsSlotsWouldTakeTooMuch) {
    const PackedScene scene = sceneOf(1000);
    DeviceInfo small = device();
    small.maxTexelBufferElements = 1u << 16;
    const JobPlan plan =
        planJob(jobOf(scene, 512), completed({.kernel = findKernel("skip-list")}, small), small);
    EXPECT_EQ(plan.maxHelperPixels, 512u);
    EXPECT_EQ(plan.helperWaiting.pending.sizeBytes, 512u * 8 * 4 * sizeof(layout::PendingRay));
    small.deviceMemoryBytes = 1;
    EXPECT_EQ(planJob(jobOf(scene, 512), completed({.kernel = findKernel("skip-list")}, small), small)
                  .maxHelperPixels,
              64u);
}

TEST(MemoryPlan, IsTheSumOfAllBuffers) {
    const PackedScene scene = sceneOf(1000);
    const RenderConfig stack = completed({.kernel = findKernel("stack")}, device());
    const ScenePlan scenePlan = planScene(scene, *findKernel("stack"));
    const JobPlan job = planJob(jobOf(scene, 100), stack, device());
    const MemoryPlan memory = requireMemory(scenePlan, job, false, device());
    EXPECT_GT(memory.deviceBytes, scenePlan.buffers[layout::bindingTriangles].sizeBytes +
                                      scenePlan.buffers[layout::bindingNormals].sizeBytes +
                                      scenePlan.buffers[layout::bindingNodes].sizeBytes + job.film.sizeBytes +
                                      job.stacks.sizeBytes + job.waiting.paths.sizeBytes +
                                      job.waiting.pending.sizeBytes);
    EXPECT_EQ(memory.hostBytes, 0u);
    EXPECT_EQ(requireMemory(scenePlan, job, true, device()).hostBytes, job.waiting.paths.sizeBytes)
        << "staging: the largest buffer";
}

TEST(MemoryPlan, WhatDoesNotFitIsRefusedWithItsParts) {
    const PackedScene scene = sceneOf(100'000);
    DeviceInfo info = device();
    const ScenePlan scenePlan = planScene(scene, *findKernel("stack"));
    const JobPlan job = planJob(jobOf(scene, 64), completed({.kernel = findKernel("stack")}, info), info);
    EXPECT_EQ(refusal(scenePlan, job, info), "");
    info.deviceMemoryBytes = 8u << 20;
    for (const char *part : {"a device, which has 8.0 MiB", "the triangles: 4.6 MiB"})
        EXPECT_NE(refusal(scenePlan, job, info).find(part), std::string::npos)
            << refusal(scenePlan, job, info);
    info = device();
    info.maxStorageBufferBytes = 1u << 20;
    EXPECT_NE(
        refusal(scenePlan, job, info).find("the nodes, 1600064 bytes, is too large: a device allows 1048576"),
        std::string::npos)
        << refusal(scenePlan, job, info);
}

TEST(MemoryPlan, ADeviceOfSoftwareTakesTheHostsMemory) {
    PackedScene scene = sceneOf(1);
    DeviceInfo info = device();
    info.maxAllocationBytes = info.maxStorageBufferBytes = info.deviceMemoryBytes = std::uint64_t{1} << 60;
    ScenePlan scenePlan = planScene(scene, *findKernel("stack"));
    const JobPlan job = planJob(jobOf(scene, 8), completed({.kernel = findKernel("stack")}, info), info);
    scenePlan.buffers[layout::bindingTriangles].sizeBytes = std::uint64_t{1} << 50;
    EXPECT_EQ(refusal(scenePlan, job, info), "");
    info.type = DeviceType::Cpu;
    EXPECT_NE(refusal(scenePlan, job, info).find("are available"), std::string::npos);
}

} // namespace
} // namespace hyalite::core::gpu
