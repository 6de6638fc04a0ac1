// Known machines: what is shipped says where each figure comes from.
#include "host/lab/known_machines.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>

namespace hyalite::core {
namespace {

TEST(KnownMachines, SayWhereTheirFiguresComeFrom) {
    setenv("HYALITE_ASSETS", HYALITE_ASSET_DIR, 1);
    const std::vector<KnownMachine> machines = readKnownMachines();
    EXPECT_GE(machines.size(), 2u);
    for (const KnownMachine &machine : machines) {
        EXPECT_TRUE(std::regex_match(machine.date, std::regex("20[0-9]{2}-[0-9]{2}-[0-9]{2}")))
            << machine.date;
        EXPECT_TRUE(machine.command.starts_with("hyalite doctor")) << machine.command;
        for (const std::string &text : {machine.machine, machine.device, machine.driver, machine.program})
            EXPECT_NE(text, "") << machine.device;
        ASSERT_EQ(machine.speed.size(), trials.size()) << machine.device;
        for (const SpeedFigure &figure : machine.speed)
            EXPECT_GT(figure.megaraysPerSecond, 0.0) << figure.scene;
    }
}

} // namespace
} // namespace hyalite::core
