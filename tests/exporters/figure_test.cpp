#include "exporters/figure.h"

#include <gtest/gtest.h>

#include "tests/core/building/replays.h"

namespace rhombloom {

namespace {

struct Model
{
    Surface surface;
    std::vector<Face> faces;

    explicit Model(const std::string& name) : surface(replays::single(name).surface)
    {
        for (const Face f : surface.faces()) {
            faces.push_back(f);
        }
    }

    FigureScene scene(int view) const { return {&surface, fitted_camera(surface, faces, {view}, Vec2(100, 100))}; }
};

//! The face that covers a point, nearest to the eye, by the planes of its two triangles; none when nothing does.
Face nearest(const FigureScene& scene, const std::vector<Face>& faces, const Vec3& point)
{
    const Vec3 eye = scene.camera.view.toward;
    Face best;
    double most = 1; // mm before the point itself
    for (const Face f : faces) {
        const Quad q = quad(*scene.surface, f);
        for (const auto& [b, c] : {std::pair{1, 2}, std::pair{2, 3}}) {
            Eigen::Matrix3d m;
            m.col(0) = scene.surface->point(Vertex(q[b])) - scene.surface->point(Vertex(q[0]));
            m.col(1) = scene.surface->point(Vertex(q[c])) - scene.surface->point(Vertex(q[0]));
            m.col(2) = -eye;
            const Vec3 x = m.fullPivLu().solve(point - scene.surface->point(Vertex(q[0])));
            if (x[0] > 0.02 && x[1] > 0.02 && x[0] + x[1] < 0.98 && x[2] > most) {
                most = x[2];
                best = f;
            }
        }
    }
    return best;
}

} // namespace

TEST(PainterOrder, DrawsNothingOverWhatIsNearer)
{
    for (const char* name : {"ball-30", "torus-12x6", "tube-6x6", "polar-5x8"}) {
        const Model model(name);
        for (int view = 0; view < static_cast<int>(viewpoints().size()); view += 3) {
            const FigureScene scene = model.scene(view);
            const std::vector<Face> order = painter_order(scene, model.faces);
            ASSERT_EQ(order.size(), model.faces.size());
            for (std::size_t i = 0; i < order.size(); ++i) {
                const Face front = nearest(scene, model.faces, element_centre(model.surface, order[i]));
                const auto at = std::find(order.begin(), order.end(), front) - order.begin();
                EXPECT_TRUE(!front.is_valid() || at >= static_cast<long>(i)) << name << " view " << view;
            }
        }
    }
}

TEST(PainterOrder, DrawsEachFaceOnce)
{
    const Model model("checker-24");
    std::vector<Face> order = painter_order(model.scene(3), model.faces);
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, model.faces);
}

TEST(Camera, ProjectsAsThePageMatrixSays)
{
    const Model model("ball-30");
    const Vec2 centre(150, 200);
    for (int view = 0; view < static_cast<int>(viewpoints().size()); ++view) {
        const Camera camera = model.scene(view).camera;
        const Matrix34 m = page_matrix(camera, centre, 842);
        for (const Vertex v : model.surface.vertices()) {
            const Vec3& p = model.surface.point(v);
            const Vec3 on_page = m.leftCols<3>() * p + m.col(3);
            const Vec2 there = centre + project(camera, p);
            EXPECT_NEAR(on_page.x(), there.x(), 1e-9);
            EXPECT_NEAR(on_page.y(), 842 - there.y(), 1e-9);
            EXPECT_NEAR(on_page.z(), depth(camera, p), 1e-9);
            EXPECT_LE(project(camera, p).cwiseAbs().maxCoeff(), 100 + 1e-9);
        }
    }
}

TEST(SeenPart, IsAllInFrontAndNothingBehind)
{
    const Model model("ball-30");
    const FigureScene scene = model.scene(0);
    const std::vector<Face> order = painter_order(scene, model.faces);
    EXPECT_EQ(seen_part(scene, order.back(), model.faces), 1);
    EXPECT_LT(seen_part(scene, order.front(), model.faces), 0.05);
}

} // namespace rhombloom
