#include "host/jobs/render_job.h"

#include "host/base/hash.h"
#include "host/engine/identity.h"
#include "host/image/png.h"
#include "host/jobs/diagnosis.h"
#include "host/jobs/film_picture.h"

#include <fmt/format.h>

#include <utility>

namespace hyalite {

namespace {

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A part is a checkpoint that is finished.
RenderRequest withCheckpoint(RenderRequest request) {
    if (request.part) {
        request.checkpoint = request.output;
        request.isResuming = true;
    }
    return request;
}

/// Whether the output may be the frame already; then it is opened only once it is known not to be.
bool mayBeThere(const RenderRequest &request) {
    std::error_code error;
    return request.frame && request.isResuming && std::filesystem::is_regular_file(request.output, error);
}

} // namespace

RenderJob::RenderJob(const RenderRequest &request, const std::string &commandLine, RenderSession &session)
    : request_(withCheckpoint(request)),
      format_(request.part ? ImageFormat::Exr : imageFormatOf(request.output)), session_(session) {
    if (!request_.part && !mayBeThere(request_))
        image_.emplace(request_.output);
    if (!request_.report.empty())
        reportFile_.emplace(request_.report);
    if (!request_.checkpoint.empty()) {
        requireWritableCheckpoint(request_.checkpoint);
        checkpointLock_.emplace(request_.checkpoint);
    }
    report_.origin.commandLine = commandLine;
    report_.output = request_.output;
}

void RenderJob::prepare() {
    if (!session_.isPrepared())
        session_.prepare(request_);
    if (!session_.isOpen()) { // the first picture
        report_.loadSeconds = session_.scene().loadSeconds;
        report_.buildSeconds = session_.scene().buildSeconds;
    }
    report_.origin = provenanceOf(session_.scene(), report_.origin.commandLine);
    const Part part = request_.part.value_or(Part{});
    if (const std::uint32_t most = Partition::mostParts(session_.scene().crop); part.count > most)
        throw OverrideError("part",
                            fmt::format("found {}/{}; a picture of {} x {} pixels has at most {} parts",
                                        part.index, part.count, session_.scene().crop.width(),
                                        session_.scene().crop.height(), most));
    partition_.emplace(session_.scene().crop, part.count);
}

std::span<const Crop> RenderJob::squares() const {
    return partition_->squaresOf(request_.part.value_or(Part{}).index);
}

std::uint64_t RenderJob::pixelCount() const {
    return partition_->pixelCountOf(request_.part.value_or(Part{}).index);
}

void RenderJob::requireRoom() const {
    if (format_ == ImageFormat::Png)
        requirePngSize(request_.output, session_.scene().crop.width(), session_.scene().crop.height());
    const bool isCopied = !request_.checkpoint.empty() || request_.partialSeconds;
    requireFilmMemory(session_.scene().crop,
                      (isCopied ? 2 : 1) + static_cast<unsigned>(request_.layers.size()));
}

void RenderJob::openDevice() {
    requireRoom();
    session_.open();
    report_.device = session_.backend().identity(session_.scene().packed,
                                                 session_.scene().loaded.scene.settings.integrator);
}

void RenderJob::lookForFrame() {
    const RenderSettings &settings = session_.scene().loaded.scene.settings;
    const std::string whole =
        fmt::format("{}samples per pixel: {}\nexposure: {}\ntone: {}\n",
                    identityText(identityOf(session_.scene(), session_.backend(), &request_.layers)),
                    settings.samplesPerPixel, settings.exposureStops,
                    static_cast<int>(request_.tone.value_or(ToneCurve::Gamma)));
    frameIdentity_ = hashText(hashBytes(std::as_bytes(std::span(whole))));
    const Crop &crop = session_.scene().crop;
    isFrameThere_ = !image_ && isImageWith(request_.output, frameIdentity_, crop.width(), crop.height());
    if (!isFrameThere_ && !image_)
        image_.emplace(request_.output);
}

void RenderJob::resume() {
    if (request_.frame)
        lookForFrame();
    if (isFrameThere_ || request_.checkpoint.empty())
        return;
    const RenderIdentity identity =
        identityOf(session_.scene(), session_.backend(), request_.part ? &request_.layers : nullptr);
    const int samplesPerPixel = session_.scene().loaded.scene.settings.samplesPerPixel;
    CheckpointSubject subject{session_.scene().crop,
                              request_.part.value_or(Part{}),
                              static_cast<std::uint32_t>(samplesPerPixel),
                              {}};
    if (request_.part)
        subject.origin = toText(partOrigin());
    std::optional<ResumedCheckpoint> resumed;
    if (request_.isResuming)
        try {
            resumed = resumeCheckpoint(request_.checkpoint, identity, subject);
        } catch (const Error &error) {
            // A damaged part is overwritten; one of another picture is an error. A frame that has changed begins anew,
            // as it does without a checkpoint.
            if (request_.part && error.remedy == Remedy::BeginAnew)
                throw Error(error.kind, fmt::format("{}; remove {}, or name another output", error.what(),
                                                    request_.output));
            if (!request_.frame && !request_.part)
                throw;
            checkpointDamage_ = error.what();
        }
    requireOwnCheckpoint(request_.checkpoint);
    // Without a resumed checkpoint, the existing file belongs to another render and may be lost with the second
    // generation.
    checkpoint_.emplace(request_.checkpoint, identity, subject,
                        checkpointDamage_.empty() && (!resumed || resumed->damage.empty()));
    if (!resumed) {
        if (request_.part)
            filmBefore_ = filmOfSquares(session_.scene().crop, squares(), subject.samplesPerPixel);
        return;
    }
    checkpointDamage_ = resumed->damage;
    raysBefore_ = resumed->checkpoint.rays;
    report_.resumed = ResumedWork{
        resumed->path.string(),
        finishedWork(resumed->checkpoint.film, squares(), samplesPerPixel).sampleCount, raysBefore_};
    filmBefore_ = std::move(resumed->checkpoint.film);
    layersBefore_ = std::move(resumed->checkpoint.layers);
}

PartOrigin RenderJob::partOrigin() const {
    PartOrigin origin;
    origin.host = hostName();
    origin.folder = std::filesystem::current_path().string();
    origin.words = request_.words;
    origin.wholeWidth = session_.scene().loaded.scene.camera.width;
    origin.wholeHeight = session_.scene().loaded.scene.camera.height;
    origin.layers = request_.layers;
    origin.provenance = provenanceToJson(report_.origin, report_.device)
                            .dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    return origin;
}

bool RenderJob::isFinishedBefore() const {
    if (isFrameThere_)
        return true;
    if (!request_.part || !report_.resumed || !checkpointDamage_.empty())
        return false;
    const int samplesPerPixel = session_.scene().loaded.scene.settings.samplesPerPixel;
    bool isFinished = finishedWork(*filmBefore_, squares(), samplesPerPixel).isComplete;
    for (std::size_t i = 0; i < layersBefore_.size(); ++i)
        isFinished = isFinished && finishedWork(layersBefore_[i], squares(),
                                                samplesOfView(request_.layers[i], samplesPerPixel))
                                       .isComplete;
    return isFinished;
}

void RenderJob::writeCheckpoint(const Film &film, const RayCounts &rays) {
    std::vector<const Film *> layers;
    if (request_.part)
        for (const ViewFilm &layer : layers_)
            layers.push_back(&layer.film);
    checkpoint_->write(film, rays, layers);
}

std::vector<PeriodicFile> RenderJob::periodicFiles() {
    std::vector<PeriodicFile> files;
    if (checkpoint_)
        files.push_back(
            {request_.checkpointSeconds.value_or(10.0),
             [this](const Film &film, const RayCounts &rays) { writeCheckpoint(film, raysBefore_ + rays); }});
    if (request_.partialSeconds)
        files.push_back({*request_.partialSeconds, [this](const Film &film, const RayCounts &) {
                             AtomicFile partial(request_.output);
                             writePicture(partial, film);
                             partial.commit();
                         }});
    return files;
}

void RenderJob::renderLayers() {
    snapshots_.emplace(session_.scene().crop, periodicFiles(), session_.observer());
    timeLimit_ = TimeLimit(request_.timeLimitSeconds);
    layers_ = renderViews(session_.backend(), session_.scene(), request_.layers,
                          request_.part ? squares() : std::span<const Crop>(), layersBefore_,
                          session_.observer(), timeLimit_);
}

void RenderJob::render() {
    Continuation continuation;
    continuation.film = std::move(filmBefore_);
    continuation.snapshots = &*snapshots_;
    continuation.shareOfOthers = shareOutside(session_.scene().crop, squares());
    BackendResult result =
        hyalite::render(session_.backend(), session_.scene(),
                        request_.frame ? fmt::format("frame {}", *request_.frame) : "render",
                        session_.observer(), timeLimit_, nullptr, std::move(continuation));
    snapshots_->finish();
    takeResult(std::move(result));
}

void RenderJob::takeResult(BackendResult result) {
    stop_ = session_.observer().wantsStop();
    report_.finished =
        finishedWork(result.film, squares(), session_.scene().loaded.scene.settings.samplesPerPixel);
    const int samplesPerPixel = session_.scene().loaded.scene.settings.samplesPerPixel;
    for (const ViewFilm &layer : layers_)
        report_.finished.isComplete =
            report_.finished.isComplete &&
            finishedWork(layer.film, squares(), samplesOfView(layer.view, samplesPerPixel)).isComplete;
    if (result.failure && report_.finished.sampleCount == 0)
        throw Error(*result.failure);
    if (stop_ && report_.finished.sampleCount == 0)
        throw Error(
            stop_->kind,
            fmt::format("stopped by {} before the first sample was finished: nothing is written", stop_->by));
    if (!report_.finished.isComplete)
        report_.stoppedBy = result.failure ? "the device" : stop_ ? stop_->by : "the time limit";
    report_.faults = std::move(result.faults);
    report_.shares = std::move(result.shares);
    report_.timing = result.timing;
    report_.deviceBytes = result.memory.deviceBytes;
    report_.rays = raysBefore_ + result.rays;
    if (result.failure)
        renderFailure_.emplace(*result.failure);
    film_ = std::move(result.film);
}

void RenderJob::writePicture(AtomicFile &file, const Film &film) const {
    const Scene &scene = session_.scene().loaded.scene;
    FilmPicture picture{.film = film, .views = layers_};
    picture.wholeWidth = scene.camera.width;
    picture.wholeHeight = scene.camera.height;
    picture.attributes = attributesOf(provenanceToJson(report_.origin, report_.device));
    if (request_.frame) {
        picture.attributes.emplace_back("frame", fmt::format("{}", *request_.frame));
        picture.attributes.emplace_back("identity", frameIdentity_);
    }
    picture.integrator = scene.settings.integrator;
    picture.exposureStops = scene.settings.exposureStops;
    picture.tone = request_.tone.value_or(ToneCurve::Gamma);
    writeFilmPicture(file, format_, picture);
}

void RenderJob::writeImage() {
    const Clock::time_point writeStart = Clock::now();
    if (checkpoint_) {
        try { // the checkpoint first: if there is no room for the picture, nothing is lost
            writeCheckpoint(*film_, report_.rays);
        } catch (const Error &error) {
            checkpointFailure_.emplace(error);
        }
    }
    if (request_.frame && !report_.finished.isComplete)
        image_.reset(); // who looks at files takes it for finished
    if (image_) {
        writePicture(*image_, *film_);
        image_->commit();
    } else if (report_.finished.isComplete && !checkpointFailure_) {
        std::error_code ignored; // the older generation is of no use to who merges parts
        std::filesystem::remove(olderCheckpoint(request_.checkpoint), ignored);
    }
    report_.writeSeconds = secondsSince(writeStart);
}

void RenderJob::writeReport() {
    report_.totalSeconds = secondsSince(start_);
    if (!reportFile_ || (request_.frame && !report_.finished.isComplete))
        return;
    reportFile_->write(formatReport(report_));
    reportFile_->commit();
}

std::optional<std::string> RenderJob::diagnosis() const {
    return report_.finished.isComplete && !request_.part
               ? diagnosePicture(session_.scene(), *film_, report_.rays)
               : std::nullopt;
}

void RenderJob::throwFailure() const {
    if (checkpointFailure_)
        throw Error(*checkpointFailure_);
    if (renderFailure_)
        throw Error(*renderFailure_);
}

bool RenderJob::isCutByTime() const { return !report_.finished.isComplete && !renderFailure_ && !stop_; }

} // namespace hyalite
