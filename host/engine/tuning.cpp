#include "host/engine/tuning.h"

#include "host/base/atomic_file.h"
#include "host/base/clean_text.h"
#include "host/base/error.h"
#include "host/base/hash.h"
#include "host/base/json_document.h"
#include "host/base/json_text.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <system_error>

namespace hyalite::core {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char *exchangeKey = "exchange of 16 lanes";
constexpr const char *broadcasts = "broadcasts";
constexpr const char *shuffles = "shuffles";

std::optional<fs::path> findFile() {
    const auto valueOf = [](const char *name) {
        const char *value = std::getenv(name);
        return std::string(value != nullptr ? value : "");
    };
    if (const std::string folder = valueOf("HYALITE_CACHE"); !folder.empty())
        return fs::path(folder) / "tuning.json";
    // A relative one is to be passed over (XDG Base Directory Specification 0.8).
    if (const fs::path folder = valueOf("XDG_CACHE_HOME"); folder.is_absolute())
        return folder / "hyalite/tuning.json";
    if (const std::string folder = valueOf("HOME"); !folder.empty())
        return fs::path(folder) / ".cache/hyalite/tuning.json";
    return std::nullopt;
}

/// The key of an entry. It omits the device name, because that of lavapipe contains the vector width.
Json keyOf(const gpu::DeviceInfo &device) {
    return {{"vendorId", device.vendorId},
            {"deviceId", device.deviceId},
            {"driver", device.driver},
            {"kernels", hashText(gpu::hashOfKernels())}};
}

/// Reads all entries. Throws Error{BadInput}.
Json readEntries(const fs::path &file) {
    const Json document = readJsonFile(file);
    const auto devices = document.find("devices");
    if (!document.is_object() || devices == document.end() || !devices->is_array())
        throw Error(ErrorKind::BadInput, fmt::format("{}: has no list of devices", file.string()));
    return *devices;
}

const gpu::KernelRow *kernelNamed(const Json &name) {
    for (const auto &[known, row] : gpu::kernelNames)
        if (name == known)
            return row;
    throw Error(ErrorKind::BadInput, "found the kernel " + excerpt(name.dump()));
}

} // namespace

fs::path tuningFile() {
    if (const std::optional<fs::path> file = findFile())
        return *file;
    throw Error(ErrorKind::OutputNotWritten,
                "there is nowhere to keep measurements: set HYALITE_CACHE to a folder");
}

Tuning readTuning(const gpu::DeviceInfo &device, Observer &observer) {
    constexpr const char *outcome = "kernels are chosen as if nothing had been measured";
    const std::optional<fs::path> file = findFile();
    std::error_code error;
    if (!file || !fs::exists(*file, error))
        return {};
    try {
        const Json key = keyOf(device);
        for (const Json &entry : readEntries(*file)) {
            if (!entry.is_object() || entry.value("key", Json()) != key)
                continue;
            Tuning tuning;
            tuning.verifiedDate = excerpt(entry.value("verified", std::string()));
            if (const auto exchange = entry.find(exchangeKey); exchange != entry.end())
                tuning.hasSlowShuffles = *exchange == broadcasts;
            tuning.date = excerpt(entry.value("date", std::string()));
            if (tuning.isMeasured())
                for (const auto &[name, workload] : gpu::workloadNames)
                    tuning.kernels[static_cast<std::size_t>(workload)] =
                        kernelNamed(entry.value(name, Json()));
            return tuning;
        }
    } catch (const Error &fault) {
        observer.note(fmt::format("{}; {}", fault.what(), outcome));
    } catch (const nlohmann::json::exception &fault) {
        observer.note(fmt::format("{}: {}; {}", file->string(), fault.what(), outcome));
    }
    return {};
}

void storeTuning(const gpu::DeviceInfo &device, const Tuning &tuning, Observer &observer) {
    const fs::path file = tuningFile();
    std::error_code error;
    fs::create_directories(file.parent_path(), error); // an error shows when the file is written
    Json entries = Json::array();
    const Json key = keyOf(device);
    if (fs::exists(file, error)) {
        try {
            for (const Json &entry : readEntries(file))
                if (entry.is_object() && entry.value("key", Json()) != key)
                    entries.push_back(entry);
        } catch (const Error &fault) {
            observer.note(fmt::format("{}; it will be rewritten", fault.what()));
        }
    }
    Json entry;
    entry["key"] = key;
    entry["device"] = device.name;
    if (!tuning.verifiedDate.empty())
        entry["verified"] = tuning.verifiedDate;
    if (tuning.hasSlowShuffles)
        entry[exchangeKey] = *tuning.hasSlowShuffles ? broadcasts : shuffles;
    if (tuning.isMeasured()) {
        entry["date"] = tuning.date;
        for (const auto &[name, workload] : gpu::workloadNames) {
            entry[std::string(name)] = gpu::kernelName(tuning.kernels[static_cast<std::size_t>(workload)]);
        }
    }
    entries.push_back(entry);
    AtomicFile output(file);
    output.write(jsonText(Json{{"devices", entries}}));
    output.commit();
}

std::string today() { return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr))); }

gpu::BitGuarantee guaranteeOf(const gpu::BitGuarantee &byStartupCheck, const Tuning &tuning) {
    if (byStartupCheck.degree != gpu::BitDegree::Measured)
        return byStartupCheck;
    if (tuning.verifiedDate.empty())
        return {gpu::BitDegree::None,
                byStartupCheck.reason + "; `hyalite verify` has yet to compare whole kernels here"};
    return {gpu::BitDegree::Measured,
            fmt::format("{}, nor did `hyalite verify` on {}", byStartupCheck.reason, tuning.verifiedDate)};
}

} // namespace hyalite::core
