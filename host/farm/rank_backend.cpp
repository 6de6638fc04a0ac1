#include "host/farm/rank_backend.h"

#include "host/base/error.h"
#include "host/engine/identity.h"
#include "host/farm/part_origin.h"
#include "host/scene/settings_table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>
#include <utility>

namespace hyalite::core {

namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

/// A message: what it says, and what a film has of some pixels.
///
///     the size of the JSON and the number of pixels, 8 bytes each   JSON   pixels   layers of light
struct Message {
    std::string text; ///< the JSON
    FilmRecords records{};

    [[nodiscard]] json header() const { return json::parse(text); }
};

using MessageSizes = std::array<std::uint64_t, 2>;

void send(Ranks &ranks, int to, const json &header, const FilmRecords &records = {}) {
    const std::string text = header.dump(-1, ' ', false, json::error_handler_t::replace);
    const MessageSizes sizes{text.size(), records.pixels.size()};
    std::vector<std::byte> bytes;
    const auto append = [&bytes](std::span<const std::byte> piece) {
        bytes.insert(bytes.end(), piece.begin(), piece.end());
    };
    append(std::as_bytes(std::span(sizes)));
    append(std::as_bytes(std::span(text)));
    append(std::as_bytes(std::span(records.pixels)));
    append(std::as_bytes(std::span(records.light)));
    ranks.send(to, bytes);
}

std::optional<Message> poll(Ranks &ranks, int from) {
    const std::optional<std::vector<std::byte>> bytes = ranks.poll(from);
    if (!bytes)
        return std::nullopt;
    std::span<const std::byte> rest = *bytes;
    const auto take = [&rest](auto &values, std::size_t count) {
        values.resize(count);
        const std::span<std::byte> into = std::as_writable_bytes(std::span(values));
        std::ranges::copy(rest.first(into.size()), into.begin());
        rest = rest.subspan(into.size());
    };
    std::vector<std::uint64_t> sizes;
    take(sizes, MessageSizes().size());
    Message message;
    take(message.text, sizes[0]);
    take(message.records.pixels, sizes[1]);
    take(message.records.light, rest.size() / sizeof(float));
    return message;
}

constexpr auto pollInterval = std::chrono::milliseconds(1); // a tile takes seconds

Message waitFor(Ranks &ranks, int from) {
    for (;;) {
        if (std::optional<Message> message = poll(ranks, from))
            return std::move(*message);
        std::this_thread::sleep_for(pollInterval);
    }
}

json toJson(const RayCounts &rays) {
    json counts = json::array();
    for (const RayKind &kind : rayKinds)
        counts.push_back(rays.*kind.count);
    return counts;
}

RayCounts raysFrom(const json &counts) {
    RayCounts rays;
    for (std::size_t i = 0; i < rayKinds.size(); ++i)
        rays.*rayKinds[i].count = counts.at(i).get<std::uint64_t>();
    return rays;
}

json toJson(const RendererIdentity &identity) {
    return {
        {"name", identity.name},           {"driver", identity.driver}, {"arithmetic", identity.arithmetic},
        {"equalBits", identity.equalBits}, {"kernel", identity.kernel}, {"kernelHash", identity.kernelHash}};
}

RendererIdentity identityFrom(const json &from) {
    return {from.at("name"),      from.at("driver"), from.at("arithmetic"),
            from.at("equalBits"), from.at("kernel"), from.at("kernelHash")};
}

/// The renderer of another rank.
class RankBackend : public Backend {
  public:
    RankBackend(Ranks &ranks, int rank, std::string hello)
        : ranks_(ranks), rank_(rank), hello_(std::move(hello)) {}

    [[nodiscard]] std::string name() const override {
        return fmt::format("{} of rank {}", hello().at("name").get<std::string>(), rank_);
    }
    [[nodiscard]] std::string description() const override {
        return fmt::format("rank {} on {}: {}", rank_, hello().at("host").get<std::string>(),
                           hello().at("description").get<std::string>());
    }
    [[nodiscard]] RendererIdentity identity(const PackedScene &, Integrator) const override {
        return identityFrom(hello().at("renderer"));
    }
    [[nodiscard]] gpu::BitGuarantee bits() const override {
        return {static_cast<gpu::BitDegree>(hello().at("bitDegree").get<int>()), hello().at("bitReason")};
    }
    [[nodiscard]] std::string precision() const override { return hello().at("precision"); }
    [[nodiscard]] bool hasCompiler() const override { return hello().at("hasCompiler"); }

    [[nodiscard]] BackendResult render(const PackedScene &, const RenderSettings &settings, Film film,
                                       const RenderHooks &hooks) override {
        const Crop &crop = film.crop;
        send(ranks_, rank_,
             {{"kind", "tile"},
              {"settings", settingsToJson(settings)},
              {"crop", {crop.x0, crop.x1, crop.y0, crop.y1}}},
             film);
        std::optional<Clock::time_point> stopped;
        std::optional<Message> answer;
        while (!(answer = poll(ranks_, rank_))) {
            if (!stopped && hooks.shouldStop && hooks.shouldStop()) {
                send(ranks_, rank_, {{"kind", "stop"}});
                stopped = Clock::now();
            }
            // The rank may be gone: then mpirun ends this one, too, and what is finished had better be written.
            if (stopped && Clock::now() - *stopped > std::chrono::seconds(2))
                throw Error(ErrorKind::DeviceLost, "it does not answer");
            std::this_thread::sleep_for(pollInterval);
        }
        const json header = answer->header();
        if (const std::string why = header.at("error"); !why.empty())
            throw Error(static_cast<ErrorKind>(header.at("errorKind").get<int>()), why);
        static_cast<FilmRecords &>(film) = std::move(answer->records);
        BackendResult result{std::move(film), raysFrom(header.at("rays")), {}, {}};
        result.timing.dispatchCount = header.at("dispatches");
        result.timing.pipelineSeconds = header.at("pipelineSeconds");
        result.timing.uploadSeconds = header.at("uploadSeconds");
        result.memory.deviceBytes = header.at("deviceBytes");
        result.faults = header.at("faults").get<std::vector<std::string>>();
        if (const std::string why = header.at("failure"); !why.empty())
            result.failure.emplace(static_cast<ErrorKind>(header.at("failureKind").get<int>()), why);
        return result;
    }
    [[nodiscard]] std::vector<layout::TraceEvent> trace(const PackedScene &, const RenderSettings &,
                                                        const glm::uvec2 &, std::uint32_t) override {
        throw Error(ErrorKind::Usage, "paths are traced in one process");
    }

  private:
    [[nodiscard]] json hello() const { return json::parse(hello_); }

    Ranks &ranks_;
    int rank_;
    std::string hello_; ///< JSON
};

/// Whether rank 0 wants the tile back as it is. Asks seldom: it is called after each sample.
class StopQuestion {
  public:
    explicit StopQuestion(Ranks &ranks) : ranks_(ranks) {}

    [[nodiscard]] bool operator()() {
        if (isStopped_ || Clock::now().time_since_epoch().count() < nextTicks_)
            return isStopped_;
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock.owns_lock())
            return isStopped_;
        nextTicks_ = (Clock::now() + std::chrono::milliseconds(20)).time_since_epoch().count();
        if (poll(ranks_, 0)) // while a tile is rendered, nothing else comes
            isStopped_ = true;
        return isStopped_;
    }

  private:
    Ranks &ranks_;
    std::mutex mutex_;
    std::atomic<Clock::rep> nextTicks_ = 0;
    std::atomic<bool> isStopped_ = false;
};

/// Renders the tile of a message, and answers.
void renderTile(Ranks &ranks, const PackedScene &scene, Backend &backend, const json &job,
                FilmRecords records) {
    const json &crop = job.at("crop");
    Film film{Crop{}};
    film.crop = {crop.at(0), crop.at(1), crop.at(2), crop.at(3)};
    static_cast<FilmRecords &>(film) = std::move(records);
    StopQuestion shouldStop(ranks);
    try {
        const BackendResult result =
            backend.render(scene, settingsFromJson(job.at("settings")), std::move(film),
                           {.shouldStop = [&] { return shouldStop(); }});
        send(ranks, 0,
             {{"error", ""},
              {"rays", toJson(result.rays)},
              {"dispatches", result.timing.dispatchCount},
              {"pipelineSeconds", result.timing.pipelineSeconds},
              {"uploadSeconds", result.timing.uploadSeconds},
              {"deviceBytes", result.memory.deviceBytes},
              {"faults", result.faults},
              {"failure", result.failure ? result.failure->what() : ""},
              {"failureKind", static_cast<int>(result.failure ? result.failure->kind : ErrorKind{})}},
             result.film);
    } catch (const Error &error) {
        send(ranks, 0, {{"error", error.what()}, {"errorKind", static_cast<int>(error.kind)}});
    }
}

} // namespace

RankPool::~RankPool() {
    try {
        for (int rank = 1; rank < ranks_.count(); ++rank)
            send(ranks_, rank, {{"kind", "end"}});
    } catch (const std::exception &) { // of memory: mpirun ends those that wait for ever
    }
}

std::vector<std::unique_ptr<Backend>> RankPool::backends(const PreparedScene &scene, const Backend &backend,
                                                         std::vector<std::string> &notes) {
    const std::string here = identityText(identityOf(scene, backend));
    std::vector<std::unique_ptr<Backend>> backends;
    for (int rank = 1; rank < ranks_.count(); ++rank) {
        Message message = waitFor(ranks_, rank);
        const json hello = message.header();
        std::string why = hello.value("reportFailure", "");
        if (const std::string there = hello.value("identity", here); why.empty() && there != here)
            why = describeDifferences(there, here);
        if (why.empty())
            backends.push_back(std::make_unique<RankBackend>(ranks_, rank, std::move(message.text)));
        else
            notes.push_back(fmt::format("left out rank {}: {}", rank, why));
    }
    return backends;
}

void serveTiles(Ranks &ranks, const PreparedScene &scene, Backend &backend) {
    const gpu::BitGuarantee bits = backend.bits();
    send(ranks, 0,
         {{"name", backend.name()},
          {"host", hostName()},
          {"description", backend.description()},
          {"identity", identityText(identityOf(scene, backend))},
          {"renderer", toJson(backend.identity(scene.packed, scene.loaded.settings.integrator))},
          {"bitDegree", static_cast<int>(bits.degree)},
          {"bitReason", bits.reason},
          {"precision", backend.precision()},
          {"hasCompiler", backend.hasCompiler()}});
    for (;;) {
        Message message = waitFor(ranks, 0);
        const json header = message.header();
        const std::string kind = header.at("kind");
        if (kind == "end")
            return;
        if (kind == "tile") // a "stop" that comes after its tile means nothing
            renderTile(ranks, scene.packed, backend, header, std::move(message.records));
    }
}

void reportFailure(Ranks &ranks, const std::string &why) {
    send(ranks, 0, {{"reportFailure", why}});
    while (waitFor(ranks, 0).header().at("kind") != "end") {
    }
}

} // namespace hyalite::core
