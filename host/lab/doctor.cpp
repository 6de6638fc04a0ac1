#include "host/lab/doctor.h"

#include "host/base/error.h"
#include "host/film/timeline.h"
#include "host/gpu/vk/driver_manifests.h"
#include "host/lab/device_report.h"
#include "host/lab/shipped_films.h"
#include "host/lab/verify.h"
#include "host/lab/verify_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace hyalite::core {

namespace {

using Json = nlohmann::json;

/// Passes on what drivers need, and wants a stop when the limit is reached.
class LimitedObserver : public Observer {
  public:
    LimitedObserver(Observer &observer, const TimeLimit &limit) : observer_(observer), limit_(limit) {}

    void beforeDriver(const gpu::ProcessorUse &use) override { observer_.beforeDriver(use); }
    [[nodiscard]] std::optional<Stop> wantsStop() override {
        if (std::optional<Stop> stop = observer_.wantsStop())
            return stop;
        return limit_.isReached() ? std::optional(Stop{"the time limit", ErrorKind::Interrupted})
                                  : std::nullopt;
    }

  private:
    Observer &observer_;
    TimeLimit limit_;
};

/// Everything of a device that can be told without rendering. One that cannot be opened is no reason to lose the others.
Json factsOf(const gpu::DeviceInfo &device, Observer &observer) {
    try {
        return deviceToJson(device, observer);
    } catch (const Error &error) {
        gpu::DeviceInfo rejected = device;
        rejected.rejection = error.what();
        return deviceToJson(rejected, observer);
    }
}

/// The facts of all devices, and why there is no list of them.
std::pair<Json, std::string> listDevices(Observer &observer, const RunApart &runApart) {
    try {
        return {runApart([&] {
                    Json list = Json::array();
                    for (const gpu::DeviceInfo &device : gpu::listDevices())
                        list.push_back(Json(factsOf(device, observer)));
                    return list;
                }),
                ""};
    } catch (const Error &error) {
        return {Json::array(), error.what()};
    }
}

/// Loads each driver's library, in a process of its own.
std::vector<DriverFile> judgeDriverFiles(const RunApart &runApart) {
    std::vector<DriverFile> drivers;
    for (const std::filesystem::path &manifest : gpu::driverManifests())
        try {
            drivers.push_back({manifest, runApart([&]() -> Json { return gpu::faultOf(manifest); })});
        } catch (const Error &error) {
            drivers.push_back({manifest, fmt::format("{}: {}", manifest.string(), error.what())});
        }
    return drivers;
}

ListedDevice listed(const Json &facts) {
    return {facts.at("index"),
            facts.at("name"),
            facts.at("vendorId"),
            facts.at("deviceId"),
            facts.at("type") == gpu::deviceTypeName(gpu::DeviceType::Cpu),
            facts.value("rejection", "")};
}

/// The patients that the request names, each once.
std::vector<Patient> admit(const std::vector<std::string> &names, const Json &devices, Observer &observer,
                           const RunApart &runApart) {
    std::vector<Patient> patients;
    const auto add = [&](const std::string &name, const nlohmann::ordered_json &facts) {
        if (std::ranges::find(patients, name, &Patient::name) == patients.end())
            patients.push_back({name, facts});
    };
    for (const std::string &name : names) {
        if (name == "all" || name == "cpu")
            add("cpu", referenceToJson());
        if (name == "all")
            for (std::size_t i = 0; i < devices.size(); ++i)
                add(std::to_string(i), devices[i]);
        if (name == "all" || name == "cpu")
            continue;
        const Json index = runApart([&]() -> Json {
            observer.beforeDriver({});
            return gpu::chooseDevice(gpu::listDevices(), name).index;
        });
        add(std::to_string(index.get<int>()), devices.at(index.get<std::size_t>()));
    }
    return patients;
}

/// The kernels that renders choose on a device; none for the CPU.
std::vector<std::string> kernelsOf(const Patient &patient) {
    std::set<std::string> kernels;
    if (patient.isVulkan())
        for (const auto &[workload, kernel] : patient.facts.at("kernels").items())
            kernels.insert(kernel.get<std::string>());
    return {kernels.begin(), kernels.end()};
}

Json checkBits(const Patient &patient, const ShippedFilms &shipped, const TimeLimit &limit,
               Observer &observer) {
    LimitedObserver limited(observer, limit);
    ObservedTask progress(observer, "verify " + patient.facts.at("name").get<std::string>());
    Json bits = {{"rendered", 0}, {"equal", 0}, {"isWhole", false}, {"faults", Json::array()}};
    constexpr std::size_t maxFaultCount = 8; // they have to fit into a pipe
    const auto keep = [&](const FilmVerdict &film, double share) {
        progress.update(share);
        if (film.isSkipped())
            return;
        bits["rendered"] = bits["rendered"].get<std::size_t>() + 1;
        if (!film.isFaulty())
            bits["equal"] = bits["equal"].get<std::size_t>() + 1;
        else if (bits["faults"].size() < maxFaultCount)
            bits["faults"].push_back(
                fmt::format("{}{}: {}", nameOf(film.film), film.kernel.empty() ? "" : ", " + film.kernel,
                            film.difference ? describe(*film.difference) : film.failure));
    };
    try {
        static_cast<void>(verifyDevice(patient.name, shipped, limited, kernelsOf(patient), keep));
        bits["isWhole"] = true;
    } catch (const Error &) {
        if (!limit.isReached())
            throw;
    }
    return bits;
}

BitsFigure readBits(const Json &bits, double seconds) {
    return {bits.at("rendered"), bits.at("equal"), seconds, bits.at("isWhole"), bits.at("faults")};
}

Json measure(const Patient &patient, const TimeLimit &limit, Observer &observer) {
    ObservedTask progress(observer, "measure " + patient.facts.at("name").get<std::string>());
    Json rates = Json::array();
    for (const SpeedFigure &figure : measureSpeed(patient.name, limit, observer))
        rates.push_back({{"scene", figure.scene}, {"rate", figure.megaraysPerSecond}});
    return rates;
}

void examineOne(Patient &patient, const ShippedFilms &shipped, const TimeLimit &limit, Observer &observer,
                const RunApart &runApart) {
    constexpr double shareOfBits = 0.5;
    try {
        if (limit.isReached())
            return;
        const TimeLimit verifying = limit.share(shareOfBits);
        Stopwatch watch;
        const Json bits = runApart([&] { return checkBits(patient, shipped, verifying, observer); });
        patient.bits = readBits(bits, watch.lap().seconds());
        for (const Json &rate : runApart([&] { return measure(patient, limit, observer); }))
            patient.speed.push_back({rate.at("scene"), rate.at("rate")});
    } catch (const Error &error) {
        patient.failure = error.what();
    }
}

std::vector<Finding> findingsOf(const Patient &patient) {
    std::vector<Finding> findings;
    const std::string name = patient.facts.at("name");
    if (!patient.failure.empty())
        findings.push_back({"device-failure", true, fmt::format("{} failed: {}", name, patient.failure),
                            "another version of its driver may not"});
    if (patient.bits && !patient.bits->faults.empty())
        findings.push_back({"wrong-bits", true,
                            fmt::format("{} computes other bits: {}", name, patient.bits->faults.front()),
                            "use another version of its driver; `hyalite verify` tells more"});
    return findings;
}

} // namespace

Examination examine(const ExaminationRequest &request, Observer &observer, const RunApart &runApart) {
    Examination examination;
    const ShippedFilms shipped = readShippedFilms();
    examination.filmsVersion = shipped.version;
    examination.date = today();
    examination.machine = describeMachine();
    examination.machine.drivers = judgeDriverFiles(runApart);
    const auto [devices, loaderError] = listDevices(observer, runApart);
    std::vector<ListedDevice> list;
    std::ranges::transform(devices, std::back_inserter(list), listed);
    examination.findings = diagnose(examination.machine, list, loaderError);
    examination.wantsVulkan =
        std::ranges::any_of(request.devices, [](const std::string &name) { return name != "cpu"; });
    examination.patients = admit(request.devices, devices, observer, runApart);
    const TimeLimit limit(request.timeLimitSeconds);
    for (std::size_t i = 0; i < examination.patients.size(); ++i) {
        Patient &patient = examination.patients[i];
        if (patient.isUsable())
            examineOne(patient, shipped,
                       limit.share(1.0 / static_cast<double>(examination.patients.size() - i)), observer,
                       runApart);
        const std::vector<Finding> more = findingsOf(patient);
        examination.findings.insert(examination.findings.begin(), more.begin(), more.end());
    }
    return examination;
}

} // namespace hyalite::core
