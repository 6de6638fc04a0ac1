#include "host/jobs/picture_render.h"

#include "host/base/hash.h"
#include "host/engine/identity.h"
#include "host/farm/part_origin.h"
#include "host/film/first_samples.h"
#include "host/film/noise.h"
#include "host/image/image_file.h"
#include "host/image/png.h"
#include "host/jobs/denoising.h"
#include "host/jobs/diagnosis.h"
#include "host/jobs/film_picture.h"
#include "host/jobs/layers.h"
#include "host/jobs/noisiest_pixels.h"
#include "host/jobs/periodic_files.h"
#include "host/jobs/projection.h"
#include "host/packing/light_planes.h"
#include "host/reference/denoise.h"
#include "host/scene/light_sources.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <filesystem>
#include <system_error>
#include <utility>

namespace hyalite::core {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Whether the output may be the frame already; then it is opened only once it is known not to be.
bool mayBeThere(const RenderRequest &request) {
    std::error_code error;
    return request.frame && request.isResuming && std::filesystem::is_regular_file(request.output, error);
}

Part partOf(const PictureFiles &files) { return files.request.part.value_or(Part{}); }

void setSquares(const Part &part, const Crop &crop, int smallestSide, PictureBeginning &begun) {
    if (const std::uint32_t most = Partition::maxParts(crop, smallestSide); part.count > most)
        throw OverrideError("part",
                            fmt::format("found {}/{}; a picture of {} x {} pixels has at most {} parts",
                                        part.index, part.count, crop.width(), crop.height(), most));
    const Partition partition(crop, part.count, smallestSide);
    const std::span<const Crop> squares = partition.squaresOf(part.index);
    begun.squares.assign(squares.begin(), squares.end());
    begun.pixelCount = partition.pixelCountOf(part.index);
}

std::string identityOfFrame(const RenderRequest &request, const RenderSession &session) {
    const RenderSettings &settings = session.scene().loaded.settings;
    const FileOptions options = request.file.options();
    std::string whole =
        fmt::format("{}samples per pixel: {}\nexposure: {}\ntone: {}\n",
                    identityText(identityOf(session.scene(), session.backend(), &session.scene().views)),
                    settings.samplesPerPixel, settings.exposureStops, static_cast<int>(options.tone));
    if (options.exr != ExrOptions()) // those of older frames stay what they were
        whole += fmt::format("half: {}\ncompression: {}\n", options.exr.isHalf,
                             static_cast<int>(options.exr.compression));
    if (isAdaptive(settings))
        whole += fmt::format("noise: {}\n", settings.noise);
    if (request.hasMotion)
        whole += "motion vectors\n";
    if (isToBeDenoised(settings))
        whole += fmt::format("denoised: {}\n", reference::denoiserName);
    return hashText(hashBytes(std::as_bytes(std::span(whole))));
}

PartOrigin originOfPart(const RenderRequest &request, const RenderReport &report,
                        const PreparedScene &scene) {
    PartOrigin origin;
    origin.host = hostName();
    origin.folder = std::filesystem::current_path().string();
    origin.words = request.words;
    origin.wholeWidth = scene.loaded.scene.camera.width;
    origin.wholeHeight = scene.loaded.scene.camera.height;
    origin.projection = projectionOf(scene.loaded.scene);
    for (const PictureView &view : viewsOf(scene))
        origin.layers.push_back({view.view, scene.packed.namesOf(view.view), view.isOfDenoiser});
    origin.lightPlanes = lightPlaneNames(scene.packed, scene.loaded.settings);
    origin.provenance = provenanceToJson(report.origin, report.device)
                            .dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    return origin;
}

/// The checkpoint to go on from, if there is one. A damaged part is overwritten; one of another picture is an error. A
/// frame that has changed begins anew, as it does without a checkpoint.
std::optional<ResumedCheckpoint> readBegun(const RenderRequest &request, const RenderIdentity &identity,
                                           const CheckpointSubject &subject, std::string &damage) {
    if (!request.isResuming)
        return std::nullopt;
    try {
        return resumeCheckpoint(request.checkpoint, identity, subject);
    } catch (const Error &error) {
        if (request.part && error.remedy == Remedy::BeginAnew)
            throw Error(error.kind,
                        fmt::format("{}; remove {}, or name another output", error.what(), request.output));
        if (!request.frame && !request.part)
            throw;
        damage = error.what();
        return std::nullopt;
    }
}

bool isPartFinished(const PictureFiles &files, const PreparedScene &scene, const PictureBeginning &begun) {
    const RenderSettings &settings = scene.loaded.settings;
    if (!files.request.part || !begun.report.resumed || !begun.checkpointDamage.empty())
        return false;
    const std::span<const Crop> squares = begun.squares;
    bool isFinished = finishedWork(*begun.film, squares, settings).isComplete;
    const std::vector<PictureView> views = viewsOf(scene);
    for (std::size_t i = 0; i < begun.layers.size(); ++i)
        isFinished = isFinished &&
                     finishedWork(begun.layers[i], squares, samplesOfView(views[i], settings)).isComplete;
    return isFinished;
}

/// Throws for a checkpoint of a render with more samples, which was ended before it had its first ones.
void requireFirst(const PictureBeginning &begun, int samplesPerPixel) {
    const std::uint32_t most =
        samplesBeyondFirst(*begun.film, begun.squares, static_cast<std::uint32_t>(samplesPerPixel));
    if (most > 0)
        throw OverrideError(
            "spp",
            fmt::format("found {} and a checkpoint with {} samples in a pixel, of which the denoiser's first "
                        "ones were not kept; allowed: {} or more",
                        samplesPerPixel, most, std::bit_ceil(most) + 1));
}

void resume(const PictureFiles &files, const RenderSession &session, PictureBeginning &begun) {
    const RenderRequest &request = files.request;
    const PreparedScene &scene = session.scene();
    const int samplesPerPixel = scene.loaded.settings.samplesPerPixel;
    const RenderIdentity identity =
        identityOf(scene, session.backend(), request.part ? &scene.views : nullptr);
    CheckpointSubject subject{scene.crop,
                              partOf(files),
                              static_cast<std::uint32_t>(samplesPerPixel),
                              {},
                              wantedNoise(scene.loaded.settings)};
    if (request.part)
        subject.origin = toText(originOfPart(request, begun.report, scene));
    std::optional<ResumedCheckpoint> resumed = readBegun(request, identity, subject, begun.checkpointDamage);
    requireOwnCheckpoint(request.checkpoint);
    // Without a resumed checkpoint, the existing file belongs to another render and may be lost with the second
    // generation.
    begun.checkpoint.emplace(request.checkpoint, identity, subject,
                             begun.checkpointDamage.empty() && (!resumed || resumed->damage.empty()));
    if (!resumed) {
        if (request.part)
            begun.film = filmOfSquares(scene.crop, begun.squares, subject.samplesPerPixel);
        return;
    }
    begun.checkpointDamage = resumed->damage;
    begun.rays = resumed->checkpoint.rays;
    begun.report.resumed = ResumedWork{
        resumed->path.string(),
        finishedWork(resumed->checkpoint.film, begun.squares, samplesPerPixel).sampleCount, begun.rays};
    begun.film = std::move(resumed->checkpoint.film);
    begun.layers = std::move(resumed->checkpoint.layers);
    if (keepsDenoisingData(scene.loaded.settings) && !isAdaptive(scene.loaded.settings))
        requireFirst(begun, samplesPerPixel);
    const bool isOfSameWish = resumed->checkpoint.samplesPerPixel == subject.samplesPerPixel &&
                              resumed->checkpoint.noise == subject.noise;
    begun.isFinished = isOfSameWish && isPartFinished(files, scene, begun); // else its file is to say so
}

/// The render itself, with what its periodic files need.
class PictureRender {
  public:
    PictureRender(PictureFiles &files, PictureBeginning &begun, RenderSession &session)
        : files_(files), request_(files.request), begun_(begun), session_(session), report_(begun.report),
          squares_(begun.squares) {}

    FinishedPicture finish() {
        const PreparedScene &scene = session_.scene();
        PeriodicFiles snapshots(periodicFiles(), session_.observer());
        const TimeLimit limit(request_.timeLimitSeconds);
        layers_ = renderViews(session_.backend(), session_.scene(), viewsOf(scene),
                              request_.part ? squares_ : std::span<const Crop>(), begun_.layers,
                              session_.observer(), limit);
        const RenderTask task{.name = taskName(),
                              .limit = limit,
                              .snapshots = &snapshots,
                              .shareOfOthers = shareOutside(scene.crop, squares_),
                              .keepsFirst = true};
        BackendResult result =
            render(session_.backend(), scene.packed, scene.loaded.settings,
                   begun_.film ? std::move(*begun_.film) : Film(scene.crop), session_.observer(), task);
        snapshots.finish();
        FinishedPicture finished;
        take(result, finished);
        writeFiles(result.film, finished);
        if (files_.report)
            report_.noisiest = noisiestPixels(scene, result.film, squares_);
        writeReport();
        if (report_.finished.isComplete && !request_.part)
            finished.diagnosis = diagnose(result.film);
        finished.report = std::move(report_);
        return finished;
    }

  private:
    [[nodiscard]] std::string taskName() const {
        if (request_.frame)
            return fmt::format("frame {}", *request_.frame);
        return request_.view.empty() ? "render" : "view " + request_.view;
    }

    void take(BackendResult &result, FinishedPicture &finished) {
        for (const ViewFilm &layer : layers_)
            if (rowOf(layer.view).isOfNumbers() && !rowOf(layer.view).tallies())
                report_.numbers.emplace_back(nameOf(layer.view), layer.names);
        const std::optional<Stop> stop = session_.observer().wantsStop();
        const RenderSettings &settings = session_.scene().loaded.settings;
        report_.finished = finishedWork(result.film, squares_, settings);
        for (const ViewFilm &layer : layers_)
            report_.finished.isComplete =
                report_.finished.isComplete &&
                finishedWork(layer.film, squares_, samplesOfView(layer, settings)).isComplete;
        if (result.failure && report_.finished.sampleCount == 0)
            throw Error(*result.failure);
        if (stop && report_.finished.sampleCount == 0)
            throw Error(
                stop->kind,
                fmt::format("stopped by {} before the first sample{} was finished: nothing{} is written",
                            stop->by, request_.frame ? fmt::format(" of frame {}", *request_.frame) : "",
                            request_.frame ? " of it" : ""));
        if (!report_.finished.isComplete)
            report_.stoppedBy = result.failure ? "the device" : stop ? stop->by : "the time limit";
        finished.isCutByTime = !report_.finished.isComplete && !result.failure && !stop;
        if (result.failure)
            finished.failure.emplace(*result.failure);
        report_.faults = std::move(result.faults);
        report_.shares = std::move(result.shares);
        report_.timing = result.timing;
        report_.deviceBytes = result.memory.deviceBytes;
        report_.rays = begun_.rays + result.rays;
    }

    [[nodiscard]] std::optional<std::string> diagnose(const Film &film) const {
        const PreparedScene &scene = session_.scene();
        const RenderSettings &settings = scene.loaded.settings;
        std::optional<std::string> fault = diagnosePicture(scene, film, report_.rays);
        if (!fault && formatOf(request_) == ImageFormat::Png && rowOf(settings.integrator).showsLight)
            fault = diagnoseExposure(film, settings.exposureStops);
        return fault;
    }

    void writeCheckpoint(const Film &film, const RayCounts &rays) {
        std::vector<const Film *> layers;
        if (request_.part)
            for (const ViewFilm &layer : layers_)
                layers.push_back(&layer.film);
        begun_.checkpoint->write(film, rays, layers);
    }

    /// If the picture is to be denoised, and can be. A failure leaves it noisy.
    std::optional<Image> denoisedColours(const Film &film, FinishedPicture &finished) {
        if (!isToBeDenoised(session_.scene().loaded.settings))
            return std::nullopt;
        const Clock::time_point start = Clock::now();
        std::optional<Image> clean;
        try {
            if ((clean = denoised(session_.backend(), film, layers_, session_.observer())))
                report_.denoiser = reference::denoiserName;
        } catch (const Error &error) {
            session_.observer().warning("the picture stays noisy, as the denoiser failed");
            finished.failure.emplace(error);
        }
        report_.denoiseSeconds = secondsSince(start);
        return clean;
    }

    /// `clean`: the denoised colours, or null.
    [[nodiscard]] FilmPicture pictureOf(const Film &film, const Image *clean) const {
        const LoadedScene &loaded = session_.scene().loaded;
        FilmPicture picture{.film = film, .views = layers_, .clean = clean};
        picture.wholeWidth = loaded.scene.camera.width;
        picture.wholeHeight = loaded.scene.camera.height;
        nlohmann::ordered_json origin = provenanceToJson(report_.origin, report_.device);
        if (report_.finished.noise)
            origin["noise"] = noiseToJson(*report_.finished.noise, loaded.settings.noise);
        picture.attributes = attributesOf(origin);
        if (clean != nullptr)
            picture.attributes.emplace_back(denoisedAttribute, reference::denoiserName);
        if (!request_.view.empty())
            picture.attributes.emplace_back("view", request_.view);
        if (request_.frame) {
            picture.attributes.emplace_back("frame", fmt::format("{}", *request_.frame));
            picture.attributes.emplace_back("identity", begun_.frameIdentity);
        }
        picture.settings = loaded.settings;
        picture.options = request_.file.options();
        picture.projection = projectionOf(loaded.scene);
        picture.motion = motion_;
        return picture;
    }

    /// Into the image's file, or the clip.
    void writePicture(const FilmPicture &picture) {
        std::vector<std::string> losses;
        if (files_.image) {
            losses = writeFilmPicture(*files_.image, formatOf(request_), picture);
            files_.image->commit();
        } else {
            if (files_.clip->frames().empty())
                losses = lossesOf(picture, formatOf(request_), request_.output);
            files_.clip->add(*request_.frame, drawFilmPicture(picture));
        }
        for (const std::string &loss : losses)
            session_.observer().warning(fmt::format("{}: {}", request_.output, loss));
    }

    [[nodiscard]] std::vector<PeriodicFile> periodicFiles() {
        std::vector<PeriodicFile> files;
        if (begun_.checkpoint)
            files.push_back(
                {request_.checkpointSeconds.value_or(10.0), [this](const Film &film, const RayCounts &rays) {
                     writeCheckpoint(film, begun_.rays + rays);
                 }});
        if (request_.partialSeconds)
            files.push_back({*request_.partialSeconds, [this](const Film &film, const RayCounts &) {
                                 AtomicFile partial(request_.output);
                                 // The last one tells what is lost.
                                 writeFilmPicture(partial, formatOf(request_), pictureOf(film, nullptr));
                                 partial.commit();
                             }});
        if (files_.display)
            files.push_back({Display::secondsBetween,
                             [this](const Film &film, const RayCounts &) { files_.display->update(film); }});
        return files;
    }

    void show(const Film &film, const Image *clean) {
        showOn(files_.display, session_.observer(), [&](Display &display) {
            display.update(film);
            if (clean != nullptr)
                display.show(*clean);
        });
    }

    /// The checkpoint first: if there is no room for the picture, nothing is lost.
    void writeFiles(const Film &film, FinishedPicture &finished) {
        const Clock::time_point start = Clock::now();
        bool isStored = true;
        if (begun_.checkpoint) {
            try {
                writeCheckpoint(film, report_.rays);
            } catch (const Error &error) {
                isStored = false;
                finished.failure.emplace(error);
            }
        }
        const bool isWritten = !request_.part && (!request_.frame || report_.finished.isComplete);
        if (isWritten) { // scripts take an existing frame for finished
            if (request_.hasMotion)
                motion_ = motionVectors(session_.scene(), session_.loadNeighbours());
            const std::optional<Image> colours = denoisedColours(film, finished);
            const Image *clean = colours ? &*colours : nullptr;
            show(film, clean);
            writePicture(pictureOf(film, clean));
        } else {
            show(film, nullptr);
            std::error_code ignored; // the older generation is of no use to who merges parts
            if (report_.finished.isComplete && isStored)
                std::filesystem::remove(olderCheckpoint(request_.checkpoint), ignored);
        }
        report_.writeSeconds = secondsSince(start) - report_.denoiseSeconds;
    }

    void writeReport() {
        report_.totalSeconds = secondsSince(files_.openedAt);
        if (!files_.report || (request_.frame && !report_.finished.isComplete))
            return;
        files_.report->write(formatReport(report_));
        files_.report->commit();
    }

    PictureFiles &files_;
    const RenderRequest &request_;
    PictureBeginning &begun_;
    RenderSession &session_;
    RenderReport report_;
    std::span<const Crop> squares_;
    std::vector<ViewFilm> layers_; ///< the periodic files have them
    std::vector<glm::vec4> motion_;
};

} // namespace

PictureFiles openFiles(RenderRequest request) {
    if (request.part) { // a part is a checkpoint that is finished
        request.checkpoint = request.output;
        request.isResuming = true;
    }
    static_cast<void>(formatOf(request)); // of no format: that is said first
    PictureFiles files;
    if (!request.part && !request.isInClip && !mayBeThere(request))
        files.image.emplace(request.output);
    if (!request.report.empty())
        files.report.emplace(request.report);
    if (!request.checkpoint.empty()) {
        requireWritableCheckpoint(request.checkpoint);
        files.lock = std::make_unique<CheckpointLock>(request.checkpoint);
    }
    if (!request.display.empty())
        files.display = std::make_unique<Display>(request.display, request.output);
    files.request = std::move(request);
    return files;
}

void requireRoom(const PictureFiles &files, const PreparedScene &scene) {
    const Crop &crop = scene.crop;
    if (formatOf(files.request) == ImageFormat::Png)
        requirePngSize(files.request.output, crop.width(), crop.height());
    const bool isCopied =
        !files.request.checkpoint.empty() || files.request.partialSeconds || files.display != nullptr;
    const unsigned copies = isCopied ? 2 : 1;
    const RenderSettings &settings = scene.loaded.settings;
    requireFilmMemory(crop, copies + static_cast<unsigned>(viewsOf(scene).size()),
                      copies * lightPlanesOf(scene.packed, settings).count(),
                      denoisingBytes(settings, crop, copies));
}

PictureBeginning beginPicture(PictureFiles &files, const std::string &commandLine, RenderSession &session) {
    const PreparedScene &scene = session.scene();
    PictureBeginning begun;
    setSquares(partOf(files), scene.crop, smallestSquare(wantedNoise(scene.loaded.settings)), begun);
    RenderReport &report = begun.report;
    report.output = files.request.output;
    report.origin = provenanceOf(scene, commandLine);
    report.device = session.backend().identity(scene.packed, scene.loaded.settings.integrator);
    if (session.isFirstPicture()) {
        report.loadSeconds = scene.loadSeconds;
        report.buildSeconds = scene.buildSeconds;
    }
    if (files.request.frame && !files.request.isInClip) {
        begun.frameIdentity = identityOfFrame(files.request, session);
        begun.isFinished = !files.image && isImageWith(files.request.output, begun.frameIdentity,
                                                       scene.crop.width(), scene.crop.height());
        if (!begun.isFinished && !files.image)
            files.image.emplace(files.request.output);
    }
    if (!begun.isFinished && !files.request.checkpoint.empty())
        resume(files, session, begun);
    return begun;
}

FinishedPicture finishPicture(PictureFiles &files, PictureBeginning &&begun, RenderSession &session) {
    return PictureRender(files, begun, session).finish();
}

} // namespace hyalite::core
