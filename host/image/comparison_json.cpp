#include "host/image/comparison_json.h"

namespace hyalite::core {

namespace {

nlohmann::ordered_json colourToJson(const glm::vec3 &colour) { return {colour.x, colour.y, colour.z}; }

nlohmann::ordered_json flipToJson(const ImageComparison &comparison) {
    nlohmann::ordered_json flip;
    flip["kind"] = comparison.encoding == Encoding::Linear ? "HDR" : "LDR";
    flip["pixelsPerDegree"] = flipPixelsPerDegree;
    flip["mean"] = comparison.flip.mean;
    flip["weightedMedian"] = comparison.flip.weightedMedian;
    flip["max"] = comparison.flip.max;
    if (comparison.flipExposures) {
        flip["startStops"] = comparison.flipExposures->startStops;
        flip["stopStops"] = comparison.flipExposures->stopStops;
        flip["exposureCount"] = comparison.flipExposures->count;
    }
    return flip;
}

nlohmann::ordered_json alphaToJson(const AlphaMetrics &alpha, int width) {
    const std::size_t side = static_cast<std::size_t>(width);
    return {{"inReference", alpha.hasReference},
            {"inTest", alpha.hasTest},
            {"identical", alpha.identical()},
            {"differingPixelCount", alpha.differingPixelCount},
            {"maxDifference", alpha.maxAbsoluteDifference},
            {"meanAbsoluteDifference", alpha.meanAbsoluteDifference},
            {"worstPixel", {{"x", alpha.worstIndex % side}, {"y", alpha.worstIndex / side}}}};
}

} // namespace

nlohmann::ordered_json comparisonToJson(const ImageComparison &comparison, const Image &reference,
                                        const Image &test) {
    const PixelMetrics &pixels = comparison.pixels;
    const bool isLinear = comparison.encoding == Encoding::Linear;
    nlohmann::ordered_json json;
    json["width"] = reference.width();
    json["height"] = reference.height();
    json["encoding"] = isLinear ? "linear" : "display";
    json["identical"] = comparison.identical();
    json["pixelCount"] = pixels.pixelCount;
    json["differingPixelCount"] = pixels.differingPixelCount;
    json["outlierCount"] = pixels.outlierCount;
    json["outlierFraction"] = pixels.outlierFraction();
    json["nonFiniteCount"] = pixels.nonFiniteCount;
    json["maxDifference"] = pixels.maxAbsoluteDifference;
    if (!pixels.identical()) {
        nlohmann::ordered_json worst;
        worst["x"] = pixels.worstX;
        worst["y"] = pixels.worstY;
        worst["reference"] = colourToJson(reference.at(pixels.worstX, pixels.worstY));
        worst["test"] = colourToJson(test.at(pixels.worstX, pixels.worstY));
        json["worstPixel"] = worst;
    }
    if (isLinear)
        json["maxUlpDistance"] = pixels.maxUlpDistance;
    json["meanAbsoluteDifference"] = pixels.meanAbsoluteDifference;
    json["meanDifference"] = pixels.meanDifference;
    json["mse"] = pixels.meanSquaredError;
    json["psnrDecibels"] = pixels.psnrDecibels();
    if (comparison.ssim)
        json["ssim"] = *comparison.ssim;
    else
        json["ssim"] = nullptr;
    json["flip"] = flipToJson(comparison);
    if (comparison.alpha)
        json["alpha"] = alphaToJson(*comparison.alpha, reference.width());
    return json;
}

} // namespace hyalite::core
