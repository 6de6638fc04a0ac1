// What a command says, and with which exit code it ends, when something is thrown.
#include "host/cli/failure.h"

#include "host/base/version.h"
#include "host/engine/prepare.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

namespace hyalite::core {
namespace {

const std::string commandLine = "hyalite render 'my scene.json' -o a.png";

template <class Exception> Failure failureOf(const Exception &exception) {
    return describeFailure(std::make_exception_ptr(exception), commandLine);
}

void expectBug(const Failure &failure, const std::string &what) {
    EXPECT_EQ(static_cast<int>(failure.code), 70);
    EXPECT_TRUE(failure.message.starts_with("internal error: " + what)) << failure.message;
    for (const std::string &part : {std::string("a bug in hyalite " HYALITE_VERSION), std::string("report"),
                                    std::string("`hyalite devices`"), commandLine})
        EXPECT_NE(failure.message.find(part), std::string::npos) << part << " is not in " << failure.message;
}

TEST(Failure, WhatNobodyExpectedIsABugOfOurs) {
    expectBug(failureOf(std::logic_error("planted")), "planted");
    expectBug(failureOf(std::out_of_range("planted")), "planted");
    expectBug(failureOf(std::system_error(std::make_error_code(std::errc::invalid_argument), "planted")),
              "planted");
    expectBug(failureOf(Error(ErrorKind::Internal, "planted")), "planted");
    expectBug(failureOf(42), "an exception of an unknown type");
    try {
        static_cast<void>(nlohmann::json::parse("{}").at("missing"));
    } catch (...) {
        expectBug(describeFailure(std::current_exception(), commandLine), "[json.exception");
    }
}

TEST(Failure, EveryKindHasItsExitCode) {
    const std::pair<ErrorKind, int> codes[] = {
        {ErrorKind::Usage, 2},         {ErrorKind::BadInput, 3},      {ErrorKind::NoDevice, 4},
        {ErrorKind::LimitExceeded, 5}, {ErrorKind::DeviceLost, 6},    {ErrorKind::OutputNotWritten, 7},
        {ErrorKind::HungUp, 129},      {ErrorKind::Interrupted, 130}, {ErrorKind::Terminated, 143}};
    for (const auto &[kind, code] : codes) {
        const Failure failure = failureOf(Error(kind, "planted"));
        EXPECT_EQ(static_cast<int>(failure.code), code);
        EXPECT_EQ(failure.message, "planted");
    }
}

TEST(Failure, MemoryAndThreadsThatAreNotToBeHadAreNoBugs) {
    EXPECT_EQ(failureOf(std::bad_alloc()).code, ExitCode::LimitExceeded);
    const Failure noThread =
        failureOf(std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again)));
    EXPECT_EQ(noThread.code, ExitCode::LimitExceeded);
    EXPECT_NE(noThread.message.find("ulimit -u"), std::string::npos);
}

TEST(Failure, RemediesAndOverridesAreNamedByTheirOptions) {
    EXPECT_EQ(failureOf(Error(ErrorKind::NoDevice, "no driver", Remedy::ReferenceInstead)).message,
              "no driver; --device cpu renders without Vulkan, to the same bits");
    EXPECT_EQ(
        failureOf(Error(ErrorKind::DeviceLost, "a and cpu disagree", Remedy::OneDevice)).message,
        "a and cpu disagree; a picture by one --device alone has no seams, and `hyalite verify` tells more "
        "of its bits");
    const Failure failure = failureOf(OverrideError("crop", "0,0,0,0 is empty"));
    EXPECT_EQ(failure.code, ExitCode::Usage);
    EXPECT_EQ(failure.message, "--crop: 0,0,0,0 is empty");
}

} // namespace
} // namespace hyalite::core
