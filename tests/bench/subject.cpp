#include "tests/bench/subject.h"

#include "host/scene/framing.h"
#include "tests/bench/meshes.h"

#include <algorithm>

namespace hyalite::core::bench {

// By its index: names of devices may be alike.
Context::Context(gpu::DeviceInfo device)
    : device_(std::move(device)), targets_{{"device", std::to_string(device_.index)}} {}

void Context::addTarget(Target target) {
    while (std::ranges::find(targets_, target.name, &Target::name) != targets_.end())
        target.name += ", another";
    targets_.push_back(std::move(target));
}

Subject &Context::subject(const std::string &meshName) {
    if (subjectName_ != meshName) {
        subject_.reset(); // before the next one is made
        subject_ = std::make_unique<Subject>(meshName, device_);
        subjectName_ = meshName;
    }
    return *subject_;
}

Subject::Subject(const std::string &meshName, const gpu::DeviceInfo &device)
    : device_(device), scene_(frameMesh(loadMesh(meshName))) {}

const PackedScene &Subject::packed() {
    if (!packed_)
        packed_ = packScene(scene_, buildBvh(TreeKind::Sah, scene_, RenderSettings{}.leafSize));
    return *packed_;
}

const RaySet &Subject::rays(RayKind kind) {
    const auto found = rays_.find(kind);
    return found != rays_.end() ? found->second : rays_.emplace(kind, makeRays(packed(), kind)).first->second;
}

gpu::RayScene &Subject::onDevice(const gpu::KernelRow &kernel) {
    return onDevice_.try_emplace({kernel.tree, kernel.memory}, device_, packed(), kernel).first->second;
}

const EmbreeScene &Subject::embree() {
    if (!embree_) {
        embree_ = std::make_unique<EmbreeScene>(mesh());
        embree_->commit();
    }
    return *embree_;
}

} // namespace hyalite::core::bench
