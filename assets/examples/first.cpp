// Renders a shipped scene on a Vulkan device, compares it with the CPU twin, and writes it.
#include <hyalite/hyalite.h>

#include <iostream>

int main() {
    try {
        hyalite::Renderer device; // the best one that there is; software is enough
        hyalite::Renderer twin("cpu");
        const hyalite::Scene scene = hyalite::Scene::load("cornell");
        const hyalite::Settings settings{{"spp", 16}, {"width", 128}, {"height", 128}};

        const hyalite::Image image = device.render(scene, settings, {.layers = {"albedo", "depth"}});
        const hyalite::Difference difference = hyalite::diff(twin.render(scene, settings), image);
        std::cout << device.description() << ": "
                  << (difference.isIdentical ? "equal to the CPU twin, bit for bit" : "NOT equal") << "\n";

        image.save("cornell.png");
        image.save("cornell.exr"); // linear, with the layers
        return difference.isIdentical ? 0 : 1;
    } catch (const hyalite::Error &error) {
        std::cerr << hyalite::toText(error.kind()) << ": " << error.what() << "\n";
        return 2;
    }
}
