#include "host/base/atomic_file.h"

#include "host/base/error.h"
#include "tests/fixtures/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include <csignal>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hyalite::core {
namespace {

namespace fs = std::filesystem;

/// A fresh folder for each test, removed after it. Every test runs with both kinds of temporary file.
class AtomicFileTest : public ::testing::TestWithParam<TemporaryFile> {
  protected:
    [[nodiscard]] std::ptrdiff_t entryCount() const {
        return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
    }

    /// Of one file that is not committed: none where the file system has files without names.
    [[nodiscard]] std::ptrdiff_t temporaryEntries() const {
        const int unnamed = ::open(folder.c_str(), O_WRONLY | O_TMPFILE, 0600);
        if (unnamed >= 0)
            close(unnamed);
        return GetParam() == TemporaryFile::Named || unnamed < 0 ? 1 : 0;
    }
    [[nodiscard]] AtomicFile open(const fs::path &path) const { return AtomicFile(path, GetParam()); }

    const testing::TemporaryFolder temporary_;
    const fs::path &folder = temporary_.path;
};

INSTANTIATE_TEST_SUITE_P(, AtomicFileTest, ::testing::Values(TemporaryFile::Automatic, TemporaryFile::Named),
                         [](const auto &kind) {
                             return kind.param == TemporaryFile::Named ? "Named" : "Automatic";
                         });

void store(const fs::path &path, const std::string &text) { std::ofstream(path, std::ios::binary) << text; }

std::string load(const fs::path &path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The message of the refusal, or nothing if there was none.
std::optional<std::string> refusalOf(const fs::path &path) {
    try {
        AtomicFile file(path);
        return std::nullopt;
    } catch (const Error &error) {
        EXPECT_EQ(error.kind, ErrorKind::OutputNotWritten);
        return error.what();
    }
}

void expectRefused(const fs::path &path, const std::string &reason) {
    const std::optional<std::string> message = refusalOf(path);
    ASSERT_TRUE(message.has_value()) << path;
    EXPECT_NE(message->find(path.string()), std::string::npos) << *message;
    EXPECT_NE(message->find(reason), std::string::npos) << *message;
}

TEST_P(AtomicFileTest, CommitPutsTheBytesInPlaceAndLeavesNothingElse) {
    AtomicFile file = open(folder / "out.txt");
    file.write("one ");
    file.write("two");
    EXPECT_FALSE(fs::exists(folder / "out.txt"));
    file.commit();
    EXPECT_EQ(load(folder / "out.txt"), "one two");
    EXPECT_EQ(entryCount(), 1);
}

TEST_P(AtomicFileTest, WithoutCommitTheOldFileStaysAndNoTemporaryFileIsLeft) {
    store(folder / "out.txt", "old");
    {
        AtomicFile file = open(folder / "out.txt");
        file.write("new");
        EXPECT_EQ(entryCount(), temporaryEntries() + 1);
    }
    EXPECT_EQ(load(folder / "out.txt"), "old");
    EXPECT_EQ(entryCount(), 1);
}

TEST_P(AtomicFileTest, CommitReplacesTheOldFile) {
    store(folder / "out.txt", "an older and longer text");
    AtomicFile file = open(folder / "out.txt");
    file.write("new");
    EXPECT_EQ(load(folder / "out.txt"), "an older and longer text");
    file.commit();
    EXPECT_EQ(load(folder / "out.txt"), "new");
    EXPECT_EQ(entryCount(), 1);
}

TEST_P(AtomicFileTest, AnEmptyFileIsAFile) {
    AtomicFile file = open(folder / "out.txt");
    file.commit();
    EXPECT_EQ(fs::file_size(folder / "out.txt"), 0u);
}

TEST_P(AtomicFileTest, TheNewFileHasThePermissionsOfTheUmask) {
    const mode_t before = umask(027);
    AtomicFile file = open(folder / "out.txt");
    file.commit();
    umask(before);
    EXPECT_EQ(fs::status(folder / "out.txt").permissions(), static_cast<fs::perms>(0640));
}

TEST_P(AtomicFileTest, MovingHandsTheTemporaryFileOn) {
    std::optional<AtomicFile> outer;
    {
        AtomicFile inner = open(folder / "out.txt");
        inner.write("kept");
        outer.emplace(std::move(inner));
    }
    AtomicFile other = open(folder / "other.txt");
    EXPECT_EQ(entryCount(), 2 * temporaryEntries());
    other = std::move(*outer); // drops the file that it had
    outer.reset();
    EXPECT_EQ(entryCount(), temporaryEntries());
    other.commit();
    EXPECT_EQ(load(folder / "out.txt"), "kept");
    EXPECT_EQ(entryCount(), 1);
}

TEST_P(AtomicFileTest, TwoWritersOfOneTargetDoNotMeet) {
    AtomicFile first = open(folder / "out.txt");
    AtomicFile second = open(folder / "out.txt");
    first.write("first");
    second.write("second");
    second.commit();
    first.commit();
    EXPECT_EQ(load(folder / "out.txt"), "first");
    EXPECT_EQ(entryCount(), 1);
}

TEST_P(AtomicFileTest, ANameOfTheGreatestLengthCanBeWritten) {
    const std::string name(255, 'n');
    AtomicFile file = open(folder / name);
    file.commit();
    EXPECT_TRUE(fs::exists(folder / name));
    expectRefused(folder / std::string(256, 'n') / "x", "shorter name");
}

TEST_P(AtomicFileTest, ANameInTheWorkingFolderNeedsNoPath) {
    const fs::path before = fs::current_path();
    fs::current_path(folder);
    AtomicFile file = open("out.txt");
    file.commit();
    fs::current_path(before);
    EXPECT_TRUE(fs::exists(folder / "out.txt"));
    EXPECT_EQ(file.path(), "out.txt");
}

TEST_P(AtomicFileTest, ALinkIsWrittenThrough) {
    fs::create_directory(folder / "far");
    store(folder / "far/real.txt", "old");
    fs::create_symlink("far/real.txt", folder / "link1");
    fs::create_symlink(folder / "link1", folder / "link2");
    AtomicFile file = open(folder / "link2");
    file.write("new");
    file.commit();
    EXPECT_TRUE(fs::is_symlink(folder / "link1"));
    EXPECT_TRUE(fs::is_symlink(folder / "link2"));
    EXPECT_EQ(load(folder / "far/real.txt"), "new");
    EXPECT_EQ(entryCount(), 3);
}

TEST_P(AtomicFileTest, ADanglingLinkCreatesWhatItPointsAt) {
    fs::create_symlink("real.txt", folder / "link");
    AtomicFile file = open(folder / "link");
    file.write("new");
    file.commit();
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(load(folder / "real.txt"), "new");
}

TEST_P(AtomicFileTest, LinksInACircleAreRefused) {
    fs::create_symlink("b", folder / "a");
    fs::create_symlink("a", folder / "b");
    expectRefused(folder / "a", "circle");
}

TEST_P(AtomicFileTest, WhatCannotBeWrittenIsRefusedAtOnceAndNothingIsLeft) {
    store(folder / "file", "text");
    fs::create_directory(folder / "sub");
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    expectRefused("", "empty");
    expectRefused(folder / "missing" / "out.txt", "create the folder");
    expectRefused(folder / "file" / "out.txt", "is a file, not a folder");
    expectRefused(folder / "sub", "it is a folder");
    expectRefused(folder / "sub" / "", "names no file");
    expectRefused(folder / "sub" / ".", "it is a folder");
    expectRefused(folder / "pipe", "not a regular file");
    expectRefused("/dev/null", "not a regular file");
    expectRefused("/dev/full", "not a regular file");
    expectRefused("/proc/out.txt", "no file can be created in '/proc'");
    EXPECT_EQ(entryCount(), 3);
    EXPECT_EQ(load(folder / "file"), "text");
}

TEST_P(AtomicFileTest, ProtectedFilesAndFoldersAreRefused) {
    if (geteuid() == 0) { // root may write everywhere
        ASSERT_EQ(refusalOf(folder / "file"), std::nullopt);
        return;
    }
    store(folder / "file", "text");
    fs::permissions(folder / "file", fs::perms::owner_read);
    expectRefused(folder / "file", "write-protected");
    fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
    expectRefused(folder / "new", "make the folder writable");
    fs::permissions(folder, fs::perms::owner_all);
}

TEST_P(AtomicFileTest, AFullDiskIsReportedAndTheOldFileStays) {
    store(folder / "out.txt", "old");
    // A limit on the size of files stands in for the full disk.
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto signalBefore = std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit = before;
    limit.rlim_cur = 4096;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
    std::string message;
    try {
        AtomicFile file = open(folder / "out.txt");
        file.write(std::string(10000, 'x'));
        file.commit();
    } catch (const Error &error) {
        EXPECT_EQ(error.kind, ErrorKind::OutputNotWritten);
        message = error.what();
    }
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, signalBefore);
    EXPECT_NE(message.find("File too large"), std::string::npos) << message;
    EXPECT_EQ(load(folder / "out.txt"), "old");
    EXPECT_EQ(entryCount(), 1);
}

TEST_P(AtomicFileTest, AFailingRenameSaysWhereWhatIsFinishedIs) {
    AtomicFile file = open(folder / "out.txt");
    file.write("new");
    fs::create_directory(folder / "out.txt"); // appears while the render runs
    try {
        file.commit();
        FAIL() << "renamed a file over a folder";
    } catch (const Error &error) {
        EXPECT_EQ(error.kind, ErrorKind::OutputNotWritten);
        for (const fs::directory_entry &entry : fs::directory_iterator(folder)) {
            if (entry.is_directory())
                continue;
            EXPECT_EQ(load(entry.path()), "new");
            EXPECT_NE(std::string(error.what()).find(entry.path().string()), std::string::npos)
                << error.what();
        }
    }
    EXPECT_EQ(entryCount(), 2);
}

TEST_P(AtomicFileTest, ANameThatIsTooLongIsRefusedAtOnce) {
    EXPECT_THROW(static_cast<void>(open(folder / std::string(256, 'e'))), Error);
    EXPECT_EQ(entryCount(), 0);
}

} // namespace
} // namespace hyalite::core
