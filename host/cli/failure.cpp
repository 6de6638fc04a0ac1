#include "host/cli/failure.h"

#include "host/base/version.h"
#include "host/engine/prepare.h"

#include <fmt/format.h>

#include <cstdlib>
#include <new>
#include <string_view>
#include <system_error>

namespace hyalite::core {

namespace {

std::string_view wordsFor(Remedy remedy) {
    switch (remedy) {
    case Remedy::None:
        return "";
    case Remedy::SmallerImage:
        return "; render a smaller image, or parts of it with --crop";
    case Remedy::SmallerRender:
        return "; render fewer triangles, smaller parts of the image with --crop, or with --device cpu";
    case Remedy::ReferenceInstead:
        return "; --device cpu renders without Vulkan, to the same bits";
    case Remedy::NoKernelChoice:
        return "; leave out --kernel";
    case Remedy::CompareRenders:
        return "; `hyalite compare` tells where";
    case Remedy::OneDevice:
        return "; a picture by one --device alone has no seams, and `hyalite verify` tells more of its bits";
    case Remedy::BeginAnew:
        return "; render as before, or start over without --resume";
    case Remedy::AllowPath:
        return "; --allow-path PATH allows another folder or file";
    case Remedy::Turntable:
        return "; --turntable COUNT turns around it";
    case Remedy::DenoisingData:
        return "; render it with --denoising-data";
    case Remedy::ProfileReport:
        return "; `hyalite profile --report` writes one";
    }
    std::abort(); // unreachable: the switch is complete
}

Failure internalFailure(std::string_view what, const std::string &commandLine) {
    return {
        ExitCode::Internal,
        fmt::format("internal error: {}\n"
                    "This is a bug in hyalite " HYALITE_VERSION ", not in your input. Please report it with "
                    "this message, the output of `hyalite devices`, the scene, and the command line:\n  {}",
                    what, commandLine)};
}

Failure describeError(const Error &error, const std::string &commandLine) {
    if (error.kind == ErrorKind::Internal)
        return internalFailure(error.what(), commandLine);
    return {exitCodeOf(error.kind), fmt::format("{}{}", error.what(), wordsFor(error.remedy))};
}

} // namespace

ExitCode exitCodeOf(ErrorKind kind) {
    switch (kind) {
    case ErrorKind::Usage:
        return ExitCode::Usage;
    case ErrorKind::BadInput:
        return ExitCode::BadInput;
    case ErrorKind::NoDevice:
        return ExitCode::NoDevice;
    case ErrorKind::LimitExceeded:
        return ExitCode::LimitExceeded;
    case ErrorKind::DeviceLost:
        return ExitCode::DeviceLost;
    case ErrorKind::OutputNotWritten:
        return ExitCode::OutputNotWritten;
    case ErrorKind::HungUp:
        return ExitCode::HungUp;
    case ErrorKind::Interrupted:
        return ExitCode::Interrupted;
    case ErrorKind::Terminated:
        return ExitCode::Terminated;
    case ErrorKind::Internal:
        return ExitCode::Internal;
    }
    std::abort(); // unreachable: the switch is complete
}

Failure describeFailure(const std::exception_ptr &failure, const std::string &commandLine) {
    try {
        std::rethrow_exception(failure);
    } catch (const OverrideError &error) {
        return {exitCodeOf(error.kind),
                fmt::format("--{}: {}{}", error.name, error.what(), wordsFor(error.remedy))};
    } catch (const Error &error) {
        return describeError(error, commandLine);
    } catch (const std::bad_alloc &) {
        return {ExitCode::LimitExceeded, "out of memory"};
    } catch (const std::system_error &error) {
        if (error.code() == std::errc::resource_unavailable_try_again)
            return {ExitCode::LimitExceeded,
                    "no thread can be started; raise the limit (ulimit -u), or end other programs"};
        return internalFailure(error.what(), commandLine);
    } catch (const std::exception &error) {
        return internalFailure(error.what(), commandLine);
    } catch (...) {
        return internalFailure("an exception of an unknown type", commandLine);
    }
}

} // namespace hyalite::core
