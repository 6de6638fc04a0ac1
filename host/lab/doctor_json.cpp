#include "host/lab/doctor_json.h"

#include "host/report/provenance.h"

#include <fmt/format.h>

namespace hyalite::core {

namespace {

nlohmann::ordered_json toJson(const Machine &machine) {
    nlohmann::ordered_json json = {
        {"system", machine.system}, {"kernel", machine.kernel},       {"architecture", machine.architecture},
        {"libc", machine.libc},     {"processor", machine.processor}, {"threads", machine.threadCount}};
    if (machine.memoryBytes)
        json["memoryBytes"] = *machine.memoryBytes;
    json["isContainer"] = machine.isContainer;
    if (!machine.nvidiaModule.empty())
        json["nvidiaModule"] = machine.nvidiaModule;
    json["cards"] = nlohmann::ordered_json::array();
    for (const GraphicsCard &card : machine.cards)
        json["cards"].push_back({{"address", card.address},
                                 {"vendorId", card.vendorId},
                                 {"deviceId", card.deviceId},
                                 {"kernelDriver", card.kernelDriver}});
    json["nodes"] = nlohmann::ordered_json::array();
    for (const DeviceNode &node : machine.nodes)
        json["nodes"].push_back(
            {{"file", node.file.string()}, {"group", node.group}, {"isAccessible", node.isAccessible}});
    json["variables"] = nlohmann::ordered_json::object();
    for (const auto &[name, value] : machine.variables)
        json["variables"][name] = value;
    json["drivers"] = nlohmann::ordered_json::array();
    for (const DriverFile &driver : machine.drivers)
        json["drivers"].push_back({{"manifest", driver.manifest.string()}, {"fault", driver.fault}});
    return json;
}

nlohmann::ordered_json toJson(const Patient &patient) {
    nlohmann::ordered_json json = patient.facts;
    if (const auto &bits = patient.bits)
        json["bits"] = {{"rendered", bits->renderedCount},
                        {"equal", bits->equalCount},
                        {"isWhole", bits->isWhole},
                        {"seconds", bits->seconds},
                        {"faults", bits->faults}};
    if (!patient.speed.empty())
        json["megaraysPerSecond"] = nlohmann::ordered_json::object();
    for (const SpeedFigure &figure : patient.speed)
        json["megaraysPerSecond"][figure.scene] = figure.megaraysPerSecond;
    if (!patient.failure.empty())
        json["failure"] = patient.failure;
    return json;
}

} // namespace

nlohmann::ordered_json examinationToJson(const Examination &examination, const std::string &commandLine) {
    nlohmann::ordered_json json = {{"doctorVersion", doctorVersion}};
    json.update(programToJson(commandLine));
    json["date"] = examination.date;
    json["filmsVersion"] = examination.filmsVersion;
    json["machine"] = toJson(examination.machine);
    json["devices"] = nlohmann::ordered_json::array();
    for (const Patient &patient : examination.patients)
        json["devices"].push_back(toJson(patient));
    json["findings"] = nlohmann::ordered_json::array();
    for (const Finding &finding : examination.findings)
        json["findings"].push_back({{"code", finding.code},
                                    {"isProblem", finding.isProblem},
                                    {"what", finding.what},
                                    {"remedy", finding.remedy}});
    return json;
}

} // namespace hyalite::core
