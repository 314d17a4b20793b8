#include <gtest/gtest.h>

#include "apps/studio/server/geometry.h"
#include "apps/studio/server/guard.h"
#include "apps/studio/server/kit_job.h"
#include "apps/studio/server/merge_preview.h"
#include "core/design/pose.h"
#include "core/model/base_shapes.h"
#include "core/model/element_stretch.h"

namespace rhombloom::studio {
namespace {

Provenance right_post()
{
    return {"POST", "/api/apply", {"127.0.0.1:8000"}, {"http://127.0.0.1:8000"}, {"same-origin"}, {"secret"}};
}

TEST(Guard, LetsItsOwnPageIn)
{
    const Guard guard(8000, "secret");
    EXPECT_EQ(guard.refusal(right_post()), 0);
    EXPECT_EQ(guard.refusal({"GET", "/", {"localhost:8000"}, {}, {"none"}, {}}), 0);
}

TEST(Guard, KeepsEverybodyElseOut)
{
    const Guard guard(8000, "secret");
    Provenance other_name = right_post();
    other_name.host = {"rebound.example:8000"};
    EXPECT_EQ(guard.refusal(other_name), 421);
    Provenance other_page = right_post();
    other_page.origin = {"http://localhost:8000"}; // ours, but not the one that was asked
    EXPECT_EQ(guard.refusal(other_page), 403);
    Provenance no_token = right_post();
    no_token.token.clear();
    EXPECT_EQ(guard.refusal(no_token), 403);
    Provenance reads = right_post();
    reads.method = "GET";
    reads.path = "/api/state";
    reads.token = {"Secret"};
    EXPECT_EQ(guard.refusal(reads), 403);
}

TEST(RandomToken, IsNewEveryTime)
{
    EXPECT_EQ(random_token().size(), 32u);
    EXPECT_NE(random_token(), random_token());
}

TEST(Zip, GivesTheSameBytesForTheSameFiles)
{
    const FileSet files = {{"README.txt", "cut the coupon first"}, {"cut/sheet-01.svg", std::string(5000, 'x')}};
    const auto first = zip(files, "kit");
    ASSERT_TRUE(first);
    EXPECT_EQ(first->substr(0, 2), "PK");
    EXPECT_NE(first->find("kit/cut/sheet-01.svg"), std::string::npos);
    EXPECT_EQ(*zip(files, "kit"), *first);
}

TEST(Strain, IsNothingInAFlatElement)
{
    const Element element;
    const auto sheet = base_shape("sheet-1x1", element);
    ASSERT_TRUE(sheet);
    Surface surface = sheet->surface;
    embed(surface, element);
    EXPECT_NEAR(element_stretch(surface, element, Face(0)), 0, 1e-6);
    for (const Vertex v : surface.vertices()) {
        surface.set_point(v, 1.02 * surface.point(v));
    }
    EXPECT_NEAR(element_stretch(surface, element, Face(0)), 0.02, 1e-6);
}

TEST(Strain, OfTheWorstElementIsTheLargestStretchOfTheEmbedding)
{
    const Element element;
    auto ball = base_shape("ball-90", element);
    ASSERT_TRUE(ball);
    const EmbedReport report = embed(ball->surface, element);
    double largest = -1;
    for (const Face f : ball->surface.faces()) {
        largest = std::max(largest, element_stretch(ball->surface, element, f));
    }
    EXPECT_NEAR(largest, report.max_stretch, 1e-9);
    EXPECT_LT(largest, 0.01);
}

//! Two balls, the second moved along z.
MergeQuestion balls(double apart)
{
    auto scene = std::make_shared<Scene>();
    MergeQuestion question;
    for (const char* id : {"body", "head"}) {
        auto shape = base_shape("ball-30", question.element);
        embed_in_place(shape->surface, question.element, {});
        scene->parts.push_back({id, shape->surface, {}});
    }
    question.scene = scene;
    question.on = "body";
    question.with = "head";
    question.motion.translate(Vec3(0, 0, apart));
    return question;
}

TEST(MergePreview, ShowsWhatTheMergeMakes)
{
    MergePreview preview;
    const MergeQuestion question = balls(170);
    Surface head = question.scene->parts[1].surface;
    for (const Vertex v : head.vertices()) {
        head.set_point(v, question.motion * head.point(v));
    }
    for (const int candidate : {1, 0}) {
        const MergeAnswer answer = preview.answer(question, candidate);
        const auto merged = merge(question.scene->parts[0].surface, head, question.element, candidate);
        ASSERT_EQ(answer.surface != nullptr, merged.has_value());
        if (merged) {
            EXPECT_EQ(answer.surface->n_faces(), merged->surface.n_faces());
        }
    }
}

TEST(MergePreview, GivesTheReasonAndAHintThatWorks)
{
    MergePreview preview;
    const MergeQuestion apart = balls(300);
    EXPECT_NE(preview.answer(apart, 0).reason.find("do not touch"), std::string::npos);
    const auto hint = merge_hint(apart, 30);
    ASSERT_TRUE(hint);
    EXPECT_EQ(hint->kind, "closer");
    MergeQuestion closer = apart;
    closer.motion = hint->motion * apart.motion;
    EXPECT_NE(preview.answer(closer, 0).surface, nullptr);
}

} // namespace
} // namespace rhombloom::studio
