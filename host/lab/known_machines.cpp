#include "host/lab/known_machines.h"

#include "host/base/json_document.h"
#include "host/base/json_reader.h"
#include "host/import/assets.h"

#include <array>
#include <string_view>

namespace hyalite::core {

namespace {

constexpr std::size_t maxMachineCount = 1000;
constexpr Interval anyRate{0.0, 1e9, false};

KnownMachine readMachine(const JsonNode &node) {
    constexpr std::array<std::string_view, 7> keys{"machine", "device",  "driver",           "date",
                                                   "program", "command", "megaraysPerSecond"};
    const JsonObject object(node, keys);
    KnownMachine machine{object.text("machine"),
                         object.text("device"),
                         object.text("driver"),
                         object.text("date"),
                         object.text("program"),
                         object.text("command"),
                         {}};
    const JsonObject speed(object.at("megaraysPerSecond"));
    for (const auto &[scene, rate] : speed.members(trials.size()))
        machine.speed.push_back({scene, rate.number(anyRate)});
    return machine;
}

} // namespace

std::vector<KnownMachine> readKnownMachines() {
    const std::filesystem::path file = shippedFile("known-machines.json");
    const std::string fileName = file.string();
    const nlohmann::json document = readJsonFile(file);
    constexpr std::array<std::string_view, 1> keys{"machines"};
    const JsonObject object({&document, &fileName}, keys);
    std::vector<KnownMachine> machines;
    for (const JsonNode &node : object.elements("machines", maxMachineCount))
        machines.push_back(readMachine(node));
    return machines;
}

} // namespace hyalite::core
