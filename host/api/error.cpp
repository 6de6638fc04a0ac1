#include "hyalite/error.h"

#include "host/api/contents.h"
#include "host/base/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <new>
#include <string_view>
#include <system_error>

#include <unistd.h>

namespace hyalite {

namespace {

std::string_view wordsFor(core::Remedy remedy) {
    switch (remedy) {
    case core::Remedy::SmallerImage:
        return "; render a smaller image, or parts of it with the setting crop";
    case core::Remedy::SmallerRender:
        return "; render fewer triangles, smaller parts of the image with the setting crop, or with the "
               "device cpu";
    case core::Remedy::ReferenceInstead:
        return "; the device cpu renders without Vulkan, to the same bits";
    case core::Remedy::NoKernelChoice:
        return "; leave out the kernel";
    case core::Remedy::CompareRenders:
        return "; a comparison tells where";
    case core::Remedy::DenoisingData:
        return "; render it with the setting denoising_data";
    case core::Remedy::AllowPath:
        return "; put it in or below the folder of the scene";
    case core::Remedy::None:
    case core::Remedy::OneDevice: // the others are of commands
    case core::Remedy::BeginAnew:
    case core::Remedy::ProfileReport:
    case core::Remedy::Turntable:
        return "";
    }
    std::abort(); // unreachable: the switch is complete
}

ErrorKind kindOf(core::ErrorKind kind) {
    switch (kind) {
    case core::ErrorKind::Usage:
        return ErrorKind::Usage;
    case core::ErrorKind::BadInput:
        return ErrorKind::BadInput;
    case core::ErrorKind::NoDevice:
        return ErrorKind::NoDevice;
    case core::ErrorKind::LimitExceeded:
        return ErrorKind::LimitExceeded;
    case core::ErrorKind::DeviceLost:
        return ErrorKind::DeviceLost;
    case core::ErrorKind::OutputNotWritten:
        return ErrorKind::OutputNotWritten;
    case core::ErrorKind::HungUp:
    case core::ErrorKind::Interrupted:
    case core::ErrorKind::Terminated:
        return ErrorKind::Stopped;
    case core::ErrorKind::Internal:
        return ErrorKind::Internal;
    }
    std::abort(); // unreachable: the switch is complete
}

/// The process that the library works in; 0: it has not begun.
std::atomic<pid_t> ownProcess = 0;

} // namespace

const char *version() noexcept { return HYALITE_VERSION; }

const char *toText(ErrorKind kind) noexcept {
    switch (kind) {
    case ErrorKind::Usage:
        return "usage";
    case ErrorKind::BadInput:
        return "bad input";
    case ErrorKind::NoDevice:
        return "no device";
    case ErrorKind::LimitExceeded:
        return "limit exceeded";
    case ErrorKind::DeviceLost:
        return "device lost";
    case ErrorKind::OutputNotWritten:
        return "output not written";
    case ErrorKind::Stopped:
        return "stopped";
    case ErrorKind::Internal:
        return "internal";
    }
    return "unknown";
}

Error::Error(ErrorKind kind, const std::string &message) : std::runtime_error(message), kind_(kind) {}
Error::~Error() = default;

void throwAsError() {
    try {
        throw;
    } catch (const Error &) {
        throw;
    } catch (const core::OverrideError &error) {
        std::string name = error.name;
        std::ranges::replace(name, '-', '_');
        throw Error(ErrorKind::Usage, fmt::format("{}: {}{}", name, error.what(), wordsFor(error.remedy)));
    } catch (const core::Error &error) {
        throw Error(kindOf(error.kind), fmt::format("{}{}", error.what(), wordsFor(error.remedy)));
    } catch (const std::bad_alloc &) {
        throw Error(ErrorKind::LimitExceeded, "out of memory");
    } catch (const std::system_error &error) {
        if (error.code() == std::errc::resource_unavailable_try_again)
            throw Error(ErrorKind::LimitExceeded,
                        "no thread can be started; raise the limit (ulimit -u), or end other programs");
        throw Error(ErrorKind::Internal, error.what());
    } catch (const std::exception &error) {
        throw Error(ErrorKind::Internal, error.what());
    } catch (...) {
        throw Error(ErrorKind::Internal, "an exception of an unknown type");
    }
}

bool isForked() noexcept {
    const pid_t process = ownProcess;
    return process != 0 && process != getpid();
}

void requireOwnProcess() {
    pid_t none = 0;
    ownProcess.compare_exchange_strong(none, getpid());
    if (isForked())
        throw Error(
            ErrorKind::Usage,
            "this process was forked from one that had used Hyalite, whose threads are not in it; start "
            "processes anew (in Python: the start method \"spawn\"), or fork before the first use");
}

} // namespace hyalite
