// Views: their names and directions, and the files of several.
#include "host/jobs/views.h"

#include <gtest/gtest.h>

#include <string>

namespace hyalite::core {
namespace {

RenderRequest requestFor(const std::string &output, const std::string &report = {}) {
    RenderRequest request;
    request.output = output;
    request.report = report;
    return request;
}

const std::vector<View> frontAndTop{{"front", {0.0, 0.0}}, {"top", {0.0, 90.0}}};

/// The name of the override that is refused.
std::string refusalOf(const RenderRequest &request, const std::vector<View> &views) {
    try {
        static_cast<void>(ViewSeries(request, {views}));
    } catch (const OverrideError &error) {
        return error.name;
    }
    return {};
}

TEST(Views, AroundAreEvenlySpread) {
    const std::vector<View> views = viewsAround(8);
    ASSERT_EQ(views.size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(views[i].name, "contact-" + std::to_string(i + 1));
        EXPECT_EQ(views[i].from.azimuthDegrees, 45.0 * static_cast<double>(i));
        EXPECT_EQ(views[i].from.elevationDegrees, 20.0);
    }
}

TEST(Views, HaveAFileEachWhereTheNameSaysSo) {
    const ViewSeries series(requestFor("out/{view}-of-{view}.exr", "{view}.json"), {frontAndTop});
    EXPECT_FALSE(series.isSheet());
    EXPECT_EQ(series.requestOf(frontAndTop[1]).output, "out/top-of-top.exr");
    EXPECT_EQ(series.requestOf(frontAndTop[1]).report, "top.json");
    EXPECT_EQ(series.requestOf(frontAndTop[1]).view, "top");
}

TEST(Views, SeveralInOnePngAreASheetAndOneIsAPicture) {
    EXPECT_TRUE(ViewSeries(requestFor("a.png"), {frontAndTop}).isSheet());
    EXPECT_FALSE(ViewSeries(requestFor("a.exr"), {{frontAndTop[0]}}).isSheet());
}

TEST(Views, WhatDoesNotFitIsRefused) {
    EXPECT_EQ(refusalOf(requestFor("a.exr"), frontAndTop), "output");
    EXPECT_EQ(refusalOf(requestFor("a.png", "a.json"), frontAndTop), "report");
    EXPECT_EQ(refusalOf(requestFor("{view}.png", "a.json"), frontAndTop), "report");
    EXPECT_EQ(refusalOf(requestFor("a.png"), {frontAndTop[0], frontAndTop[0]}), "views");
    RenderRequest placed = requestFor("a.png");
    placed.scene.cameraPosition = {1, 2, 3};
    EXPECT_EQ(refusalOf(placed, frontAndTop), "camera-position");
    placed = requestFor("a.png");
    placed.scene.load.camera = "0";
    EXPECT_EQ(refusalOf(placed, frontAndTop), "camera");
    EXPECT_EQ(refusalOf(requestFor("a.png"), frontAndTop), "");
}

} // namespace
} // namespace hyalite::core
