#include "host/engine/shared_backend.h"

#include "host/base/error.h"
#include "host/engine/shared_render.h"

#include <algorithm>
#include <span>
#include <utility>

namespace hyalite::core {

namespace {

class SharedBackend : public Backend {
  public:
    explicit SharedBackend(std::vector<std::unique_ptr<Backend>> members) {
        for (std::unique_ptr<Backend> &member : members)
            members_.push_back({std::move(member)});
    }

    [[nodiscard]] std::string name() const override {
        return joined([](const Backend &backend) { return backend.name(); });
    }
    [[nodiscard]] std::string description() const override {
        return joined([](const Backend &backend) { return backend.description(); }, "; ");
    }
    [[nodiscard]] RendererIdentity identity(const PackedScene &scene, Integrator integrator) const override {
        std::vector<RendererIdentity> all;
        for (const Member &member : members_) {
            const bool isLast = all.empty() && &member == &members_.back();
            try {
                all.push_back(member.backend->identity(scene, integrator));
            } catch (const Error &) { // it cannot render this, and will be left out
                if (isLast)
                    throw;
            }
        }
        RendererIdentity identity = all.front();
        for (const RendererIdentity &other : std::span(all).subspan(1)) {
            const auto add = [](std::string &text, const std::string &more) {
                if (text != more && !more.empty())
                    text += (text.empty() ? "" : " + ") + more;
            };
            identity.name += " + " + other.name;
            add(identity.driver, other.driver);
            add(identity.arithmetic, other.arithmetic);
            add(identity.equalBits, other.equalBits);
            add(identity.kernel, other.kernel);
            if (identity.kernelHash == 0)
                identity.kernelHash = other.kernelHash;
        }
        return identity;
    }
    [[nodiscard]] gpu::BitGuarantee bits() const override {
        return std::ranges::min_element(members_, {},
                                        [](const Member &member) { return member.backend->bits().degree; })
            ->backend->bits();
    }
    [[nodiscard]] std::string precision() const override { return members_.front().backend->precision(); }
    [[nodiscard]] bool hasCompiler() const override {
        return std::ranges::any_of(members_,
                                   [](const Member &member) { return member.backend->hasCompiler(); });
    }

    [[nodiscard]] BackendResult render(const PackedScene &scene, const RenderSettings &settings, Film begun,
                                       const RenderHooks &hooks) override {
        if (hooks.timeline != nullptr)
            throw Error(ErrorKind::Usage, "dispatches are measured on one device at a time");
        return renderShared(members_, scene, settings, std::move(begun), hooks);
    }
    [[nodiscard]] std::vector<layout::TraceEvent> trace(const PackedScene &scene,
                                                        const RenderSettings &settings,
                                                        const glm::uvec2 &pixel,
                                                        std::uint32_t sampleIndex) override {
        return members_.front().backend->trace(scene, settings, pixel, sampleIndex);
    }
    /// By the first member that is not left out: a tile takes less time than to agree on who does it.
    [[nodiscard]] Image denoise(const NoisyPicture &picture) override {
        const auto member = std::ranges::find_if_not(members_, &Member::isLeftOut);
        return (member == members_.end() ? members_.front() : *member).backend->denoise(picture);
    }

  private:
    template <class Text>
    [[nodiscard]] std::string joined(const Text &text, const char *between = " + ") const {
        std::string all;
        for (const Member &member : members_)
            all += (all.empty() ? "" : between) + text(*member.backend);
        return all;
    }

    std::vector<Member> members_;
};

} // namespace

std::unique_ptr<Backend> shareBackends(std::vector<std::unique_ptr<Backend>> members) {
    return std::make_unique<SharedBackend>(std::move(members));
}

} // namespace hyalite::core
