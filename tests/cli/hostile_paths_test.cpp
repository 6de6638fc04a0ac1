// A scene from a stranger reads nothing but what came with it, and waits for nothing.
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

namespace hyalite::core::testing {
namespace {

namespace fs = std::filesystem;

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

std::string sceneWithMesh(const std::string &file) {
    return R"({"materials": {"m": {"type": "mirror"}}, "meshes": [{"file": ")" + file +
           R"(", "material": "m"}]})";
}

struct HostilePaths : CommandLine {
    void SetUp() override {
        CommandLine::SetUp();
        fs::create_directories(folder / "scene/sub");
        fs::create_directory(folder / "other");
        store("scene/mesh.obj", triangle);
        store("scene/sub/mesh.obj", triangle);
        store("other/mesh.obj", triangle);
        store("scene.obj", triangle); // its name begins as the folder's does
    }

    void expectTaken(const std::string &file, const std::string &options = "") const {
        store("scene/scene.json", sceneWithMesh(file));
        const Outcome outcome = run("inspect scene/scene.json" + options);
        EXPECT_EQ(outcome.exitCode, 0) << file << options << outcome;
    }
    void expectOutOfReach(const std::string &file, const std::string &leadsTo,
                          const std::string &options = "") const {
        store("scene/scene.json", sceneWithMesh(file));
        expectFailure(
            "inspect scene/scene.json" + options, 3,
            {"scene.json: /meshes/0/file: ", "leads to " + leadsTo, "--allow-path", "scene's folder"});
    }
};

TEST_F(HostilePaths, ASceneReadsItsOwnFolder) {
    for (const char *file :
         {"mesh.obj", "./mesh.obj", "sub/mesh.obj", "sub/../mesh.obj", "../scene/mesh.obj"})
        expectTaken(file);
    expectTaken((folder / "scene/mesh.obj").string());
    fs::create_symlink("sub/mesh.obj", folder / "scene/link.obj");
    fs::create_directory_symlink("sub", folder / "scene/link");
    expectTaken("link.obj");
    expectTaken("link/mesh.obj");
    // The folder itself may be reached through a link, and may be the working directory.
    fs::create_directory_symlink("scene", folder / "alias");
    EXPECT_EQ(run("inspect alias/scene.json").exitCode, 0);
    store("here.json", sceneWithMesh("scene/mesh.obj"));
    EXPECT_EQ(run("inspect here.json").exitCode, 0);
    EXPECT_EQ(run("inspect ./here.json").exitCode, 0);
}

TEST_F(HostilePaths, ASceneReadsTheAssets) { expectTaken(HYALITE_ASSET_DIR "/scenes/cat.obj"); }

TEST_F(HostilePaths, ASceneDoesNotLeaveItsFolder) {
    const std::string root = fs::canonical(folder).string();
    expectOutOfReach("../other/mesh.obj", root + "/other/mesh.obj");
    expectOutOfReach("../scene.obj", root + "/scene.obj");
    expectOutOfReach((folder / "other/mesh.obj").string(), root + "/other/mesh.obj");
    expectOutOfReach("/etc/passwd", "/etc/passwd");
    // Whether the file exists is not told either.
    expectOutOfReach("/no/such/file.obj", "/no/such/file.obj");
    expectOutOfReach("sub/../../other/mesh.obj", root + "/other/mesh.obj");
}

TEST_F(HostilePaths, NorThroughLinks) {
    const std::string root = fs::canonical(folder).string();
    fs::create_symlink("../other/mesh.obj", folder / "scene/link.obj");
    expectOutOfReach("link.obj", root + "/other/mesh.obj");
    fs::create_directory_symlink("../other", folder / "scene/link");
    expectOutOfReach("link/mesh.obj", root + "/other/mesh.obj");
    expectOutOfReach("link/../scene.obj", root + "/scene.obj"); // .. of where the link leads
    fs::create_symlink("/dev/zero", folder / "scene/zero.obj");
    expectOutOfReach("zero.obj", "/dev/zero");
    fs::create_symlink("loop.obj", folder / "scene/loop.obj");
    store("scene/scene.json", sceneWithMesh("loop.obj"));
    expectFailure("inspect scene/scene.json", 3, {"/meshes/0/file", "loop.obj"});
}

TEST_F(HostilePaths, UnlessItIsAllowed) {
    expectTaken("../other/mesh.obj", " --allow-path other");
    expectTaken("../other/mesh.obj", " --allow-path /");
    expectTaken("../other/mesh.obj", " --allow-path other/mesh.obj");
    expectTaken("../other/mesh.obj", " --allow-path scene --allow-path other");
    expectOutOfReach("../scene.obj", fs::canonical(folder).string() + "/scene.obj", " --allow-path other");
    store("scene/scene.json", sceneWithMesh("../other/mesh.obj"));
    EXPECT_EQ(run("inspect --allow-path other scene/scene.json").exitCode, 0);
    EXPECT_GT(litPixelCount(
                  renderImage("scene/scene.json --allow-path other --width 8 --height 8 --spp 1 --device cpu "
                              "--camera-position 0.25,0.25,1 --background 1,1,1")),
              0);
    expectFailure("inspect scene/scene.json --allow-path missing", 2, {"--allow-path", "missing"});
    expectFailure("inspect scene/scene.json --allow-path ''", 2, {"--allow-path"});
}

TEST_F(HostilePaths, NothingButRegularFilesIsOpened) {
    ASSERT_EQ(mkfifo((folder / "scene/pipe.obj").c_str(), 0600), 0);
    const int listener = socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string name = (folder / "scene/socket.obj").string();
    ASSERT_LT(name.size(), sizeof address.sun_path);
    name.copy(address.sun_path, name.size());
    ASSERT_EQ(bind(listener, reinterpret_cast<const sockaddr *>(&address), sizeof address), 0);
    close(listener);

    store("scene/scene.json", sceneWithMesh("pipe.obj"));
    expectFailure("inspect scene/scene.json", 3, {"pipe.obj", "a pipe, not a regular file"});
    store("scene/scene.json", sceneWithMesh("socket.obj"));
    expectFailure("inspect scene/scene.json", 3, {"socket.obj", "a socket, not a regular file"});
    store("scene/scene.json", sceneWithMesh("sub"));
    expectFailure("inspect scene/scene.json", 3, {"sub", "a folder, not a regular file"});
    store("scene/scene.json", sceneWithMesh("/dev/zero"));
    expectFailure("inspect scene/scene.json --allow-path /", 3,
                  {"/dev/zero", "a device, not a regular file"});
    // A regular file without a size, each byte of which is somebody's memory.
    store("scene/scene.json", sceneWithMesh("/proc/self/mem"));
    expectFailure("inspect scene/scene.json --allow-path /", 3, {"/mem", "no triangle"});

    ASSERT_EQ(mkfifo((folder / "pipe.json").c_str(), 0600), 0);
    expectFailure("inspect scene/pipe.obj", 3, {"a pipe"});
    expectFailure("inspect pipe.json", 3, {"a pipe"});
    expectFailure("diff pipe.json pipe.json", 3, {"a pipe"});
    expectFailure("diff /dev/zero /dev/zero", 3, {"/dev/zero", "a device"});
    expectFailure("profile spheres --spp 1 --baseline pipe.json", 3, {"a pipe"});
}

TEST_F(HostilePaths, WhatIsNoFileInTheFolderIsNoMaterialLibrary) {
    ASSERT_EQ(mkfifo((folder / "pipe.mtl").c_str(), 0600), 0);
    for (const char *library : {"pipe.mtl", "/dev/zero", "/proc/self/mem", ".", "missing.mtl"}) {
        store("mesh.obj", std::string("mtllib ") + library + "\nusemtl " + library + '\n' + triangle);
        EXPECT_EQ(run("inspect mesh.obj").exitCode, 0) << library;
    }
}

} // namespace
} // namespace hyalite::core::testing
