#include <set>

#include <gtest/gtest.h>

#include "core/model/base_shapes.h"
#include "exporters/preview_model.h"

namespace rhombloom {
namespace {

PreviewModel model_of(const std::string& shape, const Element& element = {})
{
    const Surface surface = base_shape(shape, element)->surface;
    PreviewModel model;
    model.bent = *bent_surface(surface, element);
    model.labels = element_labels(surface, {});
    model.components = surface.components;
    model.thickness = element.thickness;
    return model;
}

TEST(PreviewMerged, EveryElementIsInOnePartOfItsSide)
{
    const PreviewModel model = model_of("ball-270");
    const MergedPreview merged = *encoded_merged(model, {});
    EXPECT_GT(merged.parts.size(), 2U);
    std::set<int> seen;
    for (const MergedPart& part : merged.parts) {
        const std::set<int> inside(part.mesh.elements.begin(), part.mesh.elements.end());
        EXPECT_LE(inside.size(), 96U);
        for (const int f : inside) {
            EXPECT_TRUE(seen.insert(f).second) << f;
            EXPECT_EQ(model.bent.elements[f].outward, part.outward) << f;
        }
    }
    EXPECT_EQ(seen.size(), model.bent.elements.size());
}

TEST(PreviewMerged, KeepsEveryToleranceThatMayBeAsked)
{
    const PreviewModel model = model_of("polar-5x4", {40, 44.8, 1.0, 0.25});
    for (const double tolerance : {5.0, 0.05, 0.001}) {
        PreviewOptions options;
        options.tolerance_mm = tolerance;
        const double error = *decoded_error_mm(encoded_merged(model, options)->parts);
        EXPECT_LE(error, tolerance);
        EXPECT_GT(error, 0.5 * tolerance); // no bits are wasted
    }
}

TEST(PreviewMerged, BoundsAreTheDecodedPoints)
{
    const MergedPreview merged = *encoded_merged(model_of("tube-6x6"), {});
    for (const MergedPart& part : merged.parts) {
        Eigen::AlignedBox3f seen;
        Eigen::AlignedBox3f foreseen;
        const DracoMesh decoded = *decompress(part.stream);
        for (const Eigen::Vector3f& p : decoded.points) {
            seen.extend(p);
        }
        for (const Eigen::Vector3f& p : on_grid(part.mesh.points, part.grid)) {
            foreseen.extend(p);
        }
        EXPECT_LT((seen.min() - foreseen.min()).norm(), 1e-6F);
        EXPECT_LT((seen.max() - foreseen.max()).norm(), 1e-6F);
    }
}

TEST(PreviewMerged, AnErrorIsMeasuredWhereverItIs)
{
    MergedPreview merged = *encoded_merged(model_of("polar-5x4"), {});
    merged.parts.back().mesh.points[100].x() += 0.003F;
    EXPECT_NEAR(*decoded_error_mm(merged.parts), 3, 0.2);
}

TEST(PreviewMerged, RefusesWhatDoesNotReadBack)
{
    const MergedPreview merged = *encoded_merged(model_of("polar-3x3"), {});
    std::vector<MergedPart> cut = merged.parts;
    cut[0].stream.bytes.resize(cut[0].stream.bytes.size() / 2);
    EXPECT_FALSE(decoded_error_mm(cut));
    std::vector<MergedPart> other = merged.parts;
    other[0].mesh.triangles.pop_back();
    EXPECT_FALSE(decoded_error_mm(other));
}

} // namespace
} // namespace rhombloom
