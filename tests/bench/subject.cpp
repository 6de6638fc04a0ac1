#include "tests/bench/subject.h"

#include "host/scene/framing.h"
#include "tests/bench/meshes.h"

namespace hyalite::bench {

namespace {

gpu::DeviceInfo chosenDevice;

} // namespace

const gpu::DeviceInfo &device() { return chosenDevice; }

void chooseBenchDevice(const std::string &name) {
    chosenDevice = gpu::chooseDevice(gpu::listDevices(), name);
}

Subject &Subject::get(const std::string &meshName) {
    static std::string keptName;
    static std::unique_ptr<Subject> kept;
    if (keptName != meshName) {
        kept.reset();
        kept = std::make_unique<Subject>(meshName);
        keptName = meshName;
    }
    return *kept;
}

Subject::Subject(const std::string &meshName) : scene_(frameMesh(loadMesh(meshName))) {}

const PackedScene &Subject::packed() {
    if (!packed_)
        packed_ =
            packScene(scene_, buildBvh(TreeKind::Sah, buildTriangles(scene_), scene_.settings.leafSize));
    return *packed_;
}

const RaySet &Subject::rays(RayKind kind) {
    const auto found = rays_.find(kind);
    return found != rays_.end() ? found->second : rays_.emplace(kind, makeRays(packed(), kind)).first->second;
}

gpu::RayScene &Subject::onDevice(bool isSkipList) {
    return onDevice_.try_emplace(isSkipList, device(), packed(), isSkipList).first->second;
}

const EmbreeScene &Subject::embree() {
    if (!embree_) {
        embree_ = std::make_unique<EmbreeScene>(mesh());
        embree_->commit();
    }
    return *embree_;
}

} // namespace hyalite::bench
