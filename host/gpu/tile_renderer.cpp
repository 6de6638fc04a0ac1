#include "host/gpu/tile_renderer.h"

#include "host/base/error.h"
#include "host/packing/light_planes.h"
#include "host/scene/names.h"
#include "shaders/embedded_kernels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <ctime>
#include <tuple>
#include <utility>

namespace hyalite::core::gpu {

namespace {

constexpr std::uint32_t workgroupSize = 64;
constexpr std::uint32_t samplesInPass = 64; // per pixel and pass over the image

// Samples that a slot takes in turn in a dispatch: with more, fewer lanes are idle at the end; with fewer, dispatches
// have enough workgroups for many threads.
constexpr std::uint32_t maxSamplesPerSlot = 32;
constexpr std::uint32_t regenerationGroups = 64;

RayCounts raysOf(const layout::DispatchProgress &counters) {
    return {counters.primaryRays, counters.shadowRays, counters.reflectionRays, counters.refractionRays,
            counters.bounceRays};
}

WorkCounts workOf(const layout::DispatchProgress &counters) {
    return {counters.nodesVisited, counters.boxesTested, counters.trianglesTested, counters.deepestStack};
}

LaneCounts lanesOf(const layout::DispatchProgress &counters, std::uint32_t slotsPerSubgroup) {
    return {counters.traversalPasses, counters.busySlots, slotsPerSubgroup};
}

/// The plan for the resumable or for the direct kernel.
const WaitingPlan &waitingPlan(const JobPlan &plan, bool isResumable) {
    return isResumable && plan.isDirect ? plan.helperWaiting : plan.waiting;
}

/// Buffers or their plans, by binding. `scene` are those of the scene.
template <class T, class Scene>
std::array<const T *, layout::bindingCount> byBinding(const Scene &scene, const T &film, const T &light,
                                                      const T &progress, const T &paths, const T &pending,
                                                      const T &stacks, const T &trace) {
    std::array<const T *, layout::bindingCount> all{};
    std::ranges::transform(scene, all.begin(), [](const T &each) { return &each; });
    all[layout::bindingFilm] = &film;
    all[layout::bindingLight] = &light;
    all[layout::bindingProgress] = &progress;
    all[layout::bindingPaths] = &paths;
    all[layout::bindingPending] = &pending;
    all[layout::bindingStacks] = &stacks;
    all[layout::bindingTrace] = &trace;
    return all;
}

SpecializationConstants constantsOf(const RenderConfig &config, const Job &job, const JobPlan &plan,
                                    bool isResumable) {
    const PackedScene &scene = job.scene;
    const WaitingPlan &waiting = waitingPlan(plan, isResumable);
    SpecializationConstants constants{};
    constants[layout::constantWorkgroupSize] = workgroupSize;
    constants[layout::constantSphereCount] = static_cast<std::uint32_t>(scene.loopSpheres.size());
    constants[layout::constantTreeSpheres] = scene.treeSpheres;
    constants[layout::constantLightCount] = static_cast<std::uint32_t>(scene.lights.size());
    constants[layout::constantHasTriangles] = scene.hasTriangles;
    constants[layout::constantHasNormals] = scene.hasNormals;
    constants[layout::constantHasInstances] = !scene.instances.empty();
    const bool isLookingThrough = looksThrough(job.settings.integrator, job.settings);
    constants[layout::constantHasSpecular] = scene.hasSpecular || isLookingThrough; // metals of glTF
    constants[layout::constantHasDielectric] = scene.hasDielectric;
    constants[layout::constantHasEmission] = scene.hasEmission;
    constants[layout::constantEmitterCount] = static_cast<std::uint32_t>(scene.emitters.size());
    constants[layout::constantHasLightTree] = !scene.lightNodes.empty();
    constants[layout::constantInfiniteEmitters] = scene.infiniteEmitterCount;
    constants[layout::constantScattering] = scene.scattering;
    constants[layout::constantLighting] = scene.lighting;
    constants[layout::constantCamera] = scene.camera;
    constants[layout::constantTexturing] = scene.texturing;
    constants[layout::constantAnyHit] = scene.anyHit;
    constants[layout::constantAlpha] = alphaKindOf(job.settings);
    const LightPlanes light = lightPlanesOf(scene, job.settings);
    constants[layout::constantLightClasses] = light.classes;
    constants[layout::constantLightGroups] = light.groups;
    const bool testsPairs = config.kernel->tree == KernelTree::SkipLists;
    constants[layout::constantTrianglePairs] =
        testsPairs ? static_cast<std::uint32_t>(scene.listedPairs(job.settings.integrator)) : 0;
    constants[layout::constantHasPairs] = testsPairs && scene.hasPairs;
    constants[layout::constantView] = viewOf(job.settings);
    constants[layout::constantPlaceCount] = static_cast<std::uint32_t>(scene.places.size());
    constants[layout::constantTallies] = rowOf(job.settings.integrator).tallies();
    constants[layout::constantLooksThrough] = isLookingThrough;
    constants[layout::constantSampler] = samplerOf(job.settings);
    constants[layout::constantStackSize] = plan.stackSize;
    constants[layout::constantIsTracing] = job.isTraced;
    constants[layout::constantExactDivision] = config.arithmetic == Arithmetic::Native;
    constants[layout::constantSamplesInFlight] = plan.samplesInFlight;
    constants[layout::constantIsResumable] = isResumable;
    constants[layout::constantPathRegeneration] = plan.regeneratesPaths && !isResumable;
    constants[layout::constantBroadcasts] = plan.exchangesByBroadcast;
    constants[layout::constantIsCounting] = config.isCounting;
    constants[layout::constantShowsCost] = showsWork(job.settings);
    constants[layout::constantPendingInRegisters] = waiting.pendingInRegisters;
    return constants;
}

std::shared_ptr<Pipeline> pipelineOf(Device &device, PipelineCache &pipelines, const RenderConfig &config,
                                     const Job &job, const ScenePlan &scenePlan, const JobPlan &plan,
                                     bool isResumable) {
    const WaitingPlan &waiting = waitingPlan(plan, isResumable);
    std::array<BufferUse, layout::bindingCount> uses{};
    std::ranges::transform(byBinding(scenePlan.buffers, plan.film, plan.light, plan.progress, waiting.paths,
                                     waiting.pending, plan.stacks, plan.trace),
                           uses.begin(), [](const BufferPlan *buffer) { return buffer->use; });
    return pipelines.get(
        device,
        fmt::format("{} {}{}", nameOf(job.settings.integrator), kernelName(config),
                    isResumable && config.kernel->lanes == KernelLanes::Exchanging ? ", resumable" : ""),
        kernelWords(config, job.settings.integrator), constantsOf(config, job, plan, isResumable), uses);
}

} // namespace

TileRenderer::TileRenderer(Device &device, PipelineCache &pipelines, const SceneBuffers &buffers,
                           const RenderConfig &config, const Job &job, const ScenePlan &scenePlan,
                           const JobPlan &plan, const DispatchCosts &known)
    : device_(device), pipelines_(pipelines), buffers_(buffers), config_(config), job_(job),
      scenePlan_(scenePlan), plan_(plan), film_(device, plan.film), light_(device, plan.light),
      progress_(device, plan.progress), stacks_(device, plan.stacks), trace_(device, plan.trace),
      sizer_(config.dispatchSeconds, plan.samplesInFlight, plan.largestTile.pixelCount(), known) {
    uploadFilm();
    for (const layout::FilmPixel &pixel : job.film)
        samplesInFilm_ += std::min(pixel.sampleCount, job.sampleEnd); // some may have more
    dispatch_.cropX = static_cast<std::uint32_t>(job.crop.x0);
    dispatch_.cropY = static_cast<std::uint32_t>(job.crop.y0);
    dispatch_.filmWidth = plan.layout.width();
    dispatch_.filmHeight = plan.layout.height();
    dispatch_.isGathered = plan.layout.isGathered() ? 1 : 0;
    dispatch_.sampleBegin = job.sampleBegin;
    dispatch_.stepBudget = config.steps;
    dispatch_.traceCapacity = job.isTraced ? traceCapacity : 0;
    // lavapipe gives each thread one range of workgroups: 16 suits every thread count that divides it.
    dispatch_.interleave = device.info().isSoftware() ? 16 : 1;
    dispatch_.sampleEnd = job.sampleEnd;
    if (plan.regeneratesPaths)
        stacks_.clear();
    moveTo(plan.largestTile);
}

std::uint32_t TileRenderer::slotCount(const Tile &tile) const {
    return static_cast<std::uint32_t>(tile.pixelCount()) * plan_.samplesInFlight;
}

void TileRenderer::moveTo(const Tile &tile) {
    dispatch_.tileX = tile.x;
    dispatch_.tileY = tile.y;
    dispatch_.tileWidth = tile.width;
    dispatch_.tileHeight = tile.height;
    const std::uint32_t slotsPerGroup =
        workgroupSize * static_cast<std::uint32_t>(config_.kernel->raysAtOnce);
    groupCount_ = groupsFor(slotCount(tile), slotsPerGroup);
    dispatch_.samplesPerSlot =
        std::clamp(slotCount(tile) / (slotsPerGroup * regenerationGroups), 1u, maxSamplesPerSlot);
    regenerationGroupCount_ = groupsFor(slotCount(tile), slotsPerGroup * dispatch_.samplesPerSlot);
    addingGroupCount_ = groupsFor(static_cast<std::uint32_t>(tile.pixelCount()), workgroupSize);
}

std::uint32_t TileRenderer::groupsFor(std::uint32_t count, std::uint32_t perGroup) const {
    const std::uint32_t perRound = perGroup * dispatch_.interleave;
    return (count + perRound - 1) / perRound * dispatch_.interleave;
}

void TileRenderer::makeKernel() {
    (plan_.isDirect ? direct_ : resumable_).emplace(makeProgram(!plan_.isDirect));
}

void TileRenderer::warmUp() { warmUp(direct_ ? *direct_ : *resumable_); }

void TileRenderer::warmUp(Program &program) {
    if (program.kernel.isWarm() && (!program.adding || program.adding->isWarm()))
        return;
    const std::uint32_t sampleEnd = std::exchange(dispatch_.sampleEnd, dispatch_.sampleBegin);
    const std::uint32_t groupCount = std::exchange(groupCount_, dispatch_.interleave); // the minimum
    const std::uint32_t regenerationGroupCount = std::exchange(regenerationGroupCount_, dispatch_.interleave);
    (void)runOnce(program);
    groupCount_ = groupCount;
    regenerationGroupCount_ = regenerationGroupCount;
    dispatch_.sampleEnd = sampleEnd;
}

void TileRenderer::makePipeline(Device &device, PipelineCache &pipelines, const RenderConfig &config,
                                const Job &job, const ScenePlan &scenePlan, const JobPlan &plan) {
    (void)pipelineOf(device, pipelines, config, job, scenePlan, plan, !plan.isDirect);
}

TileRenderer::Program TileRenderer::makeProgram(bool isResumable) {
    const WaitingPlan &waiting = waitingPlan(plan_, isResumable);
    Buffer paths(device_, waiting.paths);
    Buffer pending(device_, waiting.pending);
    const auto bound = byBinding(buffers_.buffers, film_, light_, progress_, paths, pending, stacks_, trace_);
    Kernel kernel(device_, pipelineOf(device_, pipelines_, config_, job_, scenePlan_, plan_, isResumable),
                  bound);
    std::optional<Kernel> adding;
    if (plan_.regeneratesPaths && !isResumable) {
        std::array<BufferUse, layout::bindingCount> uses{};
        std::ranges::transform(bound, uses.begin(), [](const Buffer *buffer) { return buffer->use(); });
        adding.emplace(device_,
                       pipelines_.get(device_, "add samples", embeddedKernel("addSamples"),
                                      constantsOf(config_, job_, plan_, isResumable), uses),
                       bound);
    }
    return {std::move(paths), std::move(pending), std::move(kernel), std::move(adding)};
}

TileRenderer::Program &TileRenderer::resumableProgram(Timeline *timeline) {
    if (!resumable_) {
        Stopwatch watch;
        resumable_.emplace(makeProgram(true));
        warmUp(*resumable_);
        const Span span = watch.lap();
        lateBuildSeconds_ += span.seconds();
        if (timeline != nullptr)
            timeline->stages.push_back({"resumable kernel", span, device_.allocatedBytes()});
    }
    return *resumable_;
}

TileTotals TileRenderer::run(const std::function<void(double)> &onProgress, Timeline *timeline,
                             const std::function<bool()> &shouldStop,
                             const std::function<void(const RayCounts &)> &onPause) {
    Run run{onProgress, timeline, shouldStop, onPause, samplesInFilm_, {}};
    // Passes over the whole image: a render that is stopped early has samples everywhere.
    for (std::uint32_t begin = job_.sampleBegin + plan_.fewestSamples;
         begin < job_.sampleEnd && !run.totals.isStopped;) {
        const std::uint32_t end = begin + std::min(samplesInPass, job_.sampleEnd - begin);
        std::vector<WorkItem> waiting = cutFilm(begin);
        while (!waiting.empty() && !run.totals.isStopped) {
            WorkItem &item = waiting.back();
            if (item.begin == end) {
                waiting.pop_back();
            } else if (mustHalve(item, end)) {
                WorkItem half = item;
                std::tie(half.tile, item.tile) = item.tile.halves();
                waiting.push_back(half);
            } else {
                addSamples(item, end, run);
            }
        }
        begin = end;
    }
    return run.totals;
}

void TileRenderer::addSamples(WorkItem &item, std::uint32_t end, Run &run) {
    moveTo(item.tile);
    const std::uint64_t pixels = item.tile.pixelCount();
    const std::uint32_t most = plan_.regeneratesPaths ? plan_.samplesInFlight : samplesInPass;
    dispatch_.sampleEnd = item.begin + std::min({sizer_.samples(pixels), most, end - item.begin});
    dispatch_.isResumed = 0;
    double seconds = 0.0;
    std::uint64_t finished = 0;
    bool isResumed = false;
    bool isUnfinished = true;
    while (isUnfinished && !run.totals.isStopped) {
        const bool isDirect = direct_ && !item.isLong;
        const Step step = dispatch(isDirect ? *direct_ : resumableProgram(run.timeline), isResumed, run);
        isResumed = true;
        isUnfinished = step.counters.unfinishedSlots > 0;
        seconds += step.workSeconds;
        finished += step.counters.finishedSamples;
        // Samples that were in the film already take no time.
        sizer_.learnSamples(seconds, isUnfinished ? finished : pixels * (dispatch_.sampleEnd - item.begin));
        if (!isDirect) {
            dispatch_.isResumed = 1;
            continue;
        }
        item.isLong = isUnfinished && step.counters.finishedSamples == 0;
        const bool isTooLarge = isUnfinished && mustHalve(item, end);
        if (plan_.regeneratesPaths && (item.isLong || isTooLarge))
            stacks_.clear(); // what waits behind an unfinished sample
        if (isTooLarge)
            return;
    }
    item.begin = dispatch_.sampleEnd;
    item.isLong = false;
}

TileRenderer::Step TileRenderer::dispatch(Program &program, bool isResumed, Run &run) {
    const Step step = runOnce(program);
    sizer_.learnWork(step.workSeconds, step.counters.workDone);
    run.samplesFinished += step.counters.finishedSamples;
    TileTotals &totals = run.totals;
    totals.rays += raysOf(step.counters);
    totals.work += workOf(step.counters);
    totals.lanes += lanesOf(step.counters, device_.info().subgroupSize *
                                               static_cast<std::uint32_t>(config_.kernel->raysAtOnce));
    if (run.timeline != nullptr)
        run.timeline->dispatches.push_back(describe(program, step, isResumed));
    ++totals.dispatchCount;
    if (run.onProgress)
        run.onProgress(static_cast<double>(run.samplesFinished) /
                       (static_cast<double>(job_.crop.pixelCount()) * (job_.sampleEnd - job_.sampleBegin)));
    totals.isStopped = run.shouldStop && run.shouldStop();
    if (run.onPause && !totals.isStopped)
        run.onPause(totals.rays);
    return step;
}

std::vector<TileRenderer::WorkItem> TileRenderer::cutFilm(std::uint32_t begin) const {
    std::vector<WorkItem> items;
    for (std::uint32_t y = 0; y < dispatch_.filmHeight; y += plan_.largestTile.height)
        for (std::uint32_t x = 0; x < dispatch_.filmWidth; x += plan_.largestTile.width)
            items.push_back({{x, y, plan_.largestTile.width, plan_.largestTile.height}, begin, false});
    std::ranges::reverse(items);
    return items;
}

bool TileRenderer::mustHalve(const WorkItem &item, std::uint32_t end) const {
    const std::uint64_t most = sizer_.pixels(end - item.begin);
    return item.tile.canBeHalved() &&
           item.tile.pixelCount() > (item.isLong ? std::min(most, plan_.maxHelperPixels) : most);
}

void TileRenderer::readFilm(std::span<layout::FilmPixel> pixels, std::span<float> light) const {
    if (!plan_.layout.isGathered()) {
        film_.download(std::as_writable_bytes(pixels));
        light_.download(std::as_writable_bytes(light));
        return;
    }
    std::vector<layout::FilmPixel> gathered(plan_.layout.pixelCount());
    film_.download(std::as_writable_bytes(std::span(gathered)));
    plan_.layout.scatter(std::span<const layout::FilmPixel>(gathered), 1, pixels);
    const std::size_t lightSize = light.size() / pixels.size();
    std::vector<float> gatheredLight(gathered.size() * lightSize);
    light_.download(std::as_writable_bytes(std::span(gatheredLight)));
    plan_.layout.scatter(std::span<const float>(gatheredLight), lightSize, light);
}

void TileRenderer::uploadFilm() {
    const FilmLayout &ofDevice = plan_.layout;
    const std::uint32_t planes = lightPlanesOf(job_.scene, job_.settings).count();
    if (job_.film.empty()) {
        film_.clear();
        if (planes > 0)
            light_.clear();
    } else if (ofDevice.isGathered()) {
        std::vector<layout::FilmPixel> pixels(ofDevice.pixelCount());
        ofDevice.gather(job_.film, 1, std::span(pixels));
        film_.upload(std::as_bytes(std::span(pixels)));
        const std::size_t size = std::size_t{planes} * layout::lightWordsPerPlane;
        std::vector<float> light(pixels.size() * size);
        ofDevice.gather(job_.light, size, std::span(light));
        light_.upload(std::as_bytes(std::span(light)));
        const std::vector<std::uint32_t> positions = ofDevice.positions();
        film_.upload(std::as_bytes(std::span(positions)), std::span(pixels).size_bytes());
    } else {
        film_.upload(std::as_bytes(job_.film));
        light_.upload(std::as_bytes(job_.light));
    }
}

void TileRenderer::restart() {
    assert(job_.film.empty());
    uploadFilm();
    if (plan_.regeneratesPaths)
        stacks_.clear();
}

std::uint32_t TileRenderer::laneOf(const glm::uvec2 &pixel, std::uint32_t sampleIndex) const {
    // As shaders/drive/places.glsl places slots: tiles begin and end with blocks of 8x8 pixels, whose slots fill
    // subgroups.
    const std::uint32_t x = (pixel.x - dispatch_.cropX) % 8;
    const std::uint32_t y = (pixel.y - dispatch_.cropY) % 8;
    const std::uint32_t inBlock = (x & 3) | (y & 1) << 2 | (x & 4) << 1 | (y & 6) << 3;
    const std::uint32_t slot = inBlock * plan_.samplesInFlight + sampleIndex % plan_.samplesInFlight;
    const auto perLane = static_cast<std::uint32_t>(config_.kernel->raysAtOnce);
    const std::uint32_t lane = plan_.regeneratesPaths ? slot : slot / (8 * perLane) * 8 + slot % 8;
    return lane % device_.info().subgroupSize;
}

std::vector<layout::TraceEvent> TileRenderer::readTrace() const {
    std::vector<layout::TraceEvent> events(std::min(traceEventCount_, traceCapacity));
    trace_.download(std::as_writable_bytes(std::span(events)));
    return events;
}

TileRenderer::Step TileRenderer::runOnce(Program &program) {
    layout::DispatchProgress counters{};
    counters.traceEvents = traceEventCount_;
    dispatch_.workBudget = sizer_.work();
    progress_.upload(std::as_bytes(std::span(&counters, 1)));
    const std::clock_t begin = std::clock();
    const RunTimes times = program.adding ? program.kernel.run(dispatch_, regenerationGroupCount_,
                                                               *program.adding, addingGroupCount_)
                                          : program.kernel.run(dispatch_, groupCount_);
    // A software device shares its processors with other programs. Time spent waiting for them must not make dispatches
    // smaller, which would wait more often.
    const double processorSeconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    const double workSeconds = device_.info().isSoftware()
                                   ? std::min(times.best().seconds(), processorSeconds)
                                   : times.best().seconds();
    progress_.download(std::as_writable_bytes(std::span(&counters, 1)));
    traceEventCount_ = counters.traceEvents;
    if (counters.stackOverflows > 0)
        throw Error(
            ErrorKind::LimitExceeded,
            fmt::format("the traversal stack of {} entries overflowed: the tree of depth {} is damaged",
                        plan_.stackSize, job_.scene.treeDepth));
    return {counters, times, workSeconds};
}

DispatchRecord TileRenderer::describe(const Program &program, const Step &step, bool isResumed) const {
    DispatchRecord record;
    record.kernel = program.kernel.name();
    if (plan_.layout.isGathered()) { // from anywhere in the film
        record.tileX = job_.crop.x0;
        record.tileY = job_.crop.y0;
        record.tileWidth = job_.crop.width();
        record.tileHeight = job_.crop.height();
    } else {
        record.tileX = job_.crop.x0 + static_cast<int>(dispatch_.tileX);
        record.tileY = job_.crop.y0 + static_cast<int>(dispatch_.tileY);
        record.tileWidth = std::min(static_cast<int>(dispatch_.tileWidth), job_.crop.x1 - record.tileX);
        record.tileHeight = std::min(static_cast<int>(dispatch_.tileHeight), job_.crop.y1 - record.tileY);
    }
    record.sampleBegin = dispatch_.sampleBegin;
    record.sampleEnd = dispatch_.sampleEnd;
    record.isResumed = isResumed;
    record.rays = raysOf(step.counters);
    record.invocations =
        std::uint64_t{program.adding ? regenerationGroupCount_ : groupCount_} * workgroupSize;
    record.times = step.times;
    return record;
}

} // namespace hyalite::core::gpu
